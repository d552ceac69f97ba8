"""The scripts and style sheets of the kinds of controls and of questions."""

from collections.abc import Iterable, Mapping
from pathlib import Path

from simulations.engine.controls import KINDS as CONTROLS
from site_builder.document.blocks import contents
from site_builder.document.book import Book
from site_builder.document.questions import Question
from site_builder.files.engine import ENGINE
from site_builder.markdown.questions.kind import HERE as QUESTION_FOLDER
from site_builder.markdown.questions.kinds import KINDS as QUESTIONS
from site_builder.markdown.questions.kinds import kind_of
from site_builder.pages.views.control import FOLDER as CONTROL_FOLDER


def kind_files(book: Book | None = None) -> dict[str, bytes | Path]:
    """Files of all kinds of controls, and of the kinds of questions that the book asks: scripts,
    modules that list these, and their style sheets joined; by the paths from ``static/``.
    ``.ci/web/book.d.ts`` has the types of the modules."""
    asked = {
        kind_of(question).folder
        for chapter in (book.chapters if book else ())
        for question in contents(chapter.body, Question)
    }
    controls = {CONTROL_FOLDER / name: (name,) for name in CONTROLS}
    questions = {
        QUESTION_FOLDER / kind.folder: (*kind.quiz, *kind.predict)
        for kind in QUESTIONS
        if kind.folder in asked
    }
    return {
        **_scripts("js/figure/control_kinds.js", controls),
        **_scripts("js/question/book_kinds.js", questions),
        "css/control-kinds.css": _sheet(controls),
        "css/question-kinds.css": _sheet(questions),
    }


def _scripts(table: str, kinds: Mapping[Path, Iterable[str]]) -> dict[str, bytes | Path]:
    """Scripts of the kinds in these folders, and the module ``table`` with each by its names."""
    lines: list[str] = []
    entries: dict[str, str] = {}
    for at, (folder, names) in enumerate(kinds.items()):
        path = folder.relative_to(ENGINE).as_posix()
        lines.append(f'import {{ kind as kind{at} }} from "../../../{path}/kind.js";\n')
        entries |= dict.fromkeys(names, f"kind{at}")
    listed = ", ".join(f'"{name}": {kind}' for name, kind in entries.items())
    files = [folder / "kind.ts" for folder in kinds]
    return {
        **{f"../{file.relative_to(ENGINE).as_posix()}": file for file in files},
        table: f"{''.join(lines)}export const KINDS = {{ {listed} }};\n".encode(),
    }


def _sheet(folders: Iterable[Path]) -> bytes:
    return b"\n".join((folder / "kind.css").read_bytes() for folder in folders)
