"""The box with a hole: blur against light."""

import numpy as np
import pytest
from support.frames import frame_of, pixels_of

from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb
from simulations.pictures.balloon import balloon
from simulations.scenes.pinhole import SCENE


def light(**given: object) -> Floats:
    return decode_srgb(pixels_of(frame_of(SCENE, **given))[..., :3] / 255.0)


def test_the_light_goes_with_the_area_of_the_hole_unless_the_exposure_is_longer() -> None:
    wide, half = (float(light(hole=hole).mean()) for hole in (2.0, 1.0))
    assert half / wide == pytest.approx(1 / 4, rel=0.01)
    means = [float(light(hole=hole, longer=True).mean()) for hole in (0.1, 0.5, 2.0)]
    assert means == pytest.approx([means[0]] * 3, rel=0.02)


def test_the_picture_is_sharpest_at_about_four_tenths_of_a_millimetre() -> None:
    pictures = [light(hole=hole, longer=True) for hole in (2.0, 1.0, 0.4, 0.2, 0.1)]
    sharp = [float(np.abs(np.diff(picture, axis=1)).mean()) for picture in pictures]
    assert sharp[0] < sharp[1] < sharp[2] > sharp[3] > sharp[4]


def test_the_picture_is_the_scene_upside_down_with_left_and_right_exchanged() -> None:
    seen, scene = light(hole=0.4, longer=True), balloon()
    assert np.corrcoef(seen.ravel(), scene[::-1, ::-1].ravel())[0, 1] > 0.95
    assert np.corrcoef(seen.ravel(), scene.ravel())[0, 1] < 0.5
