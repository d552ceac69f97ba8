"""The two lines at infinity in the transform explorer, over the sliders' own steps in pairs.

Level, upright and coincident lines come about near zero, at single steps: ends and random
settings miss them.
"""

import itertools
import re

import numpy as np
import pytest
from support.label_boxes import in_figures, labels

from simulations.engine.controls import Slider
from simulations.scenes._mapped_square.plane import HEIGHT, WIDTH, lines_at_infinity
from simulations.scenes.transform_2d.handles import matrix
from simulations.scenes.transform_2d.scene import SCENE

SLIDERS = {control.name: control for control in SCENE.controls if isinstance(control, Slider)}
PAIRS = list(itertools.permutations(("amount", "pull_x", "pull_y"), 2))


def steps(name: str) -> list[float]:
    slider = SLIDERS[name]
    return np.arange(slider.minimum, slider.maximum + slider.step / 2.0, slider.step).tolist()


def special(name: str) -> set[float]:
    """The ends, and the steps around the rest position at which lines are level or upright."""
    slider = SLIDERS[name]
    around = {-slider.step, 0.0, slider.step}
    return {slider.minimum, slider.maximum} | {
        value for value in around if slider.minimum <= value <= slider.maximum
    }


@pytest.mark.deep
@pytest.mark.parametrize(("swept", "special_one"), PAIRS)
def test_lines_and_their_names_lie_in_the_view_at_every_step(swept: str, special_one: str) -> None:
    for value, other in itertools.product(steps(swept), special(special_one)):
        setting = {"transform": "projective", "amount": 0, swept: value, special_one: other}
        drawn = lines_at_infinity(matrix(SCENE.check(setting)))
        for name in labels(drawn, in_figures):
            assert 0.0 <= name.box.left < name.box.right <= WIDTH, setting
            assert 0.0 <= name.box.top < name.box.bottom <= HEIGHT, setting


@pytest.mark.parametrize("pull_x", [59, 60, 61, 62])
def test_a_level_horizon_is_drawn_level(pull_x: float) -> None:
    settings = SCENE.check({"transform": "projective", "amount": 0, "pull_x": pull_x})
    horizon = re.search(
        r'"image dashed" x1="-4" y1="([\d.]+)" x2="404" y2="([\d.]+)"',
        lines_at_infinity(matrix(settings)),
    )
    assert horizon
    assert horizon[1] == horizon[2]


@pytest.mark.parametrize("amount", [24, 45, 90])
def test_the_name_of_the_horizon_stands_on_its_line(amount: float) -> None:
    drawn = lines_at_infinity(matrix(SCENE.check({"transform": "projective", "amount": amount})))
    line = re.search(r'"image dashed" x1="(\S+)" y1="(\S+)" x2="(\S+)" y2="(\S+)"', drawn)
    assert line
    x1, y1, x2, y2 = map(float, line.groups())
    (box,) = (name.box for name in labels(drawn, in_figures) if name.text == "horizon")
    middle = (box.left + box.right) / 2.0
    assert box.top < y1 + (y2 - y1) * (middle - x1) / (x2 - x1) < box.bottom
