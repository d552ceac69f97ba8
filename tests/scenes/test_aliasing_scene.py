"""Aliasing: patterns and the reader's picture, filtered and sampled, against theory."""

from itertools import product

import numpy as np
import pytest
from scipy.integrate import quad
from support.frames import estimates_of, frame_of, number_of

from simulations.engine.photograph import Photograph
from simulations.engine.stages import StageCache
from simulations.models.color.srgb import encode_srgb
from simulations.models.sampling.aliasing import zone_plate
from simulations.models.sampling.prefilters import prefilter
from simulations.scenes.aliasing.drawing import alias_curve
from simulations.scenes.aliasing.light import (
    SHOWN,
    ideal,
    pattern_of,
    photograph_light,
    sample_photograph,
)
from simulations.scenes.aliasing.scene import FILTERS, SCENE


def test_half_the_sampling_rate_is_described_as_nyquist() -> None:
    for rate in np.arange(0.5, 2.01, 0.1).round(2):
        shown = frame_of(SCENE, frequency=round(rate / 2, 2), rate=rate)
        assert "exactly at Nyquist" in shown.description, rate


def test_box_filtered_zone_plate_is_its_integral_over_the_pixel() -> None:
    pattern = pattern_of("zone_plate", 1.1, 40.0)
    x, y = pattern.first + np.arange(pattern.width), np.arange(pattern.height) - 59.5
    plate = zone_plate(x, y[:, None], 1 / pattern.chirp)
    sharp = pattern_of("zone_plate", 1.1, 90.0).picture(prefilter("none"))
    np.testing.assert_allclose(sharp, plate, atol=1e-12)

    def mean(centre: float) -> complex:
        ends = centre - 0.5, centre + 0.5
        real = quad(lambda u: np.cos(np.pi * pattern.chirp * u * u), *ends)[0]
        imaginary = quad(lambda u: np.sin(np.pi * pattern.chirp * u * u), *ends)[0]
        return complex(real, imaginary)

    box = 0.5 + 0.5 * (np.exp(1j * pattern.phase_rad) * mean(x[140]) * mean(y[20])).imag
    assert pattern.picture(prefilter("box"))[20, 140] == pytest.approx(box, abs=1e-5)


@pytest.mark.parametrize("kind", ["stripes", "zone_plate"])
@pytest.mark.parametrize(
    ("frequency", "rate", "filtered"),
    [
        *product((0.62, 1.2), (1.0,), FILTERS),
        *((0.62 * rate, rate, "box") for rate in (0.5, 0.75, 1.5, 2.0)),
    ],
)
def test_alias_curve_passes_through_the_samples(
    kind: str, frequency: float, rate: float, filtered: str
) -> None:
    """On the zone plate the curve is computed for locally pure waves."""
    pattern, kernel = pattern_of(kind, frequency, 65.0, rate), prefilter(filtered)
    at = pattern.first + pattern.start
    curve = alias_curve(pattern, kernel, at)
    assert curve is not None
    places = np.linspace(0, SHOWN - 1, curve.size) * rate
    on_sample = np.abs(places - np.rint(places)) < 1e-9
    samples = pattern.wave(kernel, at + places[on_sample])
    np.testing.assert_allclose(curve[on_sample], samples, atol=1e-9 if kind == "stripes" else 0.03)


def test_nyquist_ring_lies_where_the_local_frequency_is_one_half() -> None:
    shown = frame_of(SCENE, pattern="zone_plate", frequency=0.8, rate=1.2)
    (place,) = (each for each in shown.handles if each.name == "ring")
    pattern = pattern_of("zone_plate", 0.8, 0.0, 1.2)
    sample = (place.x / 400 - 0.5) * pattern.width
    assert abs(pattern.local_frequency(sample)) == pytest.approx(0.5, abs=1e-4)


@pytest.mark.parametrize(
    ("given", "error"),
    [
        ({"frequency": 0.49}, "under 10⁻⁹"),
        ({"frequency": 0}, "under 10⁻⁹"),
        ({"frequency": 0.75}, f"{1 / 2 / np.sqrt(2):.2f}"),
        ({"frequency": 0.75, "prefilter": "box"}, f"{np.sinc(0.75) / 2 / np.sqrt(2):.2f}"),
    ],
)
def test_error_of_stripes_agrees_with_theory(given: dict[str, object], error: str) -> None:
    """A wave of amplitude a has the RMS a/√2; light has half of the range."""
    assert [each.text for each in estimates_of(SCENE, **given)] == [error]


def test_ideal_picture_is_the_plate_inside_the_band_and_grey_beyond() -> None:
    pattern = pattern_of("zone_plate", 1.0, 90.0)
    truth, certain = ideal(pattern)
    x = np.abs(pattern.first + np.arange(pattern.width))
    y = np.abs(np.arange(pattern.height) - 59.5)[:, None]
    finest = np.maximum(x, y) * pattern.chirp
    inside, beyond = certain & (finest < 0.5), certain & (finest > 0.5)
    plate = zone_plate(x, y, 1 / pattern.chirp)
    np.testing.assert_allclose(truth[inside], plate[inside], atol=1e-12)
    assert (truth[beyond] == 0.5).all()
    assert finest[inside].max() == pytest.approx(0.4, abs=0.02)
    assert finest[beyond].min() == pytest.approx(0.6, abs=0.02)


@pytest.mark.parametrize("kind", FILTERS)
@pytest.mark.parametrize("rate", [0.5, 1.7])
def test_filter_leaves_an_even_picture_unchanged(kind: str, rate: float) -> None:
    grey = Photograph(1, np.full((240, 320, 3), 99, np.uint8))
    shown = sample_photograph(photograph_light(grey), kind, rate)
    assert shown is not None
    assert (shown.raster[..., :3] == 99).all()


def waves(cycles_per_pixel: float) -> Photograph:
    """A photograph of vertical stripes of amplitude 0.4, five of its pixels to a sample."""
    wave = 0.5 + 0.4 * np.cos(2 * np.pi * cycles_per_pixel * (np.arange(320) + 0.5) / 5)
    codes = np.rint(255 * encode_srgb(wave)).astype(np.uint8)
    return Photograph(1, np.broadcast_to(codes[:, None], (240, 320, 3)).copy())


@pytest.mark.parametrize(
    ("cycles", "given", "least", "most"),
    [
        (0.8, {}, 0.85 * 0.4 / np.sqrt(2), 1.15 * 0.4 / np.sqrt(2)),
        (0.8, {"prefilter": "sinc"}, 0, 0.028),
        (0.8, {"rate": 2}, 0, 0.15),
        (0.25, {}, 0, 0.03),
    ],
)
def test_error_of_photographed_waves_agrees_with_theory(
    cycles: float, given: dict[str, object], least: float, most: float
) -> None:
    (estimate,) = SCENE.estimates(SCENE.check(given), "", StageCache(), waves(cycles))
    assert least <= number_of(estimate.text) < most
