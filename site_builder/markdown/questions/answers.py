"""The body of a question: what is asked, and below it a list of answers, each with its reply.

- [x] 16 px
  : Twice the radius gives eight times the displacement.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from markdown_it.token import Token

from site_builder.document.passage import Passage, passage
from site_builder.document.questions import OTHERWISE, Option
from site_builder.markdown.directive import DirectiveCall
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.text.tokens import plain_text

MARKS = {"[ ]": "wrong", "[x]": "right", "[X]": "right", "[?]": "computed"}
LEGAL_MARKS = "'- [ ] …' or '- [x] …'"


@dataclass(frozen=True, slots=True)
class Item:
    """The tokens of one item of the list."""

    paragraphs: tuple[Token, ...]
    line: int


@dataclass(frozen=True, slots=True)
class Parts:
    """A question taken apart."""

    prompt: tuple[Token, ...]
    items: tuple[Item, ...]
    rest: tuple[Token, ...]
    """What stands below the list."""


@dataclass(frozen=True, slots=True)
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


def split_body(body: Sequence[Token], kind: str = "bullet") -> Parts:
    """What is asked, the items of the last list at the margin, and what follows."""
    margin = body[0].level if body else 0
    starts = [
        index
        for index, token in enumerate(body)
        if token.type == f"{kind}_list_open" and token.level == margin
    ]
    if not starts:
        return Parts(tuple(body), (), ())
    end = next(
        index
        for index in range(starts[-1], len(body))
        if body[index].type == f"{kind}_list_close" and body[index].level == margin
    )
    items: list[Item] = []
    paragraphs: list[Token] = []
    for token in body[starts[-1] + 1 : end]:
        if token.type == "list_item_open" and token.level == margin + 1:
            paragraphs, item = [], token
        elif token.type == "inline":
            paragraphs.append(token)
        elif token.type == "list_item_close" and token.level == margin + 1:
            items.append(Item(tuple(paragraphs), (item.map or [0])[0] + 1))
    return Parts(tuple(body[: starts[-1]]), tuple(items), tuple(body[end + 1 :]))


def check_parts(call: DirectiveCall, parts: Parts, context: ParseContext) -> None:
    """There is something above the answers, and nothing below: it would not be shown."""
    what = f"{call.name} {call.argument!r}"
    if not parts.prompt:
        expected = "some text above its answers"
        context.problem(call.line, f"{what} asks no question; legal: {expected}")
    if parts.rest:
        line = (parts.rest[0].map or [call.line - 1])[0] + 1
        expected = "nothing after the answers, each explained by a ': …' line below it"
        context.problem(line, f"text below the answers of {what}; legal: {expected}")


def read_answer(
    item: Item,
    context: ParseContext,
    *,
    marked: bool = True,
    coded: bool = False,
    replies: bool = True,
) -> Answer | None:
    """The item, or None and a diagnostic. ``coded``: it begins with an expression in code, as
    marks that are computed do too; ``replies``: it has a reply."""
    lines = [line for paragraph in item.paragraphs for line in _split_lines(paragraph)]
    mark = _take_mark(lines, item.line, context) if marked else ""
    if mark is None:
        return None
    said, reply = _said_and_reply(lines)
    code = _take_code(said) if coded or mark == "computed" else ""
    words = Token("inline", "", 0, children=said)
    text = plain_text(words)
    if not text and not code:
        context.problem(item.line, "an answer without text; legal: '- [ ] some text'")
    if replies and not reply:
        what = text or code
        expected = "a ': …' line below it"
        context.problem(item.line, f"answer {what!r} is not explained; legal: {expected}")
    return Answer(
        mark=mark,
        code=code,
        words=passage([words]),
        text=text,
        reply=passage([Token("inline", "", 0, children=reply)]),
        line=item.line,
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


def _said_and_reply(lines: list[list[Token]]) -> tuple[list[Token], list[Token]]:
    texts: tuple[list[Token], list[Token]] = ([], [])
    explaining = False
    for line in lines:
        if line and line[0].type == "text" and line[0].content.startswith(": "):
            line[0].content = line[0].content[2:]
            explaining = True
        texts[explaining].extend([*line, Token("softbreak", "br", 0)])
    return texts[0][:-1], texts[1][:-1]


def _take_code(said: list[Token]) -> str:
    """The expression that an answer begins with, which leaves its words; nothing without one."""
    while said and said[0].type == "text" and not said[0].content.strip():
        del said[0]
    if not said or said[0].type != "code_inline":
        return ""
    code = said.pop(0).content
    if said and said[0].type == "text":
        said[0].content = said[0].content.lstrip()
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
    items: int,
    context: ParseContext,
    *,
    least: int = 2,
    form: str = "- [ ] …",
    right: str = "one",
) -> bool:
    """Whether ``items`` are enough, one of them is right and no two are alike; what is not so is
    reported. ``right`` says what is legal where several are; nothing: any number of them."""
    what = f"{call.name} {call.argument!r}"
    correct = sum(option.correct for option in options)
    if items < least:
        fault = f"{what} has {items} answers; legal: a list of {least} or more '{form}'"
    elif len(options) < items:
        return False  # a mistake already reported would be counted twice
    elif correct == 0:
        fault = f"{what} has no right answer; mark one with [x]"
    elif correct > 1 and right:
        fault = f"{what} has {correct} right answers; legal: {right}"
    elif len({option.text for option in options}) < len(options):
        fault = f"{what} gives the same answer twice; legal: answers that differ"
    else:
        return True
    context.problem(call.line, fault)
    return False


def check_otherwise(call: DirectiveCall, options: Sequence[Option], context: ParseContext) -> None:
    """The last answer is the reply to whatever no other recognises."""
    if options[-1].text != OTHERWISE:
        what = f"{call.name} {call.argument!r} has no reply to other answers"
        expected = f"'- [ ] {OTHERWISE}' at the end, with a ': …' line below it"
        context.problem(call.line, f"{what}; legal: {expected}")


def report_not_coded(answer: Answer, context: ParseContext) -> None:
    expected = f"an expression between backticks, or '- [ ] {OTHERWISE}'"
    context.problem(answer.line, f"answer {answer.text!r} is not computed; legal: {expected}")
