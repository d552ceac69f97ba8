"""``content/lecture-plan.toml``: the sections of another textbook, and ours that teach them.

The file only names sections. Their figures and questions are found in the chapters.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from site_builder.document.book import LecturePlan, Lesson, Taught
from site_builder.document.places import Target
from site_builder.files.text import Sources
from site_builder.markdown.targets import Targets
from site_builder.settings.declared import Reader

FILE = "content/lecture-plan.toml"
END = "questions"
"""Id of the section that closes a chapter."""


def read_lecture_plan(sources: Sources, targets: Targets) -> LecturePlan | None:
    """The plan; None where there is no such file. Mistakes are reported."""
    toml = sources.toml(FILE)
    if toml is None:
        return None
    reader = Reader(FILE, toml, sources.problems)
    read = reader.tables(Lesson, "section", ("intro",))
    if read is None:
        return None
    lessons: list[Lesson] = []
    for place, lesson in enumerate(read):
        sections = tuple(_sections(lesson, toml.line("section", place), targets, reader))
        chapters = dict.fromkeys(item.section.chapter for item in sections)
        closing = (end for chapter in chapters if (end := _closing(chapter, targets)))
        lessons.append(replace(lesson, sections=sections, closing=tuple(closing)))
    return LecturePlan(str(toml.table.get("intro", "")), tuple(lessons))


def _sections(lesson: Lesson, line: int, targets: Targets, reader: Reader) -> Iterator[Taught]:
    for name in lesson.taught:
        try:
            yield _taught(_section(name, targets), targets)
        except LookupError as error:
            reader.problems.add(FILE, reader.toml.line_of_text(name, line), str(error))


def _section(name: str, targets: Targets) -> Target:
    found = targets.find(name, "")
    if found.kind != "Section" or "#" not in name:
        raise LookupError(f"{name!r} is {found.name}; legal: a section, 'chapter#section'")
    return found


def _taught(section: Target, targets: Targets) -> Taught:
    inside = targets.inside[section.chapter]
    own = _until_next_section(inside[inside.index(section) + 1 :])
    return Taught(
        chapter=targets.chapters[section.chapter],
        section=section,
        figures=tuple(target for target in own if target.kind == "Figure"),
        questions=tuple(target for target in own if target.kind == "Question"),
    )


def _closing(chapter: str, targets: Targets) -> Taught | None:
    """The questions at the end of a chapter; None where it has none."""
    found = [t for t in targets.inside[chapter] if t.kind == "Section" and t.id == END]
    return _taught(found[0], targets) if found else None


def _until_next_section(targets: Sequence[Target]) -> Sequence[Target]:
    ends = [place for place, target in enumerate(targets) if target.kind == "Section"]
    return targets[: ends[0]] if ends else targets
