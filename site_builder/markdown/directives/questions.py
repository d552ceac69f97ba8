"""``{quiz}`` asks, ``{predict}`` asks for a guess, and ``{answer}`` is hidden until it was made.

Every question has an id, options that fit its kind, and answers that the kind reads.
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from markdown_it.token import Token

from site_builder.diagnostics.diagnostic import UNREAD
from site_builder.document.blocks import Block, Prediction, Question, Quiz, Reveal
from site_builder.document.places import Passage, Plain, passage
from site_builder.markdown.block_tree import BLOCKS, plain_tokens
from site_builder.markdown.directive import (
    Argument,
    Body,
    Directive,
    DirectiveCall,
    Numbered,
    OptionLine,
    OptionValue,
)
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.questions.kinds import (
    KINDS,
    kind_named,
    names_of_kinds,
    options_of_kinds,
)
from site_builder.markdown.text.tokens import plain_text

ID = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")


def question_directive[Q: Question](
    name: str,
    made: type[Q],
    read_prompt: Callable[[DirectiveCall, Sequence[Token], ParseContext], Passage],
    *,
    doc: str,
    kind_doc: str,
    numbered: Numbered,
) -> Directive[Any]:
    """A directive that asks a question of one of the `KINDS`; it becomes a ``made``."""

    def read(call: DirectiveCall, body: Sequence[Token], context: ParseContext) -> Q | None:
        _check_id(call, context)
        _check_options(call, context)
        plain_tokens(call, body, context)
        asked = kind_named(call.text("kind")).read(call, body, context)
        if asked is None:
            return None
        texts = (plain_text(token) for token in asked.prompt if token.type == "inline")
        return made(
            id=call.argument,
            kind=call.text("kind"),
            prompt=read_prompt(call, asked.prompt, context),
            prompt_text=" ".join(texts),
            options=asked.options,
            path=context.path,
            line=call.line,
            details=asked.details,
            decides=asked.decides or (0.0 if made is Quiz else None),
        )

    kind = OptionLine(name="kind", doc=kind_doc, expected=names_of_kinds(name))
    return Directive(
        name=name,
        doc=doc,
        argument=Argument("id", lacks="has no id"),
        options=(kind, *options_of_kinds(name)),
        body=Body("the question, and its answers as a list", lambda _call, body, _context: body),
        read=read,
        template=name,
        numbered=numbered,
        plain=lambda question: Plain((question.prompt,), "question"),
    )


def prediction_id(call: DirectiveCall) -> str:
    """Element id of the prediction that this is, or is the answer to."""
    return f"predict-{call.argument}"


def _check_id(call: DirectiveCall, context: ParseContext) -> None:
    if not ID.fullmatch(call.argument):
        expected = "small letters, digits and hyphens"
        message = f"{call.name} id {call.argument!r}; legal: {expected}"
        context.problem(call.line, message, spoils=UNREAD)


def _check_options(call: DirectiveCall, context: ParseContext) -> None:
    """Report options that mean nothing to this kind of question."""
    own = call.text("kind")
    for name, option in call.options.items():
        kinds = [
            each
            for kind in KINDS
            if name in (line.name for line in kind.options)
            for each in kind.names(call.name)
        ]
        if kinds and own not in kinds:
            expected = " or ".join(f"with ':kind: {each}'" for each in kinds)
            context.problem(
                option.line, f"option {name!r} of a {own!r} {call.name}; legal: {expected}"
            )


def _prompt(call: DirectiveCall, prompt: Sequence[Token], context: ParseContext) -> Passage:
    """The question as phrasing content, all that a paragraph may hold: one line below another."""
    shown: list[list[Token]] = []
    for token in prompt:
        if token.type == "inline":
            shown.append(list(token.children or ()))
        elif token.type in ("math_block", "math_block_label"):
            shown.append([Token("math_inline", "math", 0, content=token.content, meta=token.meta)])
        elif token.type not in ("paragraph_open", "paragraph_close"):
            quiz = f"quiz {call.argument!r}"
            message = f"the question of {quiz} holds more than text and formulae"
            message += "; legal: put it above the quiz, or answers as one list"
            context.problem(call.line, message, spoils=(f"{quiz} has",))
            break
    first, *others = shown or [[]]
    lines = [*first]
    for line in others:
        lines += [Token("hardbreak", "br", 0), *line]
    return passage([Token("inline", "", 0, children=lines)])


QUIZ = question_directive(
    "quiz",
    Quiz,
    _prompt,
    doc="a question with explained answers",
    kind_doc="how it is answered",
    numbered=Numbered("Question", lambda call: f"quiz-{call.argument}"),
)


def read_exercise(call: DirectiveCall, body: Sequence[Token], context: ParseContext) -> Quiz | None:
    options = {**call.options, "kind": OptionValue(CODE.quiz[0], call.line)}
    question = QUIZ.read(replace(call, name="quiz", options=options), body, context)
    return question if isinstance(question, Quiz) else None


CODE = kind_named("code")
EXERCISE = replace(
    QUIZ,
    name="exercise",
    doc="a function to write",
    options=CODE.options,
    body=replace(QUIZ.body, doc="the task, its parts in code blocks, and hints as a list"),
    read=read_exercise,
)


PREDICT = question_directive(
    "predict",
    Prediction,
    lambda _call, prompt, _context: passage(prompt),
    doc="a guess, before the answer",
    kind_doc="what is guessed",
    numbered=Numbered("Prediction", prediction_id),
)


def read_reveal(call: DirectiveCall, _body: Sequence[Block], context: ParseContext) -> Reveal:
    name = context.free_id(f"answer-{call.argument}", call.line)
    return Reveal(call.argument, name, context.path, call.line)


ANSWER = Directive(
    name="answer",
    doc="what is hidden until the prediction of that id is answered",
    argument=Argument("id", lacks="names no prediction"),
    body=BLOCKS,
    read=read_reveal,
    template="answer",
)
