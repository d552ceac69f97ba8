r"""Chemical formulae and reactions: ``\ce{2 H2 + O2 -> 2 H2O}``.

Of mhchem: elements, groups in brackets, amounts, charges (``SO4^2-``, ``Na+``), isotopes
(``^{227}_{90}Th``), states (``(aq)``), water of crystals (``*``), and arrows.
"""

import re

from site_builder.markdown.text.math import UnsupportedTexError, quoted
from site_builder.markdown.text.tex_arguments import replaced

CE = re.compile(r"\\ce(?![A-Za-z])")
ARROWS = {
    "<=>": r"\rightleftharpoons",
    "<->": r"\leftrightarrow",
    "->": r"\longrightarrow",
    "<-": r"\longleftarrow",
}
COUNT = r"\d+(?:/\d+|\.\d+)?"
ELEMENT = r"[A-Z][a-z]?"
PARTS = (
    ("arrow", re.compile("|".join(map(re.escape, ARROWS)))),
    ("state", re.compile(r"\((?:aq|s|l|g|cr)\)(?=\s|$)")),
    (
        "isotope",
        re.compile(rf"\^\{{?(?P<mass>\d+)\}}?(?:_\{{?(?P<number>-?\d+)\}}?)?(?={ELEMENT}|e\b|n\b)"),
    ),
    ("element", re.compile(rf"{ELEMENT}|e(?=[\^+-])|n(?![a-z])")),
    ("open", re.compile(r"[(\[]")),
    ("close", re.compile(r"[)\]]")),
    ("charge", re.compile(r"\^\{?(?P<charge>\d*[+-])\}?")),
    ("sign", re.compile(r"[+-](?=[\s)\]]|$)")),
    ("count", re.compile(rf"_?\{{?(?P<count>{COUNT})\}}?")),
    ("water", re.compile(r"\s*[*·.]\s*")),
    ("space", re.compile(r"\s+")),
)
LEGAL = "'H2O', 'SO4^2-', '2 H2 + O2 -> 2 H2O', '^{14}_{6}C'"
BEHIND = ("element", "close")
"""Parts behind which a number is an index and a sign is a charge."""


def with_chemistry(tex: str) -> str:
    r"""``tex`` with what stands in ``\ce{…}`` written out. Raises `UnsupportedTexError`."""
    return replaced(tex, CE, lambda _, given: f"{{{_chemistry(given[0])}}}", 1)


def _chemistry(text: str) -> str:
    parts: list[str] = []
    last, rest, depth = "space", 0, 0
    text = text.strip()
    while rest < len(text):
        kind, found = _next(text, rest)
        rest = found.end()
        parts.append(_set(kind, found, last))
        depth += (kind == "open") - (kind == "close")
        if depth < 0:
            break
        is_index = kind == "count" and last in BEHIND
        last = "close" if is_index else "space" if kind == "water" else kind
    if not parts or depth:
        raise UnsupportedTexError(f"chemistry {quoted(text)}; legal: {LEGAL}")
    return "".join(parts)


def _next(text: str, start: int) -> tuple[str, re.Match[str]]:
    for kind, pattern in PARTS:
        if found := pattern.match(text, start):
            return kind, found
    raise UnsupportedTexError(f"{text[start]!r} in chemistry {quoted(text)}; legal: {LEGAL}")


def _set(kind: str, found: re.Match[str], last: str) -> str:
    match kind:
        case "arrow":
            return f" {ARROWS[found[0]]} "
        case "state":
            return rf"\,\text{{{found[0]}}}"
        case "isotope":
            number = f"_{{{found['number']}}}" if found["number"] else ""
            return f"{{}}^{{{found['mass']}}}{number}"
        case "element":
            return rf"\text{{{found[0]}}}"
        case "charge":
            return f"^{{{found['charge']}}}"
        case "sign" if last in BEHIND:
            return f"^{{{found[0]}}}"
        case "sign":
            return f" {found[0]} "
        case "count" if last in BEHIND:
            return f"_{{{found['count']}}}"
        case "count":
            whole, _, part = found["count"].partition("/")
            return (rf"\frac{{{whole}}}{{{part}}}" if part else whole) + r"\,"
        case "water":
            return r" \cdot "
        case "space":
            return ""
    return found[0]
