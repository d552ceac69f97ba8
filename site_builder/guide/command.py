"""``python -m site_builder guide``: write the guide as a book, then build or serve it."""

import os
import subprocess
import sys
from pathlib import Path

from site_builder.files.engine import ENGINE, STATIC, own_or_engine
from site_builder.guide.changes import changes_page
from site_builder.guide.classes import read_classes
from site_builder.guide.controls import MARK, controls_table
from site_builder.guide.pages import directive_page, drawing_page, role_page, settings_page
from site_builder.scaffold.files import HERE as SCAFFOLD
from site_builder.scaffold.files import SUFFIX, filled

OWN = Path(__file__).with_name("book")
SCENE = "content/06-a-scene.md"
TAKEN = "simulations/"
"""The folder that the guide takes from the template of a new book."""


def guide_files() -> dict[str, bytes]:
    """Every file of the guide by its path. Raises `NoExampleError`."""
    classes = read_classes(STATIC / "css" / "overlay.css")
    made = {
        "content/03-directives.md": directive_page(),
        "content/04-roles.md": role_page(),
        "content/05-drawings.md": drawing_page(classes.roles, classes.manners, classes.texts),
        SCENE: (OWN / SCENE).read_text(encoding="utf-8").replace(MARK, controls_table()),
        "content/08-settings.md": settings_page(),
        "content/11-changes.md": changes_page(own_or_engine(ENGINE, "CHANGELOG.md")),
        "simulations/models/classes.py": (
            f'"""Made by the guide."""\n\nROLES = {classes.roles!r}\n'
            f"MANNERS = {tuple(classes.manners)!r}\nTEXTS = {classes.texts!r}\n"
        ),
    }
    new_book = {
        path: filled(f"book/{file.relative_to(SCAFFOLD / 'book').as_posix()}").encode()
        for file in sorted((SCAFFOLD / "book").rglob("*"))
        if file.is_file()
        for path in (file.relative_to(SCAFFOLD / "book").as_posix().removesuffix(SUFFIX),)
        if path.startswith(TAKEN)
    }
    own = {
        file.relative_to(OWN).as_posix().removesuffix(SUFFIX): file.read_bytes()
        for file in sorted(OWN.rglob("*"))
        if file.is_file()
    }
    return {**new_book, **own, **{path: text.encode() for path, text in made.items()}}


def write_guide(folder: Path) -> None:
    """Replace the contents of ``folder`` by the guide. Unchanged files are left alone, so that a
    server of the guide builds only what has changed."""
    files = guide_files()
    for old in sorted(folder.rglob("*")) if folder.is_dir() else ():
        if old.is_file() and old.relative_to(folder).as_posix() not in files:
            old.unlink()
    for path, data in files.items():
        file = folder / path
        if not file.is_file() or file.read_bytes() != data:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(data)


FOLDER = Path("build", "guide")


def run_guide(place: tuple[str, int] | None, *, runtime: bool = True, folder: Path = FOLDER) -> int:
    """Serve it at ``place``, host and port, or only build it; the exit code of that."""
    book, site = folder.resolve() / "book", folder.resolve() / "site"
    write_guide(book)
    how = ["serve", "--host", place[0], "--port", str(place[1])] if place else ["build"]
    command = [sys.executable, "-m", "site_builder", *how, "--out", str(site)]
    given = [] if runtime else ["--no-runtime"]
    environment = {**os.environ, "PYTHONPATH": str(ENGINE)}  # from the folder of another book
    return subprocess.run([*command, *given], cwd=book, env=environment, check=False).returncode
