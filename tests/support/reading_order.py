"""Scenes in the order in which the book shows them: a visit to all turns few pages."""

import re
from pathlib import Path

import pytest

from simulations.registry import SCENE_MODULES

CHAPTERS = sorted((Path(__file__).parents[2] / "content").glob("*.md"))
SHOWS = re.compile(r"^:+\{simulation\} *([\w-]+)", re.MULTILINE)
SHOWN = [name for file in CHAPTERS for name in SHOWS.findall(file.read_text(encoding="utf-8"))]
IN_READING_ORDER = tuple(
    dict.fromkeys([*filter(SCENE_MODULES.__contains__, SHOWN), *SCENE_MODULES])
)
"""Every scene of the registry; what no chapter shows comes last."""

SAMPLE = ("lens-distortion", "perspective-projection", "wagon-wheel")
"""Scenes that `make test` tries in browsers: pixels in tiers, a drawing, a film.
Python's own answers are tried for all scenes, in `tests/scenes`."""
SAMPLED = tuple(
    pytest.param(name, marks=[] if name in SAMPLE else pytest.mark.deep)
    for name in IN_READING_ORDER
)
