"""All kinds of questions. To add one: its folder, its import, and its name in `KINDS`.

The folder has ``kind.py``, ``kind.html``, ``kind.ts``, ``kind.css``, examples in ``kind.md``, and
for quizzes ``moodle.xml`` and ``qti.xml``, its form on learning platforms. Words of its template
and script go into every ``languages/*.toml``, in the same place.
"""

from site_builder.document.blocks import Question
from site_builder.markdown.directive import OptionLine
from site_builder.markdown.questions.choice.kind import CHOICE
from site_builder.markdown.questions.code.kind import CODE
from site_builder.markdown.questions.figure.kind import FIGURE
from site_builder.markdown.questions.kind import QuestionKind
from site_builder.markdown.questions.number.kind import NUMBER
from site_builder.markdown.questions.order.kind import ORDER
from site_builder.markdown.questions.sketch.kind import SKETCH

KINDS = (CHOICE, NUMBER, ORDER, FIGURE, SKETCH, CODE)


def kind_named(name: str) -> QuestionKind:
    """The kind that authors call ``name``."""
    return next(kind for kind in KINDS if name in (*kind.quiz, *kind.predict))


def kind_of(question: Question) -> QuestionKind:
    return kind_named(question.kind)


def names_of_kinds(directive: str) -> tuple[str, ...]:
    """What may stand behind ``:kind:``, the default first."""
    return tuple(name for kind in KINDS for name in kind.names(directive))


def options_of_kinds(directive: str) -> tuple[OptionLine, ...]:
    """The option lines that some kinds have."""
    kinds = [kind for kind in KINDS if kind.names(directive)]
    return tuple(dict.fromkeys(option for kind in kinds for option in kind.options))
