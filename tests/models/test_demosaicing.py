"""Demosaicing against colour_demosaicing, and what must hold of any method."""

import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simulations.models.demosaicing import METHODS, PATTERNS, demosaic, mosaic, psnr_db

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # the oracle warns that it cannot plot
    import colour_demosaicing as oracle

ORACLES = {
    "bilinear": oracle.demosaicing_CFA_Bayer_bilinear,
    "malvar": oracle.demosaicing_CFA_Bayer_Malvar2004,
    "menon": oracle.demosaicing_CFA_Bayer_Menon2007,
}
BORDER = {"bilinear": 1, "malvar": 2, "menon": 6}
"""Pixels at the border where conventions differ."""


@pytest.mark.parametrize("pattern", PATTERNS)
@pytest.mark.parametrize("method", ORACLES)
@pytest.mark.parametrize("shape", [(37, 42), (40, 31)])
def test_interior_equals_the_published_method(pattern, method, shape):
    cfa = mosaic(np.random.default_rng(1).random((*shape, 3)), pattern)
    inner = (slice(BORDER[method], -BORDER[method]),) * 2
    ours, theirs = demosaic(cfa, pattern, method), ORACLES[method](cfa, pattern)
    np.testing.assert_allclose(ours[inner], theirs[inner], atol=1e-12)


@pytest.mark.parametrize("method", METHODS)
@given(
    shape=st.tuples(st.integers(2, 9), st.integers(2, 9)),
    pattern=st.sampled_from(PATTERNS),
    colour=st.tuples(*[st.floats(0, 1)] * 3),
)
@settings(max_examples=30, deadline=None)
def test_flat_colour_survives_up_to_the_border(method, shape, pattern, colour):
    flat = np.broadcast_to(np.array(colour), (*shape, 3))
    np.testing.assert_allclose(demosaic(mosaic(flat, pattern), pattern, method), flat, atol=1e-14)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("pattern", PATTERNS)
def test_measured_values_are_kept(method, pattern):
    cfa = mosaic(np.random.default_rng(2).random((17, 20, 3)), pattern)
    np.testing.assert_array_equal(mosaic(demosaic(cfa, pattern, method), pattern), cfa)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("shape", [(1, 1), (1, 2), (2, 1), (1, 7), (8, 1)])
def test_a_line_of_grey_stays_grey(method, shape):
    np.testing.assert_allclose(demosaic(np.full(shape, 0.3), "GRBG", method), 0.3, atol=1e-15)


def test_a_row_is_interpolated_along_itself():
    rgb = demosaic(np.array([[0.0, 0.1, 0.4, 0.3]]), "RGGB")
    np.testing.assert_allclose(rgb[0, :, 0], [0.0, 0.2, 0.4, 0.4])
    np.testing.assert_allclose(rgb[0, :, 1], [0.1, 0.1, 0.2, 0.3])


def test_bilinear_is_exact_on_a_ramp():
    y, x = np.mgrid[:20, :24].astype(float)
    ramp = np.stack([x + y, 2 * x - y, 3 * y], axis=-1)
    result = demosaic(mosaic(ramp), "RGGB", "bilinear")
    np.testing.assert_allclose(result[1:-1, 1:-1], ramp[1:-1, 1:-1], atol=1e-12)


def test_float32_stays_float32():
    cfa = np.random.default_rng(3).random((16, 16)).astype(np.float32)
    assert {demosaic(cfa, "RGGB", method).dtype for method in METHODS} == {np.dtype(np.float32)}


@pytest.mark.parametrize(
    ("cfa", "pattern", "method", "message"),
    [
        (np.zeros((0, 3)), "RGGB", "bilinear", r"\(0, 3\)"),
        (np.zeros((4, 4)), "RGBG", "bilinear", "RGBG"),
        (np.zeros((4, 4)), "RGGB", "magic", "magic"),
    ],
)
def test_what_cannot_be_demosaiced_is_refused_with_the_reason(cfa, pattern, method, message):
    with pytest.raises(ValueError, match=message):
        demosaic(cfa, pattern, method)


def test_psnr_of_an_error_of_one_code_is_48_decibel():
    picture = np.zeros((32, 32, 3))
    assert psnr_db(picture + 1 / 255, picture) == pytest.approx(48.1308, abs=1e-4)
    assert psnr_db(picture, picture) == np.inf
