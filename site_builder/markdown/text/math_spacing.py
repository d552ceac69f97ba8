"""Spaces that TeX sets by itself and MathML leaves to its author.

Browsers take a sign for a binary operator wherever something stands before it, even a bracket or
a comma; and they set ``cos`` tight against what follows.
"""

from itertools import pairwise
from xml.etree import ElementTree

SIGNS = {"−", "-", "+", "±", "∓"}
CLOSING = {")", "]", "}", "⟩", "⌋", "⌉", "|", "‖", "!", "′", "″", "…", "⋯"}
FUNCTIONS = {
    "sin", "cos", "tan", "cot", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh",
    "exp", "log", "ln", "lg", "det", "dim", "ker", "deg", "arg", "tr",
}  # fmt: skip
BARS = {"|", "∣", "‖"}
TIGHT = BARS | {"/"}
THIN = "0.167em"


def space_formula(tree: ElementTree.Element) -> None:
    """Mark signs as prefixes and set function names apart from their neighbours, in place."""
    leaves = [element for element in tree.iter() if not len(element)]
    if len(leaves) == 1 and leaves[0].tag == "mo":
        _close(leaves[0])  # a sign that is spoken of
    for parent in list(tree.iter()):
        if parent.tag in ("math", "mrow", "mtd", "mstyle", "msqrt"):
            _mark_prefixes(parent)
            _close_tight(parent)
            _space_functions(parent)


def _mark_prefixes(row: ElementTree.Element) -> None:
    before: ElementTree.Element | None = None
    for element in row:
        if element.tag == "mspace":
            continue
        if _text(element) in SIGNS and element.tag == "mo" and _opens(before):
            element.set("form", "prefix")
        before = element


def _opens(element: ElementTree.Element | None) -> bool:
    """Whether what follows ``element`` begins an expression."""
    return element is None or (element.tag == "mo" and _text(element) not in CLOSING)


def _close_tight(row: ElementTree.Element) -> None:
    """No space beside the bars of ``|x|``, a slash, or an operator that is alone, as ``max`` in a
    subscript: browsers' own spaces differ there."""
    for element in row:
        if element.tag == "mo" and (_text(element) in TIGHT or len(row) == 1):
            _close(element)
        if element.tag == "mo" and _text(element) in BARS:
            element.attrib.setdefault("stretchy", "false")  # unless ``\left`` asked for it


def _close(operator: ElementTree.Element) -> None:
    operator.set("lspace", "0")
    operator.set("rspace", "0")


def _space_functions(row: ElementTree.Element) -> None:
    elements = list(row)
    for element, following in pairwise(elements):
        one, other = _is_function(element), _is_function(following)
        if (one and _is_operand(following)) or (other and _is_operand(element)):
            row.insert(list(row).index(following), ElementTree.Element("mspace", width=THIN))


def _is_function(element: ElementTree.Element) -> bool:
    if element.tag in ("msub", "msup", "msubsup"):
        element = element[0]
    if element.tag == "mrow" and len(element) == 1:
        element = element[0]
    return element.tag == "mi" and _text(element) in FUNCTIONS


def _is_operand(element: ElementTree.Element) -> bool:
    """A letter, number, fraction, …; brackets and other operators bring their own space."""
    if element.tag == "mrow" and len(element):
        return _is_operand(element[0])
    return element.tag not in ("mo", "mspace", "mtext")


def _text(element: ElementTree.Element) -> str:
    return (element.text or "").strip()
