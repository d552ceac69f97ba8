"""TeX to MathML, at build time. What the converter cannot do is an error, never garbled output.

latex2mathml makes the tree; `_rewrite` puts right, before, what it would misread, and `_mend`,
after, what browsers would draw wrongly: MathML Core has no ``mathvariant`` but ``normal``, gives
unknown operators wide spaces, and stretches all brackets of one row to the same height.
"""

import re
from xml.etree import ElementTree

from simulations.engine import frame
from site_builder.diagnostics import unknown
from site_builder.kept.keeper import kept
from site_builder.markdown.text.math_spacing import space_formula

NAMESPACE = "http://www.w3.org/1998/Math/MathML"
COLOURS = (*frame.ROLES[1:], "muted")
"""Colours of ideas, and of what steps back; frames also know the empty role."""
ENVIRONMENTS = (
    "aligned", "array", "cases", "matrix", "pmatrix", "bmatrix", "Bmatrix", "vmatrix", "Vmatrix",
    "smallmatrix",
)  # fmt: skip
EMPTY = r"a formula that shows nothing; legal: '$…$' around one, or '\$' for the sign itself"
CHILDREN = {
    "mfrac": 2, "mroot": 2, "msub": 2, "msup": 2, "mover": 2, "munder": 2,
    "msubsup": 3, "munderover": 3,
}  # fmt: skip
ELEMENTS = (
    "math", "mi", "mn", "mo", "mtext", "mspace", "mrow", "mfrac", "msqrt", "mroot", "mstyle",
    "mpadded", "mphantom", "menclose", "msub", "msup", "msubsup", "munder", "mover", "munderover",
    "mtable", "mtr", "mtd",
)  # fmt: skip
ATTRIBUTES = (
    "display", "stretchy", "width", "height", "depth", "voffset", "lspace", "rspace", "mathvariant",
    "mathsize", "mathcolor", "mathbackground", "class", "fence", "form", "separator", "accent",
    "largeop", "linebreak", "displaystyle", "scriptlevel", "minsize", "maxsize", "movablelimits",
    "linethickness", "notation", "columnalign", "columnspacing", "columnlines", "rowspacing",
    "rowlines",
)  # fmt: skip
"""Of MathML, what TeX can ask for. The converter lets through what looks like markup in a formula,
scripts included."""
IN_WORDS = {"no available tokens": "a command at the end lacks what it is to work on"}
SPACES = {"negativethinmathspace": "-0.167em"}
LETTERS = {"∞", "∅", "⊤"}
OPERATORS = {"~": "∼", "‖": "‖", "⌊": "⌊", "⌋": "⌋", "⌈": "⌈", "⌉": "⌉"}
FUNCTIONS_WITH_LIMITS = {"max", "min", "argmax", "argmin", "sup", "inf", "lim"}


class UnsupportedTexError(ValueError):
    """The formula cannot be set; the message says which part of it."""


@kept
def to_mathml(tex: str, *, display: bool) -> str:
    """A ``<math>`` element. Raises `UnsupportedTexError`."""
    from latex2mathml.converter import convert  # not every book has formulae, and they are kept

    _check_balance(tex)
    if not tex.strip():
        raise UnsupportedTexError(EMPTY)
    try:
        markup = convert(_rewrite(tex), display="block" if display else "inline")
        # The converter leaves & bare outside of tables; as an entity it is found by _check.
        tree = ElementTree.fromstring(re.sub(r"&(?!#|\w+;)", "&amp;", markup))
    except UnsupportedTexError:
        raise
    except Exception as error:  # the converter raises a dozen unrelated types
        raise UnsupportedTexError(f"cannot set {quoted(tex)}: {_in_words(error)}") from error
    _strip_namespace(tree)
    _check(tree, tex)
    if not any((element.text or "").strip() for element in tree.iter()):
        raise UnsupportedTexError(EMPTY)
    _mend(tree, display=display)
    space_formula(tree)
    return ElementTree.tostring(tree, encoding="unicode")


def quoted(tex: str) -> str:
    r"""TeX as its author wrote it, on one line: ``'\frac{a}{b}'``, its backslashes single."""
    return f"'{' '.join(tex.split())}'"


def _in_words(error: Exception) -> str:
    """``double subscripts`` for a `DoubleSubscriptsError`, which says no more than its name."""
    name = type(error).__name__.removesuffix("Error")
    words = str(error) or re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name).lower()
    return IN_WORDS.get(words, words)


def _rewrite(tex: str) -> str:
    tex = re.sub(r"\\role\{([\w-]*)\}", _role, tex)
    tex = re.sub(r"(\\(?:begin|end))\{aligned\}", r"\1{split}", tex)
    tex = re.sub(r"\\bm\b", r"\\boldsymbol", tex)
    # ``\mathbf x`` would become a mathvariant; with braces it becomes the letter itself.
    tex = re.sub(r"(\\math(?:bf|rm|sf|bb|cal))\s+([A-Za-z0-9])", r"\1{\2}", tex)
    # A row of its own, or the brackets of all matrices of a line would be equally tall.
    tex = re.sub(r"(\\begin\{[bpvBV]matrix\})", r"{\1", tex)
    return re.sub(r"(\\end\{[bpvBV]matrix\})", r"\1}", tex)


def _role(match: re.Match[str]) -> str:
    if match[1] not in COLOURS:
        raise UnsupportedTexError(unknown("colour role", match[1], COLOURS))
    return rf"\class{{role-{match[1]}}}"


def _check_balance(tex: str) -> None:
    depth = 0
    for brace in re.findall(r"(?<!\\)(?:\\\\)*([{}])", tex):
        depth += 1 if brace == "{" else -1
        if depth < 0:
            break
    if depth:
        raise UnsupportedTexError(f"unbalanced braces in {quoted(tex)}")
    begun, ended = (re.findall(rf"\\{word}\{{([^}}]*)\}}", tex) for word in ("begin", "end"))
    if sorted(begun) != sorted(ended):
        raise UnsupportedTexError(f"\\begin and \\end do not match in {quoted(tex)}")
    for name in begun:
        if name not in ENVIRONMENTS:
            raise UnsupportedTexError(unknown("environment", name, ENVIRONMENTS))


def _strip_namespace(tree: ElementTree.Element) -> None:
    """HTML knows ``math`` by name; without the namespace the tree prints without prefixes."""
    for element in tree.iter():
        element.tag = element.tag.removeprefix(f"{{{NAMESPACE}}}")


def _check(tree: ElementTree.Element, tex: str) -> None:
    for element in tree.iter():
        strange = next((name for name in element.attrib if name not in ATTRIBUTES), "")
        if element.tag not in ELEMENTS or strange:
            found = strange or f"<{element.tag}>"
            message = f"{found!r} in {quoted(tex)}; legal: TeX, and '\\lt' for the sign '<'"
            raise UnsupportedTexError(message)
        text = element.text or ""
        if element.tag != "mtext" and (command := re.search(r"\\\w*", text)):
            message = f"unsupported TeX command '{command[0]}' in {quoted(tex)}"
            raise UnsupportedTexError(message)
        if element.tag != "mtext" and "&" in text:
            raise UnsupportedTexError(f"'&' outside of a table in {quoted(tex)}")
        wanted = CHILDREN.get(element.tag)
        if wanted is not None and len(element) != wanted:
            part = "a part of a fraction, root or script"
            raise UnsupportedTexError(f"{part} is missing in {quoted(tex)}")


def _mend(tree: ElementTree.Element, *, display: bool) -> None:
    for parent in tree.iter():
        _merge_upright_letters(parent)
        for index, element in enumerate(list(parent)):
            text = (element.text or "").strip()
            if element.tag == "mi" and text in OPERATORS:
                element.tag, element.text = "mo", OPERATORS[text]
            if element.tag == "mo" and text == "\u2015":  # \\overline: no font stretches its bar
                element.text, element.attrib = "‾", {"stretchy": "true"}
            if element.tag == "mo" and text in LETTERS:
                element.tag = "mi"
            if element.tag == "mo" and text.isalpha() and text.isascii():
                _space_function(element, parent[index + 1 :])
            if element.tag == "mspace":
                width = element.get("width", "")
                element.set("width", SPACES.get(width, width or "0"))
            if display and element.tag == "msub" and element[0].text in FUNCTIONS_WITH_LIMITS:
                element.tag = "munder"
            _replace_variant(element)
    for table in tree.iter("mtable"):
        _style_table(table)


def _merge_upright_letters(parent: ElementTree.Element) -> None:
    r"""``\mathrm{sample}`` as one word instead of six letters."""
    letters = [child for child in parent if child.get("mathvariant") == "normal"]
    if len(letters) > 1 and len(letters) == len(parent) and all(c.tag == "mi" for c in letters):
        letters[0].text = "".join(letter.text or "" for letter in letters)
        del letters[0].attrib["mathvariant"]
        for letter in letters[1:]:
            parent.remove(letter)


def _space_function(element: ElementTree.Element, following: list[ElementTree.Element]) -> None:
    """Thin space before a function's name, and after it unless a bracket follows."""
    bracket = not following or (following[0].text or "") in ("(", "[", "{")
    element.set("lspace", "0.167em")
    element.set("rspace", "0" if bracket else "0.167em")


def _replace_variant(element: ElementTree.Element) -> None:
    """Bold letters as the characters Unicode has for them."""
    variant = element.get("mathvariant", "normal")
    if variant == "normal" or not element.text:
        return
    del element.attrib["mathvariant"]
    element.text = "".join(_bold(letter, italic="italic" in variant) for letter in element.text)


def _bold(letter: str, *, italic: bool) -> str:
    ranges = (
        (("A", "Z", 0x1D468), ("a", "z", 0x1D482), ("Α", "Ω", 0x1D71C), ("α", "ω", 0x1D736))
        if italic
        else (("A", "Z", 0x1D400), ("a", "z", 0x1D41A), ("Α", "Ω", 0x1D6A8), ("α", "ω", 0x1D6C2))
    )
    for first, last, start in (*ranges, ("0", "9", 0x1D7CE)):
        if first <= letter <= last:
            return chr(start + ord(letter) - ord(first))
    return letter


def _style_table(table: ElementTree.Element) -> None:
    """Alignment, closed columns and rules as CSS: MathML Core dropped the attributes."""
    closed = table.get("columnspacing", "").startswith("0em")
    lines = table.get("columnlines", "").split()
    for row in table:
        for index, cell in enumerate(row):
            styles = []
            if align := cell.attrib.pop("columnalign", ""):
                styles.append(f"text-align:{align}")
            if closed:
                styles.append("padding-inline:0")
            if index and lines and lines[min(index, len(lines)) - 1] == "solid":
                styles.append("border-inline-start:1px solid currentColor")
            if styles:
                cell.set("style", ";".join(styles))
    for name in ("columnspacing", "rowspacing", "columnlines"):
        table.attrib.pop(name, None)
