"""``{quiz} id``: a question, by kinds; its answers are a list, each explained by ``: …`` below."""

from collections.abc import Mapping, Sequence

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
from site_builder.markdown.questions.answers import Item, Parts, check_parts, split_body
from site_builder.markdown.questions.options import (
    OTHERWISE,
    UNIT,
    WITHIN,
    chosen_options,
    number_options,
    ordered_options,
    state_options,
)
from site_builder.markdown.questions.question import (
    check_answers,
    check_id,
    check_options_belong,
    prompt_text,
)
from site_builder.page_model.passage import Passage, Plain, passage
from site_builder.page_model.questions import Option, Quiz

KINDS = ("single", "multiple", "number", "order", "figure")
BELONGS: Mapping[str, tuple[str, ...]] = {
    "unit": ("number",),
    "within": ("number",),
    "figure": ("figure",),
    "solution": ("figure",),
}
"""The kinds that an option has a meaning for."""


def read_quiz(call: DirectiveCall, body: Sequence[Token], context: ParseContext) -> Quiz:
    check_id(call, context)
    kind = call.text("kind")
    check_options_belong(call, kind, BELONGS, context)
    parts = split_body(body, "ordered" if kind == "order" else "bullet")
    check_parts(call, parts, context)
    options, tolerance = _read_options(call, kind, parts.items, context)
    _check_answers(call, kind, options, len(parts.items), context)
    return Quiz(
        id=call.argument,
        kind=kind,
        prompt=_prompt(parts, call, context),
        prompt_text=prompt_text(parts),
        options=options,
        path=context.path,
        line=call.line,
        unit=call.text("unit"),
        tolerance=tolerance,
        figure=call.text("figure"),
        solution=_solution(call, kind, context),
    )


def _read_options(
    call: DirectiveCall, kind: str, items: Sequence[Item], context: ParseContext
) -> tuple[tuple[Option, ...], float]:
    match kind:
        case "number":
            return number_options(call, items, context)
        case "order":
            return ordered_options(items, context), 0.0
        case "figure":
            return state_options(items, context), 0.0
        case _:
            return chosen_options(items, context), 0.0


def _solution(call: DirectiveCall, kind: str, context: ParseContext) -> dict[str, str]:
    """The settings that solve a question about a figure: ``k1=-0.1 k2=0``."""
    if kind != "figure":
        return {}
    pairs = call.text("solution").split()
    if not call.text("figure") or not pairs or not all("=" in pair for pair in pairs):
        expected = "lines ':figure: figure-SCENE' and ':solution: control=value …'"
        context.problem(call.line, f"quiz {call.argument!r} cannot be solved; legal: {expected}")
    return dict(pair.split("=", 1) for pair in pairs if "=" in pair)


def _prompt(parts: Parts, call: DirectiveCall, context: ParseContext) -> Passage:
    """The question as phrasing content, all that a ``legend`` may hold: one line below another."""
    shown: list[list[Token]] = []
    for token in parts.prompt:
        if token.type == "inline":
            shown.append(list(token.children or ()))
        elif token.type in ("math_block", "math_block_label"):
            shown.append([Token("math_inline", "math", 0, content=token.content, meta=token.meta)])
        elif token.type not in ("paragraph_open", "paragraph_close"):
            context.problem(
                call.line,
                f"the question of quiz {call.argument!r} holds more than text and formulae; "
                "legal: put it above the quiz",
            )
            break
    first, *others = shown or [[]]
    lines = [*first]
    for line in others:
        lines += [Token("hardbreak", "br", 0), *line]
    return passage([Token("inline", "", 0, children=lines)])


def _check_answers(
    call: DirectiveCall, kind: str, options: Sequence[Option], items: int, context: ParseContext
) -> None:
    """As every question's, and with a reply to what no answer foresees."""
    form = "1. …" if kind == "order" else "- [ ] …"
    right = {"single": "one, or ':kind: multiple'", "multiple": "", "order": ""}.get(kind, "one")
    sound = check_answers(call, options, items, context, form=form, right=right)
    if sound and kind in ("number", "figure") and options[-1].text != OTHERWISE:
        what = f"quiz {call.argument!r} has no reply to other answers"
        expected = f"'- [ ] {OTHERWISE}' at the end, with a ': …' line below it"
        context.problem(call.line, f"{what}; legal: {expected}")


QUIZ = Directive(
    name="quiz",
    doc="a question with explained answers",
    argument=Argument("id", lacks="has no id"),
    options=(
        OptionLine("kind", doc="how it is answered", expected=KINDS),
        UNIT,
        WITHIN,
        OptionLine("figure", doc="the element id of the figure that is to be set"),
        OptionLine("solution", doc="settings that solve it, `control=value …`"),
    ),
    body=Body("the question, and its answers as a list", plain_tokens),
    read=read_quiz,
    template="quiz",
    numbered=Numbered("Question", lambda call: f"quiz-{call.argument}"),
    plain=lambda quiz: Plain((quiz.prompt,), "question"),
)
