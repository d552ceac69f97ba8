"""Marks without their partner, and numbers of places that the book gives out itself. CommonMark
prints the former, or drops what it cannot place, in silence; in a book either is a slip."""

import re
from collections.abc import Iterator, Sequence

from markdown_it.rules_block.table import escapedSplit
from markdown_it.rules_core import StateCore
from markdown_it.token import Token

from site_builder.markdown.text.foreign_marks import foreign_marks
from site_builder.markdown.text.suspects import (
    Suspect,
    has_one,
    marks_of,
    possible,
    suspicious,
)
from site_builder.markdown.text.tokens import children_located

STRAY = (
    (("$",), r"(\$\$?)", r"opens or closes no formula; legal: '$…$', or '\$' for the sign itself"),
    (
        ("`",),
        r"((?:\{[\w-]+\})?`+)",
        "is never closed; legal: a second '`' in the same paragraph",
    ),
    (
        ("*",),
        r"(\*\*)",
        r"opens or closes no bold text; legal: '**…**', or '\*\*' for the stars",
    ),
    (("[",), r"(\[\^[^\]\n]*\])", "has no footnote; legal: a line '[^…]: the note' in this file"),
    (
        ("[",),
        r"(\[[^\]\n]*\][(\[][^\n]*?[)\]])",
        "leads nowhere; legal: '[words](NN-slug.md)'",
    ),
    ((":",), r"^(::?\{[\w-]+\}.*)", "is no directive; legal: ':::{name} argument'"),
    (
        (*"0123456789", "ppendix "),
        r"\b([Cc]hapters? \d+|[Aa]ppendix [A-Z]\b"
        r"|(?:[Ff]igure|[Tt]able|[Ee]quation|[Ee]xample|[Qq]uestion) \(?[A-Z\d]+\.\d+\)?)",
        "is a number that may change; legal: '{ref}`TARGET`', or a citation",
    ),
)
"""What stands in running text only by mistake, and what would be legal; first what all that a
pattern fits has in it."""
SUSPECTS = tuple(
    Suspect(marks, re.compile(pattern), expected) for marks, pattern, expected in STRAY
)
FOOTNOTE = re.compile(r"[ >]*\[\^([^\]]+)\]:")


def stray_marks_rule(state: StateCore) -> None:
    """Report what looks as if it were missing its other half."""
    lines = state.src.split("\n")
    problems = state.env.setdefault("problems", [])
    suspects = possible(SUSPECTS, state.src)
    marks = marks_of(suspects)
    line = 1
    for token in state.tokens:
        line = token.map[0] + 1 if token.map else line
        match token.type:
            case "inline":
                if token.content.startswith("|"):
                    head = token.content.partition("\n")[0]
                    expected = "one '---' below each of its heads"
                    problems.append((line, f"{head!r} begins no table; legal: {expected}"))
                if has_one(token.content, marks):
                    problems += _in_paragraph(token, line, suspects, marks)
            case "code_block":
                problems.append((line, "indented text; legal: at the margin, or between '```'"))
            case "fence" if not _is_closed(token, lines):
                message = f"code is never closed; close it with {token.markup!r}"
                problems.append((line, message))
            case "table_open":
                problems += _in_table(token, lines)
    problems += foreign_marks(state.tokens, state.src)
    problems += _lost_footnotes(state, lines)
    problems += _lost_addresses(state)


def _in_paragraph(
    inline: Token, line: int, suspects: Sequence[Suspect], marks: Sequence[str]
) -> Iterator[tuple[int, str]]:
    for child, place in children_located(inline, line):
        if child.type == "text":
            for what, expected in suspicious(child.content, suspects, marks):
                yield place, f"{what!r} {expected}"


def _is_closed(fence: Token, lines: Sequence[str]) -> bool:
    first, end = fence.map or [0, 0]
    return end - first > 1 and lines[end - 1].strip(" >").startswith(fence.markup)


def _in_table(table: Token, lines: Sequence[str]) -> Iterator[tuple[int, str]]:
    """Rows of more cells than the table has heads, or of fewer: cells are lost, or empty."""
    first, end = table.map or [0, 0]
    heads = len(_cells(lines[first]))
    for number in range(first + 2, end):
        count = len(_cells(lines[number]))
        if count != heads:
            message = f"a row of {_cells_told(count)} below {heads} heads; legal: as many, or '\\|'"
            yield number + 1, message


def _cells_told(count: int) -> str:
    return "1 cell" if count == 1 else f"{count} cells"


def _cells(line: str) -> list[str]:
    return escapedSplit(line.strip().removeprefix("|").removesuffix("|"))


def _lost_addresses(state: StateCore) -> Iterator[tuple[int, str]]:
    """Lines like ``[Note]: beware`` that give an address to a link which is nowhere: all that they
    say would be lost."""
    references = state.env.get("references")
    if not references:
        return
    source = " ".join(state.src.casefold().split())
    for label, found in references.items():
        if source.count(f"[{label.casefold()}]") == 1:
            expected = "words in bold, or a link '[words](https://…)'"
            message = f"'[{label.lower()}]: …' is the address of no link; legal: {expected}"
            yield found["map"][0] + 1, message


def _lost_footnotes(state: StateCore, lines: Sequence[str]) -> Iterator[tuple[int, str]]:
    """Notes that nothing in the text leads to, and all but the first of one label."""
    uses = state.env.get("footnotes", {}).get("refs")
    if not uses:
        return
    places: dict[str, int] = {}
    for number, line in enumerate(lines, start=1):
        note = FOOTNOTE.match(line)
        if note and f":{note[1]}" in uses:
            if note[1] in places:
                yield number, f"footnote '[^{note[1]}]' is written twice; legal: once"
            elif uses[f":{note[1]}"] < 0:
                yield (
                    number,
                    f"footnote '[^{note[1]}]' is not used; legal: '[^{note[1]}]' in the text",
                )
            places.setdefault(note[1], number)
