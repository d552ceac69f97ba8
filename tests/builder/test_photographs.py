"""Photographs from packages: the packed modules against the original files."""

import importlib
from importlib.metadata import distribution

import numpy as np
import pytest
from PIL import Image
from support.places import ROOT

from site_builder.photographs import credits_of

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
