"""The patterns of the aliasing figure, filtered and sampled, and the alias through the samples."""

from collections.abc import Callable
from itertools import product

import numpy as np
import pytest
from scipy.integrate import quad
from support.frames import frame_of

from simulations.models.sampling.aliasing import zone_plate
from simulations.models.sampling.prefilters import prefilter
from simulations.scenes.aliasing.pattern import SHOWN, pattern_of
from simulations.scenes.aliasing.row import alias_curve
from simulations.scenes.aliasing.scene import SCENE
from simulations.scenes.aliasing.settings import FILTERS


def test_the_zone_plate_is_that_of_the_model() -> None:
    pattern = pattern_of("zone_plate", 0.9, 90.0)
    x = pattern.first + np.arange(pattern.width)
    y = np.arange(pattern.height) - 59.5
    expected = zone_plate(x, y[:, None], 1 / pattern.chirp)
    np.testing.assert_allclose(pattern.picture(prefilter("none")), expected, atol=1e-12)


def test_a_filtered_pixel_of_the_zone_plate_is_its_mean_over_the_pixel() -> None:
    pattern = pattern_of("zone_plate", 1.1, 40.0)
    rows, columns = 20, 140
    x, y = pattern.first + columns, rows - 59.5

    def mean_along(centre: float, part: Callable[[np.complex128], np.float64]) -> float:
        def wave(u: float) -> np.float64:
            return part(np.exp(1j * np.pi * pattern.chirp * u * u))

        return float(quad(wave, centre - 0.5, centre + 0.5)[0])

    along, across = (mean_along(c, np.real) + 1j * mean_along(c, np.imag) for c in (x, y))
    mean = 0.5 + 0.5 * (np.exp(1j * pattern.phase_rad) * along * across).imag
    assert pattern.picture(prefilter("box"))[rows, columns] == pytest.approx(mean, abs=1e-5)


@pytest.mark.parametrize("kind", ["stripes", "zone_plate"])
@pytest.mark.parametrize(
    ("frequency", "rate", "filtered"),
    [
        *product((0.62, 0.85, 1.2), (1.0,), FILTERS),
        *((0.62 * rate, rate, "box") for rate in (0.5, 0.75, 1.5, 2.0)),
    ],
)
def test_the_alias_passes_through_the_samples(
    kind: str, frequency: float, rate: float, filtered: str
) -> None:
    """On the zone plate the curve takes the wave for locally pure, and its middle row for all."""
    pattern, kernel = pattern_of(kind, frequency, 65.0, rate), prefilter(filtered)
    at = pattern.first + pattern.start
    curve = alias_curve(pattern, kernel, at)
    assert curve is not None
    places = np.linspace(0, SHOWN - 1, curve.size) * rate
    on_sample = np.abs(places - np.rint(places)) < 1e-9
    samples = pattern.wave(kernel, at + places[on_sample])
    np.testing.assert_allclose(curve[on_sample], samples, atol=1e-9 if kind == "stripes" else 0.03)


def test_a_true_wave_has_no_alias() -> None:
    pattern = pattern_of("stripes", 0.45, 0.0)
    assert alias_curve(pattern, prefilter("none"), 0.0) is None
    assert "alias" not in frame_of(SCENE, frequency=0.45).panels[1].overlay
