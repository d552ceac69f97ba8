"""The BRDF figure shows what its models say."""

import math
from functools import partial

import numpy as np
import pytest
from support.frames import frame_of, texts_at

from simulations.engine.stages import StageCache
from simulations.models.color.srgb import encode_srgb
from simulations.models.light.brdf import Material, reflected
from simulations.scenes.brdf import energy, materials
from simulations.scenes.brdf.scene import SCENE
from simulations.scenes.brdf.settings import MODELS
from simulations.scenes.brdf.spheres import TINT
from simulations.scenes.brdf.stages import AROUND_DEG

frame = partial(frame_of, SCENE)


texts = partial(texts_at, SCENE)

MIDDLE = tuple(round(materials.FINE * each) for each in reversed(materials.CENTRE))
"""The pixel at the ball's centre."""


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize(("light", "view"), [(-50, 38), (20, 60), (-70, 0), (0, -45)])
def test_the_pixel_at_the_probed_point_has_the_brightness_read_out(
    model: str, light: int, view: int
) -> None:
    shown = frame(model=model, light_angle=light, view_angle=view, specular=0.05, albedo=0.4)
    raster = shown.panels[0].raster
    assert raster is not None
    x, y = materials.on_equator(-view)
    pixel = raster[round(y * materials.FINE), int(x * materials.FINE)]
    seen = float(next(item for item in shown.readouts if item.name == "seen").text)
    assert pixel[0] == pytest.approx(255 * min(float(encode_srgb(seen)), 1), abs=3)


def test_the_matte_part_has_the_balls_colour_and_the_mirrored_that_of_the_lamp() -> None:
    matte = frame(model="lambert", light_angle=0, view_angle=0, albedo=0.6).panels[0].raster
    metal = frame(albedo=0, light_angle=0, view_angle=0, roughness=0.6).panels[0].raster
    assert matte is not None
    assert metal is not None
    expected = 255 * encode_srgb(0.6 * TINT)
    np.testing.assert_allclose(matte[MIDDLE][:3], expected, atol=1.5)
    assert np.ptp(metal[MIDDLE][:3]) == 0


def test_the_far_side_of_the_ball_is_black() -> None:
    raster = frame(light_angle=-88, view_angle=88).panels[0].raster
    assert raster is not None
    assert not raster[MIDDLE][:3].any()


@pytest.mark.parametrize("model", MODELS)
def test_the_lobe_is_what_cameras_all_round_would_see(model: str) -> None:
    run = SCENE.run(SCENE.check({"model": model, "light_angle": -50}), "", StageCache())
    for place in (10, 45, 70):
        view = int(AROUND_DEG[place])
        seen = float(texts(model=model, light_angle=-50, view_angle=view)["seen"])
        assert run.outputs["lobe"][place] == pytest.approx(seen, abs=6e-4)


def test_light_and_camera_exchanged_exchange_the_two_readouts() -> None:
    for model in MODELS:
        one = texts(model=model, light_angle=-70, view_angle=30)
        other = texts(model=model, light_angle=30, view_angle=-70)
        assert (one["there"], one["back"]) == (other["back"], other["there"])
        assert one["reciprocal"] == ("no" if model == "phong" else "yes")


def test_facets_send_light_beyond_the_mirrors_direction() -> None:
    around = np.radians(np.arange(0.0, 90.0, 0.5))
    light = math.radians(70)
    found = reflected(
        "microfacets",
        Material(0.0, 0.04, 0.3),
        np.array(math.cos(light)),
        np.cos(around),
        np.cos(light + around),
    )
    assert math.degrees(around[found.argmax()]) > 75


def test_a_sphere_of_the_chart_looks_like_the_ball_of_its_material() -> None:
    place = materials.at(1.0, 1.0)
    chosen = SCENE.pull(SCENE.check({}), "material", place)
    assert chosen == {"roughness": 1.0, "specular": 1.0}
    raster = frame(light_angle=10, view_angle=-10, **chosen).panels[0].raster
    assert raster is not None
    sample = raster[tuple(round(materials.FINE * each) for each in reversed(place))]
    np.testing.assert_allclose(sample[:3], raster[MIDDLE][:3], atol=4)


def test_the_curves_handle_leaves_the_lamp_on_its_side() -> None:
    assert SCENE.pull(SCENE.check({}), "incidence", energy.at(66, 0.2)) == {"light_angle": -66}
    right = SCENE.check({"light_angle": 10})
    assert SCENE.pull(right, "incidence", energy.at(66, 0.2)) == {"light_angle": 66}
