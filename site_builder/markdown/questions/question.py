"""What every question has: an id, options that fit its kind, and answers that the kind reads."""

import re
from collections.abc import Callable, Sequence
from typing import Any

from markdown_it.token import Token

from site_builder.markdown.bodies import plain_tokens
from site_builder.markdown.directive import (
    Argument,
    Body,
    Directive,
    DirectiveCall,
    Numbered,
    OptionLine,
)
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.questions.kinds import (
    KINDS,
    kind_named,
    names_of_kinds,
    options_of_kinds,
)
from site_builder.markdown.text.tokens import plain_text
from site_builder.page_model.passage import Passage, Plain
from site_builder.page_model.questions import Question

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
            decides=asked.decides,
        )

    kind = OptionLine("kind", doc=kind_doc, expected=names_of_kinds(name))
    return Directive(
        name=name,
        doc=doc,
        argument=Argument("id", lacks="has no id"),
        options=(kind, *options_of_kinds(name)),
        body=Body("the question, and its answers as a list", plain_tokens),
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
        context.problem(call.line, f"{call.name} id {call.argument!r}; legal: {expected}")


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
