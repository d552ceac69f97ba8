"""The second-bounce figure shows what two planes throw at each other."""

from functools import partial

import numpy as np
import pytest
from support.frames import frame_of

from simulations.engine.stages import StageCache
from simulations.models.color.srgb import decode_srgb
from simulations.scenes.second_bounce.scene import SCENE
from simulations.scenes.second_bounce.stages import Planes

BEHIND = {"light_angle": 105, "place": 0.12}


frame = partial(frame_of, SCENE)


def numbers(**given: object) -> dict[str, float]:
    return {item.name: float(item.text) for item in frame(**given).readouts}


def planes(**given: object) -> Planes:
    found: Planes = SCENE.run(SCENE.check(given), "", StageCache()).outputs["planes"]
    return found


def test_light_comes_into_the_shadow_with_the_second_bounce() -> None:
    red = [numbers(**BEHIND, bounces=each)["red"] for each in ("0", "1", "2", "4", "all")]
    assert red[:2] == [0.0, 0.0]
    assert 0.0 < red[2] < red[3] <= red[4]


def test_the_shadow_has_the_colour_of_the_wall() -> None:
    seen = numbers(**BEHIND)
    assert seen["blue"] < 0.15 * seen["red"]
    white = numbers(**BEHIND, wall="white")
    assert white["blue"] == white["red"]


def test_without_bounces_all_light_is_the_lamps() -> None:
    found = planes(bounces="0", wall="white")
    np.testing.assert_allclose(found.all_light[0], found.lamp)
    np.testing.assert_allclose(found.all_light[1], found.lamp)


def test_near_the_edge_two_white_planes_are_brighter_by_nearly_the_factor_read_out() -> None:
    seen = numbers(light_angle=45, wall="white", place=0.01)
    assert seen["red"] / seen["lamp"] == pytest.approx(seen["factor"], rel=0.05)


def test_the_picture_shows_the_floor_below_and_the_wall_above() -> None:
    raster = frame(light_angle=40).panels[1].raster
    assert raster is not None
    found = planes(light_angle=40).all_light
    middle = raster.shape[0] // 2
    for row, side in ((middle, 0), (middle - 1, 1)):
        light = decode_srgb(raster[row, 200, :3] / 255.0)
        near_edge = np.clip([found[0, side, 1], found[1, side, 1]], 0, 1)
        np.testing.assert_allclose(light[:2], near_edge, atol=0.05)


def test_in_a_shadow_with_bounces_gathered_where_they_are_seen_its_border_stays_sharp() -> None:
    floor = planes(light_angle=110).all_light[0, 0]
    steps = np.diff(floor)
    assert steps.max() == pytest.approx(0.8 * np.sin(np.radians(110)), abs=0.02)
