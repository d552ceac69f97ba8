"""The scripts and style sheets of the kinds of questions that a book asks."""

from pathlib import Path

from site_builder.book import Book
from site_builder.book_root import ENGINE
from site_builder.markdown.questions.kinds import KINDS, kind_of
from site_builder.page_model.blocks import contents
from site_builder.page_model.questions import Question


def question_files(book: Book) -> dict[str, bytes | Path]:
    """The scripts of the kinds with the module ``js/question/book_kinds.js``, which lists them, and
    their style sheets in one; ``.ci/web/book.d.ts`` has the module's type."""
    asked = {
        kind_of(question).folder
        for chapter in book.chapters
        for question in contents(chapter.body, Question)
    }
    kinds = [kind for kind in KINDS if kind.folder in asked]
    scripts = {f"../{kind.file('ts').relative_to(ENGINE)}": kind.file("ts") for kind in kinds}
    lines = [
        f'import {{ kind as kind{at} }} from "../../{name.removesuffix(".ts")}.js";\n'
        for at, name in enumerate(scripts)
    ]
    entries = ", ".join(
        f"{name}: kind{at}"
        for at, kind in enumerate(kinds)
        for name in dict.fromkeys((*kind.quiz, *kind.predict))
    )
    listed = f"{''.join(lines)}export const KINDS = {{ {entries} }};\n".encode()
    sheet = "\n".join(kind.file("css").read_text(encoding="utf-8") for kind in kinds).encode()
    return {
        **scripts,
        "js/question/book_kinds.js": listed,
        "css/question-kinds.css": sheet,
    }
