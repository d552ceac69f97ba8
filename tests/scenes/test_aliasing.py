"""The aliasing figure: the picture is the sampled pattern, and the alias fits the same samples."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad

from simulations.engine.frame import Frame, Raster
from simulations.engine.stages import StageCache
from simulations.ladders.anti_aliasing import LADDER
from simulations.models.color.srgb import decode_srgb
from simulations.models.sampling.aliasing import zone_plate
from simulations.models.sampling.prefilters import prefilter
from simulations.scenes.aliasing.pattern import SHOWN, pattern_of
from simulations.scenes.aliasing.row import FINE, alias_curve
from simulations.scenes.aliasing.scene import SCENE, ideal
from simulations.scenes.aliasing.settings import FILTERS


def frame(cache: StageCache | None = None, **given: object) -> Frame:
    return SCENE.render(SCENE.check(given), "", cache or StageCache())


def raster(shown: Frame) -> Raster:
    pixels = shown.panels[0].raster
    assert pixels is not None
    return pixels


def texts(shown: Frame) -> dict[str, str]:
    return {item.name: item.text for item in shown.readouts}


def judged(**given: object) -> str:
    """The error as shown."""
    (estimate,) = SCENE.estimates(SCENE.check(given), "", StageCache())
    assert estimate.unit == "of range"
    return estimate.text


def light(shown: Frame) -> NDArray[np.floating]:
    return decode_srgb(raster(shown)[..., 0] / 255.0)


@pytest.mark.parametrize(
    ("true", "seen"), [(0.3, "0.30"), (0.5, "0.50"), (0.7, "0.30"), (0.8, "0.20"), (1.2, "0.20")]
)
def test_frequencies_fold_at_one_half(true: float, seen: str) -> None:
    assert texts(frame(frequency=true))["alias"] == seen


def test_the_shirt_of_the_chapter_gets_a_false_stripe_every_five_pixels() -> None:
    shown = frame(frequency=0.8)
    assert texts(shown)["period"] == "5.0"
    row = light(shown)[0]
    np.testing.assert_allclose(row[5:], row[:-5], atol=0.01)
    np.testing.assert_allclose(row, light(frame(frequency=0.2))[0], atol=0.01)


@pytest.mark.parametrize(("phase", "kept"), [(0, "0.000"), (30, "0.500"), (90, "1.000")])
def test_at_nyquist_the_phase_decides(phase: float, kept: str) -> None:
    shown = frame(frequency=0.5, phase=phase)
    assert texts(shown)["kept"] == kept
    row = light(shown)[0]
    assert (row.max() - row.min()) == pytest.approx(float(kept), abs=0.01)


def test_one_cycle_a_pixel_is_flat() -> None:
    shown = frame(frequency=1)
    assert np.ptp(raster(shown)[..., 0].astype(int)) <= 1
    assert (texts(shown)["kept"], texts(shown)["period"]) == ("0.000", "∞")


def test_the_pixels_area_leaves_what_the_chapter_says() -> None:
    passed = {f: texts(frame(frequency=f, prefilter="box"))["passed"] for f in (0.5, 0.8, 1.0)}
    assert passed == {0.5: "0.637", 0.8: "0.234", 1.0: "0.000"}


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
@pytest.mark.parametrize("filtered", FILTERS)
@pytest.mark.parametrize("frequency", [0.62, 0.85, 1.2])
def test_the_alias_passes_through_the_samples(kind: str, filtered: str, frequency: float) -> None:
    pattern, kernel = pattern_of(kind, frequency, 65.0), prefilter(filtered)
    at = pattern.first + pattern.start
    curve = alias_curve(pattern, kernel, at)
    assert curve is not None
    samples = pattern.wave(kernel, at + np.arange(SHOWN))
    # On the zone plate the curve takes the wave for locally pure, and its middle row for all.
    np.testing.assert_allclose(curve[::FINE], samples, atol=1e-9 if kind == "stripes" else 0.03)


def test_a_true_wave_has_no_alias() -> None:
    pattern = pattern_of("stripes", 0.45, 0.0)
    assert alias_curve(pattern, prefilter("none"), 0.0) is None
    assert "alias" not in frame(frequency=0.45).panels[1].overlay


@pytest.mark.parametrize("pattern", ["stripes", "zone_plate"])
@pytest.mark.parametrize("frequency", [0, 0.5, 1, 1.2])
@pytest.mark.parametrize("filtered", FILTERS)
def test_every_extreme_can_be_drawn_in_the_same_layout(
    pattern: str, frequency: float, filtered: str
) -> None:
    shown = frame(pattern=pattern, frequency=frequency, phase=0, prefilter=filtered)
    assert [panel.name for panel in shown.panels] == ["picture", "row", "spectrum"]
    assert len(shown.readouts) == 6
    assert not any("nan" in panel.overlay for panel in shown.panels)


def test_the_picture_is_kept_while_nothing_changes() -> None:
    cache = StageCache()
    first = frame(cache)
    assert raster(frame(cache)) is raster(first)


def test_the_filter_offers_the_rungs_of_the_ladder_and_no_second_control_repeats_it() -> None:
    names = {"none": "point", "box": "area", "sinc": "sinc-4", "gaussian": None}
    offered = [names.get(kind, kind) for kind in FILTERS]
    assert {name for name in offered if name} == {tier.id for tier in LADDER.tiers}
    assert SCENE.tiers == ()


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


def test_the_ideal_stripes_keep_their_phase() -> None:
    truth, certain = ideal(pattern_of("stripes", 0.25, 30.0))
    row = 0.5 + 0.5 * np.sin(np.radians(30 + 90 * np.arange(64)))
    np.testing.assert_allclose(truth, np.tile(row, (48, 1)), atol=1e-12)
    assert certain.all()
