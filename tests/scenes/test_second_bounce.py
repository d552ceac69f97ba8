"""The second-bounce figure shows what two planes throw at each other."""

import numpy as np
import pytest

from simulations.engine.frame import Frame
from simulations.engine.stages import StageCache
from simulations.models.color.srgb import decode_srgb
from simulations.scenes.second_bounce import profile, section
from simulations.scenes.second_bounce.scene import SCENE
from simulations.scenes.second_bounce.stages import Planes

BEHIND = {"light_angle": 105, "place": 0.12}


def frame(**given: object) -> Frame:
    return SCENE.render(SCENE.check(given), "", StageCache())


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


def test_lamp_wall_and_point_go_where_they_are_led() -> None:
    settings = SCENE.check({})
    assert SCENE.pull(settings, "lamp", section.towards(120, 80)) == {"light_angle": 120}
    assert SCENE.pull(settings, "wall", section.towards(70, 300)) == {"opening": 70}
    assert SCENE.pull(settings, "point", section.towards(0, 0.4 * section.LENGTH)) == {
        "place": pytest.approx(0.4)
    }
    assert SCENE.pull(settings, "plotted", profile.at(0.6, 0.1)) == {"place": pytest.approx(0.6)}
    below = (section.EDGE[0] + 50, section.EDGE[1] + 30)
    assert SCENE.pull(settings, "lamp", below) == {"light_angle": 10}
