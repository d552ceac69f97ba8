"""Style sheets, scripts, fonts and pictures: what pages have beside them, in one folder."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from site_builder.book import Book
from site_builder.book_root import own_or_engine
from site_builder.figures.initial_frames import InitialFrames
from site_builder.files import folder_files
from site_builder.markdown.directives.figure import SUFFIXES
from site_builder.offline.release import SCRIPT as RELEASE_SCRIPT
from site_builder.offline.release import integrity
from site_builder.output.assets import Content, content_bytes, hashed_folder
from site_builder.output.book_files import book_css, book_script
from site_builder.output.font_faces import MATHS_FACES, face_rule
from site_builder.output.fonts import subset_fonts
from site_builder.output.scripts import imported_scripts, reachable
from site_builder.output.style_sheets import join_style_sheets, without_comments
from site_builder.pages.features import kinds_script, parts_script, sheets_not_for, shown_in
from site_builder.pages.render import back_matter

STYLE_SHEET = "css/book.css"
"""The one that pages hold or, while the book is written, link to, below ``static/``."""
SCRIPT = "js/main.js"
IN_HEAD = (SCRIPT,)
"""Scripts that the head of a page runs."""
ENTRIES = (SCRIPT, RELEASE_SCRIPT)
"""Scripts that something else than a script asks for."""

NOW = "assets/now/"
"""Folder of the assets while the book is written: a changed style sheet changes no page."""

type Files = Mapping[str, Content]


def gather_assets(
    book: Book,
    root: Path,
    pictures: Mapping[str, bytes],
    made: Files,
    folder: str = "",
    join: Callable[[Files], Files] = dict,
) -> tuple[str, Files]:
    """Style sheets, scripts, fonts, stills, the author's pictures, what opens the figures' Python
    and what searches, in one folder: ``folder``, or one that is named by what is in it. The
    engine's own are handed through ``join``."""
    content = folder_files(root / "content")
    static = folder_files(own_or_engine(root, "static"))
    files: Files = {
        **join(_engine_files(book, static)),
        **{f"fonts/{name}": data for name, data in subset_fonts().items()},
        **{f"stills/{name}": data for name, data in pictures.items()},
        **{f"content/{name}": file for name, file in content.items() if name.endswith(SUFFIXES)},
        **made,
    }
    if folder:
        return folder, {folder + name: content for name, content in files.items()}
    return hashed_folder("assets", files)


def _engine_files(book: Book, static: Files) -> Files:
    """Of the engine's style sheets and scripts those that the book uses."""
    shown = shown_in(book, dict(back_matter(book)))
    own = book_css(book.settings, book.words) + "".join(map(face_rule, MATHS_FACES))
    files = {
        **join_style_sheets(static, STYLE_SHEET, own, without=sheets_not_for(shown)),
        "js/book.js": book_script(book.settings, book.words),
        "js/book_parts.js": parts_script(shown),
        "js/question/book_kinds.js": kinds_script(shown),
    }
    used = reachable(files, ENTRIES) | {STYLE_SHEET}
    loaded = ("css/", "js/")
    return {
        name: file for name, file in files.items() if name in used or not name.startswith(loaded)
    }


def _scripts(files: Files, assets: str) -> tuple[str, ...]:
    """What pages run at once, below the folder ``assets``."""
    return imported_scripts({name.removeprefix(assets): files[name] for name in files}, SCRIPT)


def prerendered_files(initial_frames: InitialFrames) -> Files:
    """What figures can show before Python has started."""
    frames = [each.prerendered for each in initial_frames.values() if each.prerendered]
    return {f"prerendered/{each.file}": each.data for each in frames}


def handed_out(book: Book, root: Path) -> Files:
    """The author's films, captions and downloads."""
    names = {name for chapter in book.chapters for name in chapter.files}
    return {f"content/{name}": root / "content" / name for name in sorted(names)}


def in_page(files: Files, assets: str, *, reload: bool) -> dict[str, Any]:
    """What a page holds of its assets, besides their addresses. While the book is written no more
    than the scripts' names, so that a changed style sheet changes no page."""
    scripts = _scripts(files, assets)
    if reload:
        return {"scripts": scripts}
    sheet = content_bytes(files[assets + STYLE_SHEET]).decode("utf-8")
    named = {name: files[assets + name] for name in (*IN_HEAD, *scripts) if assets + name in files}
    hashes = {name: integrity(content_bytes(file)) for name, file in named.items()}
    return {"scripts": scripts, "styles": without_comments(sheet), "hashes": hashes}
