"""What a kind of question is: one value in a folder of its own, beside its other files.

    NAME/kind.py    how it is written, and what a page must know of it
    NAME/kind.html  how it is asked and, in the answers at the end of the book, solved
    NAME/kind.ts    how a page reads and judges an answer
    NAME/kind.css   how it looks
    NAME/kind.md    examples for the authors' guide
    NAME/moodle.xml and NAME/qti.xml, of quizzes: how learning platforms import it

``kinds.py`` lists them; nothing else names one.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from markdown_it.token import Token

from site_builder.document.blocks import Option, Question, Simulation
from site_builder.markdown.directive import DirectiveCall, OptionLine
from site_builder.markdown.parse_context import ParseContext

HERE = Path(__file__).parent
FIGURE_LINE = OptionLine(name="figure", doc="the element id of a figure of the page")


@dataclass(frozen=True, slots=True)
class QuestionBody:
    """The body of a question, as its kind has read it."""

    prompt: tuple[Token, ...]
    options: tuple[Option, ...] = ()
    details: Any = None
    """What only its kind knows, for the functions below and its template."""
    decides: object = None
    """What else than the options decides what is right: stored answers to a question with another
    value are forgotten."""


@dataclass(frozen=True, slots=True, kw_only=True)
class QuestionKind:
    folder: str
    doc: str
    """In the authors' guide: ``a number within a tolerance``."""
    read: Callable[[DirectiveCall, Sequence[Token], ParseContext], QuestionBody | None]
    """None, and a report, where mistakes leave nothing to ask."""
    quiz: tuple[str, ...] = ()
    """What a ``{quiz}`` of it writes behind ``:kind:``; nothing where no quiz may be of it."""
    predict: tuple[str, ...] = ()
    """The same for a ``{predict}``."""
    options: tuple[OptionLine, ...] = ()
    """Option lines that no other kind has, or that kinds share by the same value."""
    numbered: bool = False
    """Whether the options are listed by number, and not by whether they are right."""
    page_data: Callable[[Question], Mapping[str, object]] = lambda _question: {}
    """What its script must know besides the options."""
    catalogue: Callable[[Question], Mapping[str, object]] = lambda _question: {}
    """What its entry in ``book.json`` has besides."""
    form_data: Callable[[Question], Mapping[str, object]] = lambda _question: {}
    """``data-`` attributes of its form."""
    view: Callable[[Question, Sequence[Simulation]], object] = lambda _question, _figures: None
    """What its template shows besides; it is given the figures of the chapter."""
    offered: Callable[[Question], Sequence[Option]] = lambda _question: ()
    """The options to choose from or to put in order, as a page lists them."""
    drawn: bool = False
    """Whether its field is a drawing, which holds what is right."""
    cells: Callable[[Question], Sequence[str]] = lambda _question: ()
    """The Python that a notebook offers to complete, and its checks."""
    is_program: bool = False
    """Whether its answer is a program, for which readers take minutes of their own."""
    needs_page: bool = False
    """Whether it is answered with a figure of its page, which no other place has."""

    def names(self, directive: str) -> tuple[str, ...]:
        return self.quiz if directive == "quiz" else self.predict

    @property
    def template(self) -> str:
        return f"questions/{self.folder}/kind.html"

    def export(self, platform: str) -> str:
        """Its template for ``moodle`` or ``qti``."""
        return f"questions/{self.folder}/{platform}.xml"

    def file(self, suffix: str) -> Path:
        return HERE / self.folder / f"kind.{suffix}"
