"""Numbers, and references that say them: right in every order of the chapters."""

from collections.abc import Callable, Mapping

import pytest
from support.html_outline import Page, read_html
from support.little_book import files_of, rendered

from site_builder.build import Options

type MakeBook = Callable[..., Options]

IN_ORDER = 'chapters = ["00-first", "01-second"]\n'
SWAPPED = 'chapters = ["01-second", "00-first"]\n'
APPENDED = 'chapters = ["00-first"]\nappendices = ["01-second"]\n'


def outline(order: str) -> str:
    return f'title = "T"\nsubtitle = "S"\nprerequisites = "P"\n{order}'


def pages(make_book: MakeBook, order: str) -> Mapping[str, Page]:
    files = {**files_of("references"), "content/book.toml": outline(order)}
    site = rendered(make_book(files=files))
    return {name: read_html(site[f"{name}/index.html"]) for name in ("first", "second")}


def numbers(page: Page) -> list[str]:
    return [link.text.strip() for link in page.all("a", "numbered")]


def references(page: Page) -> list[str]:
    return [" ".join(link.text.split()) for link in page.all("a", "reference")]


@pytest.mark.parametrize(
    ("order", "page", "expected"),
    [
        (
            IN_ORDER,
            "first",
            "(0.1), (0.2), Figure 0.1, Figure 0.2, Example 0.1, Table 0.1, Question 0.1",
        ),
        (IN_ORDER, "second", "(1.1), Figure 1.1, Figure 1.2"),
        (APPENDED, "second", "(A.1), Figure A.1, Figure A.2"),
    ],
)
def test_each_kind_of_thing_has_its_own_count_in_a_chapter(
    make_book: MakeBook, order: str, page: str, expected: str
) -> None:
    assert ", ".join(numbers(pages(make_book, order)[page])) == expected


def test_references_name_what_they_lead_to(make_book: MakeBook) -> None:
    assert references(pages(make_book, IN_ORDER)["second"]) == [
        "Chapter 0 (First)",
        "Chapter 0",
        "Equation (0.1)",
        "Figure 0.1",
        "Figure 0.2",
        "Table 0.1",
        "Example 0.1",
        "Question 0.1",
        "“Shared words” in Chapter 0",
        "“Shared words”",
        "the number 0.1",
    ]


def test_swapped_chapters_change_every_number_and_no_address(make_book: MakeBook) -> None:
    before, after = (pages(make_book, order) for order in (IN_ORDER, SWAPPED))
    swap = str.maketrans("01", "10")
    for name in before:
        assert [text.translate(swap) for text in marked(before[name])] == marked(after[name])
        assert addresses(before[name]) == addresses(after[name])


def marked(page: Page) -> list[str]:
    """What says the number of a chapter; the thing's own number is left out."""
    texts = [*numbers(page), *references(page), page.all("p", "chapter-number")[0].text]
    return [text.partition(".")[0] for text in texts]


def addresses(page: Page) -> list[str | None]:
    return [
        link.attributes["href"]
        for kind in ("numbered", "reference", "anchor")
        for link in page.all("a", kind)
    ]


def test_sections_equations_and_figures_can_be_linked_to_by_their_readers(
    make_book: MakeBook,
) -> None:
    first = pages(make_book, IN_ORDER)["first"]
    ids = {element.attributes.get("id") for element in first.elements}
    links = [*first.all("a", "anchor"), *first.all("a", "numbered")]
    assert len(links) == 8
    assert {(link.attributes["href"] or "").removeprefix("#") for link in links} <= ids
    anchor = first.all("a", "anchor")[0]
    assert anchor.attributes["aria-label"] == "Link to Shared words"
