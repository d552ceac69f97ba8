"""``{predict} id``: a guess before the answer: a number, a choice, or a sketch."""

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
from site_builder.markdown.questions.answers import Parts, check_parts, split_body
from site_builder.markdown.questions.options import (
    UNIT,
    WITHIN,
    chosen_options,
    number_options,
)
from site_builder.markdown.questions.question import (
    check_answers,
    check_id,
    check_options_belong,
    prediction_id,
    prompt_text,
)
from site_builder.markdown.questions.sketches import read_curve
from site_builder.page_model.passage import Plain, passage
from site_builder.page_model.questions import Option, Prediction

KINDS = ("choice", "number", "sketch")
BELONGS: Mapping[str, tuple[str, ...]] = {
    "unit": ("number",),
    "within": ("number",),
    "curve": ("sketch",),
    "x": ("sketch",),
    "y": ("sketch",),
}
"""The kinds that an option has a meaning for."""
LEAST = {"choice": (2, "- [ ] …"), "number": (1, "- [x] `expression`")}
"""How many answers a kind must have, and how one is written."""


def read_predict(
    call: DirectiveCall, body: Sequence[Token], context: ParseContext
) -> Prediction | None:
    check_id(call, context)
    kind = call.text("kind")
    check_options_belong(call, kind, BELONGS, context)
    parts = Parts(tuple(body), (), ()) if kind == "sketch" else split_body(body)
    check_parts(call, parts, context)
    curve = read_curve(call, context) if kind == "sketch" else None
    if kind == "sketch" and curve is None:
        return None
    options, tolerance = _read_options(call, kind, parts, context)
    if kind != "sketch":
        least, form = LEAST[kind]
        check_answers(call, options, len(parts.items), context, least=least, form=form)
    return Prediction(
        id=call.argument,
        kind=kind,
        prompt=passage(parts.prompt),
        prompt_text=prompt_text(parts),
        options=options,
        path=context.path,
        line=call.line,
        unit=call.text("unit"),
        tolerance=tolerance,
        curve=curve,
    )


def _read_options(
    call: DirectiveCall, kind: str, parts: Parts, context: ParseContext
) -> tuple[tuple[Option, ...], float]:
    match kind:
        case "number":
            return number_options(call, parts.items, context, replies=False)
        case "choice":
            return chosen_options(parts.items, context), 0.0
        case _:
            return (), 0.0


PREDICT = Directive(
    name="predict",
    doc="a guess, before the answer",
    argument=Argument("id", lacks="has no id"),
    options=(
        OptionLine("kind", doc="what is guessed", expected=KINDS),
        UNIT,
        WITHIN,
        OptionLine("curve", doc="what is to be sketched, an expression in `x`"),
        OptionLine("x", doc="an axis, `0 90 Angle (°)`"),
        OptionLine("y", doc="the other axis"),
    ),
    body=Body("the question, and its answers as a list", plain_tokens),
    read=read_predict,
    template="predict",
    numbered=Numbered("Prediction", prediction_id),
    plain=lambda prediction: Plain((prediction.prompt,), "question"),
)
