"""What some books show and others do not, and the scripts and style sheets that it takes.

Keys are what `shown_in` tells: the templates of blocks, the kinds of questions, the pages of the
back matter. What no line below names is shipped with every book, or reached from what is.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping

from site_builder.book import Book
from site_builder.markdown.directives.simulation import SIMULATION
from site_builder.page_model.blocks import walk
from site_builder.page_model.questions import Quiz

PARTS: Mapping[str, str] = {
    "simulation": "editor/feature.js",
    "ladder": "ladder/bench.js",
    "extremes": "page/case_filter.js",
    "terms": "page/terms.js",
    "quiz": "question/questions.js",
    "predict": "question/predictions.js",
    "asked": "question/drafts.js",
    "progress": "question/keeping.js",
}
"""Modules that `main.js` installs, below ``static/js/``."""

KINDS: Mapping[str, tuple[str, str]] = {
    "single": ("choice", "choice.js"),
    "multiple": ("choice", "choice.js"),
    "number": ("number", "number.js"),
    "order": ("order", "order.js"),
    "figure": ("figure", "figure.js"),
}
"""What judges each kind of question: its name, and its module beside ``questions.js``."""

KIND = "question"
"""Begins what is told of a kind of questions."""
DRAWINGS = ("illustration", "figure", "video")
ASKED = ("quiz", "predict")

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
    "quiz.css": ASKED,
    "answers.css": ASKED,
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
            if block.template in ASKED:
                yield "asked"
            if isinstance(block.content, Quiz):
                yield f"{KIND} {block.content.kind}"
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


def kinds_script(shown: Collection[str]) -> bytes:
    """The module ``js/question/book_kinds.js``, likewise."""
    kinds = {kind: judge for kind, judge in KINDS.items() if f"{KIND} {kind}" in shown}
    modules = dict(kinds.values())
    lines = [f'import {{ {name} }} from "./{module}";\n' for name, module in modules.items()]
    entries = ", ".join(f"{kind}: {name}" for kind, (name, _) in kinds.items())
    return f"{''.join(lines)}export const KINDS = {{ {entries} }};\n".encode()


def sheets_not_for(shown: Collection[str]) -> frozenset[str]:
    """Style sheets that nothing in the book asks for."""
    return frozenset(sheet for sheet, uses in SHEETS.items() if not set(uses) & set(shown))
