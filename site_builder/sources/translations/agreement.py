"""Whether a translated chapter has what its original has: the same places in the same order under
the same ids, the same figures and the same questions."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from site_builder.cache.hashing import hash_of
from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.document.blocks import Block, Question, Simulation
from site_builder.document.book import Chapter
from site_builder.document.places import Target
from site_builder.markdown.questions.kinds import kind_of


def check_places(
    original: Chapter,
    places: Sequence[Target],
    translated: Chapter,
    others: Sequence[Target],
    problems: Diagnostics,
) -> None:
    """``places`` are the original's, ``others`` the translation's. A place that is missing is
    reported where the one before it stands."""
    expected = {(place.kind, place.id): place for place in places}
    found = {(place.kind, place.id): place for place in others}
    path, line = translated.path, 1
    for key, place in expected.items():
        what = f"{place.kind.lower()} {place.id!r} of {original.path}:{place.line}"
        if key not in found:
            problems.add(path, line, f"no {what}; legal: {_written(place)}")
        elif found[key].line < line:
            problems.add(path, found[key].line, f"{what} is out of order; legal: the original's")
        else:
            line = found[key].line
    for key, place in found.items():
        if key not in expected:
            ids = [name for kind, name in expected if kind == place.kind]
            kind = f"{place.kind.lower()} of {original.path}"
            problems.add(path, place.line, unknown(kind, place.id, ids))


def _written(place: Target) -> str:
    """How an author gives a place its id."""
    match place.kind:
        case "Section":
            return f"'## … {{#{place.id}}}'"
        case "Equation":
            return f"'$$…$$ ({place.id})'"
        case _:
            return "the same directive with the same id or ':label:'"


def check_contents(original: Chapter, translated: Chapter, problems: Diagnostics) -> None:
    """Figures with other settings, questions with other answers."""
    if translated.summary == original.summary:
        message = f"the summary is that of {original.path}; better: in the language of the folder"
        problems.warn(translated.path, 1, message)
    deeper, meant = (
        {heading.id for heading in chapter.headings if heading.deeper}
        for chapter in (translated, original)
    )
    for name in sorted(deeper ^ meant):
        verb = "is not" if name in meant else "is"
        message = f"section {name!r} {verb} deeper, unlike that of {original.path}"
        problems.add(translated.path, 1, f"{message}; legal: '{{.deeper}}' as in the original")
    figures = {figure.id: figure for figure in original.simulations}
    for figure in translated.simulations:
        other = figures.get(figure.id)
        if other and _setting(figure) != _setting(other):
            message = f"figure {figure.id!r} is not set as in {other.path}:{other.line}"
            problems.add(figure.path, figure.line, f"{message}; legal: the same options")
    questions = _by_id(original)
    for key, question in _by_id(translated).items():
        asked = questions.get(key)
        if asked and [*map(_judged, question.variants)] != [*map(_judged, asked.variants)]:
            message = f"question {question.id!r} has other answers than {asked.path}:{asked.line}"
            expected = "as many, in the same order, the same of them right"
            problems.add(question.path, question.line, f"{message}; legal: {expected}")


def _by_id(chapter: Chapter) -> Mapping[tuple[str, str], Question]:
    asked: Iterable[Question] = (*chapter.quizzes, *chapter.predictions)
    return {(type(question).__name__, question.id): question for question in asked}


def _setting(figure: Simulation) -> tuple[object, ...]:
    return figure.scene.id, dict(figure.values), figure.tier, figure.in_sight, figure.yours


def _judged(question: Question) -> tuple[object, ...]:
    """What decides which answers are right: not their words, but numbers and conditions."""
    coded = kind_of(question).needs_page
    answers = [
        (option.correct, option.value, option.text if coded else "") for option in question.options
    ]
    details = question.details if coded else None
    return question.kind, answers, question.decides, details, question.drawn


def _answered_as[Q: Question](question: Q, original: Question) -> Q:
    """With the edition of the original, for all numbers that it may draw."""
    pairs = zip(question.others, original.others, strict=False)
    return replace(
        question,
        answered_as=original.edition,
        others=tuple(replace(other, answered_as=first.edition) for other, first in pairs),
    )


def with_shared(translated: Chapter, original: Chapter, folder: str) -> Chapter:
    """The chapter with the figures that are drawn for the original, and with the editions of its
    questions, under which answers are stored; its page in ``folder``."""
    figures, questions = {each.id: each for each in original.simulations}, _by_id(original)

    def shared(content: object) -> object:
        match content:
            case Simulation():
                first = figures.get(content.id, content)
                return replace(content, path=first.path, line=first.line)
            case Question():
                asked = questions.get((type(content).__name__, content.id), content)
                return _answered_as(content, asked)
        return content

    def block(part: Block) -> Block:
        inside = tuple(map(block, part.inside))
        return replace(part, content=shared(part.content), inside=inside)

    return replace(
        translated,
        body=tuple(map(block, translated.body)),
        folder=folder,
        cache_key=hash_of(translated.cache_key, original.cache_key, folder),
    )
