"""Mistakes in Markdown that CommonMark prints, or drops, without a word: unpaired marks, syntax of
other kinds of Markdown, numbers of figures and chapters, which may change."""

import re
from collections.abc import Iterator, Sequence
from typing import Any

from markdown_it.rules_block.table import escapedSplit
from markdown_it.rules_core import StateCore
from markdown_it.token import Token

from site_builder.diagnostics.diagnostic import BELOW, NOT_OPENED, TARGETS, UNREAD, quoted
from site_builder.files.text import CONTROL, control_character_message
from site_builder.markdown.text.tokens import children_located

NOT_KEPT = "may change; better: '{ref}`TARGET`', or a citation"
NO_TEX = "outside of a formula; legal: Markdown, '{cite}`key`', '{ref}`TARGET`', or in '$…$'"
NO_BREAK = r"outside of a formula; legal: '\' alone, which ends a line"
NO_ID = "means nothing here; legal: ':label: name' in a directive, '(name)=' above a heading"
SLIPS = tuple(
    (re.compile(pattern), expected)
    for pattern, expected in (
        (r"(\$\$?)", r"opens or closes no formula; legal: '$…$', or '\$' for the sign itself"),
        (r"((?:\{[\w-]+\})?`+)", "is never closed; legal: a second '`' in the same paragraph"),
        (r"(?<![\w*])(\*)(?=\w)", r"begins no emphasis; legal: '*…*', or '\*' for the star"),
        (r"(\*\*)", r"opens or closes no bold text; legal: '**…**', or '\*\*' for the stars"),
        (r"(\[\^[^\]\n]*\])", "has no footnote; legal: a line '[^…]: the note' in this file"),
        (r"(\[[^\]\n]*\][(\[][^\n]*?[)\]])", "leads nowhere; legal: '[words](NN-slug.md)'"),
        (
            r"\b([Cc]hapters? \d+|[Aa]ppendix [A-Z]\b"
            r"|(?:[Ff]igure|[Tt]able|[Ee]quation|[Ee]xample|[Qq]uestion) \(?[A-Z\d]+\.\d+\)?)",
            "is a number that may change; legal: '{ref}`TARGET`', or a citation",
        ),
        (
            r"((?<![\w@.])@(?:fig|tbl|sec|eq|lst)-[\w-]+)",
            "means nothing here; legal: '{ref}`TARGET`'",
        ),
        *(
            (pattern, "means nothing here; legal: a formula, '$…$'")
            for pattern in (r"(\b\w+~[^~\s]+~)(?!~)", r"(\b\w+\^[^\^\s]+\^)")
        ),
        (r"(\+\+[^+\s](?:[^+\n]*[^+\s])?\+\+)", "means nothing here; legal: '*…*'"),
        (r"(?<=\S )(:[a-z][a-z_]+:)(?![\w:/])", "means nothing here; legal: the sign itself"),
        (r"((?<!\\)\{#[\w:.-]+\})", NO_ID),
        (
            r"(\{\{[^}\n]*\}\}|(?<!\\)\{(?:#(?![\w:.-]+\})|\.[\w:-])[^}\n]*\}?"
            r"|~~[^~\s][^~\n]*~~|==[^=\s](?:[^=\n]*[^=\s])?==|\[\[[^\]\n]+\]\]|\[!\w+\]"
            r"|&[A-Za-z][A-Za-z0-9]+;|\{[%:][^}\n]*\}|%%[^%\n]+%%|\]\{[\w-]+=[^}\n]*\})",
            "means nothing here; legal: CommonMark, directives and roles",
        ),
    )
)
"""Patterns of mistakes in running text, each with what is legal."""
SHORT = r"(?:Fig|Eq|Tab|Sec)s?\."
TYPED_NUMBER = re.compile(
    rf"\b({SHORT}\s?\(?[A-Z\d]+(?:\.\d+)*\)?"
    r"|(?:Figure|Table|Equation|Example|Question)s?\s\(?\d+\b(?!\.\d)\)?"
    r"|[Cc]hapters? (?:one|two|three|four|five|six|seven|eight|nine|ten)\b)"
)
"""What may be a reference typed by hand, or one to another work."""
UNOPENED = (*NOT_OPENED, *UNREAD, *TARGETS)
NO_LABEL = "labels nothing; legal: above a heading, a formula or a figure"
NO_DIRECTIVE = "is no directive; legal: ':::{name} argument'"
FOLLOWS = {NO_DIRECTIVE: UNOPENED, NO_ID: TARGETS, NO_LABEL: TARGETS}
LINE_SLIPS = tuple(
    (re.compile(pattern), expected)
    for pattern, expected in (
        (r"(::?\{[\w-]+\}.*)", NO_DIRECTIVE),
        (r"(\([\w:.-]+\)=)", NO_LABEL),
        (r"(#{2,6}\w[^\n]*|#[A-Za-z][^\n]*)", "is no heading; legal: a space behind the '#'"),
        (
            r"(:[a-z_][\w-]*:?)(?:$|[\s=])",
            "is no option here; legal: ':name: value' below the opening line of a directive",
        ),
        (r"(\d\d?[.)] \S[^\n]*)", "begins no list; legal: an empty line above it"),
        (r"([•◦▪‣·]\s)", "begins no list; legal: '- '"),
        (r"(!!! \w+|\?\?\?\+? \w+|\.\. [\w-]+::)", NO_DIRECTIVE),
        (r"(\[TOC\]|–8<–.*)", "means nothing here; legal: CommonMark, directives and roles"),
    )
)
"""Likewise at the start of a line."""
LETTERED = r"(?:\(\w{1,3}\)|[a-z][.)])"
OUTSIDE_LISTS = (
    (
        re.compile(r"^([:~] \S.*)", re.MULTILINE),
        "defines nothing here; legal: content/glossary.toml, or '**word**: …'",
    ),
    (
        re.compile(rf"^({LETTERED} \S.*)\n{LETTERED} ", re.MULTILINE),
        "begins no list; legal: '1. …' with an empty line above",
    ),
)
"""Likewise, but not in the answers of questions, which are explained so."""
TASKS = ((re.compile(r"^(\[[ xX]\] .*)"), "is no task; legal: an item without the box"),)
"""Likewise in a list that is no question's."""
QUESTIONS = {"quiz", "predict", "exercise"}
FOOTNOTE = re.compile(r"[ >]*\[\^([^\]]+)\]:")


def stray_marks_rule(state: StateCore) -> None:
    """Report them all, with their lines."""
    lines = state.src.split("\n")
    problems = state.env.setdefault("problems", [])
    doubts = state.env.setdefault("doubts", [])
    line, around = 1, list[str]()
    for token in state.tokens:
        line = token.map[0] + 1 if token.map else line
        match token.type:
            case "directive_open":
                around.append(token.meta["call"].name)
            case "list_item_open":
                around.append("item")
            case "directive_close" | "list_item_close":
                around.pop()
            case "inline":
                slips = OUTSIDE_LISTS if around[-1:] != ["item"] else TASKS
                for pattern, expected in () if QUESTIONS & {*around} else slips:
                    for found in pattern.finditer(token.content):
                        place = line + token.content.count("\n", 0, found.start())
                        problems.append((place, f"{found[1]!r} {expected}"))
                if token.content.startswith("|"):
                    head = token.content.partition("\n")[0]
                    expected = "one '---' below each of its heads"
                    message = f"{head!r} begins no table; legal: {expected}"
                    problems.append((line, message, "{table} holds no table"))
                problems += _in_paragraph(token, line, doubts)
            case "code_block":
                problems.append((line, "indented text; legal: at the margin, or between '```'"))
            case "fence" if not _is_closed(token, lines):
                message = f"code is never closed; close it with {token.markup!r}"
                problems.append((line, message, BELOW, *TARGETS))
            case "table_open":
                problems += _in_table(token, lines)
    problems += _lost_footnotes(state, lines)
    problems += _lost_addresses(state)


def _in_paragraph(
    inline: Token, line: int, doubts: list[tuple[int, str]]
) -> Iterator[tuple[Any, ...]]:
    above = 0
    behind = [*(inline.children or ())[1:], None]
    for (child, place), after in zip(children_located(inline, line), behind, strict=False):
        if child.type == "text_special" and (command := _command(child, after)):
            yield place, f"{quoted(command)} {NO_TEX if command[1:].strip('\\') else NO_BREAK}"
        for text in (child.content, *map(str, child.attrs.values())):
            if written := CONTROL.search(text):  # as an entity
                yield place, control_character_message(written[0])
        if child.type == "text":
            for number in TYPED_NUMBER.finditer(child.content):
                doubts.append((place, f"{number[1]!r} {NOT_KEPT}"))
            found = [(pattern.search(child.content), expected) for pattern, expected in SLIPS]
            if place > above:
                found += [(start.match(child.content), expected) for start, expected in LINE_SLIPS]
            for slip, expected in found:
                if slip:
                    yield place, f"{quoted(slip[1])} {expected}", *FOLLOWS.get(expected, ())
        above = place


def _command(escape: Token, after: Token | None) -> str:
    """The command of TeX that begins with this backslash, or ends the line; nothing for others."""
    if after is None or after.type == "softbreak":
        return escape.markup if escape.markup == r"\\" else ""
    name = re.match(r"[A-Za-z]+\*?(?:\{[^}\n]*\})?", after.content)
    command = escape.content + (name[0] if name else "")
    is_end = command.startswith(r"\end{")  # of what is reported
    return command if name and escape.content[1:].isalpha() and not is_end else ""


def _is_closed(fence: Token, lines: Sequence[str]) -> bool:
    first, end = fence.map or [0, 0]
    return end - first > 1 and lines[end - 1].strip(" \t>").startswith(fence.markup)


def _in_table(table: Token, lines: Sequence[str]) -> Iterator[tuple[int, str]]:
    """Rows with more cells than the table has heads, which are dropped, or with fewer."""
    first, end = table.map or [0, 0]
    heads = len(_cells(lines[first]))
    for number in range(first + 2, end):
        count = len(_cells(lines[number]))
        if count != heads:
            cells = "1 cell" if count == 1 else f"{count} cells"
            yield number + 1, f"a row of {cells} below {heads} heads; legal: as many, or '\\|'"


def _cells(line: str) -> list[str]:
    return escapedSplit(line.strip().removeprefix("|").removesuffix("|"))


def _lost_addresses(state: StateCore) -> Iterator[tuple[int, str]]:
    """Lines like ``[Note]: beware`` that define the address of no link, which are dropped."""
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
    """Notes without a reference, and all but the first of one label, which are dropped."""
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
