"""Filling in templates, and writing what came of them, all or nothing."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from site_builder.files.engine import SHARED
from site_builder.scaffold.names import ScaffoldError

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
