"""Colour conversions against scikit-image and the numbers of the standards."""

from collections.abc import Callable

import numpy as np
import pytest
import skimage.color
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.color import srgb

RGB = np.random.default_rng(4).random((500, 3))


def test_linear_0_693_is_code_217() -> None:
    assert round(255 * float(srgb.encode_srgb(0.693))) == 217


@given(st.floats(-2, 2))
def test_decoding_undoes_encoding(linear: float) -> None:
    assert srgb.decode_srgb(srgb.encode_srgb(linear)) == pytest.approx(linear, abs=1e-12)


def test_the_table_is_within_half_an_entry_of_the_steepest_part() -> None:
    light = np.linspace(0, 1, 200_001)
    off = 255 * np.abs(srgb.encode_srgb_table(light) - srgb.encode_srgb(light))
    assert off.max() < 255 * 12.92 * 0.5 / 65535 + 1e-4


def test_the_table_takes_nan_as_black_and_clips() -> None:
    wild = np.array([np.nan, -1, np.inf])
    np.testing.assert_array_equal(srgb.encode_srgb_table(wild), [0, 0, 1])
    np.testing.assert_array_equal(wild, [np.nan, -1, np.inf], "what was given stays as it was")
    assert srgb.encode_srgb_table(np.nan) == 0
    assert srgb.encode_srgb_table(np.empty((0, 3))).shape == (0, 3)


def test_gamma_2_2_is_up_to_8_5_codes_off() -> None:
    light = np.linspace(0, 1, 100_001)
    off = 255 * np.abs(srgb.encode_gamma(light) - srgb.encode_srgb(light)).max()
    assert off == pytest.approx(8.5, abs=0.2)


def test_xyz_matrix_has_the_published_entries() -> None:
    published = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    np.testing.assert_allclose(srgb.rgb_to_xyz_matrix(), published, atol=1e-4)


def test_xyz_comes_back() -> None:
    there = srgb.linear_rgb_to_xyz(RGB)
    np.testing.assert_allclose(srgb.xyz_to_linear_rgb(there), RGB, atol=1e-12)


def test_lab_agrees_with_scikit_image() -> None:
    theirs = skimage.color.rgb2lab(RGB[None])[0]
    ours = srgb.linear_rgb_to_lab(srgb.decode_srgb(RGB))
    np.testing.assert_allclose(ours, theirs, atol=0.02)


def test_ycbcr_of_grey_has_no_colour_and_comes_back() -> None:
    np.testing.assert_allclose(srgb.rgb_to_ycbcr([0.4, 0.4, 0.4]), [0.4, 0, 0], atol=1e-15)
    np.testing.assert_allclose(srgb.ycbcr_to_rgb(srgb.rgb_to_ycbcr(RGB)), RGB, atol=1e-12)


def test_white_balance_makes_the_light_grey() -> None:
    lamp = np.array([1.0, 0.7, 0.4])
    np.testing.assert_allclose(srgb.white_balance(0.5 * lamp, lamp), [0.35] * 3)
    with pytest.raises(ValueError, match="illuminant"):
        srgb.white_balance(lamp, [1, 1, 0])


@pytest.mark.parametrize(
    ("linear", "encoded"),
    [(0.001, 0.01292), (0.0031, 0.040052), (0.18, 0.461356), (0.5, 0.735357), (1.0, 1.0)],
)
def test_the_curve_has_the_values_of_the_standard(linear: float, encoded: float) -> None:
    assert srgb.encode_srgb([linear, -linear]) == pytest.approx([encoded, -encoded], abs=1e-6)
    assert srgb.decode_srgb([encoded, -encoded]) == pytest.approx([linear, -linear], abs=1e-6)


def test_the_curve_does_not_break_where_its_pieces_meet() -> None:
    """The line ends at 0.0031308; the standard's two pieces differ there by 3e-8 at most."""
    around = np.array([0.0031308 * (1 - 1e-9), 0.0031308 * (1 + 1e-9)])
    assert np.diff(srgb.encode_srgb(around))[0] == pytest.approx(0, abs=3e-8)
    assert np.diff(srgb.decode_srgb(np.array([0.04045, 0.04045 + 1e-9]))) == pytest.approx(
        0, abs=1e-8
    )


def test_dark_and_bright_colours_of_lab_agree_with_scikit_image() -> None:
    dark = RGB * 0.08
    theirs = skimage.color.rgb2lab(dark[None])[0]
    np.testing.assert_allclose(srgb.linear_rgb_to_lab(srgb.decode_srgb(dark)), theirs, atol=0.02)
    np.testing.assert_allclose(srgb.linear_rgb_to_lab([1.0, 1, 1]), [100, 0, 0], atol=1e-10)


def test_lightness_starts_as_a_line_of_slope_903() -> None:
    """CIE 15: L* = (29/3)³ Y up to Y = (6/29)³, and 116 Y^⅓ − 16 from there on."""
    white = srgb.linear_rgb_to_xyz([1.0, 1, 1])
    end = (6 / 29) ** 3
    for y in (-0.01, 0.0, 0.5 * end, end):
        assert srgb.xyz_to_lab(y * white)[0] == pytest.approx((29 / 3) ** 3 * y, abs=1e-9)
    assert srgb.xyz_to_lab(1.1 * end * white)[0] == pytest.approx(116 * (1.1 * end) ** (1 / 3) - 16)
    assert srgb.xyz_to_lab(0.9 * end * white)[0] == pytest.approx((29 / 3) ** 3 * 0.9 * end)


def test_luminance_is_the_y_of_xyz() -> None:
    picture = RGB.reshape(20, 25, 3)
    np.testing.assert_allclose(srgb.luminance(picture), srgb.linear_rgb_to_xyz(picture)[..., 1])
    assert srgb.luminance([0.0, 1.0, 0.0]) == pytest.approx(0.7152, abs=1e-4)


def test_luma_and_differences_of_the_primaries_are_those_of_jfif() -> None:
    primaries = srgb.rgb_to_ycbcr(np.eye(3))
    expected = [
        [0.299, -0.168736, 0.5],
        [0.587, -0.331264, -0.418688],
        [0.114, 0.5, -0.081312],
    ]
    np.testing.assert_allclose(primaries, expected, atol=1e-6)


def test_gamma_is_a_plain_power_and_negative_light_is_none() -> None:
    np.testing.assert_allclose(srgb.encode_gamma([0.25, -0.3], 2.0), [0.5, 0.0])
    assert srgb.encode_gamma(0.5) == pytest.approx(0.5 ** (1 / 2.2))
    for gamma in (0.0, -1.0, np.inf, np.nan):
        with pytest.raises(ValueError, match="gamma"):
            srgb.encode_gamma(0.5, gamma)


def test_primaries_on_one_line_have_no_matrix() -> None:
    with pytest.raises(ValueError, match="triangle"):
        srgb.rgb_to_xyz_matrix(((0.2, 0.2), (0.3, 0.3), (0.4, 0.4)))


def test_other_primaries_and_another_white_keep_their_promise() -> None:
    """Adobe RGB (1998), annex B."""
    adobe = srgb.rgb_to_xyz_matrix(((0.64, 0.33), (0.21, 0.71), (0.15, 0.06)))
    published = [
        [0.57667, 0.18556, 0.18823],
        [0.29734, 0.62736, 0.07529],
        [0.02703, 0.07069, 0.99134],
    ]
    np.testing.assert_allclose(adobe, published, atol=1e-4)
    equal_energy = srgb.rgb_to_xyz_matrix(white_xy=(1 / 3, 1 / 3))
    np.testing.assert_allclose(equal_energy.sum(axis=1), [1, 1, 1])


def test_grey_world_takes_the_mean_of_each_channel() -> None:
    picture = np.arange(4 * 6 * 3.0).reshape(4, 6, 3)
    np.testing.assert_allclose(srgb.grey_world(picture), [34.5, 35.5, 36.5])


@pytest.mark.parametrize(
    "light", [[1.0, -0.5, 1], [1, np.nan, 1], [1, 1, np.inf], [1, 1], [[1] * 3]]
)
def test_what_is_no_light_is_refused(light: ArrayLike) -> None:
    with pytest.raises(ValueError, match="illuminant"):
        srgb.white_balance([0.5, 0.5, 0.5], light)


@pytest.mark.parametrize("shape", [(4,), (3, 4), ()])
def test_what_is_no_colour_is_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match=r"legal: \(\.\.\., 3\)"):
        srgb.linear_rgb_to_xyz(np.zeros(shape))


def test_single_precision_stays_and_whole_numbers_become_double() -> None:
    assert srgb.decode_srgb(np.array([0.1], np.float32)).dtype == np.float32
    assert srgb.luminance(np.array([0.1, 0.2, 0.3], np.float32)).dtype == np.float32
    assert srgb.encode_srgb([1]).dtype == np.float64


def test_the_ends_of_the_straight_piece_belong_to_it_and_what_is_beyond_to_the_curve() -> None:
    assert srgb.encode_srgb(0.0031308) == 12.92 * 0.0031308
    assert srgb.decode_srgb(0.04045) == 0.04045 / 12.92
    assert srgb.decode_srgb(0.042) == pytest.approx(((0.042 + 0.055) / 1.055) ** 2.4, rel=1e-14)


def test_the_table_takes_the_nearest_of_its_entries() -> None:
    """Entry k stands for light k/65535; halfway to the next, that one begins."""
    for k in (0, 1, 700, 65534):
        entry = np.float32(srgb.encode_srgb(k / 65535))
        assert srgb.encode_srgb_table((k + 0.49) / 65535) == entry
        assert srgb.encode_srgb_table((k + 0.51) / 65535) > entry


def test_a_gamma_below_one_brightens_as_well_as_any() -> None:
    np.testing.assert_allclose(srgb.encode_gamma([0.25, 0.5], 0.5), [0.0625, 0.25])


def test_primaries_may_be_given_in_any_order_and_lie_close_together() -> None:
    red, green, blue = srgb.SRGB_PRIMARIES_XY
    swapped = srgb.rgb_to_xyz_matrix((green, red, blue))
    np.testing.assert_allclose(swapped[:, [1, 0, 2]], srgb.rgb_to_xyz_matrix(), rtol=1e-12)
    close = srgb.rgb_to_xyz_matrix(((0.3, 0.3), (0.3001, 0.3), (0.3, 0.3001)), (0.30003, 0.30003))
    assert close.sum(axis=1)[1] == pytest.approx(1)


@pytest.mark.parametrize("white", [(0.3, 0.0), (0.0, 0.3), (-0.3, 0.3), (0.7, 0.4), (0.3, np.nan)])
def test_lightness_is_measured_against_a_white_that_there_is(white: tuple[float, float]) -> None:
    with pytest.raises(ValueError, match=r"(white|chromaticity) \[.*legal: x, y"):
        srgb.xyz_to_lab([0.1, 0.2, 0.3], white)


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
        srgb.rgb_to_xyz_matrix(primaries)


def test_a_primary_may_lie_beyond_all_colours() -> None:
    """ACES AP0 (SMPTE ST 2065-1): its blue has a negative y. The matrix is printed there."""
    primaries = ((0.7347, 0.2653), (0.0, 1.0), (0.0001, -0.077))
    published = [
        [0.9525523959, 0.0, 0.0000936786],
        [0.3439664498, 0.7281660966, -0.0721325464],
        [0.0, 0.0, 1.0088251844],
    ]
    matrix = srgb.rgb_to_xyz_matrix(primaries, (0.32168, 0.33767))
    np.testing.assert_allclose(matrix, published, atol=1e-9)


@pytest.mark.parametrize(
    "function",
    [
        srgb.grey_world,
        srgb.luminance,
        srgb.xyz_to_lab,
        lambda rgb: srgb.white_balance(rgb, (1.0, 1.0, 1.0)),
    ],
)
def test_three_channels_are_asked_for_and_no_alpha(function: Callable[[Floats], object]) -> None:
    for shape in ((5, 5, 4), (5, 1)):
        with pytest.raises(ValueError, match=r"legal: \(\.\.\., 3\)"):
            function(np.ones(shape))


def test_a_picture_without_pixels_has_no_mean_colour_and_a_glaring_one_an_infinite_one() -> None:
    with pytest.raises(ValueError, match="one pixel or more"):
        srgb.grey_world(np.ones((0, 3)))
    assert (srgb.grey_world(np.full((9, 3), 1e308)) == np.inf).all()


def test_the_widest_of_all_displays_has_a_blue_of_hardly_any_light() -> None:
    """ROMM RGB, ISO 22028-2, whose blue has y = 0.0001; the matrix as B. Lindbloom tabulates it."""
    primaries = [(0.7347, 0.2653), (0.1596, 0.8404), (0.0366, 0.0001)]
    expected = [[0.7977, 0.1352, 0.0314], [0.2880, 0.7119, 0.0001], [0.0, 0.0, 0.8252]]
    found = srgb.rgb_to_xyz_matrix(primaries, (0.3457, 0.3585))
    np.testing.assert_allclose(found, expected, atol=3e-4)
