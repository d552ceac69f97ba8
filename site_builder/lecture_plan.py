"""``content/lecture-plan.toml``: the sections of another textbook, and ours that teach them.

Only the sections are named there. What each shows and asks is read off the chapters.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path

from site_builder.book import LecturePlan, Lesson, Taught
from site_builder.diagnostics import Diagnostics, unknown
from site_builder.markdown.targets import Targets
from site_builder.page_model.places import Target
from site_builder.source_text import Toml, read_toml

FILE = "content/lecture-plan.toml"
KEYS = ("intro", "section")
TEXTS = ("number", "title", "note")
TAUGHT = "taught"
END = "questions"
"""Id of the section that closes a chapter."""


def read_lecture_plan(root: Path, targets: Targets, problems: Diagnostics) -> LecturePlan | None:
    """The plan; None where there is no such file. Mistakes go to ``problems``."""
    if not (root / FILE).is_file():
        return None
    read = read_toml(root, FILE, problems)
    if read is None:
        return None
    for key in read.table:
        if key not in KEYS:
            problems.add(FILE, read.line(key), unknown("key", key, KEYS))
    entries = read.table.get("section")
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        line = read.line("section")
        problems.add(FILE, line, "no sections; legal: each below a line '[[section]]'")
        return None
    lessons = (
        _lesson(entry, read.line("section", place), read, targets, problems)
        for place, entry in enumerate(entries)
    )
    return LecturePlan(str(read.table.get("intro", "")), tuple(lessons))


def _lesson(
    entry: Mapping[str, object], line: int, read: Toml, targets: Targets, problems: Diagnostics
) -> Lesson:
    for key in entry:
        if key not in (*TEXTS, TAUGHT):
            problems.add(FILE, line, unknown("key", key, (*TEXTS, TAUGHT)))
    for key in TEXTS:
        if not isinstance(entry.get(key), str):
            problems.add(FILE, line, f'no {key!r}; legal: {key} = "some text"')
    named = entry.get(TAUGHT)
    if not isinstance(named, list) or not named:
        problems.add(FILE, line, f'no {TAUGHT!r}; legal: {TAUGHT} = ["chapter#section"]')
        named = []
    taught = []
    for name in map(str, named):
        try:
            taught.append(_taught(_section(name, targets), targets))
        except LookupError as error:
            problems.add(FILE, read.line_of_text(name, line), str(error))
    closing = dict.fromkeys(item.section.chapter for item in taught)
    return Lesson(
        number=str(entry.get("number", "")),
        title=str(entry.get("title", "")),
        note=str(entry.get("note", "")),
        taught=tuple(taught),
        closing=tuple(end for chapter in closing if (end := _closing(chapter, targets))),
    )


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
