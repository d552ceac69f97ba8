"""The aliasing figure: the picture is the sampled pattern, and the alias fits the same samples."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad

from simulations.engine.frame import Frame, Raster
from simulations.engine.photograph import Photograph
from simulations.engine.stages import StageCache
from simulations.ladders.anti_aliasing import LADDER
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.sampling.aliasing import zone_plate
from simulations.models.sampling.prefilters import prefilter
from simulations.scenes.aliasing.own import ideal_weights, own_light, sample_own, weights
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


@pytest.mark.parametrize(
    ("rate", "seen"), [(1, "0.30"), (1.5, "0.70"), (0.5, "0.20"), (0.7, "0.00")]
)
def test_waves_fold_at_half_the_sampling_rate(rate: float, seen: str) -> None:
    shown = texts(frame(frequency=0.7, rate=rate))
    assert (shown["alias"], shown["nyquist"]) == (seen, f"{rate / 2:.2f}")


def test_what_lies_exactly_on_the_fold_is_known_to_do_so_at_every_rate() -> None:
    for rate in np.arange(0.5, 2.01, 0.1).round(2):
        shown = frame(frequency=round(rate / 2, 2), rate=rate)
        assert "exactly at Nyquist" in shown.description, rate


def test_twice_the_samples_of_half_the_frequency_is_the_same_row() -> None:
    """As many samples to a cycle: on the finer grid there are twice as many of them."""
    coarse, fine = light(frame(frequency=0.8)), light(frame(frequency=1.2, rate=1.5))
    np.testing.assert_allclose(coarse[0], fine[0, :64], atol=0.01)


@pytest.mark.parametrize("kind", ["stripes", "zone_plate"])
@pytest.mark.parametrize("rate", [0.5, 0.75, 1.5, 2.0])
def test_the_alias_passes_through_the_samples_at_every_rate(kind: str, rate: float) -> None:
    pattern, kernel = pattern_of(kind, 0.62 * rate, 65.0, rate), prefilter("box")
    at = pattern.first + pattern.start
    curve = alias_curve(pattern, kernel, at)
    assert curve is not None
    places = np.linspace(0, SHOWN - 1, curve.size) * rate
    on_sample = np.abs(places - np.rint(places)) < 1e-9
    samples = pattern.wave(kernel, at + places[on_sample])
    np.testing.assert_allclose(curve[on_sample], samples, atol=1e-9 if kind == "stripes" else 0.03)


def test_a_crest_pulled_aside_is_a_crest_of_the_new_wave() -> None:
    (wanted,) = SCENE.pull(SCENE.check({"phase": 40}), "crest", (200.0, 90.0)).values()
    pixels = (200.0 - 22.0) / (386.0 - 22.0) * (SHOWN - 1)
    assert isinstance(wanted, float)
    assert np.sin(np.radians(40) + 2 * np.pi * wanted * pixels) > 0.98


def test_the_ring_at_nyquist_is_where_the_plate_has_half_a_cycle_a_sample() -> None:
    given = SCENE.check({"pattern": "zone_plate", "frequency": 0.8, "rate": 1.2})
    done = SCENE.run(given, "", StageCache())
    (handle,) = (each for each in SCENE.handles if each.name == "ring")
    place = handle.at(given, done.outputs)
    assert place is not None
    pattern = pattern_of("zone_plate", 0.8, 0.0, 1.2)
    sample = place[0] / 400 * pattern.width - 0.5 * pattern.width
    assert abs(pattern.local_frequency(sample)) == pytest.approx(0.5)


def own(codes: NDArray[np.uint8]) -> Photograph:
    rgba = np.concatenate((codes, np.full((240, 320, 1), 255, np.uint8)), axis=2)
    return Photograph.from_canvas(1, rgba.tobytes(), 320, 240)


def waves(cycles_per_pixel: float) -> Photograph:
    """Vertical stripes, with five points of the picture to a pixel."""
    x = (np.arange(320) + 0.5) / 5
    wave = 0.5 + 0.4 * np.cos(2 * np.pi * cycles_per_pixel * x)
    codes = np.rint(255 * encode_srgb(wave)).astype(np.uint8)
    return own(np.broadcast_to(codes[:, None], (240, 320, 3)).copy())


def told_of_own(picture: Photograph, **given: object) -> tuple[Frame, float]:
    settings, cache = SCENE.check(given), StageCache()
    (estimate,) = SCENE.estimates(settings, "", cache, picture)
    superscripts = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
    off = float(estimate.text.replace("\u00a0×\u00a010", "e").translate(superscripts))
    return SCENE.render(settings, "", cache, picture), off


@pytest.mark.parametrize("kind", FILTERS)
@pytest.mark.parametrize("rate", [0.5, 1.0, 1.7])
def test_every_filter_leaves_an_even_picture_as_it_is(kind: str, rate: float) -> None:
    shown = sample_own(own_light(own(np.full((240, 320, 3), 99, np.uint8))), kind, rate)
    assert shown is not None
    assert (shown.raster[..., :3] == 99).all()


def test_a_picture_of_waves_above_nyquist_shows_their_alias_and_a_wide_filter_removes_it() -> None:
    shown, wrong = told_of_own(waves(0.8))
    row = light(shown)[20]
    spectrum = np.abs(np.fft.rfft(row - row.mean()))
    assert np.argmax(spectrum) == round(0.2 * 64)
    # An amplitude of 0.4 has an RMS of 0.4/√2.
    assert wrong == pytest.approx(0.4 / np.sqrt(2), rel=0.15)
    _, filtered = told_of_own(waves(0.8), prefilter="sinc")
    assert filtered < wrong / 10


def test_a_picture_of_waves_that_the_grid_can_hold_is_right_and_so_is_a_denser_grid() -> None:
    _, held = told_of_own(waves(0.25))
    assert held < 0.03
    _, denser = told_of_own(waves(0.8), rate=2)
    assert denser < 0.15


def test_of_a_reader_s_picture_nothing_is_said_that_holds_for_the_patterns_only() -> None:
    for pattern in ("stripes", "zone_plate"):
        shown, _ = told_of_own(waves(0.3), pattern=pattern, frequency=0.7, phase=0)
        assert shown.description.startswith("Your own picture at one sample a pixel")
        assert "alias" not in shown.panels[1].overlay
        assert {place.name for place in shown.handles} == {"frequency", "nyquist"}


def test_weights_are_those_of_a_mean_and_of_an_ideal_filter() -> None:
    places = np.array([10.0, 100.0, 310.0])
    box = weights(places, prefilter("box"), 1.0, 320)
    assert box.sum(axis=1) == pytest.approx(1, abs=1e-6)
    assert box @ np.arange(320) == pytest.approx(places, abs=1e-3)
    spread = box @ np.arange(320) ** 2 - places**2
    assert spread == pytest.approx(5**2 / 12, abs=0.2)  # between points the light changes evenly
    ideal_row = ideal_weights(320, 1.0)
    x = (np.arange(320) + 0.5) * np.pi / 320
    assert ideal_row @ np.cos(63 * x) == pytest.approx(
        np.cos(63 * np.pi / 64 * (np.arange(64) + 0.5))
    )
    assert ideal_row @ np.cos(64 * x) == pytest.approx(np.zeros(64), abs=1e-9)
