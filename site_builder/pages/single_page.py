"""One page of the site or of an edition, from its template. No markup is made here."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from markupsafe import Markup

from site_builder.benchmarks.quoted_numbers import read_level_costs
from site_builder.document.blocks import Block, Simulation, contents
from site_builder.document.book import OUTLINE, Book, Chapter
from site_builder.figures.initial_frames import InitialFrames
from site_builder.pages.embeds import EMBED_FOLDER
from site_builder.pages.environment import book_context, template_environment
from site_builder.pages.views.simulation import SimulationView, view_simulation
from site_builder.references.bibliography import FILE as BIBLIOGRAPHY
from site_builder.references.terms import GLOSSARY, SYMBOLS
from site_builder.render.minutes import count_programs, reading_minutes
from site_builder.render.screen import paper_renderer
from site_builder.settings.declared import PATH
from site_builder.sources.outline import LECTURE_PLAN

BOOK_CARD = "card.png"
CARDS = "cards"
MODULES = "source/"
MADE_FROM = {
    "index.html": OUTLINE,
    "licences/index.html": "LICENSE",
    "references/index.html": BIBLIOGRAPHY,
    "lecture-plan/index.html": LECTURE_PLAN,
    "glossary/index.html": GLOSSARY,
    "symbols/index.html": SYMBOLS,
    "index-of-terms/index.html": GLOSSARY,
}
"""Pages other than those of chapters and modules, and their source files."""


def page_address(path: str) -> str:
    """Address of a file of the site, from the site's root: ``lens-distortion/``."""
    return path.removesuffix("index.html")


def card_path(chapter: Chapter | None) -> str:
    """Where the card of a chapter is, from the site's root; the book's for what is no chapter."""
    return f"{CARDS}/{chapter.id}.png" if chapter else BOOK_CARD


def origin(book: Book, path: str, chapter: Chapter | None) -> str:
    """Where the source of a page can be read; nothing where that is not known."""
    if chapter:
        file = chapter.path
    elif path.startswith(MODULES):
        file = f"{path.removeprefix(MODULES).removesuffix('/index.html')}.py"
    else:
        file = MADE_FROM.get(path, "")
    return book.source.replace(PATH, file) if file else ""


FIRST_FACES = ("serif-regular.woff2", "sans-regular.woff2")
"""Part that a reader meets first: text, and the line above it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Site:
    root: Path
    """The project, with the modules that chapters quote."""
    book: Book
    initial_frames: InitialFrames
    assets: str
    """Folder of style sheets, scripts, fonts and stills, relative to the site's root."""
    runtime: str
    """Folder of the browser's Python, relative to the site's root; nothing without a runtime."""
    sources: str = ""
    """Hash of the simulations that this Python has: those that drew the stills."""
    table: str = ""
    """Hash of the table of this Python's files, which has the hashes of all others."""
    code_editor: bool = False
    """Whether readers can rewrite the Python of a figure, or only read it."""
    search: bool = False
    """Whether there is an index to search."""
    scripts: tuple[str, ...] = ()
    """What the pages' script imports, below ``assets``."""
    reload: bool = False
    """Whether pages reload themselves when the site has been built anew."""
    styles: str = ""
    """The style sheet, with addresses relative to its folder, which each page holds;
    nothing where pages link to it."""
    hashes: Mapping[str, str] = field(default_factory=dict)
    """Hashes of assets that pages name, as in W3C Subresource Integrity."""


def render_page(
    site: Site,
    template: str,
    root: str,
    path: str = "",
    rows: Mapping[str, object] | None = None,
    **context: object,
) -> str:
    """One page, or a part of one. ``root`` is the site's root relative to it, ``path`` its own
    place below that; nothing where it has none to be known by. With ``rows``, the small
    multiples of figures by their ids, it is XHTML for paper."""
    environment = template_environment()
    assets = f"{root}{site.assets}"
    given = context.get("chapter")
    chapter = given if isinstance(given, Chapter) else None
    figures = chapter.simulations if chapter else ()

    def simulation_view(figure: Simulation) -> SimulationView:
        recorded = read_level_costs(site.root, figure.scene.id)
        still = replace(site.initial_frames[figure.path, figure.line], figure=figure)
        return view_simulation(still, assets, site.book.words, recorded)

    def block_html(block: Block) -> Markup:
        template = environment.get_template(f"blocks/{block.template}.html")
        return Markup(
            template.render(
                shared,
                block=block.content,
                inside=block.inside,
                target=block.target,
                chapter=chapter,
            )
        )

    def integrity(name: str) -> Markup:
        known = site.hashes.get(name)
        return Markup(' integrity="{}"').format(known) if known else Markup()

    shared = {
        **book_context(site.book),
        **({} if rows is None else {"renderer": paper_renderer()}),
        "root": root,
        "assets": assets,
        "anchors": chapter.anchors if chapter else (),
        "later_figures": [figure.id for figure in figures[1:]] if rows is None else (),
        "python": bool(site.runtime),
        "code_editor": site.code_editor,
        "embed_folder": EMBED_FOLDER,
        "block_html": block_html,
        "simulation_view": simulation_view,
        "paper": rows is not None,
        "rows": rows or {},
        "minutes_of": reading_minutes,
        "programs_in": count_programs,
    }
    return environment.get_template(template).render(
        shared,
        site=site,
        runtime=f"{root}{site.runtime}" if site.runtime else "",
        first_faces=FIRST_FACES,
        integrity=integrity,
        address=page_address(path) if path and site.book.address else None,
        card=card_path(chapter),
        scenes=_scenes(chapter, context.get("cover")) if site.runtime else (),
        origin=origin(site.book, path, chapter),
        **{
            "styles": site.styles.replace('url("../', f'url("{assets}'),
            "chapter": None,
            "here": "",
            "sections": (),
            "back_matter": (),
            **context,
        },
    )


def _scenes(chapter: Chapter | None, cover: object) -> tuple[str, ...]:
    """The scenes that a page shows unfolded; it starts Python at once if it has any."""
    figures = tuple(contents(chapter.first_pass, Simulation)) if chapter else ()
    if isinstance(cover, Block) and isinstance(cover.content, Simulation):
        figures = (cover.content,)
    return tuple(dict.fromkeys(figure.scene.id for figure in figures))
