"""``{predict} id``: a guess before the answer: a number, a choice, or a sketch."""

from collections.abc import Mapping, Sequence

from markdown_it.token import Token

from site_builder.markdown.bodies import plain_tokens
from site_builder.markdown.directive import Argument, Body, Directive, Numbered, OptionLine, Use
from site_builder.markdown.questions.answers import Parts, check_parts, split_body
from site_builder.markdown.questions.options import (
    UNIT,
    USES,
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
from site_builder.markdown.reading import Reading
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


def read_predict(use: Use, body: Sequence[Token], reading: Reading) -> Prediction | None:
    check_id(use, reading)
    kind = use.text("kind")
    check_options_belong(use, kind, BELONGS, reading)
    parts = Parts(tuple(body), (), ()) if kind == "sketch" else split_body(body)
    check_parts(use, parts, reading)
    curve = read_curve(use, reading) if kind == "sketch" else None
    if kind == "sketch" and curve is None:
        return None
    options, tolerance = _read_options(use, kind, parts, reading)
    if kind != "sketch":
        least, form = LEAST[kind]
        check_answers(use, options, len(parts.items), reading, least=least, form=form)
    return Prediction(
        id=use.argument,
        kind=kind,
        prompt_html=reading.html(parts.prompt),
        prompt_text=prompt_text(parts),
        options=options,
        path=reading.path,
        line=use.line,
        unit=use.text("unit"),
        tolerance=tolerance,
        curve=curve,
    )


def _read_options(
    use: Use, kind: str, parts: Parts, reading: Reading
) -> tuple[tuple[Option, ...], float]:
    match kind:
        case "number":
            return number_options(use, parts.items, reading, replies=False)
        case "choice":
            return chosen_options(use, parts.items, reading), 0.0
        case _:
            return (), 0.0


PREDICT = Directive(
    name="predict",
    says="a guess, before the answer",
    argument=Argument("id", lacks="has no id"),
    options=(
        OptionLine("kind", says="what is guessed", legal=KINDS),
        UNIT,
        WITHIN,
        USES,
        OptionLine("curve", says="what is to be sketched, an expression in `x`"),
        OptionLine("x", says="an axis, `0 90 Angle (°)`"),
        OptionLine("y", says="the other axis"),
    ),
    body=Body("the question, and its answers as a list", plain_tokens),
    read=read_predict,
    template="predict",
    numbered=Numbered("Prediction", prediction_id),
)
