"""The licences of everything that reaches the reader, gathered from the installed packages."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

from site_builder.editor.bundle import Package
from site_builder.runtime.pinned import Versions


@dataclass(frozen=True, slots=True)
class Licence:
    """One part of the site, and under which terms it is there."""

    part: str
    version: str
    name: str
    """Short name of the licence."""
    use: str
    """What the book does with it."""
    address: str
    """Where its source is."""
    text: str


def gather_licences(
    root: Path,
    versions: Versions,
    editor: Sequence[Package] = (),
    search: Sequence[Package] = (),
) -> tuple[Licence, ...]:
    """Licences of the book and of what it ships.

    The versions are the browser runtime's; ``editor`` are the packages in the code editor,
    ``search`` those that search the pages.
    """
    book = Licence(
        "Image Formation",
        "",
        "MIT (code) and CC BY 4.0 (text and figures)",
        "This book.",
        "",
        _text_of(root / "LICENSE"),
    )
    return (
        book,
        *_of_the_runtime(versions),
        *_of_the_editor(editor),
        *_of_the_search(search),
        *_of_the_fonts(),
    )


def _of_the_runtime(versions: Versions) -> tuple[Licence, ...]:
    return (
        Licence(
            "Pyodide",
            versions.pyodide,
            "MPL 2.0",
            "Python in the browser. Unmodified.",
            "https://github.com/pyodide/pyodide",
            _packaged_text("pathspec", "licenses/LICENSE"),
        ),
        Licence(
            "CPython and its standard library",
            versions.python,
            "PSF License 2.0",
            "Inside Pyodide. Cut down to what the book imports, and compiled.",
            "https://www.python.org/",
            _text_of(Path(os.__file__).parent / "LICENSE.txt")
            or _packaged_text("typing_extensions", "LICENSE"),
        ),
        Licence(
            "NumPy",
            versions.numpy,
            "BSD 3-Clause, with parts under compatible licences",
            "Arrays, in the browser and when the book is built. Cut down and compiled as well.",
            "https://numpy.org/",
            _packaged_text("numpy", "licenses/LICENSE.txt"),
        ),
    )


def _of_the_editor(packages: Sequence[Package]) -> tuple[Licence, ...]:
    """One entry for all packages, each text once below the names of those that it covers."""
    if not packages:
        return ()
    texts: dict[str, list[str]] = {}
    for package in packages:
        texts.setdefault(package.text.strip(), []).append(f"{package.name} {package.version}")
    return (
        Licence(
            "CodeMirror and Lezer",
            "",
            " and ".join(sorted({package.license for package in packages})),
            "The code editor of the figures. Cut down to what is used, and joined into one file.",
            "https://codemirror.net/",
            "\n\n\n".join(f"{', '.join(names)}\n\n{text}" for text, names in texts.items()),
        ),
    )


def _of_the_search(packages: Sequence[Package]) -> tuple[Licence, ...]:
    uses = {
        "minisearch": ("MiniSearch", "Finds sections by their words.", "lucaong/minisearch"),
        "stemmer": ("stemmer", "Takes words back to their stems.", "words/stemmer"),
    }
    return tuple(
        Licence(
            uses[package.name][0],
            package.version,
            package.license,
            f"{uses[package.name][1]} Unmodified.",
            f"https://github.com/{uses[package.name][2]}",
            package.text,
        )
        for package in packages
    )


def _of_the_fonts() -> tuple[Licence, ...]:
    return (
        Licence(
            "Source Serif and Source Sans",
            "",
            "SIL Open Font License 1.1",
            "Text and labels. Cut down to the characters used, and renamed.",
            "https://github.com/adobe-fonts",
            _packaged_text("font-source-serif-pro", "files/LICENSE.txt"),
        ),
        Licence(
            "STIX Two Math",
            "",
            "SIL Open Font License 1.1",
            "Formulae. Cut down to the characters used. Copyright 2001–2021 the STIX Fonts "
            "Project Authors.",
            "https://github.com/stipub/stixfonts",
            _open_font_licence(),
        ),
    )


def _packaged_text(package: str, ending: str) -> str:
    """A licence file of an installed package; nothing where it carries none."""
    try:
        files = distribution(package).files or []
    except PackageNotFoundError:
        return ""
    found = [file for file in files if file.as_posix().endswith(ending)]
    return found[0].read_text(encoding="utf-8") if found else ""


def _text_of(file: Path) -> str:
    """The file; nothing where there is none."""
    return file.read_text(encoding="utf-8") if file.is_file() else ""


def _open_font_licence() -> str:
    """The licence's body, without another font's copyright line at its head."""
    text = _packaged_text("font-source-serif-pro", "files/LICENSE.txt")
    start = text.find("This Font Software is licensed under")
    return text[start:] if start >= 0 else text
