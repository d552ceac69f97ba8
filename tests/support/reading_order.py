"""Scenes in the order in which the book shows them: whoever visits all of them turns few pages."""

import re
from pathlib import Path

from simulations.registry import SCENE_MODULES

CHAPTERS = sorted((Path(__file__).parents[2] / "content").glob("*.md"))
SHOWS = re.compile(r"^:+\{simulation\} *([\w-]+)", re.MULTILINE)
SHOWN = [name for file in CHAPTERS for name in SHOWS.findall(file.read_text(encoding="utf-8"))]
IN_READING_ORDER = tuple(
    dict.fromkeys([*filter(SCENE_MODULES.__contains__, SHOWN), *SCENE_MODULES])
)
"""Every scene of the registry; what no chapter shows comes last."""
