"""A quiz as the page's script needs it, to answer at once."""

from markupsafe import Markup

from site_builder.book import Quiz
from site_builder.pages.embedding import json_for_html


def quiz_data(quiz: Quiz) -> Markup:
    """JSON that is safe inside a script element."""
    return json_for_html(
        {
            "id": quiz.id,
            "kind": quiz.kind,
            "options": [
                {"correct": option.correct, "explanation_html": option.explanation_html}
                for option in quiz.options
            ],
        }
    )
