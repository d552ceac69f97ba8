"""``{quiz} id``: a question, by kinds; its answers are a list, each explained by ``: …`` below."""

from collections.abc import Mapping, Sequence

from markdown_it.token import Token

from site_builder.markdown.bodies import plain_tokens
from site_builder.markdown.directive import Argument, Body, Directive, Numbered, OptionLine, Use
from site_builder.markdown.questions.answers import Item, Parts, check_parts, split_body
from site_builder.markdown.questions.options import (
    OTHERWISE,
    UNIT,
    USES,
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
from site_builder.markdown.reading import Reading
from site_builder.page_model.questions import Option, Quiz

KINDS = ("single", "multiple", "number", "order", "figure")
BELONGS: Mapping[str, tuple[str, ...]] = {
    "unit": ("number",),
    "within": ("number",),
    "uses": ("single", "multiple", "number"),
    "figure": ("figure",),
    "solution": ("figure",),
}
"""The kinds that an option has a meaning for."""


def read_quiz(use: Use, body: Sequence[Token], reading: Reading) -> Quiz:
    check_id(use, reading)
    kind = use.text("kind")
    check_options_belong(use, kind, BELONGS, reading)
    parts = split_body(body, "ordered" if kind == "order" else "bullet")
    check_parts(use, parts, reading)
    options, tolerance = _read_options(use, kind, parts.items, reading)
    _check_answers(use, kind, options, len(parts.items), reading)
    return Quiz(
        id=use.argument,
        kind=kind,
        prompt_html=_prompt_html(parts, use, reading),
        prompt_text=prompt_text(parts),
        options=options,
        path=reading.path,
        line=use.line,
        unit=use.text("unit"),
        tolerance=tolerance,
        figure=use.text("figure"),
        solution=_solution(use, kind, reading),
    )


def _read_options(
    use: Use, kind: str, items: Sequence[Item], reading: Reading
) -> tuple[tuple[Option, ...], float]:
    match kind:
        case "number":
            return number_options(use, items, reading)
        case "order":
            return ordered_options(items, reading), 0.0
        case "figure":
            return state_options(items, reading), 0.0
        case _:
            return chosen_options(use, items, reading), 0.0


def _solution(use: Use, kind: str, reading: Reading) -> dict[str, str]:
    """The settings that solve a question about a figure: ``k1=-0.1 k2=0``."""
    if kind != "figure":
        return {}
    pairs = use.text("solution").split()
    if not use.text("figure") or not pairs or not all("=" in pair for pair in pairs):
        legal = "lines ':figure: figure-SCENE' and ':solution: control=value …'"
        reading.problem(use.line, f"quiz {use.argument!r} cannot be solved; legal: {legal}")
    return dict(pair.split("=", 1) for pair in pairs if "=" in pair)


def _prompt_html(parts: Parts, use: Use, reading: Reading) -> str:
    """The question as phrasing content: all that a ``legend`` may hold."""
    shown: list[str] = []
    for token in parts.prompt:
        if token.type == "inline":
            shown.append(reading.html([token]))
        elif token.type in ("math_block", "math_block_label"):
            shown.append(str(token.meta.get("mathml", "")))
        elif token.type not in ("paragraph_open", "paragraph_close"):
            reading.problem(
                use.line,
                f"the question of quiz {use.argument!r} holds more than text and formulae; "
                "legal: put it above the quiz",
            )
            break
    return "<br>".join(shown)


def _check_answers(
    use: Use, kind: str, options: Sequence[Option], items: int, reading: Reading
) -> None:
    """As every question's, and with a reply to what no answer foresees."""
    form = "1. …" if kind == "order" else "- [ ] …"
    right = {"single": "one, or ':kind: multiple'", "multiple": "", "order": ""}.get(kind, "one")
    sound = check_answers(use, options, items, reading, form=form, right=right)
    if sound and kind in ("number", "figure") and options[-1].text != OTHERWISE:
        what = f"quiz {use.argument!r} has no reply to other answers"
        legal = f"'- [ ] {OTHERWISE}' at the end, with a ': …' line below it"
        reading.problem(use.line, f"{what}; legal: {legal}")


QUIZ = Directive(
    name="quiz",
    says="a question with explained answers",
    argument=Argument("id", lacks="has no id"),
    options=(
        OptionLine("kind", says="how it is answered", legal=KINDS),
        UNIT,
        WITHIN,
        USES,
        OptionLine("figure", says="the element id of the figure that is to be set"),
        OptionLine("solution", says="settings that solve it, `control=value …`"),
    ),
    body=Body("the question, and its answers as a list", plain_tokens),
    read=read_quiz,
    template="quiz",
    numbered=Numbered("Question", lambda use: f"quiz-{use.argument}"),
)
