"""Parts of a book: headings of its contents on every page and in the editions."""

from collections.abc import Callable
from xml.etree.ElementTree import Element

from support.html_outline import read_html
from support.little_book import OUTLINE, rendered

from site_builder.build import Options
from site_builder.editions.compose import compose
from site_builder.editions.tree import elements, parse
from site_builder.editions.volume import volume
from site_builder.pages.environment import render_template
from site_builder.sources.parts import part_titles

PARTED = OUTLINE + '[parts]\nMotion = "second"\n'
type MakeBook = Callable[..., Options]


def test_a_part_ends_where_the_next_begins() -> None:
    titles = part_titles({"M": "b", "H": "d"}, ["a", "b", "c", "d", "e"])
    assert titles == ["", "M", "M", "H", "H"]


def test_the_title_page_and_the_contents_of_every_page_name_the_parts(make_book: MakeBook) -> None:
    site = rendered(make_book(files={"content/book.toml": PARTED}))
    title_page = read_html(site["index.html"])
    assert [each.text for each in title_page.all("h3")] == ["Motion"]
    (part,) = read_html(site["first/index.html"]).all("li", "contents-division")
    assert part.inside[-2:] == ("nav", "ol")
    assert [each.text for each in title_page.all("p") if each.inside[-1] == "li"] == ["Motion"]


def test_the_contents_of_both_editions_name_the_parts(make_book: MakeBook) -> None:
    composed = compose(make_book(files={"content/book.toml": PARTED}))
    nav = parse(render_template("editions/epub-nav.html", composed.book, composed=composed))
    (part,) = (item for item in elements(nav, "li") if item.find("{*}span") is not None)
    assert links(part) == ["second.xhtml", "second.xhtml#a-section"]
    contents = next(elements(volume(composed), kind="volume-contents"))
    assert [child.tag for child in contents] == ["h1", "ol", "h2", "ol"]
    assert links(contents[-1]) == ["#second", "#second.a-section"]


def links(element: Element) -> list[str]:
    return [link.attrib["href"] for link in elements(element, "a")]
