"""Numbers and words that figures show, worked out by hand or printed in a chapter."""

import tomllib
from pathlib import Path
from typing import Any

import pytest
from support.frames import frame_of, texts_of

from simulations.registry import load_scene

FILE = Path(__file__).parents[1] / "fixtures" / "known_values.toml"
ROWS = [
    pytest.param(scene, row["given"], row, id=f"{scene}-{number}")
    for scene, rows in tomllib.loads(FILE.read_text(encoding="utf-8")).items()
    for number, row in enumerate(rows, start=1)
]


@pytest.mark.parametrize(("scene", "given", "row"), ROWS)
def test_figure_shows_the_known_values(
    scene: str, given: dict[str, object], row: dict[str, Any]
) -> None:
    frame, shows = frame_of(load_scene(scene), **given), row.get("shows", {})
    assert {name: plain(texts_of(frame)[name]) for name in shows} == shows
    if "says" in row:
        assert row["says"] in frame.description
        assert row["says"] not in frame_of(load_scene(scene)).description


def plain(text: str) -> str:
    """Lines with single spaces."""
    return "\n".join(" ".join(line.split()) for line in text.split("\n"))
