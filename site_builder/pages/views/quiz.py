"""A question as the page's script needs it, to answer at once."""

import hashlib
from collections.abc import Sequence

from jinja2 import pass_context
from jinja2.runtime import Context
from markupsafe import Markup

from site_builder.markdown.questions.options import OTHERWISE
from site_builder.page_model.questions import Option, Quiz
from site_builder.pages.embedding import json_for_html
from site_builder.render.screen import PassageRenderer


@pass_context
def quiz_data(context: Context, quiz: Quiz) -> Markup:
    """JSON that is safe inside a script element."""
    data: dict[str, object] = {
        "id": quiz.id,
        "kind": quiz.kind,
        "edition": quiz.edition,
        "options": option_data(quiz.options, context["renderer"]),
    }
    if quiz.kind == "number":
        data["tolerance"] = quiz.tolerance
    if quiz.kind == "figure":
        data["conditions"] = [option.text for option in quiz.options if option.text != OTHERWISE]
    return json_for_html(data)


def option_data(options: Sequence[Option], render: PassageRenderer) -> list[dict[str, object]]:
    """What is said of each answer, and the number that it is, where it is one."""
    return [
        {"correct": option.correct, "explanation_html": render(option.explanation)}
        | ({} if option.value is None else {"value": option.value})
        for option in options
    ]


def in_any_order(options: Sequence[Option]) -> list[tuple[int, Option]]:
    """Things to be put in order, in one that tells nothing and does not change; where they
    belong, and what they are."""
    mixed = sorted(
        enumerate(options), key=lambda item: hashlib.sha256(item[1].text.encode()).digest()
    )
    places = [place for place, _ in mixed]
    return mixed if places != sorted(places) else mixed[::-1]
