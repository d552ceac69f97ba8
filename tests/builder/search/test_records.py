"""Records of the search: addresses, and where the book introduces a term."""

from collections.abc import Callable

from site_builder.build import Options, check_site
from site_builder.search.records import Record, explained_terms, make_records


def records_of(options: Options) -> list[Record]:
    book, *_ = check_site(options)
    made = make_records(book, lambda _figure: "")
    return [record for page in made for record in page]


def test_a_section_is_found_at_its_heading_and_an_opening_at_its_page(
    make_book: Callable[..., Options],
) -> None:
    records = records_of(make_book("A.\n\n## B\n\nC.\n"))
    assert [(r.address, r.chapter, r.title) for r in records][:2] == [
        ("first/", "First", ""),
        ("first/#b", "First", "B"),
    ]


def test_a_term_is_introduced_where_the_book_first_emphasises_it_below_a_heading(
    make_book: Callable[..., Options],
) -> None:
    records = records_of(make_book("A *pose*.\n\n## S\n\n**Pose.**\n\n## T\n\nA *pose*.\n"))
    assert [r.introduced for r in records][:3] == [("pose",), ("Pose",), ()]


def test_a_section_is_found_by_what_its_author_marked_for_the_index(
    make_book: Callable[..., Options],
) -> None:
    options = make_book("Text.\n\n## Discs\n\nIt cuts {index}`a disc <bokeh>`.\n")
    book, *_ = check_site(options)
    assert explained_terms(book) == {"first/#discs": ["bokeh"]}
    assert [r.explains for r in records_of(options) if r.title == "Discs"] == [("bokeh",)]
