"""CIE's colour spaces against scikit-image and the numbers of the standards."""

from collections.abc import Callable

import numpy as np
import pytest
import skimage.color
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.color import cie, srgb

RGB = np.random.default_rng(4).random((500, 3))


def test_xyz_matrix_has_the_published_entries() -> None:
    published = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    np.testing.assert_allclose(cie.rgb_to_xyz_matrix(), published, atol=1e-4)


def test_xyz_comes_back() -> None:
    there = cie.linear_rgb_to_xyz(RGB)
    np.testing.assert_allclose(cie.xyz_to_linear_rgb(there), RGB, atol=1e-12)


@pytest.mark.parametrize("scale", [1.0, 0.08])
def test_lab_agrees_with_scikit_image(scale: float) -> None:
    theirs = skimage.color.rgb2lab(scale * RGB[None])[0]
    ours = cie.linear_rgb_to_lab(srgb.decode_srgb(scale * RGB))
    np.testing.assert_allclose(ours, theirs, atol=0.02)
    np.testing.assert_allclose(cie.linear_rgb_to_lab([1.0, 1, 1]), [100, 0, 0], atol=1e-10)


def test_lightness_starts_as_a_line_of_slope_903() -> None:
    """CIE 15: L* = (29/3)³ Y up to Y = (6/29)³, and 116 Y^⅓ − 16 from there on."""
    white = cie.linear_rgb_to_xyz([1.0, 1, 1])
    end = (6 / 29) ** 3
    for y in (-0.01, 0.0, 0.5 * end, end):
        assert cie.xyz_to_lab(y * white)[0] == pytest.approx((29 / 3) ** 3 * y, abs=1e-9)
    assert cie.xyz_to_lab(1.1 * end * white)[0] == pytest.approx(116 * (1.1 * end) ** (1 / 3) - 16)
    assert cie.xyz_to_lab(0.9 * end * white)[0] == pytest.approx((29 / 3) ** 3 * 0.9 * end)


def test_luminance_is_the_y_of_xyz() -> None:
    picture = RGB.reshape(20, 25, 3)
    np.testing.assert_allclose(cie.luminance(picture), cie.linear_rgb_to_xyz(picture)[..., 1])
    assert cie.luminance([0.0, 1.0, 0.0]) == pytest.approx(0.7152, abs=1e-4)


def test_primaries_on_one_line_have_no_matrix() -> None:
    with pytest.raises(ValueError, match="triangle"):
        cie.rgb_to_xyz_matrix(((0.2, 0.2), (0.3, 0.3), (0.4, 0.4)))


def test_other_primaries_and_another_white_keep_their_promise() -> None:
    """Adobe RGB (1998), annex B."""
    adobe = cie.rgb_to_xyz_matrix(((0.64, 0.33), (0.21, 0.71), (0.15, 0.06)))
    published = [
        [0.57667, 0.18556, 0.18823],
        [0.29734, 0.62736, 0.07529],
        [0.02703, 0.07069, 0.99134],
    ]
    np.testing.assert_allclose(adobe, published, atol=1e-4)
    equal_energy = cie.rgb_to_xyz_matrix(white_xy=(1 / 3, 1 / 3))
    np.testing.assert_allclose(equal_energy.sum(axis=1), [1, 1, 1])


def test_primaries_may_be_given_in_any_order_and_lie_close_together() -> None:
    red, green, blue = cie.SRGB_PRIMARIES_XY
    swapped = cie.rgb_to_xyz_matrix((green, red, blue))
    np.testing.assert_allclose(swapped[:, [1, 0, 2]], cie.rgb_to_xyz_matrix(), rtol=1e-12)
    close = cie.rgb_to_xyz_matrix(((0.3, 0.3), (0.3001, 0.3), (0.3, 0.3001)), (0.30003, 0.30003))
    assert close.sum(axis=1)[1] == pytest.approx(1)


@pytest.mark.parametrize("white", [(0.3, 0.0), (0.0, 0.3), (-0.3, 0.3), (0.7, 0.4), (0.3, np.nan)])
def test_lightness_is_measured_against_a_white_that_there_is(white: tuple[float, float]) -> None:
    with pytest.raises(ValueError, match=r"(white|chromaticity) \[.*legal: x, y"):
        cie.xyz_to_lab([0.1, 0.2, 0.3], white)


@pytest.mark.parametrize(
    ("primaries", "message"),
    [
        (((0.6, 0.3), (0.3, 0.6), (0.1, 0.0)), r"\[0.1, 0.0\]; legal: x, y finite, y not 0"),
        (((0.6, 0.3), (0.3, 0.6), (np.nan, 0.1)), "y not 0"),
        (((0.6, 0.3), (0.3, 0.6)), r"shape \(2, 2\); legal: \(3, 2\)"),
    ],
)
def test_primaries_without_luminance_are_refused(primaries: ArrayLike, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        cie.rgb_to_xyz_matrix(primaries)


def test_a_primary_may_lie_beyond_all_colours() -> None:
    """ACES AP0 (SMPTE ST 2065-1): its blue has a negative y. The matrix is printed there."""
    primaries = ((0.7347, 0.2653), (0.0, 1.0), (0.0001, -0.077))
    published = [
        [0.9525523959, 0.0, 0.0000936786],
        [0.3439664498, 0.7281660966, -0.0721325464],
        [0.0, 0.0, 1.0088251844],
    ]
    matrix = cie.rgb_to_xyz_matrix(primaries, (0.32168, 0.33767))
    np.testing.assert_allclose(matrix, published, atol=1e-9)


def test_the_widest_of_all_displays_has_a_blue_of_hardly_any_light() -> None:
    """ROMM RGB, ISO 22028-2, whose blue has y = 0.0001; the matrix as B. Lindbloom tabulates it."""
    primaries = [(0.7347, 0.2653), (0.1596, 0.8404), (0.0366, 0.0001)]
    expected = [[0.7977, 0.1352, 0.0314], [0.2880, 0.7119, 0.0001], [0.0, 0.0, 0.8252]]
    found = cie.rgb_to_xyz_matrix(primaries, (0.3457, 0.3585))
    np.testing.assert_allclose(found, expected, atol=3e-4)


def test_single_precision_stays() -> None:
    colour = np.array([0.1, 0.2, 0.3], np.float32)
    assert cie.luminance(colour).dtype == np.float32
    assert cie.linear_rgb_to_xyz(colour).dtype == np.float32


@pytest.mark.parametrize("function", [cie.linear_rgb_to_xyz, cie.luminance, cie.xyz_to_lab])
def test_three_channels_are_asked_for_and_no_alpha(function: Callable[[Floats], object]) -> None:
    for shape in ((4,), (3, 4), (), (5, 5, 4), (5, 1)):
        with pytest.raises(ValueError, match=r"legal: \(\.\.\., 3\)"):
            function(np.ones(shape))
