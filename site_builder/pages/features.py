"""What some books show and others do not, and the scripts and style sheets that it takes.

Keys are what `shown_in` tells: the templates of blocks, the kinds of questions, the pages of the
back matter. What no line below names is shipped with every book, or reached from what is.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping
from pathlib import Path

from site_builder.book import Book
from site_builder.book_root import ENGINE
from site_builder.markdown.directives.simulation import SIMULATION
from site_builder.markdown.questions.kinds import KINDS as QUESTION_KINDS
from site_builder.markdown.questions.kinds import kind_of
from site_builder.page_model.blocks import walk
from site_builder.page_model.questions import Question

PARTS: Mapping[str, str] = {
    "simulation": "editor/feature.js",
    "ladder": "ladder/bench.js",
    "extremes": "page/case_filter.js",
    "terms": "page/terms.js",
    "asked": "question/questions.js",
    "progress": "question/keeping.js",
}
"""Modules that `main.js` installs, below ``static/js/``."""

KIND = "question kind "
"""Begins the key of a kind of questions."""
DRAWINGS = ("illustration", "figure", "video")
ASKED = ("asked",)

SHEETS: Mapping[str, Collection[str]] = {
    "lecture-plan.css": ("lecture-plan",),
    "terms.css": ("terms", "glossary", "index-of-terms"),
    "callouts.css": ("callout", "example", "predict"),
    "files.css": ("figure", "video", "download"),
    "figure.css": ("simulation", "ladder", *DRAWINGS),
    "overlay.css": ("simulation", "ladder", "predict", *DRAWINGS),
    "illustrations.css": DRAWINGS,
    "handles.css": ("simulation",),
    "readouts.css": ("simulation",),
    "control-grid.css": ("simulation",),
    "photograph.css": ("simulation",),
    "stage-report.css": ("simulation", "stage-costs"),
    "figure-foot.css": ("simulation",),
    "tools.css": ("simulation",),
    "questions.css": ASKED,
    "predict.css": ("predict",),
    "progress.css": ("progress",),
    "ladder.css": ("ladder", "ladder-table"),
    "ladder-tables.css": ("ladder", "ladder-table"),
    "extremes.css": ("extremes",),
}
"""For each style sheet that not every book needs, what it is for."""


def shown_in(book: Book, back_matter: Iterable[str]) -> frozenset[str]:
    """What of the above the book shows; ``back_matter`` are the addresses of its last pages."""
    return frozenset({*back_matter, *_shown(book)})


def _shown(book: Book) -> Iterator[str]:
    if book.hero:
        yield SIMULATION.template
    for chapter in book.chapters:
        for block in walk(chapter.body):
            yield block.template
            if isinstance(block.content, Question):
                yield "asked"
                yield f"{KIND}{kind_of(block.content).folder}"
        if chapter.term_uses:
            yield "terms"
        if chapter.quizzes:
            yield "progress"


def parts_script(shown: Collection[str]) -> bytes:
    """The module ``js/book_parts.js``; ``.ci/web/book.d.ts`` has its type."""
    modules = [module for name, module in PARTS.items() if name in shown]
    lines = [f'import * as part{at} from "./{module}";\n' for at, module in enumerate(modules)]
    names = ", ".join(f"part{at}" for at in range(len(modules)))
    return f"{''.join(lines)}export const PARTS = [{names}];\n".encode()


def question_files(shown: Collection[str]) -> dict[str, bytes | Path]:
    """Of the kinds of questions that the book asks: their scripts with the module
    ``js/question/book_kinds.js``, which lists them, and their style sheets in one."""
    kinds = [kind for kind in QUESTION_KINDS if f"{KIND}{kind.folder}" in shown]
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


def sheets_not_for(shown: Collection[str]) -> frozenset[str]:
    """Style sheets that nothing in the book asks for."""
    return frozenset(sheet for sheet, uses in SHEETS.items() if not set(uses) & set(shown))
