"""The two lines at infinity in the transform explorer, over the sliders' own steps in pairs.

Level, upright and coincident lines come about near zero, at single steps: ends and random
settings miss them.
"""

import re

import numpy as np
import pytest

from simulations.engine.controls import Slider
from simulations.scenes.transform_2d.handles import matrix
from simulations.scenes.transform_2d.plane import lines_at_infinity
from simulations.scenes.transform_2d.scene import SCENE

SLIDERS = {control.name: control for control in SCENE.controls if isinstance(control, Slider)}


def steps(name: str) -> list[float]:
    slider = SLIDERS[name]
    return np.arange(slider.minimum, slider.maximum + slider.step / 2.0, slider.step).tolist()


@pytest.mark.parametrize("pull_x", [59, 60, 61, 62])
def test_a_level_horizon_is_drawn_level(pull_x: float) -> None:
    settings = SCENE.check({"transform": "projective", "amount": 0, "pull_x": pull_x})
    horizon = re.search(
        r'"image dashed" x1="-4" y1="([\d.]+)" x2="404" y2="([\d.]+)"',
        lines_at_infinity(matrix(settings)),
    )
    assert horizon
    assert horizon[1] == horizon[2]
