"""The film of the wagon wheel against means computed by brute force."""

from functools import partial

import numpy as np
import pytest
from numpy.typing import NDArray
from support.frames import estimates_of, frame_of, number_of, pixels_of

from simulations.models.arrays import Floats
from simulations.pictures import spoked_wheel
from simulations.pictures.spoked_wheel import Bars
from simulations.scenes.wagon_wheel.film import by_changes
from simulations.scenes.wagon_wheel.scene import SCENE

frame = partial(frame_of, SCENE)


def film(tier: str = "", /, **given: object) -> NDArray[np.int64]:
    return pixels_of(frame(tier, **given)).astype(np.int64)


def last_error(tier: str, **given: object) -> float:
    return number_of(estimates_of(SCENE, tier, **given)[-1].text)


@pytest.mark.parametrize("time", [1, 7, 30])
def test_aliased_speeds_have_the_same_film(time: float) -> None:
    """Without blur the frames themselves are the same."""
    given: dict[str, object] = {"spokes": 8, "frame_rate": 24, "shutter": 0, "time": time}
    fast, slow = (film("", speed=speed, **given) for speed in (2.9, -0.1))
    assert np.abs(fast - slow).max() <= 1


def brute_force(row: Bars, steps: int = 1500) -> Floats:
    """Mean over the exposure of the share of each pixel that nearby spokes cover."""
    total = np.zeros_like(row.place)
    for time in (np.arange(steps) + 0.5) / steps:
        middle = row.place - row.swept * time
        left, right = middle - row.pixel / 2, middle + row.pixel / 2
        for spoke in range(int(left.min()) - 2, int(right.max()) + 3):
            edges = spoke - row.duty / 2, spoke + row.duty / 2
            total += np.clip(np.minimum(right, edges[1]) - np.maximum(left, edges[0]), 0, None)
    return total / row.pixel / steps


@pytest.mark.parametrize("swept", [0.0, 0.02, -0.7, 3.0, -3.3])
def test_reference_is_the_mean_over_all_moments(swept: float) -> None:
    rng = np.random.default_rng(2)
    place, duty, pixel = rng.uniform([[-1.0], [0.05], [0.01]], [[1.0], [0.9], [0.3]], (3, 60))
    row = Bars(place, duty, pixel, swept)
    np.testing.assert_allclose(by_changes(row), brute_force(row), atol=1e-3)


def test_errors_of_instants_agree_with_their_spread() -> None:
    """One instant of a whole spacing: wood for a share w of the time is off by √(w (1 − w)),
    softened by the pixels' width. Random instants come nearer by the root of their count."""
    canvas = spoked_wheel.build_canvas()
    share = np.minimum(spoked_wheel.bars(canvas, 8, 0.0, 0.0).duty, 1.0)
    hard = np.sqrt(np.mean(share * (1 - share)))
    whole = last_error("instants-1", speed=3, spokes=8, frame_rate=24, shutter=1)
    assert 0.85 * hard < whole < hard
    one, four, many = (last_error(f"instants-{count}", shutter=0.5) for count in (1, 4, 16))
    assert one > 4 * four > 16 * many
    turn = 2 * np.pi * 2.9 / 24
    row = spoked_wheel.bars(canvas, 8, 5 * turn, 0.5 * turn)
    moments = [spoked_wheel.at_moment(row, time) for time in (np.arange(200) + 0.5) / 200]
    free = 1 - canvas.solid[canvas.between]
    expected = np.sqrt(np.mean(np.var(moments, axis=0) * free**2) / 16)
    assert last_error("random-16", shutter=0.5) == pytest.approx(expected, rel=0.05)


@pytest.mark.parametrize("speed", [-4.0, -0.5, 2.9, 6.0])
@pytest.mark.parametrize("quarters", [-1, 1])
def test_dragged_spoke_changes_the_time_by_its_angle(speed: float, quarters: int) -> None:
    given = {"speed": speed, "frame_rate": 24, "time": 48}
    (spoke,) = (place for place in frame(**given).handles if place.name == "spoke")
    turned = (200 - quarters * (spoke.y - 150), 150 + quarters * (spoke.x - 200))
    time = float(SCENE.pull(SCENE.check(given), "spoke", turned)["time"])
    assert time == pytest.approx(48 + quarters * 0.25 * 24 / speed, abs=0.026)
