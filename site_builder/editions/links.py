"""The targets of a page's links: in the book, out of it, or missing on paper."""

import re
from collections.abc import Callable, Collection
from dataclasses import dataclass
from urllib.parse import unquote, urljoin
from xml.etree.ElementTree import Element

ABSOLUTE = re.compile(r"[a-z][a-z0-9+.-]*:", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Place:
    """A page of the book, or an element in it."""

    page: str
    """Its id: a chapter's, or ``references``."""
    id: str
    """Element id; nothing for the page as a whole."""


def is_external(address: str) -> bool:
    return ABSOLUTE.match(address) is not None


def on_site(href: str, page: str) -> str:
    """Where a link of a page leads from outside the book; nothing where it leads nowhere, as
    ``page``, the address of the page, is nothing for a book without an address."""
    if is_external(href):
        return href
    return urljoin(page, href) if href and page else ""


def place_of(address: str, page: str, pages: Collection[str]) -> Place | None:
    """The target of ``address`` on ``page``; None where that is none of ``pages``.

    The settings in a link to a figure are left out.
    """
    path, _, fragment = address.partition("#")
    target = urljoin(f"{page}/", path.partition("?")[0]).strip("/")
    return Place(target, unquote(fragment)) if target in pages else None


def bind_links(
    content: Element, page: str, pages: Collection[str], address_of: Callable[[Place], str]
) -> list[tuple[Element, Element, Place]]:
    """Give the links of a page to places in the book their address there; those to places that are
    not in it become plain text. Returns each link with its parent and its place."""
    bound = []
    for parent, link in [(each, child) for each in content.iter() for child in each]:
        address = link.get("href")
        if link.tag != "a" or address is None or is_external(address):
            continue
        place = place_of(address, page, pages)
        if place is None:
            link.tag = "span"
            link.attrib.pop("href", None)
        else:
            link.set("href", address_of(place))
            bound.append((parent, link, place))
    return bound
