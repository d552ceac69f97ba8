"""The box with a hole: blur against light."""

from functools import partial

import numpy as np
import pytest
from support.frames import frame_of, pixels_of

from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb
from simulations.pictures.balloon import balloon
from simulations.scenes.pinhole.drawing import rim
from simulations.scenes.pinhole.scene import SCENE
from simulations.scenes.pinhole.settings import NARROWEST_MM, WIDEST_MM

frame = partial(frame_of, SCENE)


def light(**given: object) -> Floats:
    raster = pixels_of(frame(**given), 0)
    return np.asarray(decode_srgb(raster[..., :3] / 255.0))


def sharpness(**given: object) -> float:
    """Mean step from one pixel to its neighbour."""
    return float(np.abs(np.diff(light(**given, longer=True), axis=1)).mean())


def test_the_light_of_the_picture_goes_with_the_area_of_the_hole() -> None:
    wide, half = (float(light(hole=hole).mean()) for hole in (2.0, 1.0))
    assert half / wide == pytest.approx(1 / 4, rel=0.01)


def test_a_longer_exposure_makes_every_hole_as_bright() -> None:
    means = [float(light(hole=hole, longer=True).mean()) for hole in (0.1, 0.5, 2.0)]
    assert means == pytest.approx([means[0]] * 3, rel=0.02)


def test_the_picture_gets_sharper_to_about_four_tenths_of_a_millimetre_and_then_softer() -> None:
    holes = (2.0, 1.0, 0.4, 0.2, 0.1)
    sharp = [sharpness(hole=hole) for hole in holes]
    assert int(np.argmax(sharp)) == holes.index(0.4)
    assert sharp[0] < sharp[1] < sharp[2] > sharp[3] > sharp[4]


def test_the_picture_is_the_scene_upside_down_with_left_and_right_exchanged() -> None:
    seen = light(hole=0.4, longer=True)
    scene = balloon()
    turned = scene[::-1, ::-1]
    assert np.corrcoef(seen.ravel(), turned.ravel())[0, 1] > 0.95
    assert np.corrcoef(seen.ravel(), scene.ravel())[0, 1] < 0.5


@pytest.mark.parametrize("units", [-30.0, 30.0])
def test_no_short_pull_runs_the_rim_to_its_stop(units: float) -> None:
    x, y = rim(1.0)
    pulled = SCENE.pull(SCENE.check({}), "rim", (x, y + units))
    assert NARROWEST_MM < float(pulled["hole"]) < WIDEST_MM
