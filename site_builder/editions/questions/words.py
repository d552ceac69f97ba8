"""Passages as plain XHTML, which platforms keep: no classes, and links that lead to the site.

Formulae are TeX for Moodle, between ``\\(`` and ``\\)``, which its filter sets and its editor shows
as text. QTI has MathML, which is part of the format.
"""

from collections.abc import Callable, Mapping
from html import escape
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from markdown_it.token import Token
from markupsafe import Markup

from site_builder.document.passage import Passage
from site_builder.editions.tree import MATHML, elements, on_site, parse
from site_builder.formulae.temml import plain_tex
from site_builder.render.screen import RULES, PassageRenderer, mathml_of, renderer_with

KEPT = frozenset({"href", "start", "colspan", "rowspan"})
LENGTHS = ("lspace", "rspace", "width", "height", "depth")

type Text = Callable[[Passage], Markup]
"""The XHTML of a passage."""


def moodle_text(page: str, macros: Mapping[str, str]) -> Text:
    """``page`` is the address of the chapter, nothing where it has none."""
    return _text(page, renderer_with({**RULES, "math_inline": lambda token: _tex(token, macros)}))


def qti_text(page: str) -> Text:
    return _text(page, renderer_with(RULES))


def _text(page: str, render: PassageRenderer) -> Text:
    def text(passage: Passage) -> Markup:
        if not passage:
            return Markup()
        root = _plain(parse(f"<div>{render(passage)}</div>"), page)
        written = ElementTree.tostring(root, encoding="unicode")
        return Markup(written.removeprefix("<div>").removesuffix("</div>"))

    return text


def _plain(root: Element, page: str) -> Element:
    """``root``, changed."""
    formulae = {part for math in elements(root, "math") for part in math.iter()}
    for element in elements(root):
        if element in formulae:
            _plain_formula(element)
            continue
        address = element.get("href", "")
        element.attrib = {name: text for name, text in element.attrib.items() if name in KEPT}
        if element.tag == "a":
            if there := on_site(address, page):
                element.set("href", there)
            else:
                element.tag, element.attrib = "span", {}
    return root


def _plain_formula(element: Element) -> None:
    """MathML 2, which QTI 2.1 has: without classes, and a length has a unit."""
    for name in ("class", "style"):
        element.attrib.pop(name, None)
    for name in LENGTHS:
        if element.get(name) == "0":
            element.set(name, "0em")
    if element.tag == "math":
        element.set("xmlns", MATHML)


def _tex(token: Token, macros: Mapping[str, str]) -> str:
    r"""``\(f = 50\)``."""
    start, end = (r"\[", r"\]") if 'display="block"' in mathml_of(token) else (r"\(", r"\)")
    before, after = (str(token.meta.get(side, "")) for side in ("before", "after"))
    return escape(f"{before}{start}{plain_tex(token.content, macros)}{end}{after}")
