"""Names of new things in all their forms, and templates filled in with them."""

import keyword
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from site_builder.files.engine import SHARED

FORM = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")


class ScaffoldError(ValueError):
    """Something new cannot be made."""


@dataclass(frozen=True, slots=True)
class Name:
    """``falling-ball``: lower case, with hyphens."""

    text: str

    @property
    def module(self) -> str:
        return self.text.replace("-", "_")

    @property
    def constant(self) -> str:
        return self.module.upper()

    @property
    def class_name(self) -> str:
        return "".join(word.capitalize() for word in self.text.split("-"))

    @property
    def title(self) -> str:
        return " ".join(word.capitalize() for word in self.text.split("-"))

    @property
    def words(self) -> str:
        return self.text.replace("-", " ")


def read_name(kind: str, text: str) -> Name:
    """Raises `ScaffoldError`."""
    if not FORM.fullmatch(text):
        expected = "small letters and digits, with hyphens between words, as in 'falling-ball'"
        raise ScaffoldError(f"{kind} {text!r}; legal: {expected}")
    if keyword.iskeyword(text):
        raise ScaffoldError(f"{kind} {text!r} is a word of Python's own; legal: any other name")
    return Name(text)


HERE = Path(__file__).parent
SUFFIX = ".jinja"


def filled(template: str, **given: object) -> str:
    """A template of this folder, by its path, with what stands between « and » filled in."""
    return _environment().get_template(template).render(given)


@cache
def _environment() -> Environment:
    return Environment(
        loader=FileSystemLoader(HERE),
        variable_start_string="«",
        variable_end_string="»",
        block_start_string="<%",
        block_end_string="%>",
        comment_start_string="<#",
        comment_end_string="#>",
        undefined=StrictUndefined,
        trim_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
    )


def write_new(root: Path, files: Mapping[str, str]) -> None:
    """Write ``files``, by their paths below ``root``. Raises `ScaffoldError` where one is there."""
    there = [path for path in files if (root / path).exists()]
    if there:
        raise ScaffoldError(f"{', '.join(there)} is there already; legal: a name that is not taken")
    for path, text in files.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text, encoding="utf-8")


def packages(root: Path, module: str) -> dict[str, str]:
    """An empty ``__init__.py`` for each folder around ``module`` that lacks one, but for those that
    a book and the engine share."""
    folders = [folder.as_posix() for folder in Path(module).parents]
    paths = [f"{folder}/__init__.py" for folder in folders if folder not in (".", *SHARED)]
    return {path: "" for path in paths if not (root / path).exists()}
