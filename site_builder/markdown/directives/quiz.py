"""``{quiz} id``: a question; answers as a task list, each explained by a ``: …`` line below it."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from markdown_it.token import Token

from site_builder.book import Option, Quiz
from site_builder.markdown.bodies import plain_tokens
from site_builder.markdown.directive import Argument, Body, Directive, OptionLine, Use
from site_builder.markdown.reading import Reading
from site_builder.markdown.text.tokens import plain_text

KINDS = ("single", "multiple")
ID = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")
MARKS = {"[ ]": False, "[x]": True, "[X]": True}


@dataclass(frozen=True, slots=True)
class _Answer:
    """The tokens of one list item."""

    paragraphs: tuple[Token, ...]
    line: int


def read_quiz(use: Use, body: Sequence[Token], reading: Reading) -> Quiz:
    _take_id(use, reading)
    kind = use.text("kind")
    prompt, answers, rest = _split(body)
    _check_parts(use, prompt, rest, reading)
    options = tuple(option for answer in answers if (option := _read_option(answer, reading)))
    _check_options_of_quiz(use, kind, options, len(answers), reading)
    return Quiz(
        id=use.argument,
        kind=kind,
        prompt_html=_prompt_html(prompt, use, reading),
        prompt_text=" ".join(plain_text(token) for token in prompt if token.type == "inline"),
        options=options,
        path=reading.path,
        line=use.line,
    )


def _take_id(use: Use, reading: Reading) -> None:
    name = use.argument
    if not ID.fullmatch(name):
        legal = "small letters, digits and hyphens"
        reading.problem(use.line, f"quiz id {name!r}; legal: {legal}")
    reading.take_id(f"quiz-{name}", use.line, "quiz")


def _check_parts(
    use: Use, prompt: Sequence[Token], rest: Sequence[Token], reading: Reading
) -> None:
    """There is something above the answers, and nothing below: it would not be shown."""
    name = use.argument
    if not prompt:
        legal = "some text above its answers"
        reading.problem(use.line, f"quiz {name!r} asks no question; legal: {legal}")
    if rest:
        line = (rest[0].map or [use.line - 1])[0] + 1
        legal = "nothing after the answers, each explained by a ': …' line below it"
        reading.problem(line, f"text below the answers of quiz {name!r}; legal: {legal}")


def _prompt_html(prompt: Sequence[Token], use: Use, reading: Reading) -> str:
    """The question as phrasing content: all that a ``legend`` may hold."""
    parts: list[str] = []
    for token in prompt:
        if token.type == "inline":
            parts.append(reading.html([token]))
        elif token.type == "math_block":
            parts.append(str(token.meta.get("mathml", "")))
        elif token.type not in ("paragraph_open", "paragraph_close"):
            reading.problem(
                use.line,
                f"the question of quiz {use.argument!r} holds more than text and formulae; "
                "legal: put it above the quiz",
            )
            break
    return "<br>".join(parts)


def _split(body: Sequence[Token]) -> tuple[list[Token], list[_Answer], list[Token]]:
    """The question, the items of the last list at the margin: the answers, and what follows."""
    starts = [
        index
        for index, token in enumerate(body)
        if token.type == "bullet_list_open" and token.level == body[0].level
    ]
    if not starts:
        return list(body), [], []
    end = next(
        index
        for index in range(starts[-1], len(body))
        if body[index].type == "bullet_list_close" and body[index].level == body[0].level
    )
    answers: list[_Answer] = []
    paragraphs: list[Token] = []
    for token in body[starts[-1] + 1 : end]:
        if token.type == "list_item_open" and token.level == body[0].level + 1:
            paragraphs, item = [], token
        elif token.type == "inline":
            paragraphs.append(token)
        elif token.type == "list_item_close" and token.level == body[0].level + 1:
            answers.append(_Answer(tuple(paragraphs), (item.map or [0])[0] + 1))
    return list(body[: starts[-1]]), answers, list(body[end + 1 :])


def _read_option(answer: _Answer, reading: Reading) -> Option | None:
    lines = [line for paragraph in answer.paragraphs for line in _split_lines(paragraph)]
    first = lines[0][0] if lines and lines[0] else None
    mark = first.content[:3] if first and first.type == "text" else ""
    if first is None or mark not in MARKS:
        reading.problem(answer.line, "an answer without its mark; legal: '- [ ] …' or '- [x] …'")
        return None
    first.content = first.content[3:].lstrip()
    texts: tuple[list[Token], list[Token]] = ([], [])
    explaining = False
    for line in lines:
        if line and line[0].type == "text" and line[0].content.startswith(": "):
            line[0].content = line[0].content[2:]
            explaining = True
        texts[explaining].extend([*line, Token("softbreak", "br", 0)])
    option = [_inline(part[:-1]) for part in texts]
    if not texts[0][:-1] or not plain_text(option[0]):
        reading.problem(answer.line, "an answer without text; legal: '- [ ] some text'")
    if not texts[1]:
        reading.problem(
            answer.line,
            f"answer {plain_text(option[0])!r} is not explained; legal: a ': …' line below it",
        )
    return Option(
        html=reading.html([option[0]]),
        text=plain_text(option[0]),
        correct=MARKS[mark],
        explanation_html=reading.html([option[1]]),
    )


def _split_lines(inline: Token) -> list[list[Token]]:
    lines: list[list[Token]] = [[]]
    for child in inline.children or ():
        if child.type == "softbreak":
            lines.append([])
        elif child.content or child.type != "text":
            lines[-1].append(child)
    return lines


def _inline(children: list[Token]) -> Token:
    return Token("inline", "", 0, children=children)


def _check_options_of_quiz(
    use: Use, kind: str, options: tuple[Option, ...], answers: int, reading: Reading
) -> None:
    name = use.argument
    right = sum(option.correct for option in options)
    if answers < 2:
        reading.problem(
            use.line,
            f"quiz {name!r} has {answers} answers; legal: a list of 2 or more '- [ ] …'",
        )
    elif len(options) < answers:
        return  # a mistake already reported would be counted twice
    elif right == 0:
        reading.problem(use.line, f"quiz {name!r} has no right answer; mark one with [x]")
    elif right > 1 and kind == "single":
        reading.problem(
            use.line,
            f"quiz {name!r} has {right} right answers; legal: one, or ':kind: multiple'",
        )
    elif len({option.text for option in options}) < len(options):
        message = f"quiz {name!r} gives the same answer twice; legal: answers that differ"
        reading.problem(use.line, message)


QUIZ = Directive(
    name="quiz",
    says="a question with explained answers",
    argument=Argument("id", lacks="has no id"),
    options=(OptionLine("kind", says="how many answers are right", legal=KINDS),),
    body=Body("the question, and its answers as a list", plain_tokens),
    read=read_quiz,
    template="quiz",
)
