"""The body of a question: what is asked, and below it a list of answers, each with its reply.

- [x] 16 px
  : Twice the radius gives eight times the displacement.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from markdown_it.token import Token

from site_builder.document.blocks import OTHERWISE, Option
from site_builder.document.places import Passage, passage
from site_builder.markdown.directive import DirectiveCall
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.text.tokens import end_of_element, plain_text

MARKS = {"[ ]": "wrong", "[x]": "right", "[X]": "right", "[?]": "computed"}
LEGAL_MARKS = "'- [ ] …' or '- [x] …'"


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """One item, read: its words, what stands in code in front of them, and its reply."""

    mark: str
    """``right``, ``wrong`` or ``computed``; nothing where the list carries no marks."""
    code: str
    """The expression that it begins with, where one is asked for."""
    words: Passage
    text: str
    reply: Passage
    line: int


@dataclass(frozen=True, slots=True)
class Answers:
    prompt: tuple[Token, ...]
    read: tuple[Answer, ...]
    count: int
    """Items of the list, with those that could not be read."""


def read_answers(
    call: DirectiveCall,
    body: Sequence[Token],
    context: ParseContext,
    *,
    kind: str = "bullet",
    marked: bool = True,
    coded: bool = False,
    replies: bool = True,
) -> Answers:
    """What is asked, and the items of the last list at the margin; mistakes are reported.

    ``coded``: each begins with an expression in code, as marks that are computed do too;
    ``replies``: each has a reply.
    """
    margin = body[0].level if body else 0
    opens = [at for at, token in enumerate(body) if token.type == f"{kind}_list_open"]
    start = next((at for at in reversed(opens) if body[at].level == margin), len(body))
    end = end_of_element(body, start) if start < len(body) else start
    items: list[tuple[list[Token], int]] = []
    for token in body[start + 1 : end]:
        if token.type == "list_item_open" and token.level == margin + 1:
            items.append(([], (token.map or [0])[0] + 1))
        elif token.type == "inline":
            items[-1][0].append(token)
    what, rest = f"{call.name} {call.argument!r}", body[end:]
    if not start:
        expected = "some text above its answers"
        context.problem(call.line, f"{what} asks no question; legal: {expected}")
    if rest:  # it would not be shown
        line = (rest[0].map or [call.line - 1])[0] + 1
        expected = "nothing after the answers, each explained by a ': …' line below it"
        context.problem(line, f"text below the answers of {what}; legal: {expected}")
    read = [_answer(*item, context, marked, coded, replies) for item in items]
    return Answers(tuple(body[:start]), tuple(filter(None, read)), len(items))


def _answer(
    paragraphs: Sequence[Token],
    line: int,
    context: ParseContext,
    marked: bool,
    coded: bool,
    replies: bool,
) -> Answer | None:
    lines = [part for paragraph in paragraphs for part in _split_lines(paragraph)]
    mark = _take_mark(lines, line, context) if marked else ""
    if mark is None:
        return None
    answer, reply = _answer_and_reply(lines)
    code = _take_code(answer) if coded or mark == "computed" else ""
    words, replied = (Token("inline", "", 0, children=part) for part in (answer, reply))
    text = plain_text(words)
    if not text and not code:
        context.problem(line, "an answer without text; legal: '- [ ] some text'")
    if replies and not reply:
        expected = "a ': …' line below it"
        context.problem(line, f"answer {text or code!r} is not explained; legal: {expected}")
    return Answer(
        mark=mark, code=code, words=passage([words]), text=text, reply=passage([replied]), line=line
    )


def _take_mark(lines: list[list[Token]], line: int, context: ParseContext) -> str | None:
    """The mark of an answer, which leaves its words; None and a diagnostic where there is none."""
    first = lines[0][0] if lines and lines[0] else None
    written = first.content[:3] if first and first.type == "text" else ""
    if first is None or written not in MARKS:
        context.problem(line, f"an answer without its mark; legal: {LEGAL_MARKS}")
        return None
    first.content = first.content[3:].lstrip()
    return MARKS[written]


def _answer_and_reply(lines: list[list[Token]]) -> tuple[list[Token], list[Token]]:
    texts: tuple[list[Token], list[Token]] = ([], [])
    explaining = False
    for line in lines:
        if line and line[0].type == "text" and line[0].content.startswith(": "):
            line[0].content = line[0].content[2:]
            explaining = True
        texts[explaining].extend([*line, Token("softbreak", "br", 0)])
    return texts[0][:-1], texts[1][:-1]


def _take_code(tokens: list[Token]) -> str:
    """The expression that an answer begins with, which leaves its words; nothing without one."""
    while tokens and tokens[0].type == "text" and not tokens[0].content.strip():
        del tokens[0]
    if not tokens or tokens[0].type != "code_inline":
        return ""
    code = tokens.pop(0).content
    if tokens and tokens[0].type == "text":
        tokens[0].content = tokens[0].content.lstrip()
    return code


def _split_lines(inline: Token) -> list[list[Token]]:
    lines: list[list[Token]] = [[]]
    for child in inline.children or ():
        if child.type == "softbreak":
            lines.append([])
        elif child.content or child.type != "text":
            lines[-1].append(child)
    return lines


def check_answers(
    call: DirectiveCall,
    options: Sequence[Option],
    count: int,
    context: ParseContext,
    *,
    least: int = 2,
    form: str = "- [ ] …",
    right: str = "one",
    otherwise: bool = False,
) -> None:
    """Report fewer than ``least`` answers, no right answer, or two equal answers.

    ``count``: answers in the Markdown, malformed ones included. ``right``: the legal number of
    right answers, for the message; empty for any number. ``otherwise``: the last answer must be
    the reply to all other answers.
    """
    what = f"{call.name} {call.argument!r}"
    correct = sum(option.correct for option in options)
    fault = ""
    if count < least:
        fault = f"{what} has {count} answers; legal: a list of {least} or more '{form}'"
    elif len(options) < count:
        return  # a mistake already reported would be counted twice
    elif correct == 0:
        fault = f"{what} has no right answer; mark one with [x]"
    elif correct > 1 and right:
        fault = f"{what} has {correct} right answers; legal: {right}"
    elif len({option.text for option in options}) < len(options):
        fault = f"{what} gives the same answer twice; legal: answers that differ"
    elif otherwise and options[-1].text != OTHERWISE:
        expected = f"'- [ ] {OTHERWISE}' at the end, with a ': …' line below it"
        fault = f"{what} has no reply to other answers; legal: {expected}"
    if fault:
        context.problem(call.line, fault)


def report_not_coded(call: DirectiveCall, answer: Answer, context: ParseContext) -> None:
    number = answer.text.replace("−", "-").replace("–", "-").replace(",", ".")
    is_number = re.fullmatch(r"-?\d*\.?\d+", number)
    expected = f"'`{number}`'" if is_number else "an expression between backticks"
    expected += f", or '- [ ] {OTHERWISE}'"
    message = f"answer {answer.text!r} is not computed; legal: {expected}"
    context.problem(answer.line, message, spoils=(f"quiz {call.argument!r} is not solved",))
