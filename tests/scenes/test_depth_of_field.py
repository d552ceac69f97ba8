"""The depth-of-field figure: limits of focus, and the blur in the picture."""

from itertools import islice
from typing import Any

import numpy as np
import pytest
from support.frames import estimates_of, frame_of, pixels_of

from simulations.engine.settings import values_of
from simulations.engine.stages import StageCache
from simulations.models.lens import thin_lens
from simulations.models.lens.depth_of_field import Layer
from simulations.scenes.depth_of_field.scene import (
    LARGEST_DRAWN_PX,
    SCENE,
    diagram_f_number,
    parameters,
)
from simulations.scenes.depth_of_field.stages import FAR_M, HEIGHT, NEAR_M, depth_of
from simulations.world.layers import LitScene
from simulations.world.still_life_camera import PITCH_MM


def test_focus_inside_the_focal_length_has_no_image_stages_or_error() -> None:
    shown = frame_of(SCENE, focal_length=100, focus=0.05)
    assert {item.text for item in shown.readouts[:5]} == {"none"}
    assert shown.stages == ()
    (estimate,) = estimates_of(SCENE, "layered", focal_length=100, focus=0.1)
    assert estimate.unit == ""


@pytest.mark.parametrize("focal", [24, 49, 135])
@pytest.mark.parametrize("focus", [0.15, 0.5, 3.2, 10])
def test_drawn_blur_is_limited_by_stopping_down(focal: float, focus: float) -> None:
    settings = SCENE.check({"focal_length": focal, "focus": focus})
    drawn = diagram_f_number(settings)
    ends_mm = [1000 * NEAR_M, 1000 * FAR_M]
    discs = thin_lens.circle_of_confusion_mm(focal, drawn, 1000 * focus, ends_mm)
    assert discs.max() / PITCH_MM <= LARGEST_DRAWN_PX + 1e-9
    assert drawn >= settings.aperture
    read = parameters(settings, "") or {}
    assert read["aperture"] == drawn
    assert set(read) & set(values_of(settings)) == {"aperture"}
    noted = (
        "no disc over 48 px" in frame_of(SCENE, "pinhole", **values_of(settings)).panels[0].overlay
    )
    assert noted == (drawn > settings.aperture)
    if 1000 * focus < 500:  # everything lies behind the focus, and the wall is blurred most
        wall_mm = thin_lens.circle_of_confusion_mm(focal, 1.4, 1000 * focus, 1000 * FAR_M)
        assert drawn == pytest.approx(1.4 * max(1, float(wall_mm) / PITCH_MM / LARGEST_DRAWN_PX))


def test_picture_grows_with_the_sensors_distance_from_the_lens() -> None:
    """Not with the focal length: 1/f = 1/s + 1/z puts the sensor at z, and x = z X / Z."""

    def width_of_the_red_ball(focus: float) -> int:
        raster = pixels_of(frame_of(SCENE, "pinhole", focus=focus)).astype(int)
        red, green, blue = (raster[..., part] for part in range(3))
        return int(((red > 2 * green) & (red > 2 * blue)).sum(axis=1).max())

    z_near, z_far = (1 / (1 / 50 - 1 / mm) for mm in (250, 10_000))
    wider = width_of_the_red_ball(0.25) / width_of_the_red_ball(10)
    assert wider == pytest.approx(z_near / z_far, rel=0.03)


def test_every_tier_and_its_reference_have_the_same_scale() -> None:
    """The sensor is 12 % farther away than the focal length, so that mixing the two would show."""
    lens: dict[str, Any] = {"focal_length": 135, "aperture": 22, "focus": 1.25}
    layered, *others = (
        pixels_of(frame_of(SCENE, tier, **lens))[..., :3].astype(float)
        for tier in ("layered", "discs", "fibonacci-16")
    )
    errors = SCENE.estimates(SCENE.check(lens), "layered", StageCache())
    after_ten_rays = next(islice(errors, 9, None))
    assert float(after_ten_rays.text) < 3
    for other in others:
        assert np.sqrt(np.mean((other - layered) ** 2)) < 3


def test_pixel_has_the_depth_of_the_nearest_object() -> None:
    ones = np.ones((4, 3, 4), np.float32)
    half = ones * np.float32(0.5)
    lit = LitScene(
        base=np.zeros((3, 6, 8), np.float32),
        base_depth=np.full((6, 8), 9.0),
        layers=(Layer(ones, 1, 2), Layer(ones, -1, 6), Layer(half, 0, 0), Layer(ones, 5, -2)),
        depths=(5.0, 4.0, 3.0, 2.0),
    )
    expected = np.full((6, 8), 9.0)
    expected[1:4, 2:6] = 5
    expected[0:2, 6:8] = 4
    expected[5, 0:2] = 2
    np.testing.assert_array_equal(depth_of(lit), expected)


@pytest.mark.parametrize("focus", [0.3, 2.0, 3.2, 6.0, 9.0])
def test_floor_line_and_handle_lie_where_the_floor_is_in_focus(focus: float) -> None:
    stages = StageCache()
    shown = frame_of(SCENE, "", stages, focus=focus)
    rows = [place.y for place in shown.handles if place.name == "floor"]
    assert bool(rows) == ("casing" in shown.panels[0].overlay) == (1 < focus < 8)
    if rows:
        outputs = SCENE.run(SCENE.check({"focus": focus}), "", stages).outputs
        depth = outputs["light"].base_depth[:, 3]
        row = rows[0] / HEIGHT * len(depth) - 0.5
        assert np.interp(row, np.arange(len(depth)), depth) == pytest.approx(focus, rel=0.01)
