"""``:::{name} argument`` … ``:::``: the block rule, and options as ``:name: value`` lines.

The body is parsed in place, so line numbers in it are those of the file and directives nest.
A directive ends at the next fence of as many colons that closes none opened inside it.
"""

import re
from collections.abc import Mapping
from typing import Any

from markdown_it.rules_block import StateBlock

from site_builder.diagnostics.diagnostic import unknown
from site_builder.markdown.directive import Directive, DirectiveCall, OptionValue

OPENING = re.compile(r"(:{3,})\{([\w-]+)\}[ \t]*(.*)")
CLOSING = re.compile(r"(:{3,})[ \t]*")
OPTION = re.compile(r":([A-Za-z_][\w-]*):[ \t]*(.*)")
CODE_FENCE = re.compile(r"`{3,}|~{3,}")


def _line(state: StateBlock, line: int) -> str:
    return state.src[state.bMarks[line] + state.tShift[line] : state.eMarks[line]].rstrip()


def directive_rule(
    directives: Mapping[str, Directive[Any]], state: StateBlock, start: int, end: int, silent: bool
) -> bool:
    """Tokens ``directive_open`` and ``directive_close`` around the body; the former carries the
    `Directive`, or None where the name is unknown, and its `DirectiveCall`."""
    text = _line(state, start)
    if state.is_code_block(start) or not text.startswith(":::"):
        return False
    if silent:
        return True
    opening = OPENING.fullmatch(text)
    if not opening:
        _complain(state, start, _stray(text))
        state.line = start + 1
        return True
    fence, name, argument = opening.groups()
    last = _find_end(state, start, end, len(fence))
    if last == end:
        _complain(state, start, f"directive {{{name}}} is never closed; close it with {fence!r}")
    if name not in directives:
        _complain(state, start, unknown("directive", name, directives))
    options, body = _read_options(state, start + 1, last)
    call = DirectiveCall(name, argument.strip(), options, start + 1)
    _push(state, directives.get(name), call, body, last)
    state.line = min(last + 1, end)
    return True


def _stray(text: str) -> str:
    if CLOSING.fullmatch(text):
        return f"{text!r} closes no directive; legal: after an opening like ':::{{note}}'"
    return f"{text!r} is no directive; legal: ':::{{name}} argument'"


def _find_end(state: StateBlock, start: int, end: int, length: int) -> int:
    """Line of the closing fence, or ``end`` where there is none."""
    depth, code = 1, ""
    for line in range(start + 1, end):
        text = _line(state, line)
        if fence := CODE_FENCE.match(text):
            marker = fence.group()
            code = "" if code and marker.startswith(code) else code or marker
        elif code:
            continue
        elif fence := OPENING.fullmatch(text) or CLOSING.fullmatch(text):
            if len(fence[1]) == length:
                depth += 1 if "{" in text else -1
            if depth == 0:
                return line
    return end


def _read_options(state: StateBlock, start: int, end: int) -> tuple[dict[str, OptionValue], int]:
    options: dict[str, OptionValue] = {}
    for line in range(start, end):
        match = OPTION.fullmatch(_line(state, line))
        if not match:
            return options, line
        name, value = match.groups()
        if name in options:
            _complain(state, line, f"option {name!r} is given twice; legal: once")
        options[name] = OptionValue(value.strip(), line + 1)
    return options, end


def _push(
    state: StateBlock, directive: Directive[Any] | None, call: DirectiveCall, body: int, last: int
) -> None:
    token = state.push("directive_open", "", 1)
    token.block = True
    token.map = [call.line - 1, last]
    token.meta = {"directive": directive, "call": call}
    parent, limit = state.parentType, state.lineMax
    state.parentType, state.lineMax = "container", last
    state.md.block.tokenize(state, body, last)
    state.parentType, state.lineMax = parent, limit
    state.push("directive_close", "", -1).block = True


def _complain(state: StateBlock, line: int, message: str) -> None:
    state.env.setdefault("problems", []).append((line + 1, message))
