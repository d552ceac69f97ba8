"""Rules asked only where a line, or a place in it, begins with a mark of theirs.

Most lines begin with a letter, and most letters are no marks: the parser would ask a dozen rules of
each, and all but the last say no at the first character. What comes out is the same.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from markdown_it import MarkdownIt
from markdown_it.common.utils import mdTrim
from markdown_it.ruler import Rule, Ruler
from markdown_it.rules_block import StateBlock
from markdown_it.rules_core import StateCore, normalize
from markdown_it.rules_core.smartquotes import process_inlines
from markdown_it.rules_inline import StateInline
from markdown_it.token import Token

BLOCK_MARKS: Mapping[str, str] = {
    "front_matter": "",  # nowhere but in the first line, of which all are asked
    "directive": ":",
    "math_block": "$",
    "fence": "`~",
    "blockquote": ">",
    "hr": "*-_",
    "list": "*+-0123456789",
    "footnote_def": "[",
    "reference": "[",
    "html_block": "<",
    "heading": "#",
}
"""What a line begins with that a rule may take, behind its indentation. Rules that are not listed
look at more, and are asked of every line."""
INLINE_MARKS: Mapping[str, str] = {
    "newline": "\n",
    "math_inline": "$",
    "escape": "\\",
    "role": "{",
    "backticks": "`",
    "emphasis": "*_",
    "link": "[",
    "image": "!",
    "footnote_inline": "^",
    "footnote_ref": "[",
    "autolink": "<",
    "html_inline": "<",
    "entity": "&",
}
"""Likewise of a place in running text."""

type BlockRule = Callable[[StateBlock, int, int, bool], bool]
type InlineRule = Callable[[StateInline, bool], bool]


def ask_by_marks(parser: MarkdownIt) -> None:
    """Have ``parser``, whose rules are complete, ask by marks."""
    parser.block.ruler = _BlockRuler(parser.block.ruler)
    parser.inline.ruler = _InlineRuler(parser.inline.ruler)
    for name, rule in CORE.items():
        parser.core.ruler.at(name, rule)


class _BlockRuler(Ruler[BlockRule]):
    """Hands out each of its chains as one rule."""

    def __init__(self, given: Ruler[BlockRule]) -> None:
        super().__init__()
        self.__rules__ = given.__rules__

    def __compile__(self) -> None:
        super().__compile__()
        assert self.__cache__ is not None
        for chain, rules in self.__cache__.items():
            named = [rule for rule in self.__rules__ if rule.enabled and rule.fn in rules]
            self.__cache__[chain] = [_block_rule(named, begins=not chain)]


class _InlineRuler(Ruler[InlineRule]):
    """Likewise."""

    def __init__(self, given: Ruler[InlineRule]) -> None:
        super().__init__()
        self.__rules__ = given.__rules__

    def __compile__(self) -> None:
        super().__compile__()
        assert self.__cache__ is not None
        named = [rule for rule in self.__rules__ if rule.enabled]
        self.__cache__[""] = [_inline_rule(named)]


def by_mark(
    rules: Sequence[Rule[Any]], marks: Mapping[str, str]
) -> tuple[dict[str, list[Any]], list[Any]]:
    """Those to ask where there is a mark, by the mark, and those to ask elsewhere; in their
    order."""
    all_marks = {mark for rule in rules for mark in marks.get(rule.name, "")}
    asked = {
        mark: [rule.fn for rule in rules if mark in marks.get(rule.name, mark)]
        for mark in all_marks
    }
    return asked, [rule.fn for rule in rules if rule.name not in marks]


def _block_rule(rules: Sequence[Rule[BlockRule]], *, begins: bool) -> BlockRule:
    """The first of ``rules`` that takes a line. Where they ``begin`` blocks, and do not ask only
    what ends one, a paragraph of one line is made here."""
    every = [rule.fn for rule in rules]
    asked, elsewhere = by_mark(rules, BLOCK_MARKS)

    def take(state: StateBlock, start: int, end: int, silent: bool) -> bool:
        place = state.bMarks[start] + state.tShift[start]
        if start == 0 or place >= state.eMarks[start]:  # front matter looks at more, and so do
            chosen = every  # rules at the end of the text
        elif (found := asked.get(state.src[place])) is not None:
            chosen = found
        elif begins and not silent and _is_alone(state, start, end):
            _push_paragraph(state, start, place)
            return True
        else:
            chosen = elsewhere
        for rule in chosen:  # noqa: SIM110  (a third quicker)
            if rule(state, start, end, silent):
                return True
        return False

    return take


def _is_alone(state: StateBlock, line: int, end: int) -> bool:
    """Whether it is a line of text with an empty one below, or none: nothing but a paragraph."""
    if end != state.lineMax or state.sCount[line] - state.blkIndent > 3:
        return False
    return line + 1 >= end or state.isEmpty(line + 1)


def _push_paragraph(state: StateBlock, line: int, place: int) -> None:
    state.line = line + 1
    state.parentType = "paragraph"  # as a heading that might have been underlined leaves it
    state.push("paragraph_open", "p", 1).map = [line, line + 1]
    token = state.push("inline", "", 0)
    token.content = mdTrim(state.src[place : state.eMarks[line]])
    token.map = [line, line + 1]
    token.children = []
    state.push("paragraph_close", "p", -1)


def _inline_rule(rules: Sequence[Rule[InlineRule]]) -> InlineRule:
    """The first of ``rules`` that takes what stands at a place."""
    asked, elsewhere = by_mark(rules, INLINE_MARKS)

    def take(state: StateInline, silent: bool) -> bool:
        for rule in asked.get(state.src[state.pos], elsewhere):  # noqa: SIM110  (a third quicker)
            if rule(state, silent):
                return True
        return False

    return take


def inline_rule(state: StateCore) -> None:
    """In the place of markdown-it's own: text without a mark in it is one piece of text."""
    parser = state.md.inline
    for token in state.tokens:
        if token.type != "inline":
            continue
        if token.children is None:
            token.children = []
        if parser.terminator_re.search(token.content):
            parser.parse(token.content, state.md, state.env, token.children)
        elif token.content:
            token.children.append(Token("text", "", 0, content=token.content))


def normalize_rule(state: StateCore) -> None:
    """Likewise: most texts have but one kind of line ends, and no NUL."""
    if "\r" in state.src or "\0" in state.src:
        normalize(state)


def quotes_rule(state: StateCore) -> None:
    """Likewise: quotation marks are set only in paragraphs that have some."""
    for token in state.tokens:
        if token.type == "inline" and ("'" in token.content or '"' in token.content):
            process_inlines(token.children or [], state)


CORE: Mapping[str, Callable[[StateCore], None]] = {
    "normalize": normalize_rule,
    "inline": inline_rule,
    "smartquotes": quotes_rule,
}
"""In the place of rules of markdown-it's own that work on all of a text."""
