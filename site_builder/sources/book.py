"""Read the book from ``content/``: first the targets of all chapters, then each chapter whole."""

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from simulations.engine.scene import Scene
from site_builder.benchmarks.measurements import Measurements
from site_builder.cache.hashing import hash_of, source_hash
from site_builder.cache.results import cached_reading, cached_result
from site_builder.diagnostics.blame import CodeError, raised_by_code
from site_builder.diagnostics.diagnostic import TARGETS, BuildError, Diagnostics, nearest, unknown
from site_builder.diagnostics.progress import counting
from site_builder.document.blocks import Simulation
from site_builder.document.book import OUTLINE, Book, Chapter
from site_builder.document.places import Passage, Position, Target, Targets, chapter_id
from site_builder.files.engine import ENGINE
from site_builder.files.folders import file_hash, folder_files, folder_hash
from site_builder.files.text import Sources
from site_builder.markdown.annotation import inline_passage
from site_builder.markdown.chapter import (
    ChapterTargets,
    ParsedChapter,
    chapter_targets,
    find_targets,
    parse_chapter,
    read_chapter,
)
from site_builder.markdown.glossary import read_definitions, read_meanings
from site_builder.markdown.parse_context import ParseContext, Shared
from site_builder.markdown.parser import make_parser
from site_builder.pool.loading import loaded
from site_builder.references.bibliography import FILE as BIBLIOGRAPHY
from site_builder.references.bibliography import NO_WORKS, read_bibliography
from site_builder.references.terms import (
    GLOSSARY,
    NO_TERMS,
    SYMBOLS,
    read_glossary,
    read_news,
    read_symbols,
)
from site_builder.sources.outline import (
    Outline,
    check_addresses,
    check_boxes,
    read_lecture_plan,
    read_outline,
    read_search_words,
)


@dataclass(slots=True)
class ChapterSource:
    path: str
    """Relative to the root of the project."""
    text: str
    position: Position
    shared: Shared
    state: bytes
    """Hash of what is shared, and of all files that a chapter may show or run, besides chapters."""
    _parsed_chapter: ParsedChapter | None = field(default=None, init=False)
    """Parsed but not yet read; reading changes it."""

    def chapter_targets(self) -> ChapterTargets:
        """The targets of the chapter; its mistakes are reported by `read`."""
        return cached_result(
            "chapter targets", self._inputs(), lambda: chapter_targets(self._parsed())
        )

    def read(self, targets: Targets, state: bytes, problems: Diagnostics) -> Chapter:
        """The whole chapter; mistakes go to ``problems`` and reading goes on. ``state``:
        `_targets_state` of the targets."""
        key = hash_of(self._inputs(), state)

        def read(own: Diagnostics) -> Chapter:
            parsed, self._parsed_chapter = self._parsed(), None
            chapter = read_chapter(parsed, targets)
            own.found.extend(parsed.context.problems.found)
            own.doubts.extend(parsed.context.problems.doubts)
            return replace(chapter, cache_key=key)

        return cached_reading("chapter", (key, self.shared.load_scene), problems, read)

    def _inputs(self) -> tuple[object, ...]:
        return self.state, self.path, self.text, self.position

    def _parsed(self) -> ParsedChapter:
        if self._parsed_chapter is None:
            context = ParseContext(
                path=self.path,
                shared=self.shared,
                problems=Diagnostics(),
                chapter=chapter_id(self.path),
                position=self.position,
            )
            self._parsed_chapter = parse_chapter(self.text, context)
        return self._parsed_chapter


def _targets_state(targets: Targets) -> bytes:
    """Hash of what a chapter can show of others: not on which line that stands."""

    def visible_parts(target: Target) -> tuple[object, ...]:
        place = target.kind, target.chapter, target.id, target.number, target.title
        return *place, target.labelled, target.deeper

    inside = {
        chapter: [visible_parts(one) for one in found] for chapter, found in targets.inside.items()
    }
    chapters = {chapter: visible_parts(target) for chapter, target in targets.chapters.items()}
    return hash_of(chapters, inside)


SCENE_FILE = re.compile(r"scenes/([^_/]\w*)[/.]")
"""A file of one scene: a module, or part of a package. Shared code is in modules and packages whose
names begin with an underscore."""
FORMULA = re.compile(r"\$\$.+?\$\$|\$[^$\n]+\$", re.DOTALL)
WORDS = re.compile(r"\{ref\}`[^`]*`|(\w+)")
"""Without references, as a chapter may have the name of a scene."""


def read_book(
    sources: Sources,
    load_scene: Callable[[str], Scene[Any]],
    measurements: Measurements | None = None,
) -> Book:
    """The whole book; mistakes are reported and reading goes on. Raises `BuildError` where there
    is no outline: all else that is reported then would be untrue."""
    outline, problems = read_outline(sources), sources.problems
    if not outline.chapters and problems:
        raise BuildError(problems.found)
    settings, words = outline.settings, outline.words
    shared = _read_shared(sources, outline, load_scene, measurements)
    state_of = _states(sources.root, outline)
    pages = list(_list_pages(outline, shared, sources, state_of))
    targets = find_targets([page.chapter_targets() for page in pages], problems)
    known = _targets_state(targets)
    check_addresses(outline, problems)
    check_boxes(outline, problems)
    _check_unlisted(sources, outline)

    formulae = {tex for page in pages for tex in FORMULA.findall(page.text)}
    with counting("formulae", len(formulae)):
        chapters = tuple(page.read(targets, known, problems) for page in pages)

    def beside[T](path: str, read: Callable[[ParseContext], T]) -> T:
        """What a file beside the chapters says."""

        def make(own: Diagnostics) -> T:
            return read(ParseContext(path=path, shared=shared, problems=own, targets=targets))

        return cached_reading(path, (state_of(path), known, shared.load_scene), problems, make)

    return Book(
        title=settings.title,
        subtitle=settings.subtitle,
        prerequisites=settings.prerequisites,
        address=settings.address,
        source=settings.source,
        news=read_news(sources, targets.chapters),
        settings=settings,
        words=words,
        hero=_read_hero(outline, shared, problems),
        starts=tuple(_read_links(settings.starts, outline, targets, problems)),
        stops=tuple(_read_links(settings.path.stops, outline, targets, problems)),
        chapters=chapters,
        bibliography=shared.bibliography,
        lecture_plan=read_lecture_plan(sources, targets),
        search_words=tuple(read_search_words(sources, targets)),
        glossary=beside(GLOSSARY, read_definitions),
        symbols=beside(
            SYMBOLS,
            lambda context: read_meanings(
                read_symbols(Sources(sources.root, context.problems)), context
            ),
        ),
    )


def _read_shared(
    sources: Sources,
    outline: Outline,
    load_scene: Callable[[str], Scene[Any]],
    measurements: Measurements | None,
) -> Shared:
    """What the chapters of an outline are read with."""
    settings, words = outline.settings, outline.words
    bibliography = cached_reading(
        BIBLIOGRAPHY,
        (file_hash(sources.root / BIBLIOGRAPHY), words),
        sources.problems,
        lambda own: read_bibliography(Sources(sources.root, own), words),
    )
    return Shared(
        root=sources.root,
        load_scene=load_scene,
        parser=make_parser(words, settings.boxes),
        words=words,
        measurements=measurements or Measurements(),
        raw_html=settings.trust.raw_html,
        macros=outline.macros,
        bibliography=bibliography,
        glossary=read_glossary(sources, words),
        colours=tuple(settings.colours),
    )


def _list_pages(
    outline: Outline, shared: Shared, sources: Sources, state_of: Callable[[str], bytes]
) -> Iterator[ChapterSource]:
    """The chapters' files."""
    problems = sources.problems
    for name, line, position in outline.chapters:
        path = f"content/{name}.md"
        if not sources.has(path):
            folder = sources.root / "content"
            files = sorted(file.stem for file in folder.glob("[!.#]*.md") if file.is_file())
            meant = f"{nearest(name, files)}.md"
            spoils = (f"content/{meant}", "unknown chapter", f"unknown page '{meant}'", *TARGETS)
            problems.add(OUTLINE, line, unknown("chapter", name, files), spoils=spoils)
            continue
        # A number in front is for the listing of the folder; it means nothing.
        if not re.fullmatch(r"(\d+-)?[a-z0-9]+(-[a-z0-9]+)*", name):
            problems.add(OUTLINE, line, f"chapter {name!r}; legal: 'NN-slug'")
        yield ChapterSource(path, sources.text(path), position, shared, state_of(path))


def _states(root: Path, outline: Outline) -> Callable[[str], bytes]:
    """A function from a chapter's path to a hash of its inputs: the files of ``content/`` besides
    chapters, shared code, and the scenes that the chapter names."""
    chapters = {f"{name}.md" for name, _, _ in outline.chapters}
    content = folder_files(root / "content").items()
    files = {name: file_hash(file) for name, file in content if name not in chapters}
    code: dict[str, list[bytes | None]] = {"": []}
    for name, file in folder_files(root / "simulations").items():
        scene = SCENE_FILE.match(name)
        code.setdefault(scene[1] if scene else "", []).append(file_hash(file))
    engine = folder_hash(ENGINE / "simulations", "*.py") if root != ENGINE else b""
    shared = hash_of(files, code.pop(""), engine, outline.words)

    def state_of(path: str) -> bytes:
        file = root / path
        text = file.read_text(encoding="utf-8", errors="replace") if file.is_file() else ""
        named = code.keys() & set(WORDS.findall(text.replace("-", "_")))
        modules = ("simulations.scenes.{}", "simulations.scenes.{}.scene")  # a file, or a package
        scenes = [
            (code[s], *(source_hash(module.format(s)) for module in modules)) for s in sorted(named)
        ]
        return hash_of(shared, scenes)

    return state_of


def _check_unlisted(sources: Sources, outline: Outline) -> None:
    listed = {f"{name}.md" for name, _, _ in outline.chapters}
    for name in folder_files(sources.root / "content"):
        if listed and name.endswith(".md") and name not in listed:
            message = f"not in {OUTLINE}; legal: listed in 'chapters' or 'appendices'"
            sources.problems.add(f"content/{name}", 1, message)


def _read_hero(outline: Outline, shared: Shared, problems: Diagnostics) -> Simulation | None:
    settings = outline.settings
    if not settings.hero:
        return None
    line, caption = outline.hero_line, _read_hero_caption(outline, shared, problems)
    try:
        scene = loaded("simulation", settings.hero, shared.load_scene, CodeError)
    except CodeError as error:
        problems.add(OUTLINE, line, str(error), raised_by_code(error))
        return None
    name, tier = f"figure-{scene.id}", scene.accuracy.default
    return Simulation(
        scene=scene, id=name, values={}, tier=tier, caption=caption, path=OUTLINE, line=line
    )


def _read_hero_caption(outline: Outline, shared: Shared, problems: Diagnostics) -> Passage:
    """The title page has no list of works and no marks of terms."""
    alone = replace(shared, bibliography=NO_WORKS, glossary=NO_TERMS)
    context = ParseContext(path=OUTLINE, shared=alone, problems=problems)
    caption = inline_passage(outline.settings.hero_caption, outline.hero_line, context)
    for link in context.links:
        message = f"link {link.target!r} in the cover's caption; legal: 'https://…'"
        context.problem(link.line, message)
    return caption


def _read_links(
    links: Mapping[str, str], outline: Outline, targets: Targets, problems: Diagnostics
) -> Iterator[tuple[str, str]]:
    """The words and the address of each of these links of the title page."""
    for words, place in links.items():
        try:
            found = targets.find(place, "")
        except LookupError as error:
            problems.add(OUTLINE, outline.link_lines[words], str(error))
        else:
            yield words, f"{found.chapter}/#{found.id}" if found.id else f"{found.chapter}/"
