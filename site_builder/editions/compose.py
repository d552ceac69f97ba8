"""The book as both editions on paper have it: the site's own pages, reduced, and the answers."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import groupby
from operator import attrgetter
from xml.etree.ElementTree import Element

from site_builder.assets.pages import Files, gather_assets
from site_builder.build import Options, check_site
from site_builder.document.blocks import Simulation
from site_builder.document.book import Book, Chapter
from site_builder.editions.multiples import Row, render_rows
from site_builder.editions.tree import elements, parse
from site_builder.pages.back_matter import BACK_MATTER, back_matter_pages
from site_builder.pages.licences import Licence, gather_licences
from site_builder.pages.page import Site, render_page
from site_builder.pages.views.question import numbered_quizzes
from site_builder.render.paper import paper_renderer
from site_builder.runtime.pinned import Versions

ANSWERS = "answers"


@dataclass(frozen=True, slots=True)
class Section:
    """A chapter, or what follows the last."""

    id: str
    """Id of a chapter; else ``answers``, or one of `BACK_MATTER`."""
    title: str
    number: str
    """``Chapter 4``, ``Appendix A``; nothing for what follows."""
    article: Element
    """Its links are those of the site, from ``ID/index.html``."""
    headings: tuple[tuple[str, str], ...] = ()
    """Id and HTML of what the contents list below its title."""
    part: str = ""
    """Title of the part of the book that it is in; nothing where it is in none."""


@dataclass(frozen=True, slots=True)
class Composed:
    """What an edition is made from."""

    book: Book
    sections: tuple[Section, ...]
    cover: str
    """Address of the title page's picture, relative to the site's root; nothing without one."""
    assets: str
    """Folder of the files, relative to the site's root."""
    files: Files
    licences: tuple[Licence, ...]

    @property
    def parts(self) -> tuple[tuple[str, tuple[Section, ...]], ...]:
        """Title and sections of each."""
        groups = groupby(self.sections, attrgetter("part"))
        return tuple((title, tuple(sections)) for title, sections in groups)

    @property
    def ids(self) -> tuple[str, ...]:
        return tuple(section.id for section in self.sections)


def compose(options: Options) -> Composed:
    """Read, check and render the book. Raises `BuildError` with all mistakes found."""
    book, initial_frames, pictures, _ = check_site(options)
    rows, row_pictures = render_rows(book, initial_frames)
    assets = gather_assets(book, options.root, {**pictures, **row_pictures}, {})
    site = Site(options.root, book, initial_frames, assets.folder, "")
    licences = gather_licences(options.root, Versions(), settings=book.settings, words=book.words)
    sections = [
        *(_chapter(site, chapter, rows) for chapter in book.chapters),
        *_answers(site),
        *_back_matter(site),
    ]
    cover = ""
    if book.hero:
        shown = initial_frames[book.hero.path, book.hero.line].pictures.values()
        cover = next((f"{assets.folder}stills/{picture.file}" for picture in shown), "")
    return Composed(book, tuple(sections), cover, assets.folder, assets.files, licences)


def _chapter(site: Site, chapter: Chapter, rows: Mapping[tuple[str, str], Row]) -> Section:
    def row_of(figure: Simulation) -> Row | None:
        return rows.get((chapter.id, figure.id))

    html = render_page(site, "chapter.html", "../", rows=row_of, chapter=chapter, sections=())
    words = paper_renderer()
    headings = tuple((item.id, words(item.words)) for item in chapter.headings if item.level == 2)
    return Section(chapter.id, chapter.title, chapter.name, parse(html), headings, chapter.part)


def _back_matter(site: Site) -> Iterator[Section]:
    """What the site has of it."""
    for id, context in back_matter_pages(site.book).items():
        html = render_page(site, f"{id}.html", "../", rows=_no_rows, **context)
        yield Section(id, site.book.words(BACK_MATTER[id]), "", parse(html))


def _no_rows(_figure: Simulation) -> None:
    return None


def _answers(site: Site) -> Iterator[Section]:
    chapters = [
        (chapter, questions)
        for chapter in site.book.chapters
        if (questions := list(numbered_quizzes(chapter.body)))
    ]
    if chapters:
        html = render_page(site, "editions/answers.html", "../", rows=_no_rows, chapters=chapters)
        article = parse(html)
        for (chapter, _), answers in zip(
            chapters, elements(article, kind="answers-of"), strict=True
        ):
            for link in elements(answers, "a"):
                if (place := link.get("href", "")).startswith("#"):  # on the question's page
                    link.set("href", f"../{chapter.url}{place}")
        yield Section(ANSWERS, site.book.words("edition.answers"), "", article)
