"""What can be checked only when all chapters are read: links between them, ids across them, what
belongs together on a page, glossary and symbols, and sentences that `new` wrote."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath

from simulations.engine.conditions import first_true
from simulations.engine.controls import ControlError, Slider
from simulations.engine.expressions import ExpressionError
from site_builder.cache.results import cached
from site_builder.checks.exercises import check_exercises
from site_builder.checks.first_pass import check_first_passes
from site_builder.diagnostics.diagnostic import Diagnostics, cause, nearest, unknown
from site_builder.document.blocks import Option, Prediction, Quiz, Reveal, Simulation, contents
from site_builder.document.book import OUTLINE, Book, Chapter
from site_builder.document.places import Formula, Link, Target, TermUse
from site_builder.figures.frames import frame_at
from site_builder.files.folders import folder_files
from site_builder.files.text import Sources
from site_builder.markdown.glossary import meanings_in
from site_builder.markdown.questions.figure.kind import FigureTask, conditions
from site_builder.markdown.text.symbols import covers, spelt, symbols_of
from site_builder.references.bibliography import FILE as BIBLIOGRAPHY
from site_builder.references.terms import BOOK, GLOSSARY
from site_builder.references.terms import SYMBOLS as FILE
from site_builder.render.words import plain_words

STANDS_OUT = 1.4
"""How many times as long as the longest wrong answer a key may be, or the shortest wrong answer as
the key: lines of one paragraph differ as much, so up to there it is not seen at a glance."""
FEW_LETTERS = 12
"""Two words: among short answers a smaller difference has no meaning, whatever its ratio."""
UNDECLARED = ("\\pi", "e")
"""Symbols that need no declaration."""
PLACEHOLDERS = (
    "What this book is about, in a sentence.",
    "What its reader should know.",
    "Choose under which terms others may use it",
    "In one sentence, what this chapter tells.",
    "say one thing that one could not say before",
    "Begin with something that one can see or hear.",
    "Say what happens, then why.",
    "What comes out, if 21 is doubled?",
    ": which law this is, in a sentence.",
    ": what is computed here in several ways.",
)
"""Sentences of the templates in ``scaffold/``."""
SKELETON_FOLDERS = ("scenes", "ladders", "models")
"""Folders of ``simulations`` in which ``new`` writes."""


def check_book(book: Book, problems: Diagnostics) -> None:
    """Report links that lead nowhere, questions that share an id, answers to no prediction and
    figures that cannot be set as a question wants; warn of keys that give themselves away."""
    _check_ids("quiz", [item for chapter in book.chapters for item in chapter.quizzes], problems)
    guesses = [item for chapter in book.chapters for item in chapter.predictions]
    _check_ids("predict", guesses, problems)
    for chapter in book.chapters:
        if not chapter.body and not any(found.path == chapter.path for found in problems.found):
            problems.add(chapter.path, 1, "no text; legal: some below the front matter")
        _check_reveals(chapter, problems)
        _check_figure_questions(chapter, problems)
    check_exercises(book, problems)
    check_first_passes(book, problems)
    _check_needs(book, problems)
    _check_key_lengths(book, problems)
    _check_cited(book, problems)
    _check_glossary(book, problems)
    _check_term_order(book, problems)
    _check_symbols(book, problems)
    _check_links(book, problems)


def check_skeletons(sources: Sources, book: Book) -> None:
    """Warn of each sentence of `PLACEHOLDERS` that is still in a file."""
    for path in _skeleton_paths(sources.root, book):
        data = (sources.root / path).read_bytes()
        for sentence in PLACEHOLDERS:
            if (place := data.find(sentence.encode())) >= 0:
                message = f"{sentence.lstrip(': ')!r} is still as `new` wrote it; better: your own"
                sources.problems.warn(path, data.count(b"\n", 0, place) + 1, message)


def _check_key_lengths(book: Book, problems: Diagnostics) -> None:
    """Warn of keys that are much longer or shorter than the wrong answers."""
    for chapter in book.chapters:
        for quiz in _single_choice(chapter):
            if message := _length_warning(quiz):
                problems.warn(quiz.path, quiz.line, message)


def _single_choice(chapter: Chapter) -> list[Quiz]:
    """The questions with exactly one key, and something else to choose."""
    return [
        quiz
        for quiz in chapter.quizzes
        if quiz.kind == "single" and len(quiz.options) > 1
        if sum(option.correct for option in quiz.options) == 1
    ]


def _answer_length(option: Option) -> int:
    """Letters of an answer as it is read: a formula counts what it shows, not its source."""
    return len(plain_words(option.words).strip())


def _length_warning(quiz: Quiz) -> str:
    """A warning where the length of the key gives it away, or nothing."""
    key, *wrong = [
        _answer_length(option) for option in sorted(quiz.options, key=lambda o: not o.correct)
    ]
    for what, other, short, long in (
        ("longest", max(wrong), max(wrong), key),
        ("shortest", min(wrong), key, min(wrong)),
    ):
        if long > STANDS_OUT * short and long - short >= FEW_LETTERS:
            return (
                f"the key of quiz {quiz.id!r} stands out: its length is {key}, that of the {what} "
                f"wrong answer {other}; better: within a factor of {STANDS_OUT:g}"
            )
    return ""


def _check_figure_questions(chapter: Chapter, problems: Diagnostics) -> None:
    """The solution that the author states is right by the conditions, and the start is not."""
    figures = {figure.id: figure for figure in chapter.simulations}
    for quiz in chapter.quizzes:
        task = quiz.details
        if not isinstance(task, FigureTask) or not task.figure or not task.solution:
            continue
        figure = figures.get(task.figure)
        error, line = None, quiz.line
        if figure:
            try:
                line, message = _figure_question_error(quiz, task, figure)
            except Exception as raised:  # whatever a scene's own code may raise
                error = raised
                message = f"quiz {quiz.id!r}: {figure.scene.id!r} cannot be drawn: {cause(raised)}"
        elif task.figure in chapter.figures:  # reported where it is
            message = ""
        else:
            message = unknown("figure of this page", task.figure, chapter.figures)
        if message:
            problems.add(quiz.path, line, message, error)


def _figure_question_error(quiz: Quiz, task: FigureTask, figure: Simulation) -> tuple[int, str]:
    """A line and what is wrong there, or nothing. Raises whatever the scene does."""
    what, solution = f"quiz {quiz.id!r}", task.solution
    stated = " ".join(f"{name}={value}" for name, value in solution.items())
    try:
        if message := _unreachable_value(solution, figure):
            return task.line, f"{what}: {message}"
        if not _reply_at(quiz, figure, {**figure.values, **solution}).correct:
            legal = "settings that its [x] is true of"
            return task.line, f"{what} is not solved by {stated!r}; legal: {legal}"
        if _reply_at(quiz, figure, figure.values).correct:
            legal = "a start that its [x] is false of"
            return quiz.line, f"{what} is solved before it is asked; legal: {legal}"
    except ControlError as error:
        return task.line, f"{what}: {error}"
    except ExpressionError as error:
        return quiz.line, f"{what}: {error}"
    return quiz.line, ""


def _unreachable_value(solution: Mapping[str, str], figure: Simulation) -> str:
    """The stated setting that no slider can show, if there is one."""
    for control in figure.scene.controls:
        value = solution.get(control.name)
        if isinstance(control, Slider) and value and not control.reaches(control.check(value)):
            expected = f"{control.minimum:g} and steps of {control.step:g}"
            return f"{control.name}: {value} is between two steps; legal: {expected}"
    return ""


def _reply_at(quiz: Quiz, figure: Simulation, values: Mapping[str, object]) -> Option:
    """The answer that holds at these settings. Raises `ControlError`, `ExpressionError`."""
    settings = figure.scene.check(values)
    frame = frame_at(figure.scene, settings, figure.tier)
    answers = conditions(quiz)
    first = first_true(answers, settings, frame)
    return quiz.options[len(answers) if first is None else first]


def _check_glossary(book: Book, problems: Diagnostics) -> None:
    """Report terms whose explaining section never uses them."""
    used = {(use.term, ch.id, use.section) for ch in book.chapters for use in ch.term_uses}
    for definition in book.glossary:
        term, place = definition.term, definition.explained
        if place and (term.name, place.chapter, place.id) not in used:
            sections = [
                f"{chapter}#{section}" if section else chapter
                for name, chapter, section in sorted(used)
                if name == term.name
            ]
            expected = ", ".join(sections[:6]) or "a section that does"
            message = f"{term.name!r} is not in the text of {term.explained!r}; legal: {expected}"
            problems.add(GLOSSARY, term.lines["explained"], message)


def _check_term_order(book: Book, problems: Diagnostics) -> None:
    """Warn of terms used before the section that explains them, unless the author marked the use:
    a mark shows the definition."""
    unexplained = {item.term.name: item.explained for item in book.glossary if item.explained}
    for chapter in book.chapters:
        for use in chapter.term_uses:
            place = unexplained.pop(use.term, None)
            if place and not use.by_author and not _is_in(use, chapter.id, place):
                message = f"{use.term!r} is used before {place.name}, which explains it"
                better = f"explain it here, or mark it: {{term}}`{use.term}`"
                problems.warn(chapter.path, use.line, f"{message}; better: {better}")


def _is_in(use: TermUse, chapter: str, place: Target) -> bool:
    return chapter == place.chapter and place.id in ("", use.section)


def _check_symbols(book: Book, problems: Diagnostics) -> None:
    """Report symbols without a meaning and meanings of no symbol; warn of those in no formula,
    where all could be read."""
    if not book.symbols:
        return
    chapters = {chapter.id: chapter for chapter in book.chapters}
    used: set[int] = set()
    for chapter in book.chapters:
        expected = [(spelt(item.symbol.tex), item) for item in meanings_in(book, chapter)]
        for tex, formula in _first_uses(chapter).items():
            covering = [item for name, item in expected if covers(name, tex)]
            used |= {item.symbol.line for item in covering}
            if not covering and tex not in UNDECLARED:
                names = [name for name, _ in expected]
                message = unknown(f"symbol in {chapter.id}", tex, names)
                rows = enumerate(formula.tex.split("\n"), formula.line)
                line = next((line for line, row in rows if tex in symbols_of(row)), formula.line)
                problems.add(chapter.path, line, f"{message} (in {FILE})")
    for name, declared in book.symbols.items():
        if name != BOOK and name not in chapters:
            line = declared[0].symbol.line - 1 if declared else 1
            spoils = (f"unknown symbol in {nearest(name, chapters)} ",)
            message = unknown("chapter", name, [BOOK, *chapters])
            problems.add(FILE, line, message, spoils=spoils)
        for item in declared:
            symbol = item.symbol
            if not spelt(symbol.tex):
                problems.add(FILE, symbol.line, f"{symbol.tex!r}; legal: one symbol, such as 'k_1'")
            elif symbol.line not in used and name in (BOOK, *chapters) and not problems:
                problems.warn(FILE, symbol.line, f"'{symbol.tex}' is in no formula of {name}")


@cached
def _first_uses(chapter: Chapter) -> dict[str, Formula]:
    """By symbol."""
    uses = ((symbol, formula) for formula in chapter.formulae for symbol in symbols_of(formula.tex))
    return dict(reversed([*uses]))


def _skeleton_paths(root: Path, book: Book) -> Iterator[str]:
    """Paths of files that ``new`` may have written."""
    paths = (OUTLINE, *(chapter.path for chapter in book.chapters))
    yield from (path for path in paths if (root / path).is_file())
    for folder in SKELETON_FOLDERS:
        for name in folder_files(root / "simulations" / folder):
            if name.endswith(".py"):
                yield f"simulations/{folder}/{name}"


def _check_links(book: Book, problems: Diagnostics) -> None:
    by_file = {PurePosixPath(chapter.path).name: chapter for chapter in book.chapters}
    for chapter in book.chapters:
        for link in chapter.links:
            if message := _link_error(link, chapter, by_file):
                problems.add(chapter.path, link.line, message)


def _check_ids(kind: str, items: Sequence[Quiz | Prediction], problems: Diagnostics) -> None:
    first: dict[str, Quiz | Prediction] = {}
    for item in items:
        other = first.setdefault(item.id, item)
        if other.path != item.path:  # else reported when the page was read
            message = f"duplicate {kind} id {item.id!r}; first used at {other.path}:{other.line}"
            problems.add(item.path, item.line, message)


def _check_cited(book: Book, problems: Diagnostics) -> None:
    cited = {citation.key for chapter in book.chapters for citation in chapter.citations}
    for key, work in book.bibliography.items():
        if key not in cited:
            message = f"work {key!r} is cited nowhere; legal: '{{cite}}`{key}`' in a chapter"
            problems.add(BIBLIOGRAPHY, work.line, message)


def _check_reveals(chapter: Chapter, problems: Diagnostics) -> None:
    guesses = [prediction.id for prediction in chapter.predictions]
    for reveal in contents(chapter.body, Reveal):
        if reveal.prediction not in guesses:
            message = unknown("prediction of this page", reveal.prediction, guesses)
            problems.add(reveal.path, reveal.line, message)


def _check_needs(book: Book, problems: Diagnostics) -> None:
    """A chapter builds on earlier chapters only."""
    ids = [chapter.id for chapter in book.chapters]
    for place, chapter in enumerate(book.chapters):
        others = [name for name in ids if name != chapter.id]
        for need in chapter.before:
            if not need.chapter:
                continue
            if need.chapter not in others:
                problems.add(chapter.path, need.line, unknown("chapter", need.chapter, others))
            elif ids.index(need.chapter) > place:
                message = (
                    f"builds on chapter {need.chapter!r}, which stands after it; better: before"
                )
                problems.warn(chapter.path, need.line, message)


def _link_error(link: Link, chapter: Chapter, by_file: dict[str, Chapter]) -> str:
    """What is wrong with ``link``; nothing where it leads somewhere."""
    file, _, anchor = link.target.partition("#")
    if not link.target or ":" in file or file.startswith("/"):
        return f"link {link.target!r}; legal: 'NN-slug.md', '#anchor' or 'https://…'"
    target = by_file.get(file) if file else chapter
    if target is None:
        return unknown("page", file, by_file)
    if anchor and anchor not in target.anchors:
        return unknown(f"anchor in {target.path}", anchor, sorted(target.anchors))
    return ""
