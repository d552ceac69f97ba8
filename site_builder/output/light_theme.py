"""Style sheets for what knows neither variables nor themes: as on paper."""

import re
from collections.abc import Mapping
from pathlib import Path

from site_builder.document.book import Colours
from site_builder.files.engine import own_or_engine
from site_builder.output.colour_rules import paper_rules

TOKEN = re.compile(r"^  (--[\w-]+): light-dark\(([^,]+), [^)]+\);", re.MULTILINE)
CONTAINER = re.compile(r"^@container (?:.*\n)*?\}\n", re.MULTILINE)


def style_of_drawings(root: Path, more: str, families: Mapping[str, str], colours: Colours) -> str:
    """The site's sheet for drawings and ``more`` rules, in plain CSS. ``root`` is the book's
    folder, ``families`` are the faces by the names of their variables, ``colours`` the book's."""
    tokens, overlay = (
        own_or_engine(root, f"static/css/{name}.css").read_text(encoding="utf-8")
        for name in ("tokens", "overlay")
    )
    rules = without_containers(overlay) + more + paper_rules(colours)
    return resolve(rules, light_tokens(tokens) | dict(families))


def light_tokens(sheet: str) -> dict[str, str]:
    """The colours of the light theme, by the name of their variable."""
    return dict(TOKEN.findall(sheet))


def resolve(sheet: str, tokens: dict[str, str]) -> str:
    """Without variables. Raises `KeyError` for one that is not a token."""
    return re.sub(r"var\((--[\w-]+)\)", lambda found: tokens[found[1]], sheet)


def without_containers(sheet: str) -> str:
    """Without what depends on the width of a place in the page."""
    return CONTAINER.sub("", sheet)
