"""Reading ``content/``: the outline in ``book.toml``, and the chapters it lists."""

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from string import ascii_uppercase
from typing import Any

from simulations.engine.scene import Scene
from site_builder.addresses import site_address, source_address
from site_builder.bibliography import read_bibliography
from site_builder.book import OUTLINE, Book, Position, Simulation, chapter_id
from site_builder.diagnostics import Diagnostics, unknown
from site_builder.glossary import FILE as GLOSSARY
from site_builder.glossary import read_glossary
from site_builder.lecture_plan import read_lecture_plan
from site_builder.markdown.chapter import Draft, find_targets, parse_chapter, read_chapter
from site_builder.markdown.definitions import read_definitions, read_meanings
from site_builder.markdown.inline import inline_html
from site_builder.markdown.parser import make_parser
from site_builder.markdown.reading import Reading
from site_builder.markdown.scenes import find_scene
from site_builder.measured.measurements import Measurements
from site_builder.news import read_news
from site_builder.source_text import Toml, read_text, read_toml
from site_builder.symbols import FILE as SYMBOLS
from site_builder.symbols import read_symbols

TEXTS = ("title", "subtitle", "prerequisites")
LISTS = ("chapters", "appendices")
ADDRESSES = {"address": site_address, "source": source_address}
KEYS = (*TEXTS, *LISTS, "hero", "hero_caption", *ADDRESSES)
OWN_FOLDERS = (
    "assets", "cards", "glossary", "index-of-terms", "lecture-plan", "licences", "references",
    "runtime", "search", "source", "symbols",
)  # fmt: skip
"""Folders of the site beside those of its chapters."""


@dataclass(frozen=True, slots=True)
class Outline:
    """``book.toml``: what the book is called, and its chapters in order."""

    title: str
    subtitle: str
    prerequisites: str
    chapters: tuple[tuple[str, int, Position], ...]
    """File names without ``.md``, each with its line in this file and its place in the book."""
    hero: str
    """Scene of the landing page's figure, or nothing."""
    hero_caption: str
    hero_line: int
    address: str
    """Where the site will be, or nothing."""
    source: str
    """Where its sources are, with ``{path}`` in it, or nothing."""


def read_book(
    root: Path,
    problems: Diagnostics,
    load_scene: Callable[[str], Scene[Any]],
    measurements: Measurements | None = None,
) -> Book:
    """The whole book; mistakes go to ``problems`` and reading goes on."""
    outline = _read_outline(root, problems)
    numbers = measurements or Measurements()
    bibliography = read_bibliography(root, problems)
    glossary = read_glossary(root, problems)
    drafts: list[Draft] = []
    for name, line, position in outline.chapters:
        file = root / "content" / f"{name}.md"
        if not file.is_file():
            problems.add(OUTLINE, line, unknown("chapter", name, _chapter_files(root)))
            continue
        _check_name(name, line, problems)
        path = file.relative_to(root).as_posix()
        reading = Reading(
            path,
            root,
            problems,
            load_scene,
            make_parser(),
            numbers,
            chapter=chapter_id(path),
            position=position,
            bibliography=bibliography,
            glossary=glossary,
        )
        drafts.append(parse_chapter(read_text(root, path, problems), reading))
    targets = find_targets(drafts)
    _check_addresses(outline, problems)
    _check_unlisted(root, outline, problems)

    def beside(file: str) -> Reading:
        return Reading(file, root, problems, load_scene, make_parser(), numbers, targets=targets)

    return Book(
        title=outline.title,
        subtitle=outline.subtitle,
        prerequisites=outline.prerequisites,
        address=outline.address,
        source=outline.source,
        news=read_news(root, targets.chapters, problems),
        hero=_read_hero(outline, root, problems, load_scene),
        chapters=tuple(read_chapter(draft, targets) for draft in drafts),
        bibliography=bibliography,
        lecture_plan=read_lecture_plan(root, targets, problems),
        glossary=read_definitions(glossary, beside(GLOSSARY)),
        symbols=read_meanings(read_symbols(root, problems), beside(SYMBOLS)),
    )


def _read_outline(root: Path, problems: Diagnostics) -> Outline:
    is_there = (root / OUTLINE).is_file()
    read = read_toml(root, OUTLINE, problems) if is_there else Toml()
    if read and not read.text.strip():
        problems.add(OUTLINE, 1, f"no outline; legal: a file with {', '.join(KEYS)}")
    given = bool(read and read.text.strip())
    read = read or Toml()
    table = dict(read.table)
    for key in table:
        if key not in KEYS:
            problems.add(OUTLINE, read.line(key), unknown("key", key, KEYS))
    for key in TEXTS:
        value = table.get(key)
        if given and not (isinstance(value, str) and value.strip()):
            problems.add(OUTLINE, read.line(key), f'no {key!r}; legal: {key} = "some text"')
    for key in LISTS:
        names = table.setdefault(key, [])
        listed = isinstance(names, list) and all(isinstance(name, str) for name in names)
        if given and not (listed and (names or key != "chapters")):
            problems.add(OUTLINE, read.line(key), f'no {key}; legal: ["00-slug", …]')
            table[key] = []
    addresses = {}
    for key, checked in ADDRESSES.items():
        try:
            addresses[key] = checked(table.get(key, ""))
        except ValueError as error:
            problems.add(OUTLINE, read.line(key), str(error))
            addresses[key] = ""
    return Outline(
        title=str(table.get("title", "")),
        subtitle=str(table.get("subtitle", "")),
        prerequisites=str(table.get("prerequisites", "")),
        chapters=tuple(
            (name, read.line_of_text(name), position)
            for name, position in _positions(table["chapters"], table["appendices"])
        ),
        hero=str(table.get("hero", "")),
        hero_caption=str(table.get("hero_caption", "")),
        hero_line=read.line("hero"),
        **addresses,
    )


def _positions(
    chapters: Sequence[str], appendices: Sequence[str]
) -> Iterator[tuple[str, Position]]:
    """Chapters are numbered from 0, appendices lettered from A."""
    for number, name in enumerate(chapters):
        yield name, Position(number, str(number))
    for index, name in enumerate(appendices):
        yield name, Position(len(chapters) + index, ascii_uppercase[index % 26], "Appendix")


def _chapter_files(root: Path) -> list[str]:
    return sorted(file.stem for file in (root / "content").glob("*.md"))


def _check_name(name: str, line: int, problems: Diagnostics) -> None:
    """A number in front is for the listing of the folder; it means nothing."""
    if not re.fullmatch(r"(\d+-)?[a-z0-9]+(-[a-z0-9]+)*", name):
        problems.add(OUTLINE, line, f"chapter {name!r}; legal: 'NN-slug'")


def _check_addresses(outline: Outline, problems: Diagnostics) -> None:
    """Two pages at one address: one would silently take the other's place."""
    taken = dict.fromkeys(OWN_FOLDERS, "a folder of the site's own")
    for name, line, _ in outline.chapters:
        slug = chapter_id(name)
        if slug in taken:
            message = f"chapter {name!r} has the address {slug}/, as {taken[slug]} has"
            problems.add(OUTLINE, line, f"{message}; legal: one of its own")
        taken.setdefault(slug, f"chapter {name!r}")


def _check_unlisted(root: Path, outline: Outline, problems: Diagnostics) -> None:
    listed = {f"content/{name}.md" for name, _, _ in outline.chapters}
    for file in sorted((root / "content").rglob("*.md")):
        path = file.relative_to(root).as_posix()
        if listed and path not in listed:
            problems.add(path, 1, f"not in {OUTLINE}; legal: listed in 'chapters' or 'appendices'")


def _read_hero(
    outline: Outline, root: Path, problems: Diagnostics, load_scene: Callable[[str], Scene[Any]]
) -> Simulation | None:
    if not outline.hero:
        return None
    reading = Reading(OUTLINE, root, problems, load_scene, make_parser())
    scene = find_scene(outline.hero, outline.hero_line, reading)
    caption_html = inline_html(outline.hero_caption, outline.hero_line, reading)
    for link in reading.links:
        problems.add(
            OUTLINE, link.line, f"link {link.target!r} in the cover's caption; legal: 'https://…'"
        )
    if scene is None:
        return None
    return Simulation(
        scene=scene,
        id=f"figure-{scene.id}",
        values={},
        tier=scene.default_tier,
        caption_html=caption_html,
        path=OUTLINE,
        line=outline.hero_line,
    )
