"""Records of the search: addresses, and where the book introduces a term."""

from collections.abc import Callable, Mapping, Sequence

from site_builder.build import Options, check_site
from site_builder.search.records import Record, explained_terms, make_records


def records_of(pages: Mapping[str, bytes], explained: Mapping[str, Sequence[str]]) -> list[Record]:
    return [record for page in make_records(pages, explained) for record in page]


def page(body: str) -> bytes:
    return f"<article data-searched><h1>Title</h1>{body}</article>".encode()


def test_a_section_is_found_at_its_heading_and_an_opening_at_its_page() -> None:
    records = records_of({"first/index.html": page('<p>A.</p><h2 id="b">B</h2><p>C.</p>')}, {})
    assert [(r.address, r.chapter, r.title) for r in records] == [
        ("first/", "Title", ""),
        ("first/#b", "Title", "B"),
    ]


def test_a_term_is_introduced_where_the_book_first_emphasises_it_below_a_heading() -> None:
    section = '<h2 id="s">S</h2><p><strong>Pose.</strong></p>'
    records = records_of(
        {
            "first/index.html": page(f"<p><em>pose</em></p>{section}"),
            "second/index.html": page(section),
        },
        {},
    )
    assert [r.introduced for r in records] == [("pose",), ("Pose",), (), ()]


def test_pages_that_are_not_marked_are_not_found() -> None:
    assert records_of({"licences/index.html": b"<article><h1>Licences</h1></article>"}, {}) == []


def test_a_section_says_which_terms_of_the_glossary_it_explains() -> None:
    pages = {"first/index.html": page('<p>A.</p><h2 id="b">B</h2><p>C.</p>')}
    records = records_of(pages, {"first/#b": ["pose"]})
    assert [record.explains for record in records] == [(), ("pose",)]


def test_a_section_is_found_by_what_its_author_marked_for_the_index(
    make_book: Callable[..., Options],
) -> None:
    book, *_ = check_site(make_book("Text.\n\n## Discs\n\nIt cuts {index}`a disc <bokeh>`.\n"))
    assert explained_terms(book) == {"first/#discs": ["bokeh"]}
