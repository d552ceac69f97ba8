"""Walking the parser's tokens; and dashes, ellipses, and no-break spaces before units.

(Quotation marks are markdown-it's ``smartquotes``; its ``replacements`` rule is not used, because
it would turn an enumeration's "(c)" into a copyright sign.)
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import accumulate, pairwise

from markdown_it.rules_core import StateCore
from markdown_it.token import Token


def located(tokens: Sequence[Token]) -> Iterator[tuple[Token, int]]:
    """All tokens, those inside paragraphs included, each with its line counted from 1."""
    line = 1
    for token in tokens:
        line = token.map[0] + 1 if token.map else line
        yield token, line
        if token.children:
            yield from children_located(token, line)


def children_located(inline: Token, line: int) -> Iterator[tuple[Token, int]]:
    """What is inside of a paragraph, which begins on ``line``, each with its own line."""
    for child in inline.children or ():
        yield child, line
        if child.type in ("softbreak", "hardbreak"):
            line += 1
        elif "\n" in child.content:
            line += child.content.count("\n")


def end_of_element(tokens: Sequence[Token], start: int) -> int:
    """The index behind the token that closes what the one at ``start`` opens."""
    depths = accumulate(token.nesting for token in tokens[start:])
    return start + next(count for count, depth in enumerate(depths, start=1) if depth == 0)


def plain_text(inline: Token) -> str:
    """The words of a paragraph or heading, without markup."""
    parts = (
        " " if child.type in ("softbreak", "hardbreak") else child.content
        for child in inline.children or ()
    )
    return "".join(parts).strip()


UNITS = "nm|µm|mm|cm|m|km|px|dB|rad|ms|s|Hz|EV|DN|kB|MB"
"""Units that stay on the line of their number."""

REPLACEMENTS = (
    (re.compile(r"(\d)'(\s?\d+(?:\.\d+)?)\""), "\\1′\\2″"),
    (re.compile(r"(?<=[)\]])'(?=s\b)|(?<!\w)'(?=\d\d(?:s|\b)|(?:tis|twas|til|em)\b)", re.I), "’"),
    (re.compile(r"(?<!\w)'n'(?!\w)", re.I), "’n’"),
    (re.compile(r"(?<!-)---(?!-)"), "—"),
    (re.compile(r"(?<!-)--(?!-)"), "–"),
    (re.compile(r"(?<!\.)\.\.\.(?!\.)"), "…"),
    (re.compile(rf"(?<=\d) (?=(?:{UNITS})\b|%)"), "\u00a0"),
)


def typography_rule(state: StateCore) -> None:
    """Replace in running text; code and formulae stay as they are."""
    for block in state.tokens:
        for token in block.children or ():
            if token.type == "text":
                for pattern, character in REPLACEMENTS:
                    token.content = pattern.sub(character, token.content)


def displays_rule(state: StateCore) -> None:
    """Formulae between ``$$`` within a line are displayed, between the parts of their paragraph;
    within a heading or a cell of a table they stay."""
    tokens: list[Token] = []
    for token in state.tokens:
        doubles = [child for child in token.children or () if child.type == "math_inline_double"]
        if doubles and tokens[-1].type == "paragraph_open":
            tokens += _parted(tokens.pop(), token)
        else:
            for child in doubles:
                child.type = "math_inline"
            tokens.append(token)
    state.tokens = tokens


def _parted(opening: Token, inline: Token) -> Iterator[Token]:
    """The paragraph without its end, its displayed formulae behind their parts."""
    part: list[Token] = []
    first = line = (inline.map or [0])[0] + 1
    closing = Token("paragraph_close", "p", -1, level=opening.level, hidden=opening.hidden)

    def begun() -> Iterator[Token]:
        yield replace(opening, map=[first - 1, line])
        yield replace(inline, children=[*part], content="", map=[first - 1, line])

    for child, line in children_located(inline, first):
        if child.type == "math_inline_double":
            yield from (*begun(), closing) if part else ()
            place = [line - 1, line]
            block = replace(child, type="math_block", map=place, level=opening.level, block=True)
            yield block
            part, first = [], line
        elif part or child.type != "softbreak":
            part.append(child)
    yield from begun()


OPENING = re.compile(r"[(\[“‘„‚]+$")
MARKS = r"^(?:[^\s\w(\[“‘]{1,3})?"
CLOSING = re.compile(MARKS)
CLOSING_AND_UNIT = re.compile(rf"{MARKS}(?:[\u00a0\u202f][^\s]+|^ (?:(?:{UNITS})\b|%))?")
LONG = 30
"""Characters of TeX from which a formula may part from its unit: together they fill a phone."""


def glue_formulae(tokens: Sequence[Token]) -> None:
    """Keep brackets, stops and units on the line of their formula, in place."""
    for token in tokens:
        if not any(child.type == "math_inline" for child in token.children or ()):
            continue
        children = [child for child in token.children or () if child.content or child.tag]
        for text, formula in pairwise(children):
            if text.type == "text" and formula.type == "math_inline":
                _take(formula, text, OPENING)
        for formula, text in pairwise(children):
            if text.type == "text" and formula.type == "math_inline":
                long = len(formula.content) > LONG
                _take(formula, text, CLOSING if long else CLOSING_AND_UNIT)


def _take(formula: Token, text: Token, pattern: re.Pattern[str]) -> None:
    """Move what ``pattern`` finds in the neighbouring text to the formula: renderers keep both on
    one line."""
    found = pattern.search(text.content)
    if not found or not found[0] or "mathml" not in formula.meta:
        return
    text.content = text.content[: found.start()] + text.content[found.end() :]
    formula.meta["before" if pattern is OPENING else "after"] = found[0].replace(" ", "\u00a0")


def displayed_parts(tex: str) -> list[str]:
    r"""The formulae of one displayed row, which the author sets apart by ``\qquad``.

    A space inside of braces or of an environment parts nothing.
    """
    parts, depth = [""], 0
    for piece in re.split(r"(\\begin\b|\\end\b|\\left\b|\\right\b|\\[{}]|[{}]|\\qquad\b)", tex):
        if piece == r"\qquad" and depth == 0:
            parts.append("")
            continue
        depth += piece in ("{", r"\begin", r"\left")
        depth -= piece in ("}", r"\end", r"\right")
        parts[-1] += piece
    return [part.strip() for part in parts if part.strip()]
