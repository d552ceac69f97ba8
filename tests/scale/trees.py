"""The same book as the sources of each builder, and the command that builds them."""

import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from scale.text import BOOKS, MKDOCS, MYST, OURS, Notation, name, picture, picture_name, title

FRONT_MATTER = "---\ntitle: {title}\nsummary: What part {n} says.\n---\n\n"
BOOK = """\
title = "The Whole"
subtitle = "A book of {count} parts."
prerequisites = "None."
chapters = [
{chapters}]
"""
MKDOCS_SETTINGS = "site_name: The Whole\nplugins: [search]\nuse_directory_urls: true\n"
SPHINX_SETTINGS = """\
project = "The Whole"
extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath", "colon_fence", "amsmath"]
html_theme = "alabaster"
"""


@dataclass(frozen=True, slots=True)
class Builder:
    """One of those that are compared."""

    title: str
    content: str
    """Folder of the chapters."""
    notation: Notation
    begin: Callable[[int], str]
    """What stands above the text of a chapter."""
    others: Callable[[int], Mapping[str, str]]
    """Its files beside the chapters, of a book of so many."""
    command: Callable[[Path, Path], list[str]]
    """From the folder of its tools, and that of the book; the site goes into ``site`` there."""
    again: Callable[[Path, Path], list[str]]
    """The same after an edit, in the builder's quick way where it has one."""


def _heading(number: int) -> str:
    return f"# {title(number)}\n\n"


def _front_matter(number: int) -> str:
    return FRONT_MATTER.format(title=title(number), n=number)


def _our_files(count: int) -> Mapping[str, str]:
    chapters = "".join(f'  "{name(number)}",\n' for number in range(1, count + 1))
    return {"content/book.toml": BOOK.format(count=count, chapters=chapters)}


def _index(count: int) -> str:
    return "".join(f"- [{title(n)}]({name(n)}.md)\n" for n in range(1, count + 1))


def _mkdocs_files(count: int) -> Mapping[str, str]:
    return {"mkdocs.yml": MKDOCS_SETTINGS, "docs/index.md": f"# The Whole\n\n{_index(count)}"}


def _sphinx_files(count: int) -> Mapping[str, str]:
    names = "".join(f"{name(number)}\n" for number in range(1, count + 1))
    toc = f"# The Whole\n\n```{{toctree}}\n{names}```\n"
    return {"docs/conf.py": SPHINX_SETTINGS, "docs/index.md": toc}


def _ours(_tools: Path, _book: Path) -> list[str]:
    return [sys.executable, "-m", "site_builder", "build", "--no-runtime", "--out", "site"]


def _mkdocs(*more: str) -> Callable[[Path, Path], list[str]]:
    return lambda tools, _book: [str(tools / "mkdocs"), "build", "--quiet", *more]


def _sphinx(tools: Path, _book: Path) -> list[str]:
    return [str(tools / "sphinx-build"), "-q", "-b", "html", "docs", "site"]


BUILDERS = (
    Builder("this builder", "content", OURS, _front_matter, _our_files, _ours, _ours),
    Builder(
        "MkDocs", "docs", MKDOCS, _heading, _mkdocs_files, _mkdocs("--clean"), _mkdocs("--dirty")
    ),
    Builder("Sphinx + MyST", "docs", MYST, _heading, _sphinx_files, _sphinx, _sphinx),
)


def write_book(builder: Builder, count: int, folder: Path, kind: str = "everything") -> None:
    """The sources of a book of ``count`` chapters, of one of the kinds of `BOOKS`."""
    for path, text in builder.others(count).items():
        _write(folder / path, text)
    for number in range(1, count + 1):
        text = builder.begin(number) + BOOKS[kind](number, count, builder.notation)
        _write(folder / builder.content / f"{name(number)}.md", text)
        if kind == "everything":
            _write(folder / builder.content / picture_name(number), picture(number))


def edit_line(builder: Builder, count: int, folder: Path, word: str) -> None:
    """Change a sentence of the chapter in the middle."""
    file = folder / builder.content / f"{name((count + 1) // 2)}.md"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("\nSo ", f"\nSo {word} ", 1), encoding="utf-8")


def _write(file: Path, text: str) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
