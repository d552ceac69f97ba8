"""Demosaicing against colour_demosaicing, and what must hold of any method."""

import warnings
from collections.abc import Callable
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simulations.models.arrays import Floats
from simulations.models.sensor.bayer import filter_colours, red_position, through_filters
from simulations.models.sensor.demosaicing import METHODS, PATTERNS, demosaic, mosaic

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # the oracle warns that it cannot plot
    import colour
    import colour_demosaicing as oracle


def menon_on_encoded_values(cfa: Floats, pattern: str) -> Floats:
    encoded = colour.cctf_encoding(cfa, "sRGB")
    guessed = oracle.demosaicing_CFA_Bayer_Menon2007(encoded, pattern, refining_step=False)
    return colour.cctf_decoding(guessed, "sRGB")


ORACLES: dict[str, Callable[[Floats, str], Floats]] = {
    "bilinear": oracle.demosaicing_CFA_Bayer_bilinear,
    "malvar": oracle.demosaicing_CFA_Bayer_Malvar2004,
    "menon-unrefined": partial(oracle.demosaicing_CFA_Bayer_Menon2007, refining_step=False),
    "menon": oracle.demosaicing_CFA_Bayer_Menon2007,
    "menon-encoded": menon_on_encoded_values,
}
BORDER = {"bilinear": 1, "malvar": 2, "menon-unrefined": 6, "menon": 6, "menon-encoded": 6}
"""Pixels at the border where conventions differ."""


@pytest.mark.parametrize("pattern", PATTERNS)
@pytest.mark.parametrize("method", ORACLES)
def test_interior_equals_the_published_method(pattern: str, method: str) -> None:
    cfa = mosaic(np.random.default_rng(1).random((40, 31, 3)), pattern)
    inner = (slice(BORDER[method], -BORDER[method]),) * 2
    ours, theirs = demosaic(cfa, pattern, method), ORACLES[method](cfa, pattern)
    if method == "menon-encoded":  # the oracle continues the toe below 0, where we mirror it
        ours, theirs = np.maximum(ours, 0), np.maximum(theirs, 0)
    np.testing.assert_allclose(ours[inner], theirs[inner], atol=1e-12)


@pytest.mark.parametrize("method", ["menon-unrefined", "menon"])
def test_where_rows_and_columns_are_equally_calm_menon_keeps_the_rows(method: str) -> None:
    """Small whole numbers tie often, and are summed without rounding."""
    cfa = np.random.default_rng(7).integers(0, 3, (60, 64)).astype(float)
    theirs = ORACLES[method](cfa, "RGGB")
    np.testing.assert_allclose(
        demosaic(cfa, "RGGB", method)[6:-6, 6:-6], theirs[6:-6, 6:-6], atol=1e-12
    )


@pytest.mark.parametrize("method", METHODS)
@given(
    shape=st.tuples(st.integers(2, 9), st.integers(2, 9)),
    pattern=st.sampled_from(PATTERNS),
    colour=st.tuples(*[st.floats(0, 1)] * 3),
)
@settings(max_examples=30, deadline=None)
def test_flat_colour_survives_up_to_the_border(
    method: str, shape: tuple[int, int], pattern: str, colour: tuple[float, float, float]
) -> None:
    flat = np.broadcast_to(np.array(colour), (*shape, 3))
    off = np.abs(demosaic(mosaic(flat, pattern), pattern, method) - flat).max()
    assert off <= (0 if method in ("nearest", "bilinear", "malvar") else 1e-14)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("pattern", PATTERNS)
def test_measured_values_are_kept(method: str, pattern: str) -> None:
    cfa = mosaic(np.random.default_rng(2).random((17, 20, 3)), pattern)
    np.testing.assert_array_equal(mosaic(demosaic(cfa, pattern, method), pattern), cfa)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("shape", [(1, 1), (1, 2), (2, 1), (1, 7), (8, 1)])
def test_a_line_of_grey_stays_grey(method: str, shape: tuple[int, int]) -> None:
    np.testing.assert_allclose(demosaic(np.full(shape, 0.3), "GRBG", method), 0.3, atol=1e-15)


@pytest.mark.parametrize("pattern", PATTERNS)
def test_each_pixel_has_the_filter_that_the_pattern_names(pattern: str) -> None:
    expected = [["RGB".index(pattern[2 * (y % 2) + x % 2]) for x in range(7)] for y in range(5)]
    assert filter_colours(5, 7, pattern).tolist() == expected
    assert filter_colours(1, 1, pattern).tolist() == [expected[0][:1]]
    assert expected[red_position(pattern)[0]][red_position(pattern)[1]] == 0


@pytest.mark.parametrize("pattern", PATTERNS)
def test_through_the_filters_only_the_measured_colour_is_seen(pattern: str) -> None:
    picture = np.random.default_rng(4).uniform(0.1, 1, (5, 7, 3))
    mask = filter_colours(5, 7, pattern)[..., None] == np.arange(3)
    seen = through_filters(mosaic(picture, pattern), pattern)
    np.testing.assert_array_equal(seen, np.where(mask, picture, 0))


def test_red_first_is_the_default() -> None:
    picture = np.random.default_rng(5).random((4, 6, 3))
    cfa = mosaic(picture)
    np.testing.assert_array_equal(cfa, mosaic(picture, "RGGB"))
    np.testing.assert_array_equal(through_filters(cfa), through_filters(cfa, "RGGB"))
    np.testing.assert_array_equal(demosaic(cfa), demosaic(cfa, "RGGB", "bilinear"))


def test_nearest_copies_from_within_the_quad() -> None:
    cfa = np.array([[1.0, 2, 5, 6], [3, 4, 7, 8]])
    result = demosaic(cfa, "RGGB", "nearest")
    np.testing.assert_array_equal(result[..., 0], [[1, 1, 5, 5], [1, 1, 5, 5]])
    np.testing.assert_array_equal(result[..., 1], [[2, 2, 6, 6], [3, 3, 7, 7]])
    np.testing.assert_array_equal(result[..., 2], [[4, 4, 8, 8], [4, 4, 8, 8]])


def test_a_line_copies_the_nearest_sample_and_greys_what_it_lacks() -> None:
    column = np.array([[0.8], [0.1], [0.6], [0.3], [0.2]])  # green and blue by turns
    result = demosaic(column, "GRBG", "nearest")[:, 0]
    np.testing.assert_allclose(result[:, 1], [0.8, 0.8, 0.6, 0.6, 0.2])
    np.testing.assert_allclose(result[:, 2], [0.1, 0.1, 0.1, 0.3, 0.3])
    np.testing.assert_allclose(result[:, 0], result[:, 1:].mean(axis=1))
