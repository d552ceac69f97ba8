"""The assets of the pages, in one folder: style sheets, scripts, fonts and pictures."""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

from simulations.engine.controls import KINDS as CONTROLS
from site_builder.cache.results import cached_result
from site_builder.document.blocks import Question, contents
from site_builder.document.book import Book
from site_builder.figures.drawn_pictures import pictures_in
from site_builder.figures.initial_frames import InitialFrames
from site_builder.files.engine import ENGINE, static_files
from site_builder.files.folders import file_hash, folder_files, integrity
from site_builder.files.text import Sources
from site_builder.markdown.content_files import PICTURES, picture_size
from site_builder.markdown.directives.pictures import DrawnIllustration, PictureFile
from site_builder.markdown.questions.kind import HERE as QUESTION_FOLDER
from site_builder.markdown.questions.kinds import KINDS as QUESTIONS
from site_builder.markdown.questions.kinds import kind_of
from site_builder.output.fonts import face_rules, fallback_rules, subset_fonts
from site_builder.output.scripts import Bundle, book_css, book_script, bundle_scripts
from site_builder.output.style_sheets import (
    colour_rules,
    join_style_sheets,
    theme_rules,
    without_comments,
)
from site_builder.output.writer import Content, content_bytes, hashed_folder
from site_builder.pages.views.simulation import CONTROL_KINDS as CONTROL_FOLDER
from site_builder.settings.model import read_settings
from site_builder.sources.outline import read_words


def kind_files(book: Book | None = None) -> dict[str, bytes | Path]:
    """Files of all kinds of controls, and of the kinds of questions that the book asks: scripts,
    modules that list these, and their style sheets joined; by the paths from ``static/``.
    ``.ci/web/book.d.ts`` has the types of the modules."""
    asked = {
        kind_of(question).folder
        for chapter in (book.chapters if book else ())
        for question in contents(chapter.body, Question)
    }
    controls = {CONTROL_FOLDER / name: (name,) for name in CONTROLS}
    questions = {
        QUESTION_FOLDER / kind.folder: (*kind.quiz, *kind.predict)
        for kind in QUESTIONS
        if kind.folder in asked
    }
    return {
        **_kind_scripts("js/figure/control_kinds.js", controls),
        **_kind_scripts("js/question/book_kinds.js", questions),
        "css/control-kinds.css": _kind_sheet(controls),
        "css/question-kinds.css": _kind_sheet(questions),
    }


def _kind_scripts(table: str, kinds: Mapping[Path, Iterable[str]]) -> dict[str, bytes | Path]:
    """Scripts of the kinds in these folders, and the module ``table`` with each by its names."""
    lines: list[str] = []
    entries: dict[str, str] = {}
    for at, (folder, names) in enumerate(kinds.items()):
        path = folder.relative_to(ENGINE).as_posix()
        lines.append(f'import {{ kind as kind{at} }} from "../../../{path}/kind.js";\n')
        entries |= dict.fromkeys(names, f"kind{at}")
    listed = ", ".join(f'"{name}": {kind}' for name, kind in entries.items())
    files = [folder / "kind.ts" for folder in kinds]
    return {
        **{f"../{file.relative_to(ENGINE).as_posix()}": file for file in files},
        table: f"{''.join(lines)}export const KINDS = {{ {listed} }};\n".encode(),
    }


def _kind_sheet(folders: Iterable[Path]) -> bytes:
    return b"\n".join((folder / "kind.css").read_bytes() for folder in folders)


STYLE_SHEET = "css/book.css"
"""The one that pages hold or, while the book is written, link to, below ``static/``."""
SCRIPT = "js/main.js"
SOURCES = ("js/main.ts", "js/offline/service_worker.ts")
"""Scripts that pages, or a service worker, load by address."""

NOW = "assets/now/"
"""Folder of the assets while the book is written: a changed style sheet changes no page."""

type Files = Mapping[str, Content]


@dataclass(frozen=True, slots=True)
class Assets:
    """What pages load, in one folder."""

    folder: str
    """Below the site's root."""
    files: Files
    scripts: tuple[str, ...]
    """What pages run at once besides `SCRIPT`, below the folder."""


def gather_assets(
    book: Book, root: Path, pictures: Mapping[str, bytes], made: Files, folder: str = ""
) -> Assets:
    """Style sheets, scripts, fonts, stills, the author's pictures, what opens the figures' Python
    and what searches, in one folder: ``folder``, or one that is named by what is in it. Raises
    `BuildError`."""
    content, widths = folder_files(root / "content"), shown_widths(book)
    static = {**static_files(root), **kind_files(book)}
    scripts = _scripts(book, static)
    files: Files = {
        **scripts.files,
        **_style_sheets(book, static, scripts.beside),
        **{
            name: file
            for name, file in static.items()
            if not name.startswith(("css/", "js/", "../"))
        },
        **{f"fonts/{name}": data for name, data in subset_fonts().items()},
        **{f"stills/{name}": data for name, data in {**pictures, **_drawn(book)}.items()},
        **{
            f"content/{name}": scaled_picture(file, widths.get(name, COLUMN_PX))
            for name, file in content.items()
            if name.lower().endswith(PICTURES.suffixes)
        },
        **made,
    }
    if folder:
        files = {folder + name: content for name, content in files.items()}
    else:
        folder, files = hashed_folder("assets", files)
    return Assets(folder, files, scripts.at_once)


def _drawn(book: Book) -> dict[str, bytes]:
    """The pictures of illustrations."""
    found: dict[str, bytes] = {}
    for chapter in book.chapters:
        for drawn in contents(chapter.body, DrawnIllustration):
            for panel in drawn.illustration.panels:
                found |= pictures_in(panel.overlay)
    return found


COLUMN_PX = 700.0
"""Width of the column of text in CSS pixels, on the widest screen."""


def shown_widths(book: Book) -> dict[str, float]:
    """How wide the author's pictures are shown, in CSS pixels."""
    widths: dict[str, float] = {}
    for chapter in book.chapters:
        for shown in contents(chapter.body, PictureFile):
            number = float(shown.width.rstrip("%px") or 100)
            width = number if shown.width.endswith("px") else COLUMN_PX * number / 100
            for name in filter(None, (shown.file, shown.dark)):
                widths[name] = max(width, widths.get(name, 0))
    return widths


def scaled_picture(file: Path, width: float) -> Content:
    """A picture with two pixels for each that it is shown on, at most, for fine screens."""
    most = round(2 * width)

    def scaled() -> bytes:
        from PIL import Image

        buffer = BytesIO()
        with Image.open(file) as picture:
            whole = picture.convert("RGBA") if picture.mode in ("1", "P") else picture
            small = whole.resize((most, round(picture.height * most / picture.width)))
            small.save(buffer, picture.format, quality=90, exif=picture.getexif())
        return buffer.getvalue()

    size = picture_size(file) if file.suffix.lower() != ".svg" else None
    if size is None or size[0] <= most:
        return file
    return cached_result("picture as shown", (file_hash(file), most), scaled)


def _scripts(book: Book, static: Files) -> Bundle:
    sources = {name: file for name, file in static.items() if name.startswith(("js/", "../"))}
    written = {"js/book.js": book_script(book.settings, book.words)}
    return bundle_scripts({**sources, **written}, *(name for name in SOURCES if name in sources))


def _style_sheets(book: Book, static: Files, beside: Collection[str]) -> Files:
    """The sheet of all pages, and those that scripts load."""
    made = {
        "css/fonts.css": (face_rules() + fallback_rules()).encode(),
        "css/roles.css": colour_rules(book.colours).encode(),
    }
    sheets = {name: file for name, file in static.items() if name.startswith("css/")} | made
    own = theme_rules(book.settings.theme) + book_css(book.words)
    joined = join_style_sheets(sheets, STYLE_SHEET, own)
    return {name: file for name, file in joined.items() if name in {STYLE_SHEET, *beside}}


def prerendered_files(initial_frames: InitialFrames) -> Files:
    """The prerendered frames of all figures."""
    frames = [each.prerendered for each in initial_frames.values() if each.prerendered]
    return {f"prerendered/{each.file}": each.data for each in frames}


def page_parts(assets: Assets, *, reload: bool) -> dict[str, Any]:
    """What a page holds of its assets, besides their addresses. While the book is written no more
    than the scripts' names, so that a changed style sheet changes no page."""
    if reload:
        return {"scripts": assets.scripts}
    contents = {
        name: content_bytes(assets.files[assets.folder + name])
        for name in (STYLE_SHEET, SCRIPT, *assets.scripts)
    }
    sheet = contents.pop(STYLE_SHEET).decode("utf-8")
    hashes = {name: integrity(content) for name, content in contents.items()}
    return {"scripts": assets.scripts, "styles": without_comments(sheet), "hashes": hashes}


def write_scripts(root: Path, site: Path, modules: Iterable[str]) -> None:
    """Single scripts, such as ``page/text``, each with what it imports, into ``js/`` of a site.

    Pages load them bundled; the bench and the tests load one alone."""
    settings, _ = read_settings(Sources(root))
    book = book_script(settings, read_words(Sources(root), settings.language))
    scripts = {**static_files(root), **kind_files()}
    sources = {name: file for name, file in scripts.items() if name.endswith((".ts", ".js"))}
    for module in modules:
        bundle = bundle_scripts({**sources, "js/book.js": book}, f"js/{module}.ts")
        for name, script in bundle.files.items():
            (site / name).parent.mkdir(parents=True, exist_ok=True)
            (site / name).write_bytes(script)
