"""Every model of pixels keeps the precision of its picture and never writes to it."""

from collections.abc import Callable, Iterable
from functools import partial
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
from simulations.models.sensor.photon_counting import SHOT_MODELS, shot_noise

type Model = Callable[[Floats], Floats]
PLACES = np.array([[1.3, 2.6], [0.2, 0.4]])
LAMP_XY = chromaticity.ILLUMINANT_A_XY
SATIN = Material(0.5, 0.3, 0.4)


def rng() -> np.random.Generator:
    return np.random.default_rng(7)


def for_each(
    name: str, kinds: Iterable[str], run: Callable[[Any, Floats], Floats]
) -> dict[str, Model]:
    """The same call for each kind of a model."""
    return {f"{name}-{kind}": partial(run, kind) for kind in kinds}


OF_COLOURS: dict[str, Model] = {
    "adapt": lambda p: chromatic_adaptation.adapt(p, D65_XY, LAMP_XY),
    "xyz_to_xyy": chromaticity.xyz_to_xyy,
    "luminance": cie.luminance,
    "xyz_to_linear_rgb": cie.xyz_to_linear_rgb,
    "rgb_to_ycbcr": ycbcr.rgb_to_ycbcr,
    "white_balance": lambda p: white_balance(p, (0.5, 1.0, 0.7)),
    "encode_srgb": srgb.encode_srgb,
    "decode_srgb": srgb.decode_srgb,
    "mosaic": demosaicing.mosaic,
}
OF_PLANES: dict[str, Model] = {
    "coarsen": lambda p: coarsen(p, (2, 2)),
    **for_each("refine", FILLINGS, lambda m, p: refine(p[:3, :4], (2, 2), p, m)),
    **for_each("parts", MODELS, lambda m, p: np.array(parts(m, SATIN, p, p, p))),
    "blend_cells": lambda p: blend_cells(p, 9, 9),
    "bspline": bspline.coefficients,
    **for_each("sample", resampling.KERNELS, lambda k, p: resampling.sample(p, PLACES, k)),
    "resize": lambda p: resampling.resize(p, 3, 3),
    **for_each("demosaic", demosaicing.METHODS, lambda m, p: demosaicing.demosaic(p, "RGGB", m)),
    "read_out": lambda p: photon_counting.read_out(p, photon_counting.Sensor(), rng()),
    "shot_noise_from_normal": lambda p: photon_counting.shot_noise_from_normal(p, p, 1000.0),
    **for_each("shot_noise", SHOT_MODELS, lambda m, p: shot_noise(p, rng(), 1000.0, m)),
}
CASES = {
    **{name: (model, (6, 8, 3)) for name, model in OF_COLOURS.items()},
    **{name: (model, (6, 8)) for name, model in OF_PLANES.items()},
}
FLOATS_ALONE = {"mosaic", "bspline"}
"""`mosaic` keeps any type of pixel, and `bspline` gets only floats from `resampling`."""


def picture(shape: tuple[int, ...], dtype: DTypeLike) -> Floats:
    """A read-only picture with values around 0.5."""
    values: Floats = rng().uniform(0.2, 0.8, shape).astype(dtype)
    values.setflags(write=False)
    return values


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("name", CASES)
def test_pictures_keep_their_precision(name: str, dtype: DTypeLike) -> None:
    model, shape = CASES[name]
    assert model(picture(shape, dtype)).dtype == dtype


@pytest.mark.parametrize("name", sorted(CASES.keys() - FLOATS_ALONE))
def test_whole_numbers_become_double_precision(name: str) -> None:
    model, shape = CASES[name]
    codes: Any = np.ones(shape, np.uint8)
    found = model(codes)
    assert found.dtype == np.float64
    np.testing.assert_array_equal(found, model(codes.astype(float)))
