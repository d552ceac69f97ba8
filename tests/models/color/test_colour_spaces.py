"""Colour spaces against colour-science, scikit-image and the numbers of the standards."""

from collections.abc import Sequence

import numpy as np
import pytest
import skimage.color
from numpy.typing import ArrayLike
from support.oracle_spectra import oracle

from simulations.models.color import cie, srgb, ycbcr
from simulations.models.color.chromatic_adaptation import adapt, adaptation_matrix
from simulations.models.color.chromaticity import (
    ILLUMINANT_A_XY,
    lab_distance,
    white_xyz,
    xyz_to_xyy,
)
from simulations.models.color.cie import D65_XY
from simulations.models.color.white_balance import grey_world, white_balance


def test_lightness_starts_as_a_line_of_slope_903() -> None:
    """CIE 15: L* = (29/3)³ Y up to Y = (6/29)³, and 116 Y^⅓ − 16 from there on."""
    white = white_xyz(D65_XY)
    end = (6 / 29) ** 3
    for y in (-0.01, 0.0, 0.5 * end, 0.9 * end, end):
        assert cie.xyz_to_lab(y * white)[0] == pytest.approx((29 / 3) ** 3 * y, abs=1e-9)
    assert cie.xyz_to_lab(1.1 * end * white)[0] == pytest.approx(116 * (1.1 * end) ** (1 / 3) - 16)


SRGB = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
ADOBE = [[0.57667, 0.18556, 0.18823], [0.29734, 0.62736, 0.07529], [0.02703, 0.07069, 0.99134]]

ACES_AP0 = [
    [0.9525523959, 0.0, 0.0000936786],
    [0.3439664498, 0.7281660966, -0.0721325464],
    [0.0, 0.0, 1.0088251844],
]

ROMM = [[0.7977, 0.1352, 0.0314], [0.2880, 0.7119, 0.0001], [0.0, 0.0, 0.8252]]


@pytest.mark.parametrize(
    ("primaries", "white", "published", "digits"),
    [
        pytest.param(cie.SRGB_PRIMARIES_XY, cie.D65_XY, SRGB, 1e-4, id="sRGB"),
        pytest.param(
            ((0.64, 0.33), (0.21, 0.71), (0.15, 0.06)), cie.D65_XY, ADOBE, 1e-4, id="Adobe RGB"
        ),
        pytest.param(  # its blue has a negative y (SMPTE ST 2065-1)
            ((0.7347, 0.2653), (0.0, 1.0), (0.0001, -0.077)),
            (0.32168, 0.33767),
            ACES_AP0,
            1e-9,
            id="ACES AP0",
        ),
        pytest.param(  # its blue has y = 0.0001 (ISO 22028-2, as B. Lindbloom tabulates it)
            ((0.7347, 0.2653), (0.1596, 0.8404), (0.0366, 0.0001)),
            (0.3457, 0.3585),
            ROMM,
            3e-4,
            id="ROMM RGB",
        ),
    ],
)
def test_display_matrices_agree_with_the_published_ones(
    primaries: ArrayLike, white: ArrayLike, published: list[list[float]], digits: float
) -> None:
    np.testing.assert_allclose(cie.rgb_to_xyz_matrix(primaries, white), published, atol=digits)


def test_srgb_table_takes_nan_as_black_and_clips() -> None:
    wild = np.array([np.nan, -1, np.inf])
    np.testing.assert_array_equal(srgb.encode_srgb_table(wild), [0, 0, 1])
    np.testing.assert_array_equal(wild, [np.nan, -1, np.inf], "what was given stays as it was")
    assert srgb.encode_srgb_table(np.nan) == 0
    assert srgb.encode_srgb_table(np.empty((0, 3))).shape == (0, 3)
    np.testing.assert_array_equal(srgb.encode_srgb_codes(wild), [0, 0, 255])


def test_srgb_is_straight_up_to_its_threshold_and_curved_beyond() -> None:
    assert srgb.encode_srgb(0.0031308) == 12.92 * 0.0031308
    assert srgb.decode_srgb(0.04045) == 0.04045 / 12.92
    assert srgb.decode_srgb(0.042) == pytest.approx(((0.042 + 0.055) / 1.055) ** 2.4, rel=1e-14)


def test_srgb_table_takes_the_nearest_entry() -> None:
    """Entry k stands for light k/65535; halfway to the next entry the next begins."""
    for k in (0, 1, 700, 65534):
        entry = np.float32(srgb.encode_srgb(k / 65535))
        assert srgb.encode_srgb_table((k + 0.49) / 65535) == entry
        assert srgb.encode_srgb_table((k + 0.51) / 65535) > entry


def test_luma_and_chroma_of_the_primaries_agree_with_jfif() -> None:
    expected = [[0.299, -0.168736, 0.5], [0.587, -0.331264, -0.418688], [0.114, 0.5, -0.081312]]
    np.testing.assert_allclose(ycbcr.rgb_to_ycbcr(np.eye(3)), expected, atol=1e-6)
    np.testing.assert_allclose(ycbcr.ycbcr_to_rgb(expected), np.eye(3), atol=5e-6)


RNG = np.random.default_rng(0)
COLOURS = RNG.uniform(0.0, 1.0, (50, 3))


@pytest.mark.parametrize(
    ("method", "theirs"), [("bradford", "Bradford"), ("von-kries", "Von Kries")]
)
@pytest.mark.parametrize("lights", [(ILLUMINANT_A_XY, D65_XY), (D65_XY, ILLUMINANT_A_XY)])
def test_adaptation_matrices_agree_with_colour_science(
    method: str, theirs: str, lights: tuple[tuple[float, float], tuple[float, float]]
) -> None:
    whites = [oracle.xy_to_XYZ(xy) for xy in lights]
    expected = oracle.adaptation.matrix_chromatic_adaptation_VonKries(*whites, transform=theirs)
    np.testing.assert_allclose(adaptation_matrix(*lights, method), expected, atol=1e-12)


def test_adaptation_in_rgb_is_white_balance() -> None:
    linear = cie.xyz_to_linear_rgb(COLOURS)
    lamp = cie.xyz_to_linear_rgb(white_xyz(ILLUMINANT_A_XY))
    balanced = white_balance(linear, lamp) / lamp[1]
    ours = cie.xyz_to_linear_rgb(adapt(COLOURS, ILLUMINANT_A_XY, D65_XY, "rgb"))
    np.testing.assert_allclose(ours, balanced, atol=1e-13)
    np.testing.assert_array_equal(
        adapt(COLOURS, D65_XY, ILLUMINANT_A_XY), adapt(COLOURS, D65_XY, ILLUMINANT_A_XY, "bradford")
    )


def test_chromaticities_and_whites_agree_with_colour_science() -> None:
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
def test_colour_without_a_chromaticity_gets_that_of_daylight(
    xyz: Sequence[float], xy: Sequence[float]
) -> None:
    np.testing.assert_allclose(xyz_to_xyy(xyz)[:2], xy, rtol=1e-15)


def test_lab_distances_agree_with_scikit_image() -> None:
    labs = RNG.uniform(-50, 50, (2, 20, 3))
    np.testing.assert_allclose(lab_distance(*labs), skimage.color.deltaE_cie76(*labs))


def test_grey_world_is_the_mean_of_each_channel() -> None:
    picture = np.arange(4 * 6 * 3.0).reshape(4, 6, 3)
    np.testing.assert_allclose(grey_world(picture), [34.5, 35.5, 36.5])
    assert (grey_world(np.full((9, 3), 1e308)) == np.inf).all()
