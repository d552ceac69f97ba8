"""The Lambertian figure shows what its formula says."""

from functools import partial

import numpy as np
import pytest
from support.frames import frame_of, pixels_of, texts_of

from simulations.engine.stages import StageCache
from simulations.scenes.lambertian_shading.scene import SCENE

frame = partial(frame_of, SCENE)


def test_the_worked_example_of_the_chapter() -> None:
    assert texts_of(frame()) == {
        "cosine": "0.866",
        "theta": "30",
        "albedo": "0.80",
        "brightness": "0.693",
        "code": "217",
    }


def test_the_pixel_at_the_probed_point_has_the_value_read_out() -> None:
    raster = pixels_of(frame())
    height, width = raster.shape[:2]
    assert abs(int(raster[height // 2, width // 2, 0]) - 217) <= 1


def test_a_light_behind_leaves_the_disc_black() -> None:
    raster = pixels_of(frame(light_angle=180))
    height, width = raster.shape[:2]
    assert not raster[height // 2, width // 2 - 120 : width // 2 + 120, :3].any()


def test_light_from_left_and_right_mirror_one_another() -> None:
    left, right = (pixels_of(frame(light_angle=angle)) for angle in (-70, 70))
    off = np.abs(left.astype(int) - right[:, ::-1].astype(int))
    assert off.max() <= 1


def test_the_albedo_scales_light_that_is_there() -> None:
    cache = StageCache()
    frame("", cache)
    again = frame("", cache, albedo=0.3)
    assert [stage.name for stage in again.stages if stage.status == "computed"] == [
        "shade",
        "picture",
    ]


@pytest.mark.parametrize(("light", "probe", "theta"), [(30, 0, 50), (30, 60, 45), (-120, -40, 100)])
def test_the_point_on_the_curve_is_led_to_an_angle_from_the_light(
    light: float, probe: float, theta: float
) -> None:
    """58 to 382 units of the plot are 0° to 180°."""
    settings = SCENE.check({"light_angle": light, "probe": probe})
    pulled = SCENE.pull(settings, "probe-curve", (58 + 324 * theta / 180, 100.0))
    shown = texts_of(frame(light_angle=light, probe=float(pulled["probe"])))
    assert shown["theta"] == str(theta)
