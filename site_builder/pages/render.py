"""From the page model to HTML, by templates. No markup is made here."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from site_builder.book import Block, Book, Chapter, Definition, Heading, Simulation
from site_builder.book_root import own_or_engine
from site_builder.kept.files import folder_hash
from site_builder.kept.keeper import given_hash, kept_as
from site_builder.markdown.directives.simulation import SIMULATION
from site_builder.markdown.text.code import highlighted_lines
from site_builder.pages.glossary_view import marked_terms, view_glossary
from site_builder.pages.index_view import view_index
from site_builder.pages.ladder_view import summary_row, view_ladder
from site_builder.pages.licences import Licence
from site_builder.pages.places import Card, card
from site_builder.pages.predict_view import predict_data, view_sketch
from site_builder.pages.progress_view import progress_data
from site_builder.pages.quiz_view import in_any_order, quiz_data
from site_builder.pages.references_view import cited_works
from site_builder.pages.simulation_view import SimulationView, view_simulation
from site_builder.pages.stills import Stills
from site_builder.pages.symbols_view import view_symbols
from site_builder.search.page_text import reading_minutes

TEMPLATES = Path(__file__).parents[1] / "templates"
BACK_MATTER = {
    "glossary": "Glossary",
    "symbols": "Symbols",
    "references": "References",
    "index-of-terms": "Index of terms",
    "lecture-plan": "A lecturer’s plan",
}
"""Pages that follow the chapters, by address; a book has those that it has something for."""
FILTERS: Mapping[str, Callable[..., object]] = {
    "quiz_data": quiz_data,
    "in_any_order": in_any_order,
    "predict_data": predict_data,
    "view_sketch": view_sketch,
    "view_ladder": view_ladder,
    "summary_row": summary_row,
    "reading_minutes": reading_minutes,
    "marked_terms": marked_terms,
    "highlighted": lambda code: highlighted_lines(code, "python"),
}
"""What templates ask for where they show more than lies ready in the page model."""


@dataclass(frozen=True, slots=True)
class Frame:
    """The book as every page may show it: of its chapters the cards, and no line of a file."""

    title: str
    subtitle: str
    prerequisites: str
    chapters: tuple[Card, ...]
    glossary: tuple[Definition, ...]
    back_matter: tuple[tuple[str, str], ...]
    """Address and title of the pages that the contents list after the chapters."""


@dataclass(frozen=True, slots=True)
class Look:
    """What of a `Site` is the same for every page, whatever the book says."""

    assets: str
    runtime: str
    code_editor: bool
    search: bool
    reload: bool


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
    code_editor: bool = False
    """Whether readers can rewrite the Python of a figure, or only read it."""
    search: bool = False
    """Whether there is an index to search."""
    reload: bool = False
    """Whether pages reload themselves when the site has been built anew."""


def render_pages(site: Site, licences: tuple[Licence, ...]) -> dict[str, bytes]:
    """Every page of the site, by its path."""
    book, render = site.book, _renderer(site)
    pages = {
        "index.html": render(
            "landing.html",
            "./",
            counts=_counts(book),
            cover=_cover(book),
            progress=progress_data(book),
        ),
        "404.html": render("not-found.html", "./"),
        "licences/index.html": render("licences.html", "../", licences=licences),
    }
    if book.bibliography.works:
        works = cited_works(book)
        pages["references/index.html"] = render(
            "references.html", "../", here="references", works=works
        )
    if plan := book.lecture_plan:
        pages["lecture-plan/index.html"] = render(
            "lecture-plan.html", "../", here="lecture-plan", plan=plan
        )
    cards = [None, *map(card, book.chapters), None]
    for index, chapter in enumerate(book.chapters):
        pages[f"{chapter.url}index.html"] = render(
            "chapter.html",
            "../",
            chapter=chapter,
            sections=nest_headings(chapter.headings),
            place=index + 1,
            previous=cards[index],
            following=cards[index + 2],
        )
    if book.glossary:
        pages["glossary/index.html"] = render(
            "glossary.html", "../", here="glossary", letters=view_glossary(book)
        )
    if book.symbols:
        pages["symbols/index.html"] = render(
            "symbols.html", "../", here="symbols", chapters=view_symbols(book)
        )
    if letters := view_index(book):
        pages["index-of-terms/index.html"] = render(
            "index-of-terms.html", "../", here="index-of-terms", letters=letters
        )
    for path in sorted({item.path for chapter in book.chapters for item in chapter.sources}):
        address = f"source/{path.removesuffix('.py')}/index.html"
        pages[address] = render(
            "source.html",
            "../" * address.count("/"),
            folder=path.rpartition("/")[0],
            file=path.rpartition("/")[2],
            code=own_or_engine(site.root, path).read_text(encoding="utf-8"),
        )
    return pages


def _renderer(site: Site) -> Callable[..., bytes]:
    """Makes the pages of a site, each kept by what all share and what it is given. The stills of a
    page follow from its figures, which it is given."""
    frame, look = _frame(site.book), _look(site)
    shared = given_hash(frame, look, folder_hash(TEMPLATES))

    def render(template: str, root: str, **context: object) -> bytes:
        def make() -> bytes:
            return _render(frame, look, site.stills, template, root, context).encode()

        return kept_as("page", (shared, template, root, context), make)[0]

    return render


def _frame(book: Book) -> Frame:
    return Frame(
        book.title,
        book.subtitle,
        book.prerequisites,
        tuple(map(card, book.chapters)),
        tuple(
            replace(item, explained=item.explained and replace(item.explained, line=0))
            for item in book.glossary
        ),
        tuple(_back_matter(book)),
    )


def _look(site: Site) -> Look:
    return Look(site.assets, site.runtime, site.code_editor, site.search, site.reload)


def render_page(site: Site, template: str, root: str, **context: object) -> str:
    """One page, or a part of one. ``root`` is the site's root relative to it."""
    return _render(_frame(site.book), _look(site), site.stills, template, root, context)


def _render(
    frame: Frame,
    look: Look,
    stills: Stills,
    template: str,
    root: str,
    context: Mapping[str, object],
) -> str:
    environment = _environment()
    assets = f"{root}{look.assets}"
    chapter = context.get("chapter")

    def simulation_view(figure: Simulation) -> SimulationView:
        return view_simulation(stills[figure.path, figure.line], assets)

    def block_html(block: Block) -> Markup:
        template = environment.get_template(f"blocks/{block.template}.html")
        return Markup(
            template.render(shared, block=block.content, inside=block.inside, target=block.target)
        )

    shared = {
        "root": root,
        "assets": assets,
        "anchors": chapter.anchors if isinstance(chapter, Chapter) else (),
        "python": bool(look.runtime),
        "code_editor": look.code_editor,
        "block_html": block_html,
        "simulation_view": simulation_view,
    }
    return environment.get_template(template).render(
        shared,
        site=look,
        book=frame,
        back_matter=frame.back_matter,
        runtime=f"{root}{look.runtime}" if look.runtime else "",
        **{"chapter": None, "here": "", "sections": (), **context},
    )


def render_template(template: str, **context: object) -> str:
    """What needs nothing of the site."""
    return _environment().get_template(template).render(**context)


@cache
def _environment() -> Environment:
    """Kept, so that each template is compiled once a build and not once a page."""
    environment = Environment(
        loader=FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters.update(FILTERS)
    return environment


def _cover(book: Book) -> Block | None:
    """The figure of the landing page."""
    hero = book.hero
    return Block(SIMULATION.template, hero) if hero else None


def _back_matter(book: Book) -> list[tuple[str, str]]:
    """Address and title of the pages that the contents list after the chapters."""
    marked = any(chapter.index_marks for chapter in book.chapters)
    there = {
        "glossary": book.glossary,
        "symbols": book.symbols,
        "references": book.bibliography.works,
        "index-of-terms": book.glossary or marked,
        "lecture-plan": book.lecture_plan,
    }
    return [(address, title) for address, title in BACK_MATTER.items() if there[address]]


def _counts(book: Book) -> dict[str, int]:
    return {
        "chapters": sum(not chapter.is_appendix for chapter in book.chapters),
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
