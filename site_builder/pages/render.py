"""From the page model to HTML, by templates. No markup is made here."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from site_builder.book import (
    Block,
    Book,
    Callout,
    CaptionedTable,
    Example,
    HardCases,
    Heading,
    Illustration,
    LadderFigure,
    LadderTable,
    Listing,
    Prose,
    Quiz,
    Simulation,
    StageCostTable,
)
from site_builder.markdown.text.code import highlighted_lines
from site_builder.pages.embedding import json_for_html
from site_builder.pages.ladder_view import summary_row, view_ladder
from site_builder.pages.licences import Licence
from site_builder.pages.simulation_view import view_figure
from site_builder.pages.stills import Stills

TEMPLATES = Path(__file__).parents[1] / "templates"
BLOCK_TEMPLATES: Mapping[type, str] = {
    Prose: "prose",
    Simulation: "simulation",
    Quiz: "quiz",
    Callout: "callout",
    Example: "example",
    Listing: "source",
    Illustration: "figure",
    CaptionedTable: "table",
    LadderFigure: "ladder",
    LadderTable: "ladder-table",
    StageCostTable: "stage-costs",
    HardCases: "extremes",
}


@dataclass(frozen=True, slots=True)
class Site:
    """What all pages share."""

    root: Path
    """The project: where quoted modules lie."""
    book: Book
    stills: Stills
    assets: str
    """Folder of style sheets, scripts, fonts and stills, relative to the site's root."""
    runtime: str
    """Folder of the browser's Python, relative to the site's root; nothing without a runtime."""
    reload: bool = False
    """Whether pages reload themselves when the site has been built anew."""


def render_pages(site: Site, licences: tuple[Licence, ...]) -> dict[str, bytes]:
    """Every page of the site, by its path."""
    pages = {
        "index.html": _page(site, "landing.html", "./", counts=_counts(site.book)),
        "404.html": _page(site, "not-found.html", "./"),
        "licences/index.html": _page(site, "licences.html", "../", licences=licences),
    }
    chapters = site.book.chapters
    for index, chapter in enumerate(chapters):
        pages[f"{chapter.url}index.html"] = _page(
            site,
            "chapter.html",
            "../",
            chapter=chapter,
            sections=nest_headings(chapter.headings),
            previous=chapters[index - 1] if index else None,
            following=chapters[index + 1] if index + 1 < len(chapters) else None,
        )
    return {path: page.encode() for path, page in {**pages, **_source_pages(site)}.items()}


def _source_pages(site: Site) -> dict[str, str]:
    """The modules that chapters quote from, whole."""
    pages = {}
    for path in sorted({item.path for ch in site.book.chapters for item in ch.listings}):
        address = f"source/{path.removesuffix('.py')}/index.html"
        code = (site.root / path).read_text(encoding="utf-8")
        pages[address] = _page(
            site,
            "source.html",
            "../" * address.count("/"),
            folder=path.rpartition("/")[0],
            file=path.rpartition("/")[2],
            lines=highlighted_lines(code, "python"),
        )
    return pages


def _page(site: Site, template: str, root: str, **context: object) -> str:
    """One page. ``root`` is the site's root relative to it."""
    environment = _environment()
    assets = f"{root}{site.assets}"

    def block_html(block: Block) -> Markup:
        name = BLOCK_TEMPLATES[type(block)]
        extra: dict[str, object] = {}
        if isinstance(block, Simulation):
            extra["view"] = view_figure(site.stills[block.path, block.line], assets)
        if isinstance(block, Quiz):
            extra["data"] = quiz_data(block)
        if isinstance(block, LadderFigure):
            extra["view"] = view_ladder(block)
        if isinstance(block, LadderTable):
            extra["rows"] = [summary_row(measured) for measured in block.rows]
            extra["anchors"] = getattr(context.get("chapter"), "anchors", ())
        return Markup(
            environment.get_template(f"blocks/{name}.html").render(
                block=block, block_html=block_html, assets=assets, root=root, **extra
            )
        )

    return environment.get_template(template).render(
        site=site,
        book=site.book,
        root=root,
        assets=assets,
        runtime=f"{root}{site.runtime}" if site.runtime else "",
        block_html=block_html,
        **{"chapter": None, **context},
    )


@cache
def _environment() -> Environment:
    """Kept, so that each template is compiled once a build and not once a page."""
    return Environment(
        loader=FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )


def _counts(book: Book) -> dict[str, int]:
    return {
        "chapters": len(book.chapters),
        "simulations": len(book.scenes),
        "questions": sum(len(chapter.quizzes) for chapter in book.chapters),
    }


def nest_headings(headings: tuple[Heading, ...]) -> list[tuple[Heading, list[Heading]]]:
    """Sections of level 2, each with its subsections of level 3."""
    sections: list[tuple[Heading, list[Heading]]] = []
    for heading in headings:
        if heading.level == 2:
            sections.append((heading, []))
        elif heading.level == 3 and sections:
            sections[-1][1].append(heading)
    return sections


def quiz_data(quiz: Quiz) -> Markup:
    """What the page's script needs to answer at once."""
    return json_for_html(
        {
            "id": quiz.id,
            "kind": quiz.kind,
            "options": [
                {"correct": option.correct, "explanation_html": option.explanation_html}
                for option in quiz.options
            ],
        }
    )
