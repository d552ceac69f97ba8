"""The book's questions as learning platforms import them: Moodle XML, and a package of QTI 2.1.

How a question of a kind is written stands in the kind's folder, ``moodle.xml`` and ``qti.xml``.
Passages become plain XHTML, which platforms keep: no classes, and links that lead to the site.
Formulae are TeX for Moodle, between ``\\(`` and ``\\)``, which its filter sets and its editor shows
as text. QTI has MathML, which is part of the format.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from html import escape
from itertools import groupby
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from markdown_it.token import Token
from markupsafe import Markup

from site_builder.document.blocks import OTHERWISE, Option, Quiz
from site_builder.document.book import Book, Chapter
from site_builder.document.places import Passage
from site_builder.editions.tree import MATHML, elements, on_site, parse
from site_builder.files.folders import archive_of
from site_builder.formulae.temml import plain_tex
from site_builder.markdown.questions.kind import QuestionKind
from site_builder.markdown.questions.kinds import kind_of
from site_builder.pages.embeds import embed_address
from site_builder.pages.environment import render_template
from site_builder.pages.views.question import numbered_quizzes
from site_builder.render.screen import RULES, PassageRenderer, mathml_of, renderer_with

KEPT = frozenset({"href", "start", "colspan", "rowspan"})
LENGTHS = ("lspace", "rspace", "width", "height", "depth")
STYLES = frozenset({"displaystyle", "mathbackground", "mathcolor", "scriptlevel"})
"""Attributes of a row that MathML 2 has on ``mstyle`` alone."""

type Text = Callable[[Passage], Markup]
"""The XHTML of a passage."""


def _text(page: str, render: PassageRenderer) -> Text:
    """``page`` is the address of the chapter, nothing where it has none."""

    def text(passage: Passage) -> Markup:
        if not passage:
            return Markup()
        root = _plain(parse(f"<div>{render(passage)}</div>"), page)
        written = ElementTree.tostring(root, encoding="unicode")
        return Markup(written.removeprefix("<div>").removesuffix("</div>"))

    return text


def _plain(root: Element, page: str) -> Element:
    """``root``, changed."""
    formulae = {part for math in elements(root, "math") for part in math.iter()}
    for element in elements(root):
        if element in formulae:
            _plain_formula(element)
            continue
        address = element.get("href", "")
        element.attrib = {name: text for name, text in element.attrib.items() if name in KEPT}
        if element.tag == "a":
            if there := on_site(address, page):
                element.set("href", there)
            else:
                element.tag, element.attrib = "span", {}
    return root


def _plain_formula(element: Element) -> None:
    """MathML 2, which QTI 2.1 has: without classes, and a length has a unit."""
    if element.tag == "mrow" and not STYLES.isdisjoint(element.keys()):
        element.tag = "mstyle"
    for name in ("class", "style", "voffset"):
        element.attrib.pop(name, None)
    for name in LENGTHS:
        if element.get(name) == "0":
            element.set(name, "0em")
    if element.tag == "math":
        element.set("xmlns", MATHML)


def _tex(token: Token, macros: Mapping[str, str]) -> str:
    r"""``\(f = 50\)``."""
    start, end = (r"\[", r"\]") if 'display="block"' in mathml_of(token) else (r"\(", r"\)")
    before, after = (str(token.meta.get(side, "")) for side in ("before", "after"))
    return escape(f"{before}{start}{plain_tex(token.content, macros)}{end}{after}")


GRADES = (
    100, 90, 83.33333, 80, 75, 70, 66.66667, 60, 50, 40, 33.33333, 30, 25, 20, 16.66667, 14.28571,
    12.5, 11.11111, 10, 5,
)  # fmt: skip
"""Percentages that Moodle's import takes."""


@dataclass(frozen=True, slots=True)
class ExportedQuestion:
    """A question of a chapter."""

    quiz: Quiz
    name: str
    """``Question 4.2``."""
    chapter: Chapter
    site: str
    """Address of the book; nothing where it has none."""

    @property
    def page(self) -> str:
        """Address of its chapter; nothing where the book has none."""
        return f"{self.site}{self.chapter.url}" if self.site else ""

    def figure_page(self, figure: str) -> str:
        """Address of the page that a figure of the chapter, by its element id, has to itself."""
        return f"{self.site}{embed_address(self.chapter, figure)}"

    @property
    def kind(self) -> QuestionKind:
        return kind_of(self.quiz)

    @property
    def id(self) -> str:
        """Unique in the book; no digit begins it, as XML wants."""
        return f"quiz-{self.quiz.id}"

    @property
    def share(self) -> float:
        """Percent that one of the right answers counts, on each platform: a grade of Moodle's."""
        right = sum(option.correct for option in self.quiz.options)
        return min(grade for grade in GRADES if grade > 100 / min(max(right, 1), 20) - 0.001)

    @property
    def right_first(self) -> list[Option]:
        """The first of the answers that recognise a number gives the reply; that for all others
        comes last."""
        options = self.quiz.options
        return sorted(options, key=lambda option: (option.text == OTHERWISE, not option.correct))


def exported_questions(book: Book) -> Iterator[ExportedQuestion]:
    """Without the book's address, none that needs a figure."""
    for chapter in book.chapters:
        for name, quiz in numbered_quizzes(chapter.body):
            if book.address or not kind_of(quiz).needs_page:
                yield ExportedQuestion(quiz, name, chapter, book.address)


def export_question(book: Book, exported: ExportedQuestion, platform: str) -> str:
    """The question for a ``platform``: Moodle sets formulae itself, for QTI they are MathML."""
    macros = book.settings.macros
    rules = {"math_inline": lambda token: _tex(token, macros)} if platform == "moodle" else {}
    return render_template(
        exported.kind.export(platform),
        book,
        exported=exported,
        quiz=exported.quiz,
        chapter=exported.chapter,
        text=_text(exported.page, renderer_with({**RULES, **rules})),
    )


def count_not_exported(book: Book) -> int:
    """How many questions are not exported."""
    ids = {exported.quiz.id for exported in exported_questions(book)}
    return sum(len(chapter.quizzes) for chapter in book.chapters) - len(ids)


def make_moodle(book: Book) -> bytes:
    categories = [
        (category, [export_question(book, exported, "moodle") for exported in group])
        for category, group in groupby(
            exported_questions(book), lambda exported: _category(book, exported)
        )
    ]
    return render_template("editions/moodle.xml", book, categories=categories).encode()


def _category(book: Book, exported: ExportedQuestion) -> str:
    """A path, in which a slash of a name is written twice."""
    path = [book.title, f"{exported.chapter.name}. {exported.chapter.title}"]
    return "/".join(["$course$", "top", *(name.replace("/", "//") for name in path)])


def make_qti(book: Book) -> bytes:
    """The archive. The same book is the same bytes."""
    questions = list(exported_questions(book))
    chapters = [
        (chapter, [*group]) for chapter, group in groupby(questions, lambda one: one.chapter)
    ]
    files = {
        "imsmanifest.xml": render_template("editions/qti-manifest.xml", book, items=questions),
        "test.xml": render_template("editions/qti-test.xml", book, chapters=chapters),
        **{f"items/{item.id}.xml": export_question(book, item, "qti") for item in questions},
    }
    return archive_of({name: content.encode() for name, content in files.items()})
