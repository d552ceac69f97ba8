"""Icons of pixels, from the one of lines."""

import io
from pathlib import Path

import pytest
from PIL import Image

from site_builder.diagnostics.diagnostic import BuildError
from site_builder.publishing.icons import FILE, SIZES, make_icons

ROOT = Path(__file__).resolve().parents[3]


def test_each_icon_has_its_size() -> None:
    for name, data in make_icons(ROOT).items():
        assert Image.open(io.BytesIO(data)).size == (SIZES[name], SIZES[name])


def test_an_icon_that_is_no_drawing_is_told_with_its_file(tmp_path: Path) -> None:
    file = tmp_path / FILE
    file.parent.mkdir(parents=True)
    file.write_text("<p>", encoding="utf-8")
    with pytest.raises(BuildError, match=f"{FILE}:1: "):
        make_icons(tmp_path)
