"""What the camera sees, and how large: things, vignetting, breathing and the dolly."""

import math
from functools import partial

import numpy as np
import pytest
from support.frames import outputs_of, texts_at

from simulations.models.distortion.lens_model import Distortion, distort
from simulations.models.light.raycasting import Sphere
from simulations.models.projection import pinhole
from simulations.pictures.still_life import things as still_life
from simulations.scenes._still_life_camera.rays import COLUMNS, PITCH_MM, ROWS, principal_mm
from simulations.scenes.camera.dolly import SUBJECT_M, after_step, focal_before_step
from simulations.scenes.camera.scene import SCENE, view_of

outputs = partial(outputs_of, SCENE, "layers")


@pytest.mark.parametrize("focus", [1.0, 10.0])
def test_silhouettes_of_balls_lie_where_projection_puts_them(focus: float) -> None:
    """Centroid of each ball's coverage against the centre of its projected outline."""
    sensor_mm = 24.0 * focus / (focus - 0.024)
    done = outputs(focal_length=24, focus=focus)
    rows, columns = done["pinhole rays"].valid.shape
    K = pinhole.intrinsics(sensor_mm / PITCH_MM, ((columns - 1) / 2, (rows - 1) / 2))
    seen = 0
    for surface in done["surfaces"]:
        if surface.thing is None or not isinstance(surface.thing.solid, Sphere):
            continue
        ball = surface.thing.solid
        centre = pinhole.world_to_camera(ball.centre, still_life.WORLD_TO_CAMERA)
        dual = K @ (np.outer(centre, centre) - ball.radius**2 * np.eye(3)) @ K.T
        column, row = dual[:2, 2] / dual[2, 2]
        rows, columns = np.indices(surface.coverage.shape)
        weight = surface.coverage / surface.coverage.sum()
        assert (weight * columns).sum() + surface.left == pytest.approx(column, abs=0.05)
        assert (weight * rows).sum() + surface.top == pytest.approx(row, abs=0.05)
        seen += 1
    assert seen == 4


def test_vignetting_darkens_a_wide_lens_by_cos4() -> None:
    """By the angle at which the sensor's corner sees the lens, from where the focus puts it."""
    for focal_length, focus in ((24, 10.0), (135, 1.0)):
        result = outputs(focal_length=focal_length, focus=focus)
        lit = result["trimming"][:, 0, 0] > 0
        ratio = (result["vignetting"] / np.maximum(result["trimming"], 1e-6))[lit, 0, 0]
        r = math.hypot((COLUMNS - 1) / 2, (ROWS - 1) / 2) * PITCH_MM
        sensor_mm = 1 / (1 / focal_length - 1 / (1000 * focus))
        assert ratio == pytest.approx(math.cos(math.atan(r / sensor_mm)) ** 4, rel=1e-4)


readouts = partial(texts_at, SCENE)


def test_the_picture_breathes_with_the_focus() -> None:
    """The field of view is that of the sensor's distance, and the plan shows the same."""
    near, far = readouts(focal_length=135, focus=1), readouts(focal_length=135, focus=10)
    assert (near["sensor_distance"], far["sensor_distance"]) == ("156.1", "136.8")
    for told, sensor_mm in ((near, 135 / 0.865), (far, 135 / 0.9865)):
        angle = 2 * math.degrees(math.atan(18 / sensor_mm))
        assert told["field_of_view"] == f"{angle:.1f}"


@pytest.mark.parametrize("focal_length", [24, 50, 135])
@pytest.mark.parametrize("k1", [-0.4, -0.1, 0.0, 0.1, 0.4])
def test_the_field_of_view_is_that_of_the_rays_that_the_lens_bends(
    focal_length: float, k1: float
) -> None:
    """Its edge is sent to the sensor's, or lies on the fold where no ray is sent so far out."""
    settings = SCENE.check({"focal_length": focal_length, "k1": k1})
    edge, r = 18.0 / principal_mm(focal_length, 3.2), math.tan(view_of(settings) / 2)
    if k1 == -0.4 and focal_length == 24:
        assert r == pytest.approx(math.sqrt(1 / 1.2), rel=1e-9)
        return
    assert r * (1 + k1 * r * r) == pytest.approx(edge, rel=1e-9)
    told = readouts(focal_length=focal_length, k1=k1)["field_of_view"]
    assert told == f"{math.degrees(2 * math.atan(r)):.1f}"


@pytest.mark.parametrize("name", ["striped ball", "red ball", "pearl"])
def test_a_dolly_zoom_keeps_the_striped_ball_and_squeezes_the_depth(name: str) -> None:
    """Three metres back, each outline has the area of its ellipse at z and Z of the new place."""
    areas, ellipses = [], []
    for back in (0, 3):
        parts = outputs(back=back, focal_length=24)["surfaces"]
        (ball,) = (part for part in parts if part.thing and part.thing.name == name)
        x, y, z = pinhole.world_to_camera(ball.thing.solid.centre, still_life.WORLD_TO_CAMERA)
        away, r = z + back, ball.thing.solid.radius
        assert ball.depth.max() == pytest.approx(away)
        scale = (SUBJECT_M + back) / SUBJECT_M
        outline = math.sqrt(x**2 + y**2 + away**2 - r**2) / (away**2 - r**2) ** 1.5
        areas.append(ball.coverage.sum())
        ellipses.append(scale**2 * outline)
    assert areas[1] / areas[0] == pytest.approx(ellipses[1] / ellipses[0], rel=0.01)
    assert (name == "striped ball") == (abs(areas[1] / areas[0] - 1) < 0.03)


def test_after_a_step_back_the_lens_is_longer_and_the_focus_on_the_same_thing() -> None:
    now = after_step(SCENE.check({"back": 2}))
    assert now.focus == pytest.approx(5.2)
    before = principal_mm(50, 3.2) / SUBJECT_M
    assert principal_mm(now.focal_length, now.focus) / (SUBJECT_M + 2) == pytest.approx(before)
    assert focal_before_step(principal_mm(now.focal_length, 5.2), 3.2, 2) == pytest.approx(50)


@pytest.mark.parametrize("k1", [-0.2, 0.2])
@pytest.mark.parametrize("thing", still_life.THINGS[:5], ids=lambda thing: thing.name)
def test_a_press_at_a_thing_in_the_photograph_brings_it_into_focus(
    thing: still_life.Thing, k1: float
) -> None:
    """All but the plum box, whose middle the green ball hides."""
    x, y, z = pinhole.world_to_camera(thing.solid.centre, still_life.WORLD_TO_CAMERA)
    sensor = 35.0 / (1 - 0.035 / 3.2) * distort((x / z, y / z), Distortion(k1=k1))
    place = (200 + sensor[0] * 400 / 36, 133.5 + sensor[1] * 267 / 24)
    values = SCENE.pull(SCENE.check({"focal_length": 35, "k1": k1}), "aim", place)
    assert values["focus"] == pytest.approx(z, abs=0.051)


def test_a_press_where_no_ray_arrives_leaves_the_focus() -> None:
    assert SCENE.pull(SCENE.check({"focal_length": 24, "k1": -0.4}), "aim", (1.0, 1.0)) == {}
