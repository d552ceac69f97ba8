"""Figures on reflection: pictures, curves and readouts agree with the models."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from support.frames import estimates_of, frame_of, number_of, outputs_of, pixels_of, texts_at

from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.light.interreflection import CELLS
from simulations.models.light.reflectance import blinn_phong, lambert, phong
from simulations.scenes import _ball
from simulations.scenes._ball import (
    LIT,
    PIXELS_PER_UNIT,
    RADIUS_PX,
    VASE,
    build_ball,
    build_vase,
    light_direction,
)
from simulations.scenes.brdf import materials
from simulations.scenes.brdf.scene import AROUND_DEG, INCIDENCE_DEG
from simulations.scenes.brdf.scene import MODELS as BRDFS
from simulations.scenes.brdf.scene import SCENE as BRDF
from simulations.scenes.lambertian_shading import SCENE as LAMBERTIAN
from simulations.scenes.phong.scene import ALBEDO, lobe
from simulations.scenes.phong.scene import SCENE as PHONG
from simulations.scenes.second_bounce import room
from simulations.scenes.second_bounce.scene import COLUMNS
from simulations.scenes.second_bounce.scene import SCENE as BOUNCE

BODIES = {LAMBERTIAN.id: build_ball(), PHONG.id: build_vase()}
GLOSS = {"phong": phong, "blinn_phong": blinn_phong}


def normals_64(scene: Any) -> NDArray[np.float64]:
    """(h, w, 3) unit normals of the body's own pixels; towards the camera elsewhere."""
    body = BODIES[scene.id]
    x, y = np.meshgrid(body.x.astype(float) / RADIUS_PX, body.y.astype(float) / RADIUS_PX)
    rising, step = y, 1e-6
    if scene is PHONG:
        radius = VASE.radius(y)
        rising = radius * (VASE.radius(y - step) - VASE.radius(y + step)) / (2 * step)
        depth = np.sqrt(np.maximum(radius**2 - x * x, 0))
    else:
        depth = np.sqrt(np.maximum(1 - x * x - y * y, 0))
    normals = np.where(body.inner[..., None], np.stack([x, rising, depth], axis=-1), (0, 0, 1.0))
    return np.asarray(normals / np.linalg.norm(normals, axis=-1, keepdims=True))


def estimate(scene: Any, tier: str, **given: object) -> float:
    (only,) = estimates_of(scene, tier, **given)
    return number_of(only.text)


@pytest.mark.parametrize("tier", LIT)
@pytest.mark.parametrize("model", ["lambert", *GLOSS])
def test_estimated_error_is_the_error_of_the_shown_pixels(tier: str, model: str) -> None:
    """Strength and albedo add up to less than 1, so that no pixel is cut off at white."""
    scene: Any = LAMBERTIAN
    given: dict[str, Any] = {"light_angle": 75}
    truth: Floats = lambert(normals_64(scene), light_direction(75), 0.8)
    if model in GLOSS:
        scene, shine = PHONG, {"specular": 0.35, "shininess": 9}
        red_paint = float(ALBEDO[0])
        truth = GLOSS[model](normals_64(scene), light_direction(75), [0, 0, 1], red_paint, **shine)
        given |= {**shine, "model": model}
    body = BODIES[scene.id]
    red = pixels_of(frame_of(scene, tier, **given))[body.square][..., 0][body.inner]
    seen = np.sqrt(np.mean((decode_srgb(red / 255.0) - truth[body.inner]) ** 2))
    assert seen == pytest.approx(estimate(scene, tier, **given), rel=0.05, abs=1.5e-3)


@pytest.mark.parametrize(
    ("scene", "given", "name"),
    [
        (LAMBERTIAN, {"probe": 40}, "code"),
        (LAMBERTIAN, {"probe": -20, "light_angle": -70}, "code"),
        (PHONG, {"probe": 15, "shininess": 4}, "brightness"),
        (PHONG, {"probe": 35, "model": "blinn_phong", "specular": 0.3}, "brightness"),
    ],
)
def test_pixel_at_the_probe_has_the_value_of_the_readout(
    scene: Any, given: dict[str, Any], name: str
) -> None:
    shown, (x, y) = (
        float(texts_at(scene, **given)[name]),
        _ball.on_equator(np.radians(given["probe"])),
    )
    pixel = pixels_of(frame_of(scene, **given))[
        round(y * PIXELS_PER_UNIT), round(x * PIXELS_PER_UNIT), 0
    ]
    assert pixel == pytest.approx(shown if name == "code" else 255 * encode_srgb(shown), abs=2)


@pytest.mark.parametrize("model", GLOSS)
@pytest.mark.parametrize(("light_angle", "probe"), [(60, 20), (100, 5), (150, 50), (-170, 40)])
def test_phong_lobe_and_readouts_follow_the_chapters_formula(
    model: str, light_angle: float, probe: int
) -> None:
    """By angles: the highlight only where the light is above the horizon."""
    turn, view = math.radians(light_angle - probe), math.radians(-probe)
    cosines = {"phong": math.cos(-turn - view), "blinn_phong": math.cos((turn + view) / 2)}
    shine = max(0, cosines[model]) ** 3 if math.cos(turn) > 0 else 0
    brightness = ALBEDO[0] * max(0, math.cos(turn)) + 0.5 * shine
    given = {"light_angle": light_angle, "probe": probe, "model": model}
    shown = texts_at(PHONG, **given, shininess=3, specular=0.5)
    names = ("brightness", "n_dot_l", "r_dot_v", "n_dot_h")
    values = [float(shown[name].replace("−", "-")) for name in names]
    assert values == pytest.approx([brightness, math.cos(turn), *cosines.values()], abs=6e-4)
    seen = lobe(light_angle - probe, model, 3, specular=0.5)[90 - probe]
    assert seen == pytest.approx(brightness, abs=1e-6)


@pytest.mark.parametrize("model", BRDFS)
@pytest.mark.parametrize(("light", "view"), [(-50, 38), (20, 60), (-70, 0), (0, -45)])
def test_ball_lobe_and_readouts_show_the_same_brdf(model: str, light: int, view: int) -> None:
    given = {"model": model, "specular": 0.05, "albedo": 0.4}
    here = {**given, "light_angle": light, "view_angle": view}
    (x, y), shown = materials.on_equator(-view), texts_at(BRDF, **here)
    pixel = pixels_of(frame_of(BRDF, **here))[round(y * materials.FINE), int(x * materials.FINE)]
    seen = float(shown["seen"])
    assert pixel[0] == pytest.approx(255 * min(float(encode_srgb(seen)), 1), abs=3)
    outputs, turned = outputs_of(BRDF, **here), {"light_angle": view, "view_angle": light}
    assert np.interp(view, AROUND_DEG, outputs["lobe"]) == pytest.approx(seen, abs=8e-3)
    curve = np.interp(abs(light), INCIDENCE_DEG, outputs["sent back"])
    assert curve == pytest.approx(float(shown["sent"]), abs=0.02)
    other = texts_at(BRDF, **given, **turned)
    assert (shown["there"], shown["back"]) == (other["back"], other["there"])
    oblique = abs(light) != abs(view)
    assert shown["reciprocal"] == ("no" if model == "phong" and oblique else "yes")


def in_room(at: tuple[float, float, float], **given: object) -> Floats:
    """Linear RGB of the picture at a place in the room."""
    x, y = (int(COLUMNS / room.SIZE * each) for each in room.project(at))
    red, green, blue, _ = pixels_of(frame_of(BOUNCE, **given))[y, x].tolist()
    return decode_srgb(np.array([red, green, blue]) / 255.0)


def test_second_bounce_lights_the_shadow_in_the_colour_of_the_wall() -> None:
    beside = {"light_angle": 90, "place": 0.12}
    two, four, every = (
        float(texts_at(BOUNCE, **beside, bounces=each)["red"]) for each in ("2", "4", "all")
    )
    assert 0 < two < four <= every
    assert float(texts_at(BOUNCE, **beside)["blue"]) < 0.35 * every
    white = texts_at(BOUNCE, **beside, wall="white")
    assert white["blue"] == white["red"]


@pytest.mark.parametrize("bounces", ["0", "2", "all"])
def test_room_has_the_brightness_of_the_curves(bounces: str) -> None:
    given = {"light_angle": 60, "albedo": 0.5, "bounces": bounces}
    profile = outputs_of(BOUNCE, **given)["profile"]
    for at, place in (((0.0, 0.5, room.LINE), 36), ((0.25, 0.0, room.LINE), 91)):
        np.testing.assert_allclose(in_room(at, **given)[:2], profile.all_light[place], atol=0.02)
    assert np.allclose(profile.all_light[73:, 0], profile.lamp[73:]) == (bounces == "0")


def test_ball_gets_as_much_light_from_an_even_room_as_a_wall() -> None:
    arriving = room.light_on_ball() @ np.ones(6 * CELLS**2)
    view = room.view(COLUMNS)
    np.testing.assert_allclose(view.basis @ arriving, 1.0, atol=0.02)
    under = room.project((float(room.CENTRE[0]), 0.0, float(room.CENTRE[2]) + room.RADIUS))
    x, y = (int(COLUMNS / room.SIZE * each) for each in under)
    square = 2 * room.RADIUS**2
    expected = room.RADIUS**3 / square**1.5
    shown = view.hidden.reshape([COLUMNS] * 2)
    assert shown[y + 1, x] == pytest.approx(expected, rel=0.1)
