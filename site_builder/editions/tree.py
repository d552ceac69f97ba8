"""Pages as trees: read as a browser reads them, changed, and written as XHTML."""

import re
from collections.abc import Iterator
from copy import deepcopy
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import html5lib

XHTML = "http://www.w3.org/1999/xhtml"
MATHML = "http://www.w3.org/1998/Math/MathML"
SVG = "http://www.w3.org/2000/svg"
ROOTS = {"html": XHTML, "math": MATHML, "svg": SVG}
"""Elements that say to which language they and what is in them belong."""


def parse(page: str) -> Element:
    """The whole page, with plain names; comments are left out."""
    return _plain(html5lib.parse(page, treebuilder="etree"))


def parse_fragment(html: str) -> Element:
    """The one element that a template has made."""
    body = first(parse(f"<!DOCTYPE html><body>{html}"), "body")
    if len(body) != 1:
        raise ValueError(f"{len(body)} elements; legal: one")
    return body[0]


def _plain(element: Element) -> Element:
    """Namespaces go by the names of their roots: no name occurs in two of them but ``a``."""
    for parent in element.iter():
        parent.tag = parent.tag.rpartition("}")[2]
        for name in [name for name in parent.attrib if name.startswith("{")]:
            parent.set(name.rpartition("}")[2], parent.attrib.pop(name))
        for child in [child for child in parent if not isinstance(child.tag, str)]:
            remove(parent, child)
    return element


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


def parents(root: Element) -> dict[Element, Element]:
    return {child: parent for parent in root.iter() for child in parent}


def remove(parent: Element, child: Element) -> None:
    """Without it; the text behind it stays."""
    place = list(parent).index(child)
    if child.tail:
        if place:
            parent[place - 1].tail = (parent[place - 1].tail or "") + child.tail
        else:
            parent.text = (parent.text or "") + child.tail
    parent.remove(child)


def insert_after(parent: Element, child: Element, new: Element) -> None:
    """Right behind it, in front of the text there."""
    parent.insert(list(parent).index(child) + 1, new)
    new.tail, child.tail = child.tail, None


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
