"""Reading ``content/``: the chapters of the outline, and what they are read with."""

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from simulations.engine.scene import Scene
from site_builder.benchmarks.measurements import Measurements
from site_builder.cache.hashing import hash_of, source_hash
from site_builder.cache.results import cached_reading
from site_builder.diagnostics.diagnostic import BuildError, Diagnostics, unknown
from site_builder.document.blocks import Simulation
from site_builder.document.book import OUTLINE, Book
from site_builder.document.passage import Passage
from site_builder.files.engine import ENGINE
from site_builder.files.folders import file_hash, folder_files, folder_hash
from site_builder.files.text import Sources
from site_builder.languages.words import languages
from site_builder.markdown.chapter import find_targets
from site_builder.markdown.glossary import read_definitions, read_meanings
from site_builder.markdown.inline import inline_passage
from site_builder.markdown.parse_context import ParseContext, Shared
from site_builder.markdown.parser import make_parser
from site_builder.markdown.scenes import find_scene
from site_builder.markdown.targets import Targets
from site_builder.references.bibliography import EMPTY as NO_WORKS
from site_builder.references.bibliography import FILE as BIBLIOGRAPHY
from site_builder.references.bibliography import read_bibliography
from site_builder.references.glossary import EMPTY as NO_TERMS
from site_builder.references.glossary import FILE as GLOSSARY
from site_builder.references.glossary import Glossary, read_glossary
from site_builder.references.news import read_news
from site_builder.references.symbols import FILE as SYMBOLS
from site_builder.references.symbols import read_symbols
from site_builder.sources.chapters import ChapterFile, targets_state
from site_builder.sources.lecture_plan import read_lecture_plan
from site_builder.sources.outline import Outline, check_addresses, read_outline
from site_builder.sources.translations.files import find_languages, folder_of

SCENE_FILE = re.compile(r"scenes/([^_/]\w*)[/.]")
"""A file of one scene: a module, or part of a package. Shared code is in modules and packages whose
names begin with an underscore."""
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
    terms = read_glossary(sources, words)
    shared = read_shared(sources, outline, terms, load_scene, measurements)
    pages = list(list_pages(outline, shared, sources))
    targets = find_targets([page.survey() for page in pages], problems)
    known = targets_state(targets)
    check_addresses(outline, problems)
    _check_unlisted(sources, outline)

    glossary = ParseContext(GLOSSARY, shared, problems, targets=targets)
    symbols = ParseContext(SYMBOLS, shared, problems, targets=targets)
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
        starts=tuple(read_starts(outline, targets, problems)),
        chapters=tuple(page.read(targets, known, problems) for page in pages),
        bibliography=shared.bibliography,
        lecture_plan=read_lecture_plan(sources, targets),
        glossary=read_definitions(glossary),
        symbols=read_meanings(read_symbols(sources), symbols),
        languages=find_languages(sources.root, settings),
    )


def read_shared(
    sources: Sources,
    outline: Outline,
    glossary: Glossary,
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
        sources.root,
        load_scene,
        make_parser(words),
        words,
        measurements or Measurements(),
        settings.trust.raw_html,
        outline.macros,
        bibliography,
        glossary,
        tuple(settings.colours),
    )


def list_pages(outline: Outline, shared: Shared, sources: Sources) -> Iterator[ChapterFile]:
    """The chapters' files, those of a translation where there are any."""
    problems, state_of = sources.problems, _states(sources.root, outline)
    for name, line, position in outline.chapters:
        path, own = f"content/{name}.md", f"content/{outline.folder}{name}.md"
        if not sources.has(path):
            problems.add(OUTLINE, line, unknown("chapter", name, _chapter_files(sources.root)))
            continue
        _check_name(name, line, problems)
        path = own if sources.has(own) else path
        yield ChapterFile(path, sources.text(path), position, shared, state_of(path))


def _states(root: Path, outline: Outline) -> Callable[[str], bytes]:
    """The hash of what a file is read with: those of ``content/`` that are no chapters, and all
    code but that of scenes that it does not name."""
    folders = ("", *map(folder_of, find_languages(root, outline.settings)))
    chapters = {f"{folder}{name}.md" for name, _, _ in outline.chapters for folder in folders}
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
        scenes = [(code[s], *map(source_hash, _scene_modules(s))) for s in sorted(named)]
        return hash_of(shared, scenes)

    return state_of


def _scene_modules(name: str) -> tuple[str, str]:
    """Names of a scene's module: as a single file, and in a package."""
    return f"simulations.scenes.{name}", f"simulations.scenes.{name}.scene"


def _chapter_files(root: Path) -> list[str]:
    return sorted(file.stem for file in (root / "content").glob("*.md") if file.is_file())


def _check_name(name: str, line: int, problems: Diagnostics) -> None:
    """A number in front is for the listing of the folder; it means nothing."""
    if not re.fullmatch(r"(\d+-)?[a-z0-9]+(-[a-z0-9]+)*", name):
        problems.add(OUTLINE, line, f"chapter {name!r}; legal: 'NN-slug'")


def _check_unlisted(sources: Sources, outline: Outline) -> None:
    content = sources.root / "content"
    tags = [tag for tag in languages() if tag != outline.settings.language]
    names = [name for name, _, _ in outline.chapters]
    listed = {
        f"content/{folder}{name}.md" for name in names for folder in ("", *map(folder_of, tags))
    }
    for file in sorted(content.rglob("*.md")):
        path = file.relative_to(sources.root).as_posix()
        if not listed or not file.is_file() or path in listed:
            continue
        message = f"not in {OUTLINE}; legal: listed in 'chapters' or 'appendices'"
        if file.stem in names:
            folder = file.parent.relative_to(content).as_posix()
            message = unknown("language of a translation", folder, tags)
        sources.problems.add(path, 1, message)


def _read_hero(outline: Outline, shared: Shared, problems: Diagnostics) -> Simulation | None:
    settings = outline.settings
    if not settings.hero:
        return None
    context = ParseContext(OUTLINE, shared, problems)
    scene = find_scene(settings.hero, outline.hero_line, context)
    caption = read_hero_caption(outline, shared, problems)
    if scene is None:
        return None
    return Simulation(
        scene=scene,
        id=f"figure-{scene.id}",
        values={},
        tier=scene.default_tier,
        caption=caption,
        path=OUTLINE,
        line=outline.hero_line,
    )


def read_hero_caption(outline: Outline, shared: Shared, problems: Diagnostics) -> Passage:
    """The title page has no list of works and no marks of terms."""
    alone = replace(shared, bibliography=NO_WORKS, glossary=NO_TERMS)
    context = ParseContext(outline.path, alone, problems)
    caption = inline_passage(outline.settings.hero_caption, outline.hero_line, context)
    for link in context.links:
        message = f"link {link.target!r} in the cover's caption; legal: 'https://…'"
        context.problem(link.line, message)
    return caption


def read_starts(
    outline: Outline, targets: Targets, problems: Diagnostics
) -> Iterator[tuple[str, str]]:
    """The words and the address of each link of the title page."""
    for words, place in outline.settings.starts.items():
        try:
            found = targets.find(place, "")
        except LookupError as error:
            problems.add(outline.path, outline.start_lines[words], str(error))
        else:
            yield words, f"{found.chapter}/#{found.id}" if found.id else f"{found.chapter}/"
