"""Photographs from packages: the packed modules against the original files."""

import importlib
import os
from importlib.metadata import distribution
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from support.places import ROOT

from site_builder.photographs import FOLDER, LIST, credits_of, prepare_photographs

CREDITS = credits_of(ROOT)


@pytest.mark.parametrize("name", CREDITS)
def test_packed_photograph_is_the_scaled_file(name: str) -> None:
    credit = CREDITS[name]
    module = importlib.import_module(f"simulations.pictures.photographs.{name}")
    installed = distribution(credit.package.partition("==")[0]).locate_file(credit.file)
    with Image.open(str(installed)) as whole:
        part = whole.convert("RGB").resize(credit.size, Image.Resampling.LANCZOS, credit.cut)
    error = np.asarray(part).astype(int) - module.codes()
    assert error.min() >= 0
    assert error.max() <= 1
    assert len(module.PACKED) * 3 / 4 < 62_000


def test_modules_follow_the_list_whatever_the_clock_says(tmp_path: Path) -> None:
    listed, (first, *_) = tmp_path / FOLDER / LIST, CREDITS.values()
    listed.parent.mkdir(parents=True)
    text = (ROOT / FOLDER / LIST).read_text(encoding="utf-8")
    for title in (first.title, "Another title"):
        listed.write_text(text.replace(first.title, title), encoding="utf-8")
        prepare_photographs(tmp_path)
        modules = [*listed.parent.glob("*.py")]
        assert sum(title in module.read_text(encoding="utf-8") for module in modules) == 1
        for module in modules:
            os.utime(module, (4e9, 4e9))  # made while the clock was fast
