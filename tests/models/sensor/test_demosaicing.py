"""Demosaicing and camera colours against published methods and measurements."""

import warnings
from collections.abc import Callable
from functools import partial

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.stats import pearsonr
from support.oracle_spectra import on_grid
from support.oracle_spectra import oracle as measurements

from simulations.models.arrays import Floats
from simulations.models.color.illuminants import D65_K, daylight, planck
from simulations.models.color.observer import tristimulus
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.models.color.surfaces import CHART, chart_patch
from simulations.models.sensor.bayer import filter_colours, red_position
from simulations.models.sensor.camera_colour import camera_curves, exposed, fit_colour_matrix
from simulations.models.sensor.demosaicing import METHODS, PATTERNS, demosaic, mosaic
from simulations.models.sensor.resolution import pixel_transfer, plate_transfer
from simulations.models.sensor.shared_detail import shared_detail

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
def test_interior_agrees_with_the_published_method(pattern: str, method: str) -> None:
    cfa = mosaic(np.random.default_rng(1).random((40, 31, 3)), pattern)
    inner = (slice(BORDER[method], -BORDER[method]),) * 2
    ours, theirs = demosaic(cfa, pattern, method), ORACLES[method](cfa, pattern)
    if method == "menon-encoded":  # the oracle extends the toe below 0, and we mirror it
        ours, theirs = np.maximum(ours, 0), np.maximum(theirs, 0)
    np.testing.assert_allclose(ours[inner], theirs[inner], atol=1e-12)


@pytest.mark.parametrize("method", ["menon-unrefined", "menon"])
def test_menon_breaks_ties_like_the_published_method(method: str) -> None:
    """Small whole numbers tie often and are summed exactly."""
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
def test_flat_colour_is_restored_up_to_the_border(
    method: str, shape: tuple[int, int], pattern: str, colour: tuple[float, float, float]
) -> None:
    flat = np.broadcast_to(np.array(colour), (*shape, 3))
    off = np.abs(demosaic(mosaic(flat, pattern), pattern, method) - flat).max()
    assert off <= (0 if method in ("nearest", "bilinear", "malvar") else 1e-14)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("pattern", PATTERNS)
def test_demosaicing_keeps_the_measured_values(method: str, pattern: str) -> None:
    cfa = mosaic(np.random.default_rng(2).random((17, 20, 3)), pattern)
    np.testing.assert_array_equal(mosaic(demosaic(cfa, pattern, method), pattern), cfa)


@pytest.mark.parametrize("pattern", PATTERNS)
def test_each_pixel_has_the_filter_that_the_pattern_names(pattern: str) -> None:
    expected = [["RGB".index(pattern[2 * (y % 2) + x % 2]) for x in range(7)] for y in range(5)]
    assert filter_colours(5, 7, pattern).tolist() == expected
    assert filter_colours(1, 1, pattern).tolist() == [expected[0][:1]]
    assert expected[red_position(pattern)[0]][red_position(pattern)[1]] == 0


def test_single_column_copies_nearest_samples_and_greys_the_missing_colour() -> None:
    column = np.array([[0.8], [0.1], [0.6], [0.3], [0.2]])  # green and blue by turns
    result = demosaic(column, "GRBG", "nearest")[:, 0]
    np.testing.assert_allclose(result[:, 1], [0.8, 0.8, 0.6, 0.6, 0.2])
    np.testing.assert_allclose(result[:, 2], [0.1, 0.1, 0.1, 0.3, 0.3])
    np.testing.assert_allclose(result[:, 0], result[:, 1:].mean(axis=1))


D65 = daylight(D65_K)
CURVES = camera_curves(WAVELENGTHS_NM)
PATCHES = np.stack([chart_patch(name) for name in CHART])


def test_camera_curves_agree_with_measured_curves() -> None:
    measured = on_grid(measurements.MSDS_CAMERA_SENSITIVITIES["Nikon 5100 (NPL)"])
    off = CURVES - measured
    assert np.abs(off).max() < 0.05
    assert (np.sqrt(np.mean(off**2, axis=0)) < [0.021, 0.0137, 0.0071]).all()


def test_raw_value_is_the_sum_over_the_spectrum() -> None:
    light, patch = planck(3000.0), PATCHES[3]
    by_hand = [sum(light * patch * CURVES[:, k]) / sum(light * CURVES[:, 1]) for k in range(3)]
    np.testing.assert_allclose(exposed(patch * light, CURVES, light), by_hand)
    assert exposed(light, CURVES, light)[1] == pytest.approx(1)


def chart() -> tuple[Floats, Floats, Floats]:
    """Balanced raw values, XYZ, and the white's XYZ."""
    white = exposed(D65, CURVES, D65)
    balanced = exposed(PATCHES * D65, CURVES, D65) / white
    return balanced, tristimulus(PATCHES * D65, D65), tristimulus(D65, D65)


def test_fitted_colour_matrix_has_the_least_error_that_keeps_white() -> None:
    balanced, xyz, white = chart()

    def matrix_of(free: NDArray[np.float64]) -> NDArray[np.float64]:
        two = free.reshape(3, 2)
        return np.column_stack([two, white - two.sum(axis=1)])

    def error(free: NDArray[np.float64]) -> float:
        return float(np.sum((balanced @ matrix_of(free).T - xyz) ** 2))

    best = minimize(error, np.full(6, 0.3), tol=1e-14).x
    np.testing.assert_allclose(fit_colour_matrix(balanced, xyz, white), matrix_of(best), atol=1e-4)


def test_shared_detail_is_the_correlation_of_the_laplacians() -> None:
    picture = np.random.default_rng(0).random((30, 41, 3))
    picture[..., 0] += 0.7 * picture[..., 1]
    picture[..., 2] -= 0.2 * picture[..., 1]
    detail = cv2.Laplacian(picture, cv2.CV_64F, ksize=1)[1:-1, 1:-1].reshape(-1, 3).T
    expected = [pearsonr(detail[colour], detail[1])[0] for colour in (0, 2)]
    assert shared_detail(picture) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("frequency", [0, 30, 125, 250, 300, 410])
def test_pixel_transfer_is_the_mean_over_its_width(frequency: float) -> None:
    places_mm = (np.arange(20_000) + 0.5) / 20_000 * 0.004 - 0.002
    mean = np.cos(2 * np.pi * frequency * places_mm).mean()
    assert pixel_transfer(frequency, 4) == pytest.approx(mean, abs=1e-7)


@pytest.mark.parametrize("frequency", [0, 30, 125, 250])
def test_plate_transfer_is_the_mean_of_two_copies(frequency: float) -> None:
    mean = np.cos(2 * np.pi * frequency * np.array([-0.0015, 0.0015])).mean()
    assert plate_transfer(frequency, 3) == pytest.approx(mean, abs=1e-12)
