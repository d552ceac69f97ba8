"""Where the engine's files are: in this repository, or where its wheel is installed.

The engine is `site_builder`, ``static/`` and `ENGINE_PARTS` of ``simulations``. All else is a
book's: ``content/``, and its own parts of ``simulations``, such as scenes and ladders.
``simulations`` and ``simulations.models`` are namespace packages: the folder in which Python is
started, a book's, and the engine's share them.
"""

from importlib.metadata import version
from pathlib import Path

from site_builder.files.folders import folder_files
from site_builder.version import __version__

DISTRIBUTION = "textbook-builder"
"""The name of the wheel."""
HERE = Path(__file__).resolve().parents[1]
ENGINE = HERE.parent
"""The folder of `site_builder` and the engine's ``simulations``."""
PACKED = HERE / "packed"
"""In a wheel, the files that lie beside `site_builder` in the repository."""
STATIC = next(folder / "static" for folder in (PACKED, ENGINE) if (folder / "static").is_dir())
ENGINE_PARTS = (
    "browser", "editing", "engine", "late_imports", "models", "notebook", "registry", "script",
)  # fmt: skip
"""Packages and modules right below ``simulations``."""
SHARED = ("simulations", "simulations/models")
"""The namespace packages."""


def engine_version() -> str:
    """Version of the installed wheel, which names its commit, or of this repository."""
    return version(DISTRIBUTION) if PACKED.is_dir() else __version__


def is_engine(module: str) -> bool:
    """Whether a module of ``simulations``, by its full name, is in a part that the engine has."""
    _, _, part = module.partition(".")
    return part.partition(".")[0] in ENGINE_PARTS


def book_or_engine_file(root: Path, path: str) -> Path:
    """The file ``path`` of the book at ``root`` or, where it has none, the engine's."""
    places = (root / path, PACKED / path)
    return next((place for place in places if place.is_file()), ENGINE / path)


def static_files(root: Path) -> dict[str, Path]:
    """The files of ``static/``; a book's own take the place of the engine's of the same name."""
    return {**folder_files(STATIC), **folder_files(root / "static")}


def hidden_parts(root: Path) -> list[str]:
    """A sentence for each part of the book at ``root`` that would hide a part of the engine."""
    if root == ENGINE:
        return []
    hiding = [f"{folder}/__init__.py" for folder in SHARED]
    taken = [
        f"{folder}/{own.name}"
        for folder in SHARED
        for own in sorted((root / folder).glob("[!_.]*"))
        if (own.is_dir() or own.suffix == ".py") and own.stem in _engine_names(folder)
    ]
    return [
        f"{path}:1: hides the engine's part of simulations; legal: {legal}"
        for paths, legal in ((hiding, "no such file"), (taken, "a name that the engine has not"))
        for path in paths
        if (root / path).exists()
    ]


def _engine_names(folder: str) -> set[str]:
    """The names in a folder that both have; each of the two itself hides nothing."""
    names = {path.stem for path in (ENGINE / folder).glob("[!_.]*")}
    return names & {*ENGINE_PARTS} - {"models"} if folder == "simulations" else names
