"""The licences of everything that reaches the reader, gathered from the installed packages."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from site_builder.book import UNSET
from site_builder.languages.words import ENGLISH, Words
from site_builder.npm import Package
from site_builder.runtime.pinned import Versions
from site_builder.settings.model import Settings


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
    settings: Settings = UNSET,
    words: Words = ENGLISH,
) -> tuple[Licence, ...]:
    """Licences of the book and of what it ships.

    The versions are the browser runtime's; ``editor`` are the packages in the code editor,
    ``search`` those that search the pages; ``settings`` are the book's, ``words`` its language's.
    """
    book = Licence(
        settings.title,
        "",
        words("licences.book", code=settings.licence.code, text=settings.licence.text),
        words("licences.this_book"),
        "",
        _text_of(root / "LICENSE"),
    )
    return (
        book,
        *(_of_the_runtime(versions, words) if versions.pyodide else ()),
        *_of_the_editor(editor, words),
        *_of_the_search(search, words),
        *_of_the_fonts(words),
    )


def _of_the_runtime(versions: Versions, words: Words) -> tuple[Licence, ...]:
    return (
        Licence(
            "Pyodide",
            versions.pyodide,
            "MPL 2.0",
            words("licences.pyodide"),
            "https://github.com/pyodide/pyodide",
            _packaged_text("pathspec", "licenses/LICENSE"),
        ),
        Licence(
            words("licences.cpython_name"),
            versions.python,
            "PSF License 2.0",
            words("licences.cpython"),
            "https://www.python.org/",
            _text_of(Path(os.__file__).parent / "LICENSE.txt")
            or _packaged_text("typing_extensions", "LICENSE"),
        ),
        Licence(
            "NumPy",
            versions.numpy,
            words("licences.numpy_licence"),
            words("licences.numpy"),
            "https://numpy.org/",
            _packaged_text("numpy", "licenses/LICENSE.txt"),
        ),
    )


def _of_the_editor(packages: Sequence[Package], words: Words) -> tuple[Licence, ...]:
    """One entry for all packages, each text once below the names of those that it covers."""
    if not packages:
        return ()
    texts: dict[str, list[str]] = {}
    for package in packages:
        texts.setdefault(package.text.strip(), []).append(f"{package.name} {package.version}")
    return (
        Licence(
            words("licences.editor_name"),
            "",
            f" {words('licences.and')} ".join(sorted({package.license for package in packages})),
            words("licences.editor"),
            "https://codemirror.net/",
            "\n\n\n".join(f"{', '.join(names)}\n\n{text}" for text, names in texts.items()),
        ),
    )


def _of_the_search(packages: Sequence[Package], words: Words) -> tuple[Licence, ...]:
    uses = {
        "minisearch": ("MiniSearch", words("licences.search"), "lucaong/minisearch"),
        "stemmer": ("stemmer", words("licences.stemmer"), "words/stemmer"),
        "@orama/stemmers": ("Orama stemmers", words("licences.stemmer"), "oramasearch/orama"),
    }
    return tuple(
        Licence(
            uses[package.name][0],
            package.version,
            package.license,
            uses[package.name][1],
            f"https://github.com/{uses[package.name][2]}",
            package.text,
        )
        for package in packages
    )


def _of_the_fonts(words: Words) -> tuple[Licence, ...]:
    return (
        Licence(
            words("licences.fonts_name"),
            "",
            "SIL Open Font License 1.1",
            words("licences.fonts"),
            "https://github.com/adobe-fonts",
            _packaged_text("font-source-serif-pro", "files/LICENSE.txt"),
        ),
        Licence(
            "STIX Two Math",
            "",
            "SIL Open Font License 1.1",
            words("licences.maths_font"),
            "https://github.com/stipub/stixfonts",
            _open_font_licence(),
        ),
    )


def _packaged_text(package: str, ending: str) -> str:
    """A licence file of an installed package; nothing where it carries none."""
    # What reads archives and letters, which takes long.
    from importlib.metadata import PackageNotFoundError, distribution

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
