"""The licences of everything that reaches the reader, gathered from the installed packages."""

import os
from collections.abc import Iterator, Sequence
from dataclasses import KW_ONLY, dataclass
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

from site_builder.document.book import UNSET
from site_builder.files.engine import DISTRIBUTION, PACKED, engine_version
from site_builder.languages.words import ENGLISH, Words
from site_builder.photographs import credits_of
from site_builder.programs.node import Package
from site_builder.runtime.store import Versions
from site_builder.settings.model import Settings

OPEN_FONT = "SIL Open Font License 1.1"
SEARCH = {
    "minisearch": ("MiniSearch", "licences.search", "lucaong/minisearch"),
    "stemmer": ("stemmer", "licences.stemmer", "words/stemmer"),
    "@orama/stemmers": ("Orama stemmers", "licences.stemmer", "oramasearch/orama"),
}
"""Name, use and repository of each package that searches."""


@dataclass(frozen=True, slots=True)
class Licence:
    """One part of the site, and under which terms it is there."""

    part: str
    name: str
    """Short name of the licence."""
    use: str
    """What the book does with it."""
    _: KW_ONLY
    version: str = ""
    address: str = ""
    """Where its source is."""
    text: str = ""


def gather_licences(
    root: Path,
    versions: Versions,
    editor: Sequence[Package] = (),
    search: Sequence[Package] = (),
    decoder: Sequence[Package] = (),
    book_packages: Sequence[Package] = (),
    settings: Settings = UNSET,
    words: Words = ENGLISH,
) -> tuple[Licence, ...]:
    """Licences of the book and of what it ships.

    The versions are the browser runtime's; ``editor`` are the packages in the code editor,
    ``search`` those that search the pages, ``decoder`` those that decode raw files,
    ``book_packages`` those that the book lists; ``settings`` are the book's, ``words`` its
    language's.
    """
    code = "https://github.com/"
    terms = words("licences.book", code=settings.licence.code, text=settings.licence.text)
    text, use = _text_of(root / "LICENSE"), words("licences.this_book")
    licences = [Licence(settings.title, terms, use, text=text)]
    if PACKED.is_dir():  # the engine's, as a wheel; in its repository it is also the book's
        text = _packaged_text(DISTRIBUTION, "licenses/LICENSE")
        text = text[max(text.find("MIT License\n"), 0) :]  # what is before is of another book
        use = words("licences.engine")
        licences.append(Licence(DISTRIBUTION, "MIT", use, version=engine_version(), text=text))
    if versions.pyodide:
        licences += _of_the_runtime(versions, words)
    for each in book_packages:
        licences.append(_licence_of(each, each.name, words("licences.package"), each.home))
    licences += _of_the_editor(editor, words)
    for each in search:
        name, use, home = SEARCH[each.name]
        licences.append(_licence_of(each, name, words(use), code + home))
    for shown in credits_of(root).values():
        use = words("licences.photograph", author=shown.author)
        licences.append(Licence(shown.title, shown.licence, use, address=shown.address))
    for each in decoder:
        use = words("licences.decoder", name=f"{each.name} {each.version}")
        home = f"{code}LibRaw/LibRaw"
        licences.append(Licence("LibRaw", each.license, use, address=home, text=each.text))
    ofl = _packaged_text("font-source-serif-pro", "files/LICENSE.txt")
    body = ofl[max(ofl.find("This Font Software is licensed under"), 0) :]  # others hold its rights
    for part, use, home, text in (
        (words("licences.fonts_name"), "licences.fonts", "adobe-fonts", ofl),
        ("STIX Two Math", "licences.maths_font", "stipub/stixfonts", body),
    ):
        licences.append(Licence(part, OPEN_FONT, words(use), address=code + home, text=text))
    return tuple(licences)


def _licence_of(package: Package, name: str, use: str, home: str) -> Licence:
    return Licence(
        name, package.license, use, version=package.version, address=home, text=package.text
    )


def _of_the_runtime(versions: Versions, words: Words) -> Iterator[Licence]:
    mpl = _packaged_text("pathspec", "licenses/LICENSE")
    psf = _text_of(Path(os.__file__).parent / "LICENSE.txt")
    psf = psf or _packaged_text("typing_extensions", "LICENSE")
    bsd = _packaged_text("numpy", "licenses/LICENSE.txt")
    use, home = words("licences.pyodide"), "https://github.com/pyodide/pyodide"
    yield Licence("Pyodide", "MPL 2.0", use, version=versions.pyodide, address=home, text=mpl)
    name, use = words("licences.cpython_name"), words("licences.cpython")
    home = "https://www.python.org/"
    yield Licence(name, "PSF License 2.0", use, version=versions.python, address=home, text=psf)
    terms, use = words("licences.numpy_licence"), words("licences.numpy")
    home = "https://numpy.org/"
    yield Licence("NumPy", terms, use, version=versions.numpy, address=home, text=bsd)


def _of_the_editor(packages: Sequence[Package], words: Words) -> Iterator[Licence]:
    """One entry for all packages, each text once below the names of those that it covers."""
    if not packages:
        return
    texts: dict[str, list[str]] = {}
    for package in packages:
        texts.setdefault(package.text.strip(), []).append(f"{package.name} {package.version}")
    text = "\n\n\n".join(f"{', '.join(names)}\n\n{text}" for text, names in texts.items())
    terms = f" {words('licences.and')} ".join(sorted({package.license for package in packages}))
    name, use = words("licences.editor_name"), words("licences.editor")
    yield Licence(name, terms, use, address="https://codemirror.net/", text=text)


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
