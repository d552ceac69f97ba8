"""The page numbers behind links, for paper."""

from collections.abc import Mapping
from xml.etree.ElementTree import Element

from site_builder.editions.tree import elements

PAGE_OF = "data-page-of"
"""Names the element whose page is to be printed here."""
PAGE_AS = "data-page-as"
"""In which words, with ``{page}`` for the number."""
UNKNOWN = "000"
"""Stands for a number while none is known: as wide as most."""


class PageNumberError(ValueError):
    """A place to which a number leads is on no page."""


def page_number(anchor: str, kind: str, words: str = "{page}") -> Element:
    """Where a number is to be printed in these words: ``kind`` is its class."""
    return Element("span", {"class": kind, PAGE_OF: anchor, PAGE_AS: words})


def fill(root: Element, pages: Mapping[str, int] | None) -> None:
    """Print the page of each anchor; before pages are known, what is as wide.

    Raises `PageNumberError` naming the anchors that are on no page.
    """
    asked = [element for element in elements(root) if PAGE_OF in element.attrib]
    missing = {element.get(PAGE_OF, "") for element in asked} - set(pages or ())
    if pages is not None and missing:
        raise PageNumberError(f"anchors on no page: {', '.join(sorted(missing))}")
    for element in asked:
        number = str(pages[element.get(PAGE_OF, "")]) if pages else UNKNOWN
        element.text = element.get(PAGE_AS, "{page}").replace("{page}", number)
