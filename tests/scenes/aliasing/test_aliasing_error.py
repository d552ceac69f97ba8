"""How far the aliasing figure's picture is from the best that its pixels could show."""

import numpy as np
import pytest
from support.frames import estimates_of

from simulations.models.sampling.aliasing import zone_plate
from simulations.scenes.aliasing.pattern import pattern_of
from simulations.scenes.aliasing.scene import SCENE, ideal


def judged(**given: object) -> str:
    """The error as shown."""
    (estimate,) = estimates_of(SCENE, **given)
    assert estimate.unit == "of range"
    return estimate.text


def test_a_wave_below_nyquist_that_no_filter_dulls_is_without_error() -> None:
    assert judged(frequency=0.49) == "under 10⁻⁹"
    assert judged(frequency=0) == "under 10⁻⁹"


@pytest.mark.parametrize(("kind", "passed"), [("none", 1.0), ("box", np.sinc(0.75))])
def test_what_is_left_of_a_wave_beyond_nyquist_is_error(kind: str, passed: float) -> None:
    """A wave of amplitude a has the RMS a/√2; light swings by half of the range."""
    assert judged(frequency=0.75, prefilter=kind) == f"{abs(passed) / 2 / np.sqrt(2):.2f}"


def test_what_a_filter_takes_of_a_wave_below_nyquist_is_error() -> None:
    lost = (1 - np.cos(np.pi * 0.25 / 2)) / 2 / np.sqrt(2)
    assert judged(frequency=0.25, prefilter="box-2") == f"{lost:.3f}"


def test_on_the_zone_plate_wide_kernels_are_nearest_to_what_pixels_can_show() -> None:
    none, points, box, sinc = (
        float(judged(pattern="zone_plate", frequency=0.9, prefilter=kind))
        for kind in ("none", "box-2", "box", "sinc")
    )
    assert none > 2 * points
    assert points > box > 3 * sinc


def test_the_ideal_picture_is_the_plate_inside_the_band_and_grey_beyond() -> None:
    pattern = pattern_of("zone_plate", 1.0, 90.0)
    truth, certain = ideal(pattern)
    x = np.abs(pattern.first + np.arange(pattern.width))
    y = np.abs(np.arange(pattern.height) - 59.5)[:, None]
    finest = np.maximum(x, y) * pattern.chirp
    plate = zone_plate(x, y, 1 / pattern.chirp)
    inside, beyond = certain & (finest < 0.5), certain & (finest > 0.5)
    np.testing.assert_allclose(truth[inside], plate[inside], atol=1e-12)
    assert (truth[beyond] == 0.5).all()
    assert finest[inside].max() == pytest.approx(0.4, abs=0.02)
    assert finest[beyond].min() == pytest.approx(0.6, abs=0.02)
