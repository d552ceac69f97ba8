"""All pages of the site."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from markupsafe import Markup

from site_builder.cache.hashing import hash_of
from site_builder.cache.results import cached_result
from site_builder.diagnostics.progress import advance, counting
from site_builder.document.blocks import Block
from site_builder.document.book import Book, Chapter
from site_builder.document.places import Heading
from site_builder.files.engine import book_or_engine_file
from site_builder.files.folders import folder_hash
from site_builder.markdown.directives.simulation import SIMULATION
from site_builder.pages.back_matter import back_matter_pages, card, titled
from site_builder.pages.embeds import embeds
from site_builder.pages.environment import FOLDERS
from site_builder.pages.licences import Licence
from site_builder.pages.policy import json_for_html
from site_builder.pages.single_page import Site, render_page
from site_builder.pages.views.question import class_data
from site_builder.pages.views.simulation import thumbnail
from site_builder.references.bibliography import NO_WORKS


def render_pages(site: Site, licences: tuple[Licence, ...]) -> dict[str, bytes]:
    """Every page of the site, by its path."""
    book, following = site.book, back_matter_pages(site.book)
    render = _renderer(site, titled(following, book.words))
    wanted: dict[str, tuple[str, dict[str, Any]]] = {}

    def add(template: str, path: str, **context: object) -> None:
        wanted[path] = template, context

    add("landing", "index.html", **_title_page(site))
    add("licences", "licences/index.html", licences=licences)
    if any(chapter.quizzes for chapter in book.chapters):
        add("class", "class/index.html", questions=class_data(book))
    for name, context in following.items():
        add(name, f"{name}/index.html", here=name, **context)
    for chapter, context in _chapter_pages(book):
        add("chapter", f"{chapter.url}index.html", **context)
    for path in sorted({item.path for chapter in book.chapters for item in chapter.sources}):
        folder, _, file = path.rpartition("/")
        code = book_or_engine_file(site.root, path).read_text(encoding="utf-8-sig")
        address = f"source/{path.removesuffix('.py')}/index.html"
        add("source", address, folder=folder, file=file, code=code)
    for chapter in book.chapters:
        for path, figure in embeds(chapter):
            # So many pages link to the style sheet rather than hold it.
            add("embed", path, chapter=chapter, cover=figure, styles="")
    pages = {"404.html": render("not-found.html")}  # which is served at any address
    with counting("pages", len(wanted)):
        for path, (template, context) in wanted.items():
            pages[path] = render(f"{template}.html", path, **context)
            advance()
    return pages


def _title_page(site: Site) -> dict[str, Any]:
    book = site.book
    return {
        "cover": Block(SIMULATION.template, book.hero) if book.hero else None,
        "starts": book.starts,
        "stops": book.stops,
        "thumbnails": {item.id: thumbnail(item, site.initial_frames) for item in book.chapters},
        "counts": {
            "chapters": sum(not chapter.is_appendix for chapter in book.chapters),
            "simulations": len(book.scenes),
            "questions": sum(len(chapter.quizzes) for chapter in book.chapters),
        },
        "progress": _progress(book),
    }


def _chapter_pages(book: Book) -> Iterator[tuple[Chapter, dict[str, Any]]]:
    """Each chapter with the context of its page."""
    cards = [None, *map(card, book.chapters), None]
    for index, chapter in enumerate(book.chapters):
        context = {
            "chapter": chapter,
            "sections": nest_headings(chapter.headings),
            "place": index + 1,
            "previous": cards[index],
            "following": cards[index + 2],
        }
        yield chapter, context


def _renderer(site: Site, follows: Sequence[tuple[str, str]]) -> Callable[..., bytes]:
    """Makes the pages of a site, whose contents list what ``follows`` the chapters. Those of
    chapters and listings are cached by what all share and what they are given; their initial frames
    follow from their figures."""
    shared = replace(site, root=Path(), book=_cards_only(site.book), initial_frames={})
    shared_hash = hash_of(shared, follows, *(folder_hash(folder, "*.html") for folder in FOLDERS))
    seen = replace(shared, initial_frames=site.initial_frames)

    def render(template: str, path: str = "", **context: Any) -> bytes:
        root = "../" * path.count("/") or "./"

        def make() -> bytes:
            html = render_page(seen, template, root, path, back_matter=follows, **context)
            return html.encode()

        if not (template == "source.html" or isinstance(context.get("chapter"), Chapter)):
            return make()  # sooner than what it shows of all chapters is hashed
        return cached_result("page", (shared_hash, template, path, context), make)

    return render


def _cards_only(book: Book) -> Book:
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
        stops=(),
        chapters=cards,
        bibliography=NO_WORKS,
        lecture_plan=None,
        search_words=(),
        glossary=tuple(glossary),
        symbols={},
    )


def _progress(book: Book) -> Markup:
    """The editions of all questions by their ids, from which a reader's progress is counted."""
    quizzes = (quiz for chapter in book.chapters for quiz in chapter.quizzes)
    return json_for_html({quiz.id: quiz.edition for quiz in quizzes})


def nest_headings(headings: tuple[Heading, ...]) -> list[tuple[Heading, list[Heading]]]:
    """Sections of level 2, each with its subsections of level 3."""
    sections: list[tuple[Heading, list[Heading]]] = []
    for heading in headings:
        if heading.level == 2:
            sections.append((heading, []))
        elif heading.level == 3 and sections:
            sections[-1][1].append(heading)
    return sections
