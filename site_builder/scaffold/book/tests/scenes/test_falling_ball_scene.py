"""A falling ball: what the figure says is what theory says."""

import math

import pytest

from simulations.engine.stages import StageCache
from simulations.scenes.falling_ball.scene import SCENE


def shown(**values: float) -> dict[str, float]:
    frame = SCENE.render(SCENE.check(values), "", StageCache())
    return {item.name: float(item.text) for item in frame.readouts}


def test_without_air_every_second_adds_the_same() -> None:
    assert shown(time=3)["free"] == pytest.approx(3 * 9.81, abs=0.01)


@pytest.mark.parametrize("terminal", [10, 30, 60])
def test_the_speed_shown_is_that_of_the_formula(terminal: float) -> None:
    expected = terminal * math.tanh(9.81 * 2 / terminal)
    assert shown(time=2, terminal=terminal)["speed"] == pytest.approx(expected, abs=0.01)
