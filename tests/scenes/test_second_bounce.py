"""The second-bounce figure shows what two planes throw at each other."""

from functools import partial

import numpy as np
import pytest
from support.frames import frame_of

from simulations.engine.stages import StageCache
from simulations.models.color.srgb import decode_srgb
from simulations.scenes.second_bounce import ball, room
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


def pixel(at: tuple[float, float, float], **given: object) -> np.ndarray:
    """Linear RGB of the picture at a place in the room."""
    raster = frame(**given).panels[0].raster
    assert raster is not None
    x, y = (int(room.FINE * each) for each in room.project(at))
    assert raster[y, x, 3] == 255
    return decode_srgb(raster[y, x, :3] / 255.0)


@pytest.mark.parametrize("bounces", ["0", "2", "all"])
def test_far_from_the_ball_the_picture_shows_what_the_curves_say(bounces: str) -> None:
    given = {"light_angle": 40, "albedo": 0.5, "bounces": bounces}
    found = planes(**given).all_light
    for at, side in (((0.5, 0.0, -1.25), 0), ((0.0, 0.5, 0.7), 1)):
        np.testing.assert_allclose(pixel(at, **given)[:2], found[:, side, 100], atol=0.02)


def test_without_bounces_the_dark_side_and_the_shadow_of_the_ball_are_black() -> None:
    low = room.CENTRE - room.RADIUS * np.array([0.8, 0.6, 0])
    lit = ball.lamp_on((low - room.CENTRE) / room.RADIUS, np.radians(55), np.radians(90))
    assert lit == 0
    shadow = (float(room.CENTRE[0]) - 0.1, 0.0, float(room.CENTRE[2]) + 0.12)
    assert not pixel(shadow, bounces="0", light_angle=65).any()
    red, blue, _ = pixel(shadow, light_angle=65)
    assert red > 1.5 * blue > 0


def test_the_ball_gets_from_the_wall_what_the_form_factors_of_its_strips_say() -> None:
    """At the point that faces the wall squarely, half the difference of the sines of its ends."""
    seen = ball.surroundings(np.pi / 2)
    facing = int((-ball.normals()[:, 0]).argmax())
    of_wall = (seen.index[facing] > room.PARTS) & (seen.index[facing] < room.NOTHING)
    off = room.CENTRE[0] - room.RADIUS
    expected = 0.5 * sum(y / np.hypot(y, off) for y in (room.RADIUS, 1.0 - room.RADIUS))
    assert of_wall.mean() == pytest.approx(expected, abs=0.04)


def test_next_to_the_ball_the_floor_sees_all_of_it_and_far_away_little() -> None:
    up = np.array([0.0, 1, 0])
    under = np.array([room.CENTRE[0], 0, room.CENTRE[2]])
    assert ball.form_factor(under, up) == pytest.approx(1)
    assert ball.form_factor(under + np.array([0, 0, 1.0]), up) < 0.01


def test_in_a_shadow_with_bounces_gathered_where_they_are_seen_its_border_stays_sharp() -> None:
    floor = planes(light_angle=110).all_light[0, 0]
    steps = np.diff(floor)
    assert steps.max() == pytest.approx(0.8 * np.sin(np.radians(110)), abs=0.02)
