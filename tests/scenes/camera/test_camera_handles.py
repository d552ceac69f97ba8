"""What can be grabbed in the camera's plan and photograph, and what a pull there means."""

import pytest

from simulations.engine.controls import Value
from simulations.models.distortion.lens_model import Distortion, distort
from simulations.models.projection import pinhole
from simulations.pictures.still_life import things as still_life
from simulations.scenes.camera.scene import SCENE

type Setting = dict[str, Value]


def pulled(handle: str, place: tuple[float, float], **given: Value) -> Setting:
    return SCENE.pull(SCENE.check(given), handle, place)


@pytest.mark.parametrize("k1", [-0.2, 0.2])
@pytest.mark.parametrize("thing", still_life.THINGS[:5], ids=lambda thing: thing.name)
def test_a_press_at_a_thing_in_the_photograph_brings_it_into_focus(
    thing: still_life.Thing, k1: float
) -> None:
    """All but the plum box, whose middle the green ball hides."""
    lens = Distortion(k1=k1)
    x, y, z = pinhole.world_to_camera(thing.solid.centre, still_life.WORLD_TO_CAMERA)
    sensor = 35.0 / (1 - 0.035 / 3.2) * distort((x / z, y / z), lens)
    place = (200 + sensor[0] * 400 / 36, 133.5 + sensor[1] * 267 / 24)
    values = pulled("aim", place, focal_length=35, k1=k1)
    assert values["focus"] == pytest.approx(z, abs=0.051)


def test_a_press_where_no_ray_arrives_leaves_the_focus() -> None:
    assert pulled("aim", (1.0, 1.0), focal_length=24, k1=-0.4) == {}
