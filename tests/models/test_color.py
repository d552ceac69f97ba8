"""Colour conversions against scikit-image and the numbers of the standards."""

import numpy as np
import pytest
import skimage.color
from hypothesis import given
from hypothesis import strategies as st

from simulations.models import color

RGB = np.random.default_rng(4).random((500, 3))


def test_linear_0_693_is_code_217():
    assert round(255 * float(color.encode_srgb(0.693))) == 217


@given(st.floats(-2, 2))
def test_decoding_undoes_encoding(linear):
    assert color.decode_srgb(color.encode_srgb(linear)) == pytest.approx(linear, abs=1e-12)


def test_the_table_is_within_a_tenth_of_a_code():
    light = np.linspace(0, 1, 200_001)
    off = 255 * np.abs(color.encode_srgb_table(light) - color.encode_srgb(light))
    assert off.max() < 0.1


def test_the_table_takes_nan_as_black_and_clips():
    np.testing.assert_allclose(color.encode_srgb_table([np.nan, -1, np.inf]), [0, 0, 1])


def test_gamma_2_2_is_up_to_8_5_codes_off():
    light = np.linspace(0, 1, 100_001)
    off = 255 * np.abs(color.encode_gamma(light) - color.encode_srgb(light)).max()
    assert off == pytest.approx(8.5, abs=0.2)


def test_xyz_matrix_has_the_published_entries():
    published = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    np.testing.assert_allclose(color.rgb_to_xyz_matrix(), published, atol=1e-4)


def test_xyz_comes_back():
    there = color.linear_rgb_to_xyz(RGB)
    np.testing.assert_allclose(color.xyz_to_linear_rgb(there), RGB, atol=1e-12)


def test_lab_agrees_with_scikit_image():
    theirs = skimage.color.rgb2lab(RGB[None])[0]
    ours = color.linear_rgb_to_lab(color.decode_srgb(RGB))
    np.testing.assert_allclose(ours, theirs, atol=0.02)


def test_ycbcr_of_grey_has_no_colour_and_comes_back():
    np.testing.assert_allclose(color.rgb_to_ycbcr([0.4, 0.4, 0.4]), [0.4, 0, 0], atol=1e-15)
    np.testing.assert_allclose(color.ycbcr_to_rgb(color.rgb_to_ycbcr(RGB)), RGB, atol=1e-12)


def test_white_balance_makes_the_light_grey():
    lamp = np.array([1.0, 0.7, 0.4])
    np.testing.assert_allclose(color.white_balance(0.5 * lamp, lamp), [0.35] * 3)
    with pytest.raises(ValueError, match="illuminant"):
        color.white_balance(lamp, [1, 1, 0])
