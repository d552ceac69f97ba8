"""``content/book.toml`` read and checked."""

import re
from pathlib import Path

from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.files.text import Toml, read_toml
from site_builder.settings.declared import Reader, keys_of
from site_builder.settings.model import FILE_NAME, Settings


def read_settings(root: Path, problems: Diagnostics) -> tuple[Settings, Toml]:
    """The settings and their places in the file; a mistake is reported, and its default holds."""
    there = (root / FILE_NAME).is_file()
    read = read_toml(root, FILE_NAME, problems) if there else Toml()
    if read is None or not read.text.strip():
        if read is not None:
            required = ", ".join(item.name for item in keys_of(Settings) if item.required)
            problems.add(FILE_NAME, 1, f"no outline; legal: a file with {required}")
        return Settings("", "", "", ()), Toml()
    return Reader(FILE_NAME, read, problems).table(Settings, read.table), read


def storage_prefix(settings: Settings) -> str:
    """Begins the names of all that a browser stores for the book: books may share a host."""
    made = re.sub(r"[^a-z0-9]+", "-", settings.title.lower()).strip("-")
    return settings.storage or made or "book"
