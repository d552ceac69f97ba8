"""The wagon wheel: what the film shows of a motion, and what it cannot tell."""

from functools import partial

import numpy as np
import pytest
from numpy.typing import NDArray
from support.frames import estimates_of, frame_of, number_of, texts_of

from simulations.engine.frame import Frame
from simulations.engine.stages import StageCache
from simulations.models.arrays import Floats
from simulations.pictures import spoked_wheel
from simulations.pictures.spoked_wheel import Bars
from simulations.scenes.wagon_wheel.film import by_changes
from simulations.scenes.wagon_wheel.scene import SCENE

frame = partial(frame_of, SCENE)


def judged(tier: str, **values: float) -> list[str]:
    """All estimates of the error, as shown, the last for all pixels."""
    estimates = estimates_of(SCENE, tier, **values)
    assert {each.unit for each in estimates} == {"of full contrast"}
    return [each.text for each in estimates]


def film(shown: Frame) -> NDArray[np.int64]:
    raster = shown.panels[0].raster
    assert raster is not None
    return raster.astype(np.int64)


def test_two_speeds_one_film() -> None:
    """The alias is no trick of the eye: without blur the frames themselves are the same."""
    for time in (1, 7, 30):
        fast, slow = (
            frame(speed=speed, spokes=8, frame_rate=24, shutter=0, time=time)
            for speed in (2.9, -0.1)
        )
        off = np.abs(film(fast) - film(slow))
        assert off.max() <= 1


def test_a_frame_is_held_until_the_next() -> None:
    cache = StageCache()
    first = frame("", cache, time=5.0).panels[0].raster
    assert frame("", cache, time=5.95).panels[0].raster is first
    assert frame("", cache, time=6.0).panels[0].raster is not first


def test_a_long_exposure_hides_the_spokes() -> None:
    shown = frame(speed=3, spokes=8, frame_rate=24, shutter=1)
    assert texts_of(shown)["contrast"] == "0.00"
    raster = film(shown)
    circle = raster[180, 240 + 60 : 240 + 66, 0]
    turned = raster[180 - 66 : 180 - 60, 240, 0]
    np.testing.assert_allclose(circle, turned[::-1], atol=2)


def brute_force(row: Bars, steps: int = 1500) -> Floats:
    """Mean over the exposure of how much of each pixel nearby spokes cover."""
    total = np.zeros_like(row.place)
    for time in (np.arange(steps) + 0.5) / steps:
        middle = row.place - row.swept * time
        left, right = middle - row.pixel / 2, middle + row.pixel / 2
        for spoke in range(int(left.min()) - 2, int(right.max()) + 3):
            edges = spoke - row.duty / 2, spoke + row.duty / 2
            total += np.clip(np.minimum(right, edges[1]) - np.maximum(left, edges[0]), 0, None)
    return total / row.pixel / steps


@pytest.mark.parametrize("swept", [0.0, 0.02, -0.7, 3.0, -3.3])
def test_the_reference_is_the_mean_over_all_moments(swept: float) -> None:
    rng = np.random.default_rng(2)
    place, duty, pixel = rng.uniform([[-1.0], [0.05], [0.01]], [[1.0], [0.9], [0.3]], (3, 60))
    row = spoked_wheel.Bars(place, duty, pixel, swept)
    np.testing.assert_allclose(by_changes(row), brute_force(row), atol=1e-3)


def test_the_integral_errs_by_rounding_alone() -> None:
    for values in ({}, {"shutter": 0}, {"speed": 6, "frame_rate": 8, "spokes": 16, "shutter": 1}):
        assert judged("integral", **values)[-1] == "under 10⁻¹²"


def test_all_tiers_agree_while_the_wheel_stands() -> None:
    pictures = [frame(tier, speed=0).panels[0].raster for tier in SCENE.tiers]
    for picture in pictures:
        np.testing.assert_array_equal(picture, pictures[0])


def test_one_instant_of_a_whole_spacing_errs_as_a_bar_does_from_its_mean() -> None:
    """Wood for a share w of the time: off by √(w (1 − w)), softened by the pixels' width."""
    canvas = spoked_wheel.build_canvas()
    row = spoked_wheel.bars(canvas, 8, 0.0, 0.0)
    share = np.minimum(row.duty, 1.0)
    hard = np.sqrt(np.mean(share * (1 - share)))
    (*_, last) = judged("instants-1", speed=3, spokes=8, frame_rate=24, shutter=1)
    assert 0.85 * hard < float(last) < hard


def test_more_instants_come_nearer_and_random_ones_only_by_the_root() -> None:
    one, four, many = (
        number_of(judged(f"instants-{count}", shutter=0.5)[-1]) for count in (1, 4, 16)
    )
    assert one > 4 * four > 16 * many
    canvas = spoked_wheel.build_canvas()
    swept = 2 * np.pi * 2.9 / 24 * 0.5
    row = spoked_wheel.bars(canvas, 8, 5 * 2 * np.pi * 2.9 / 24, swept)
    times = (np.arange(200) + 0.5) / 200
    moments = [spoked_wheel.at_moment(row, time) for time in times]
    free = 1 - canvas.solid[canvas.between]
    expected = np.sqrt(np.mean(np.var(moments, axis=0) * free**2) / 16)
    assert float(judged("random-16", shutter=0.5)[-1]) == pytest.approx(expected, rel=0.05)


def test_random_grain_is_new_on_each_frame_and_the_same_when_asked_again() -> None:
    def picture(time: float) -> NDArray[np.int64]:
        return film(frame("random-16", speed=3, frame_rate=24, shutter=1, time=time))

    assert not np.array_equal(picture(3), picture(4))
    np.testing.assert_array_equal(picture(3), picture(3.4))


def place_of(name: str, **values: object) -> tuple[float, float]:
    settings = SCENE.check(values)
    (handle,) = (each for each in SCENE.handles if each.name == name)
    place = handle.at(settings, {})
    assert place is not None
    return place


@pytest.mark.parametrize("speed", [-4.0, -0.5, 2.9, 6.0])
@pytest.mark.parametrize("quarters", [-1, 1])
def test_a_wheel_turned_by_a_quarter_lets_the_time_of_a_quarter_pass(
    speed: float, quarters: int
) -> None:
    """The nearer way round, in the sense of the hand."""
    given = {"speed": speed, "frame_rate": 24, "time": 48}
    x, y = place_of("spoke", **given)
    across, down = x - 200, y - 150
    turned = (200 - quarters * down, 150 + quarters * across)
    (time,) = SCENE.pull(SCENE.check(given), "spoke", turned).values()
    assert isinstance(time, float)
    assert time == pytest.approx(48 + quarters * 0.25 * 24 / speed, abs=0.026)


def test_the_wheel_of_a_film_that_is_at_its_start_turns_back_no_further() -> None:
    given = {"speed": 0.05, "frame_rate": 60, "time": 0}
    x, y = place_of("spoke", **given)
    assert SCENE.pull(SCENE.check(given), "spoke", (x, y - 60)) == {"time": 0}
