"""Reading ``content/``: the outline in ``book.toml``, and the chapters it lists."""

import re
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from string import ascii_uppercase
from typing import Any

from simulations.engine.scene import Scene
from site_builder.bibliography import FILE as BIBLIOGRAPHY
from site_builder.bibliography import read_bibliography
from site_builder.book import OUTLINE, Book, Definition, Meaning, Position, Simulation, chapter_id
from site_builder.chapters import Page, Shared, targets_hash
from site_builder.diagnostics import Diagnostics, unknown
from site_builder.glossary import FILE as GLOSSARY
from site_builder.glossary import read_glossary
from site_builder.kept.keeper import reads_file
from site_builder.kept.told import kept_reading
from site_builder.lecture_plan import read_lecture_plan
from site_builder.markdown.chapter import find_targets
from site_builder.markdown.definitions import read_definitions, read_meanings
from site_builder.markdown.inline import inline_html
from site_builder.markdown.parser import make_parser
from site_builder.markdown.reading import Reading
from site_builder.markdown.scenes import find_scene
from site_builder.measured.measurements import DATA as MEASUREMENTS
from site_builder.measured.measurements import Measurements
from site_builder.symbols import FILE as SYMBOLS
from site_builder.symbols import read_symbols

TEXTS = ("title", "subtitle", "prerequisites")
LISTS = ("chapters", "appendices")
KEYS = (*TEXTS, *LISTS, "hero", "hero_caption")
OWN_FOLDERS = (
    "assets", "glossary", "index-of-terms", "lecture-plan", "licences", "references", "runtime",
    "search", "source", "symbols",
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


def read_book(
    root: Path,
    problems: Diagnostics,
    load_scene: Callable[[str], Scene[Any]],
    measurements: Measurements | None = None,
) -> Book:
    """The whole book; mistakes go to ``problems`` and reading goes on."""
    outline = _read_outline(root, problems)
    numbers = measurements or Measurements()
    bibliography = _read_kept(
        root, BIBLIOGRAPHY, problems, lambda own: read_bibliography(root, own)
    )
    glossary = _read_kept(root, GLOSSARY, problems, lambda own: read_glossary(root, own))
    shared = Shared(root, load_scene, numbers, bibliography, glossary)
    pages: list[Page] = []
    for name, line, position in outline.chapters:
        file = root / "content" / f"{name}.md"
        if not file.is_file():
            problems.add(OUTLINE, line, unknown("chapter", name, _chapter_files(root)))
            continue
        _check_name(name, line, problems)
        path = file.relative_to(root).as_posix()
        pages.append(Page(path, _read_text(root, path, problems), position, shared))
    targets = find_targets([page.survey() for page in pages], problems)
    known = targets_hash(targets)
    _check_addresses(outline, problems)
    _check_unlisted(root, outline, problems)

    def beside(file: str, problems: Diagnostics) -> Reading:
        reads_file(root / MEASUREMENTS)
        return Reading(file, root, problems, load_scene, make_parser(), numbers, targets=targets)

    def definitions(own: Diagnostics) -> tuple[Definition, ...]:
        return read_definitions(glossary, beside(GLOSSARY, own))

    def meanings(own: Diagnostics) -> Mapping[str, tuple[Meaning, ...]]:
        return read_meanings(read_symbols(root, own), beside(SYMBOLS, own))

    return Book(
        title=outline.title,
        subtitle=outline.subtitle,
        prerequisites=outline.prerequisites,
        hero=_read_hero(outline, root, problems, load_scene),
        chapters=tuple(page.read(targets, known, problems) for page in pages),
        bibliography=bibliography,
        lecture_plan=read_lecture_plan(root, targets, problems),
        glossary=_read_kept(root, GLOSSARY, problems, definitions, "definitions", known),
        symbols=_read_kept(root, SYMBOLS, problems, meanings, "meanings", known),
    )


def _read_kept[T](
    root: Path, path: str, problems: Diagnostics, read: Callable[[Diagnostics], T], *given: object
) -> T:
    """What ``read`` finds in the file ``path``, kept."""

    def read_file(own: Diagnostics) -> T:
        reads_file(root / path)
        return read(own)

    read_file.__module__ = read.__module__
    return kept_reading(path, (str(root), *given), problems, read_file)[0]


def _read_outline(root: Path, problems: Diagnostics) -> Outline:
    text = _read_text(root, OUTLINE, problems) if (root / OUTLINE).is_file() else ""
    if not text:
        problems.add(OUTLINE, 1, f"no outline; legal: a file with {', '.join(KEYS)}")
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        place = re.search(r"line (\d+)", str(error))
        problems.add(OUTLINE, int(place[1]) if place else 1, f"malformed TOML: {error}")
        table, text = {}, ""
    for key in table:
        if key not in KEYS:
            problems.add(OUTLINE, _line_of(key, text), unknown("key", key, KEYS))
    for key in TEXTS:
        value = table.get(key)
        if text and not (isinstance(value, str) and value.strip()):
            problems.add(OUTLINE, _line_of(key, text), f'no {key!r}; legal: {key} = "some text"')
    for key in LISTS:
        names = table.setdefault(key, [])
        listed = isinstance(names, list) and all(isinstance(name, str) for name in names)
        if text and not (listed and (names or key != "chapters")):
            problems.add(OUTLINE, _line_of(key, text), f'no {key}; legal: ["00-slug", …]')
            table[key] = []
    return Outline(
        title=str(table.get("title", "")),
        subtitle=str(table.get("subtitle", "")),
        prerequisites=str(table.get("prerequisites", "")),
        chapters=tuple(
            (name, _line_of_name(name, text), position)
            for name, position in _positions(table["chapters"], table["appendices"])
        ),
        hero=str(table.get("hero", "")),
        hero_caption=str(table.get("hero_caption", "")),
        hero_line=_line_of("hero", text),
    )


def _positions(
    chapters: Sequence[str], appendices: Sequence[str]
) -> Iterator[tuple[str, Position]]:
    """Chapters are numbered from 0, appendices lettered from A."""
    for number, name in enumerate(chapters):
        yield name, Position(number, str(number))
    for index, name in enumerate(appendices):
        yield name, Position(len(chapters) + index, ascii_uppercase[index % 26], "Appendix")


def _read_text(root: Path, path: str, problems: Diagnostics) -> str:
    """The file below ``root``, with or without the mark that some editors put before the text."""
    data = (root / path).read_bytes()
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        problems.add(path, line, f"byte 0x{data[error.start]:02x} is not UTF-8; legal: UTF-8")
        text = data.decode("utf-8-sig", errors="replace")
    return text.replace("\r\n", "\n")


def _line_of(key: str, text: str) -> int:
    """Where ``key = …`` stands; 1 where it does not."""
    return _line_with(rf"\s*{re.escape(key)}\s*=", text)


def _line_of_name(name: str, text: str) -> int:
    return _line_with(rf".*[\"']{re.escape(name)}[\"']", text)


def _line_with(pattern: str, text: str) -> int:
    lines = enumerate(text.splitlines(), start=1)
    return next((number for number, line in lines if re.match(pattern, line)), 1)


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
