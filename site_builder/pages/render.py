"""From the page model to HTML, by templates. No markup is made here."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from markupsafe import Markup

from site_builder.book import Book, Chapter
from site_builder.cache import cached_result
from site_builder.engine_files import own_or_engine
from site_builder.figures.initial_frames import InitialFrames, describing
from site_builder.files import folder_hash
from site_builder.hashing import hash_of
from site_builder.markdown.directives.illustration import Drawn as Illustration
from site_builder.markdown.directives.simulation import SIMULATION
from site_builder.page_model.blocks import Block, Simulation
from site_builder.page_model.places import Heading
from site_builder.pages.embedding import json_for_html
from site_builder.pages.embeds import FOLDER as EMBED_FOLDER
from site_builder.pages.embeds import embeds
from site_builder.pages.environment import FOLDERS, book_context, template_environment
from site_builder.pages.licences import Licence
from site_builder.pages.outside import card_path, origin, page_address
from site_builder.pages.reading_time import reading_minutes
from site_builder.pages.term_lists import card
from site_builder.pages.versions import Version, versions_of
from site_builder.pages.views.class_page import class_data
from site_builder.pages.views.glossary import view_glossary
from site_builder.pages.views.index import view_index
from site_builder.pages.views.references import cited_works
from site_builder.pages.views.simulation import SimulationView, view_simulation
from site_builder.pages.views.symbols import view_symbols
from site_builder.pages.views.thumbnail import thumbnail
from site_builder.references.bibliography import EMPTY
from site_builder.render.paper import paper_renderer
from site_builder.translations.labels import figure_markup

BACK_MATTER = {
    "glossary": "glossary.title",
    "symbols": "symbols.title",
    "references": "references.title",
    "index-of-terms": "index.title",
    "lecture-plan": "plan.title",
}
"""Pages that follow the chapters, by address, and the keys of their titles; a book has those that
it has something for."""
FIRST_FACES = ("serif-regular.woff2", "sans-regular.woff2")
"""Of what a reader meets first: text, and the line above it."""


@dataclass(frozen=True, slots=True)
class Site:
    """What all pages share."""

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
    """Of assets that pages name, as in W3C Subresource Integrity."""


def render_pages(site: Site, licences: tuple[Licence, ...]) -> dict[str, bytes]:
    """Every page of the site, by its path."""
    book, render = site.book, _renderer(site, back_matter(site.book))
    pages: dict[str, bytes] = {}

    def add(template: str, path: str, **context: object) -> None:
        pages[path] = render(f"{template}.html", path, **context)

    add("landing", "index.html", **_title_page(site))
    pages["404.html"] = render("not-found.html")  # which is served at any address
    add("licences", "licences/index.html", licences=licences)
    if quizzes := [quiz for chapter in book.chapters for quiz in chapter.quizzes]:
        draws = any(quiz.others for quiz in quizzes)
        add("class", "class/index.html", questions=class_data(book), draws=draws)
    for name, context in back_matter_pages(book).items():
        add(name, f"{name}/index.html", here=name, **context)
    for chapter, context in _chapter_pages(book):
        add("chapter", f"{chapter.url}index.html", **context)
    for path in sorted({item.path for chapter in book.chapters for item in chapter.sources}):
        folder, _, file = path.rpartition("/")
        code = own_or_engine(site.root, path).read_text(encoding="utf-8-sig")
        address = f"source/{path.removesuffix('.py')}/index.html"
        add("source", address, folder=folder, file=file, code=code)
    for chapter in book.chapters:
        for path, figure in embeds(chapter):
            # So many pages link to the style sheet rather than hold it.
            add("embed", path, chapter=chapter, cover=figure, styles="")
    return pages


def render_translation(site: Site, original: Book) -> dict[str, bytes]:
    """The pages of a translation, whose book ``site`` has: its title page, and the chapters that
    are translated."""
    book = site.book
    follows = [(address, book.words(BACK_MATTER[address])) for address, _ in back_matter(original)]
    render = _renderer(site, follows)
    title_page = f"{book.folder}index.html"
    pages = {title_page: render("landing.html", title_page, **_title_page(site))}
    for chapter, context in _chapter_pages(book):
        if chapter.folder:
            path = f"{chapter.url}index.html"
            pages[path] = render("chapter.html", path, **context)
    return pages


def _title_page(site: Site) -> dict[str, Any]:
    book = site.book
    return {
        "cover": Block(SIMULATION.template, book.hero) if book.hero else None,
        "starts": book.starts,
        "thumbnails": {item.id: thumbnail(item, site.initial_frames) for item in book.chapters},
        "counts": _counts(book),
        "progress": _progress(book),
    }


def _chapter_pages(book: Book) -> Iterator[tuple[Chapter, dict[str, Any]]]:
    """Each chapter with the context of its page."""
    cards = [None, *map(card, book.chapters), None]
    for index, chapter in enumerate(book.chapters):
        yield (
            chapter,
            {
                "chapter": chapter,
                "sections": nest_headings(chapter.headings),
                "place": index + 1,
                "previous": cards[index],
                "following": cards[index + 2],
            },
        )


def back_matter_pages(book: Book) -> dict[str, dict[str, Any]]:
    """The contexts of the templates of the pages after the chapters, by address."""
    found: dict[str, dict[str, Any]] = {
        "glossary": {"letters": view_glossary(book)} if book.glossary else {},
        "symbols": {"chapters": view_symbols(book)} if book.symbols else {},
        "references": {"works": cited_works(book)} if book.bibliography.works else {},
        "index-of-terms": {"letters": letters} if (letters := view_index(book)) else {},
        "lecture-plan": {"plan": book.lecture_plan} if book.lecture_plan else {},
    }
    return {name: context for name, context in found.items() if context}


def _renderer(site: Site, follows: Sequence[tuple[str, str]]) -> Callable[..., bytes]:
    """Makes the pages of a site, whose contents list what ``follows`` the chapters. Those of
    chapters are cached by what all share and what they are given; their initial frames follow from
    their figures."""
    shared = replace(site, root=Path(), book=_bare(site.book), initial_frames={})
    shared_hash = hash_of(shared, follows, *(folder_hash(folder, "*.html") for folder in FOLDERS))
    seen = replace(shared, initial_frames=site.initial_frames)

    def render(template: str, path: str = "", **context: Any) -> bytes:
        root = "../" * path.count("/") or "./"

        def make() -> bytes:
            html = render_page(seen, template, root, path, back_matter=follows, **context)
            return html.encode()

        chapter = context.get("chapter")
        if not isinstance(chapter, Chapter):
            return make()
        return cached_result("page", (shared_hash, template, path, context), make)

    return render


def _bare(book: Book) -> Book:
    """The part of the book that every page shows: cards of chapters, and no line numbers."""
    cards: tuple[Any, ...] = tuple(map(card, book.chapters))
    glossary = (
        replace(item, explained=item.explained and replace(item.explained, line=0))
        for item in book.glossary
    )
    return replace(
        book,
        hero=None,
        starts=(),
        chapters=cards,
        bibliography=EMPTY,
        lecture_plan=None,
        glossary=tuple(glossary),
        symbols={},
    )


def render_page(
    site: Site,
    template: str,
    root: str,
    path: str = "",
    rows: Callable[[Simulation], object] | None = None,
    **context: object,
) -> str:
    """One page, or a part of one. ``root`` is the site's root relative to it, ``path`` its own
    place below that; nothing where it has none to be known by. With ``rows``, which finds the small
    multiples of a figure, it is XHTML for paper."""
    environment = template_environment()
    assets = f"{root}{site.assets}"
    given = context.get("chapter")
    chapter = given if isinstance(given, Chapter) else None
    figures = chapter.simulations if chapter else ()

    def simulation_view(figure: Simulation) -> SimulationView:
        return view_simulation(
            site.initial_frames[figure.path, figure.line], assets, site.book.words
        )

    def block_html(block: Block) -> Markup:
        template = environment.get_template(f"blocks/{block.template}.html")
        html = template.render(
            shared,
            block=block.content,
            inside=block.inside,
            target=block.target,
            chapter=chapter,
        )
        is_figure = isinstance(block.content, Simulation | Illustration)
        return Markup(figure_markup(html, site.book.words) if is_figure else html)

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
        "row_of": rows,
        "minutes": reading_minutes(chapter, describing(site.initial_frames)) if chapter else 0,
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
            "versions": _versions(site.book, template, chapter),
            **context,
        },
    )


def _versions(book: Book, template: str, chapter: Chapter | None) -> tuple[Version, ...]:
    """Only title pages and chapters are translated."""
    there = template in ("landing.html", "chapter.html")
    return versions_of(book, chapter) if there else ()


def _scenes(chapter: Chapter | None, cover: object) -> tuple[str, ...]:
    """The scenes of a page, which starts Python at once if it has any."""
    figures = chapter.simulations if chapter else ()
    if isinstance(cover, Block) and isinstance(cover.content, Simulation):
        figures = (cover.content,)
    return tuple(dict.fromkeys(figure.scene.id for figure in figures))


def back_matter(book: Book) -> list[tuple[str, str]]:
    """Address and title of the pages that the contents list after the chapters."""
    marked = any(chapter.index_marks for chapter in book.chapters)
    there = {
        "glossary": book.glossary,
        "symbols": book.symbols,
        "references": book.bibliography.works,
        "index-of-terms": book.glossary or marked,
        "lecture-plan": book.lecture_plan,
    }
    return [(address, book.words(key)) for address, key in BACK_MATTER.items() if there[address]]


def _counts(book: Book) -> dict[str, int]:
    return {
        "chapters": sum(not chapter.is_appendix for chapter in book.chapters),
        "simulations": len(book.scenes),
        "questions": sum(len(chapter.quizzes) for chapter in book.chapters),
    }


def _progress(book: Book) -> Markup:
    """Questions and their editions by chapter, from which a reader's progress is counted; one that
    draws numbers has several."""
    return json_for_html(
        {
            chapter.id: {
                quiz.id: [variant.edition for variant in quiz.variants] for quiz in chapter.quizzes
            }
            for chapter in book.chapters
        }
    )


def nest_headings(headings: tuple[Heading, ...]) -> list[tuple[Heading, list[Heading]]]:
    """Sections of level 2, each with its subsections of level 3."""
    sections: list[tuple[Heading, list[Heading]]] = []
    for heading in headings:
        if heading.level == 2:
            sections.append((heading, []))
        elif heading.level == 3 and sections:
            sections[-1][1].append(heading)
    return sections
