"""Pages for paper as trees of XML, written as XHTML; and what their links lead to."""

import re
from collections.abc import Callable, Collection, Iterator
from copy import deepcopy
from dataclasses import dataclass
from urllib.parse import unquote, urljoin
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

XHTML = "http://www.w3.org/1999/xhtml"
MATHML = "http://www.w3.org/1998/Math/MathML"
SVG = "http://www.w3.org/2000/svg"
SCREEN_ONLY = frozenset(
    {
        *("autocomplete", "data-kind", "data-panel", "data-predict", "data-quiz", "data-figure"),
        *("aria-describedby", "aria-labelledby", "aria-live", "name", "tabindex"),
    }
)
"""Attributes for scripts and forms, or with ids that differ on paper."""
ElementTree.register_namespace("epub", "http://www.idpf.org/2007/ops")
ROOTS = {"html": XHTML, "math": MATHML, "svg": SVG}
"""Elements that carry the namespace of their content."""


def parse(xhtml: str) -> Element:
    """What a template for paper has made. Raises `ElementTree.ParseError` where it is no XML."""
    root = ElementTree.fromstring(xhtml.partition("<!DOCTYPE html>")[2] or xhtml)
    for element in root.iter():
        for name in [name for name in element.attrib if name in SCREEN_ONLY]:
            del element.attrib[name]
    return root


def classes(element: Element) -> set[str]:
    return set(element.get("class", "").split())


def elements(root: Element, name: str = "", kind: str = "") -> Iterator[Element]:
    """Elements of a name, a class or both, with the root; a list, so that they may be changed."""
    yield from [
        element
        for element in root.iter(name or None)
        if not kind or kind in classes(element)
    ]  # fmt: skip


def first(root: Element, name: str = "", kind: str = "") -> Element:
    """Raises `LookupError` where there is none."""
    for element in elements(root, name, kind):
        return element
    raise LookupError(f"no element {name or '*'}{'.' + kind if kind else ''}")


def words(element: Element) -> str:
    """Its text, in one line."""
    return re.sub(r"\s+", " ", "".join(element.itertext())).strip()


def xhtml(root: Element) -> bytes:
    """The tree as a file of XHTML."""
    root = deepcopy(root)
    for element in root.iter():
        if element.tag in ROOTS:
            element.set("xmlns", ROOTS[element.tag])
    head = b'<?xml version="1.0" encoding="utf-8"?>\n<!DOCTYPE html>\n'
    written: bytes = ElementTree.tostring(root, encoding="utf-8")
    return head + written


ABSOLUTE = re.compile(r"[a-z][a-z0-9+.-]*:", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class LinkTarget:
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


def place_of(address: str, page: str, pages: Collection[str]) -> LinkTarget | None:
    """The target of ``address`` on ``page``; None where that is none of ``pages``.

    The settings in a link to a figure are left out.
    """
    path, _, fragment = address.partition("#")
    target = urljoin(f"{page}/", path.partition("?")[0]).strip("/")
    return LinkTarget(target, unquote(fragment)) if target in pages else None


def bind_links(
    content: Element, page: str, pages: Collection[str], address_of: Callable[[LinkTarget], str]
) -> list[tuple[Element, Element, LinkTarget]]:
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
