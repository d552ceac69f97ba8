"""``content/book.toml`` read and checked."""

import re
from pathlib import Path

from site_builder.diagnostics import Diagnostics
from site_builder.settings.declared import Given, keys_of
from site_builder.settings.model import FILE_NAME, Sans, Serif, Settings, font_files
from site_builder.settings.theme import check_theme
from site_builder.source_text import Toml, read_toml

FONT_SUFFIXES = (".ttf", ".otf", ".woff2")


def read_settings(root: Path, problems: Diagnostics) -> tuple[Settings, Toml]:
    """What the file says, and where; mistakes are reported, and defaults hold in their place."""
    there = (root / FILE_NAME).is_file()
    read = read_toml(root, FILE_NAME, problems) if there else Toml()
    if read is None or not read.text.strip():
        if read is not None:
            required = ", ".join(item.name for item in keys_of(Settings) if item.required)
            problems.add(FILE_NAME, 1, f"no outline; legal: a file with {required}")
        return Settings("", "", "", ()), Toml()
    given = Given(FILE_NAME, read, problems)
    settings = given.table(Settings, read.table)
    check_theme(settings, given)
    for role, family in (("serif", settings.fonts.serif), ("sans", settings.fonts.sans)):
        if family:
            _check_family(role, family, root, given)
    return settings, read


def storage_prefix(settings: Settings) -> str:
    """What begins the names of what a browser keeps for the book: books may share a host."""
    made = re.sub(r"[^a-z0-9]+", "-", settings.title.lower()).strip("-")
    return settings.storage or made or "book"


def _check_family(role: str, family: Serif | Sans, root: Path, given: Given) -> None:
    """Report files that are not there, or no fonts."""
    content = root / "content"
    if family.licence_file and not (content / family.licence_file).is_file():
        at = ("fonts", role, "licence_file")
        given.report(at, _lost(at, family.licence_file, "the text of the licence"))
    for face in font_files(family, role):
        fits = face.file.endswith(FONT_SUFFIXES) and (content / face.file).is_file()
        if face.file and not fits:
            expected = f"a file below content/ that ends in {', '.join(FONT_SUFFIXES)}"
            given.report(face.at, _lost(face.at, face.file, expected))


def _lost(at: tuple[str, ...], file: str, expected: str) -> str:
    return f'{".".join(at)} is "{file}", which is no such file; legal: {expected}'
