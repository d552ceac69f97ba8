"""Pages for paper as trees of XML: changed, and written as XHTML."""

import re
from collections.abc import Iterator
from copy import deepcopy
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
    """Those of a name, a class or both, the root included; a list, so that they may be changed."""
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
