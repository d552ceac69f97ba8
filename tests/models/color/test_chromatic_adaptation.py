"""Chromatic adaptation and chromaticities against colour-science."""

from collections.abc import Sequence

import numpy as np
import pytest
import skimage.color
from support.oracle_spectra import oracle

from simulations.models.color import cie, white_balance
from simulations.models.color.chromatic_adaptation import adapt, adaptation_matrix
from simulations.models.color.chromaticity import (
    ILLUMINANT_A_XY,
    lab_distance,
    white_xyz,
    xyz_to_xyy,
)
from simulations.models.color.cie import D65_XY

RNG = np.random.default_rng(0)
COLOURS = RNG.uniform(0.0, 1.0, (50, 3))


@pytest.mark.parametrize(
    ("method", "theirs"), [("bradford", "Bradford"), ("von-kries", "Von Kries")]
)
@pytest.mark.parametrize("lights", [(ILLUMINANT_A_XY, D65_XY), (D65_XY, ILLUMINANT_A_XY)])
def test_matrices_are_those_of_colour_science(
    method: str, theirs: str, lights: tuple[tuple[float, float], tuple[float, float]]
) -> None:
    whites = [oracle.xy_to_XYZ(xy) for xy in lights]
    expected = oracle.adaptation.matrix_chromatic_adaptation_VonKries(*whites, transform=theirs)
    np.testing.assert_allclose(adaptation_matrix(*lights, method), expected, atol=1e-12)


def test_gains_in_rgb_are_white_balance() -> None:
    linear = cie.xyz_to_linear_rgb(COLOURS)
    lamp = cie.xyz_to_linear_rgb(white_xyz(ILLUMINANT_A_XY))
    balanced = white_balance.white_balance(linear, lamp) / lamp[1]
    ours = cie.xyz_to_linear_rgb(adapt(COLOURS, ILLUMINANT_A_XY, D65_XY, "rgb"))
    np.testing.assert_allclose(ours, balanced, atol=1e-13)
    np.testing.assert_array_equal(
        adapt(COLOURS, D65_XY, ILLUMINANT_A_XY),
        adapt(COLOURS, D65_XY, ILLUMINANT_A_XY, "bradford"),
    )


def test_chromaticities_and_whites_are_those_of_colour_science() -> None:
    np.testing.assert_allclose(xyz_to_xyy(COLOURS), oracle.XYZ_to_xyY(COLOURS), rtol=1e-14)
    whites = oracle.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"]
    for name, xy in (("A", ILLUMINANT_A_XY), ("D65", D65_XY)):
        np.testing.assert_allclose(xy, whites[name], atol=5e-5)
        np.testing.assert_allclose(white_xyz(xy), oracle.xy_to_XYZ(xy), rtol=1e-14)


@pytest.mark.parametrize(
    ("xyz", "xy"),
    [
        ([0.2, 0.3, 0.5], [0.2, 0.3]),
        ([0.0, 0.5, 0.5], [0.0, 0.5]),
        ([1.0, -0.25, -0.25], [2.0, -0.5]),
        ([5e-324] * 3, [1 / 3, 1 / 3]),
        ([1e-310] * 3, [1 / 3, 1 / 3]),
        ([1.7e308] * 3, [1 / 3, 1 / 3]),
        ([np.nan, 1, 1], D65_XY),
        ([np.inf, 1, 1], D65_XY),
        ([1, -1, -1], D65_XY),
        ([-1.0, 1.0, 0.0], D65_XY),
        ([-1, -1, -1], D65_XY),
    ],
)
def test_every_colour_has_a_chromaticity_if_only_that_of_daylight(
    xyz: Sequence[float], xy: Sequence[float]
) -> None:
    np.testing.assert_allclose(xyz_to_xyy(xyz)[:2], xy, rtol=1e-15)


def test_lights_at_the_edge_of_all_chromaticities_have_a_white() -> None:
    np.testing.assert_allclose(white_xyz((0.0, 0.5)), [0.0, 1.0, 1.0])
    np.testing.assert_allclose(white_xyz((0.5, 0.5)), [1.0, 1.0, 0.0])
    np.testing.assert_allclose(white_xyz((0.1, 1e-5)), [1e4, 1.0, 89999.0], rtol=1e-10)


def test_a_light_with_hardly_a_response_is_still_a_light() -> None:
    """On the way from daylight to pure green, just before the short response is gone."""
    faint = 0.116308 * np.array(D65_XY) + (1 - 0.116308) * np.array([0.2, 0.8])
    matrix = adaptation_matrix(faint, D65_XY)
    np.testing.assert_allclose(matrix @ white_xyz(faint), white_xyz(D65_XY), rtol=1e-9)


def test_distances_are_those_of_scikit_image() -> None:
    labs = RNG.uniform(-50, 50, (2, 20, 3))
    np.testing.assert_allclose(lab_distance(*labs), skimage.color.deltaE_cie76(*labs))
