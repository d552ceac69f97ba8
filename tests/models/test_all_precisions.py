"""Pictures keep their precision through every model of pixels, and are never written to."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import DTypeLike

from simulations.models.arrays import Floats
from simulations.models.color import chromatic_adaptation, chromaticity, cie, srgb, ycbcr
from simulations.models.color.cie import D65_XY
from simulations.models.color.white_balance import white_balance
from simulations.models.compression.chroma_subsampling import coarsen
from simulations.models.compression.chroma_upsampling import METHODS as FILLINGS
from simulations.models.compression.chroma_upsampling import refine
from simulations.models.light.brdf import MODELS, Material, parts
from simulations.models.light.cell_blending import blend_cells
from simulations.models.sampling import bspline, resampling
from simulations.models.sensor import demosaicing, photon_counting

type Model = Callable[[Floats], Floats]
PLACES = np.array([[1.3, 2.6], [0.2, 0.4]])
D50_XY = chromaticity.D50_XY
SATIN = Material(0.5, 0.3, 0.4)


def rng() -> np.random.Generator:
    return np.random.default_rng(7)


OF_COLOURS: dict[str, Model] = {
    "adapt": lambda p: chromatic_adaptation.adapt(p, D65_XY, D50_XY),
    "xyz_to_xyy": chromaticity.xyz_to_xyy,
    "xyy_to_xyz": chromaticity.xyy_to_xyz,
    "luminance": cie.luminance,
    "linear_rgb_to_xyz": cie.linear_rgb_to_xyz,
    "rgb_to_ycbcr": ycbcr.rgb_to_ycbcr,
    "white_balance": lambda p: white_balance(p, (0.5, 1.0, 0.7)),
    "encode_srgb": srgb.encode_srgb,
    "decode_srgb": srgb.decode_srgb,
    "mosaic": demosaicing.mosaic,
}
OF_PLANES: dict[str, Model] = {
    "coarsen": lambda p: coarsen(p, (2, 2)),
    **{f"refine-{m}": lambda p, m=m: refine(p[:3, :4], (2, 2), p, m) for m in FILLINGS},
    **{f"parts-{m}": lambda p, m=m: np.array(parts(m, SATIN, p, p, p)) for m in MODELS},
    "blend_cells": lambda p: blend_cells(p, 9, 9),
    "bspline": bspline.coefficients,
    **{f"sample-{k}": lambda p, k=k: resampling.sample(p, PLACES, k) for k in resampling.KERNELS},
    "resize": lambda p: resampling.resize(p, 3, 3),
    **{
        f"demosaic-{m}": lambda p, m=m: demosaicing.demosaic(p, "RGGB", m)
        for m in demosaicing.METHODS
    },
    "read_out": lambda p: photon_counting.read_out(p, photon_counting.Sensor(), rng()),
    "shot_noise_from_normal": lambda p: photon_counting.shot_noise_from_normal(p, p, 1000.0),
    **{
        f"shot_noise-{m}": lambda p, m=m: photon_counting.shot_noise(p, rng(), 1000.0, m)
        for m in photon_counting.SHOT_MODELS
    },
}
CASES = {
    **{name: (model, (6, 8, 3)) for name, model in OF_COLOURS.items()},
    **{name: (model, (6, 8)) for name, model in OF_PLANES.items()},
}
FLOATS_ALONE = {"mosaic", "bspline"}
"""The one keeps any type of pixel, the other is given what `resampling` has made ready."""


def picture(shape: tuple[int, ...], dtype: DTypeLike) -> Floats:
    """Values around 0.5, which may not be written to."""
    values: Floats = rng().uniform(0.2, 0.8, shape).astype(dtype)
    values.setflags(write=False)
    return values


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("name", CASES)
def test_pictures_keep_their_precision(name: str, dtype: DTypeLike) -> None:
    model, shape = CASES[name]
    assert model(picture(shape, dtype)).dtype == dtype


@pytest.mark.parametrize("name", sorted(CASES.keys() - FLOATS_ALONE))
def test_whole_numbers_become_double(name: str) -> None:
    model, shape = CASES[name]
    codes: Any = np.ones(shape, np.uint8)
    found = model(codes)
    assert found.dtype == np.float64
    np.testing.assert_array_equal(found, model(codes.astype(float)))
