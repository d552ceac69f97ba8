"""The Markdown of the book: CommonMark and what is added to it, in order. Each rule has a file."""

import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from types import MappingProxyType
from typing import Any

from markdown_it import MarkdownIt
from markdown_it.rules_block import StateBlock
from mdit_py_plugins.dollarmath import dollarmath_plugin
from mdit_py_plugins.footnote import footnote_plugin
from mdit_py_plugins.front_matter import front_matter_plugin

from site_builder.diagnostics.diagnostic import BELOW, TARGETS, UNREAD
from site_builder.languages.words import ENGLISH, Words
from site_builder.markdown.directive import Directive, DirectiveCall, OptionValue
from site_builder.markdown.directives import DIRECTIVES
from site_builder.markdown.directives.boxes import book_boxes
from site_builder.markdown.numbering import heading_ids_rule
from site_builder.markdown.role import role_rule
from site_builder.markdown.roles import ROLES
from site_builder.markdown.text.dialects import dialects_rule, own_label, unknown_name
from site_builder.markdown.text.stray_marks import UNOPENED, stray_marks_rule
from site_builder.markdown.text.tokens import displays_rule, typography_rule

OPENING = re.compile(r"(:{3,})\{([\w-]+)\}[ \t]*(.*)")
CLOSING = re.compile(r"(:{3,})[ \t]*")
OPTION = re.compile(r":([A-Za-z_][\w-]*):[ \t]*(.*)")
CODE_FENCE = re.compile(r"`{3,}|~{3,}")


def displayed_rule(
    rule: Callable[[StateBlock, int, int, bool], bool],
    state: StateBlock,
    start: int,
    end: int,
    silent: bool,
) -> bool:
    """The ``rule`` of displayed formulae, which may end a paragraph: it leaves no tokens where it
    is only asked whether one begins."""
    count, line = len(state.tokens), state.line
    found = rule(state, start, end, silent)
    if silent:
        del state.tokens[count:]
        state.line = line
    return found


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
        _complain(state, start, _stray(text), *(() if CLOSING.fullmatch(text) else UNOPENED))
        attributes = re.match(r"(:{3,})\s*\{\.", text)  # of another tool, whose end is no mistake
        last = _find_end(state, start, end, len(attributes[1]))[0] if attributes else start
        state.line = min(last + 1, end)
        return True
    fence, name, argument = opening.groups()
    last, in_code = _find_end(state, start, end, len(fence))
    if last == end and not in_code:  # else the code is never closed
        _complain(
            state,
            start,
            f"directive {{{name}}} is never closed; close it with {fence!r}",
            BELOW,
            f"{{{name}}} is empty",
            *TARGETS,
        )
    known = [option.name for option in directives[name].options] if name in directives else []
    options, body = _read_options(state, start + 1, last, known)
    if name not in directives:
        _complain(state, start, unknown_name("directive", name, directives), *UNREAD, *TARGETS)
        body = last  # what it would mean is not known
    call = DirectiveCall(name, argument.strip(), options, start + 1)
    _push(state, directives.get(name), call, body, last)
    state.line = min(last + 1, end)
    return True


def _stray(text: str) -> str:
    if CLOSING.fullmatch(text):
        return f"{text!r} closes no directive; legal: after an opening like ':::{{note}}'"
    if callout := re.search(r"\{\.callout-(\w+)", text):
        return unknown_name("directive", f"callout-{callout[1]}", ("note", "tip", "warning"))
    return f"{text!r} is no directive; legal: ':::{{name}} argument'"


def _find_end(state: StateBlock, start: int, end: int, length: int) -> tuple[int, bool]:
    """Line of the closing fence, or ``end`` where there is none; and whether code stands there."""
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
                return line, False
    return end, bool(code)


def _read_options(
    state: StateBlock, start: int, end: int, known: Sequence[str]
) -> tuple[dict[str, OptionValue], int]:
    options: dict[str, OptionValue] = {}
    for line in range(start, end):
        text = _line(state, line)
        match = OPTION.fullmatch(text)
        if not match and text.partition(":")[0] in known:
            match = OPTION.fullmatch(f":{text}")
            _complain(
                state, line, f"option {text!r} without its first colon; legal: {f':{text}'!r}"
            )
        if not match:
            return options, line
        name, value = match.groups()
        if name in ("name", "label"):  # as MyST calls and writes it
            name, value = "label", own_label(value) if re.search("[:_.]", value) else value
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


def _complain(state: StateBlock, line: int, message: str, *spoils: str) -> None:
    state.env.setdefault("problems", []).append((line + 1, message, *spoils))


ENDED_BY_DIRECTIVES = ["paragraph", "reference", "blockquote", "list", "footnote_def"]
"""Blocks that need no empty line before a directive or a displayed formula."""


def make_parser(
    words: Words = ENGLISH, boxes: Mapping[str, str] = MappingProxyType({})
) -> MarkdownIt:
    """CommonMark with the book's additions, the quotation marks of its language, and its own
    ``boxes``: titles by the names of directives."""
    quotes = words("language.quotes")
    parser = MarkdownIt("commonmark", {"typographer": True, "html": True, "quotes": quotes})
    parser.enable(["table", "smartquotes"])
    parser.use(front_matter_plugin).use(footnote_plugin)
    # Labels as written: what is no label is reported.
    parser.use(
        dollarmath_plugin,
        allow_space=False,
        allow_digits=False,
        allow_blank_lines=False,
        double_inline=True,
        label_normalizer=str,
    )
    displayed = next(rule for rule in parser.block.ruler.__rules__ if rule.name == "math_block")
    parser.block.ruler.at(
        "math_block", partial(displayed_rule, displayed.fn), {"alt": ENDED_BY_DIRECTIVES}
    )
    # Each before the rule that would otherwise take, or change, what is meant for it.
    directives = {item.name: item for item in (*book_boxes(boxes), *DIRECTIVES)}
    roles = partial(role_rule, {role.name: role for role in ROLES})
    rule = partial(directive_rule, directives)
    parser.block.ruler.before("math_block", "directive", rule, {"alt": ENDED_BY_DIRECTIVES})
    parser.inline.ruler.before("backticks", "role", roles)
    parser.inline.add_terminator_char("{")  # where a run of text stops, since a role may begin
    dialects = partial(dialects_rule, tuple(directives))
    parser.core.ruler.after("normalize", "dialects", dialects)
    parser.core.ruler.before("smartquotes", "typography", typography_rule)
    parser.core.ruler.before("typography", "heading_ids", heading_ids_rule)
    parser.core.ruler.after("inline", "displays", displays_rule)
    # Before escaped characters, which are meant, are joined with the text around them.
    parser.core.ruler.before("text_join", "stray_marks", stray_marks_rule)
    return parser
