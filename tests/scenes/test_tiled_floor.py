"""The tiled floor: what it says of horizon and vanishing points is plain trigonometry."""

import math
import re
from functools import partial

import numpy as np
import pytest
from support.frames import frame_of, pixels_of, texts_of

from simulations.scenes.tiled_floor.scene import SCENE

frame = partial(frame_of, SCENE)


def texts(**given: object) -> dict[str, str]:
    return {name: text.replace("−", "-") for name, text in texts_of(frame(**given)).items()}


def pair(text: str) -> tuple[float, float]:
    x, y = re.findall(r"-?[\d.]+", text)
    return float(x), float(y)


def tangent(degrees: float) -> float:
    return math.tan(math.radians(degrees))


@pytest.mark.parametrize(("pitch", "focal", "down"), [(12, 320, 0), (-20, 150, 30), (60, 800, -9)])
def test_the_horizon_is_where_a_level_ray_meets_the_image_plane(
    pitch: float, focal: float, down: float
) -> None:
    for height in (0.4, 4.0):
        shown = texts(pitch=pitch, focal_length=focal, principal_y=down, height=height)
        assert float(shown["horizon"]) == pytest.approx(
            150 + down - focal * tangent(pitch), abs=0.06
        )


@pytest.mark.parametrize("yaw", [-50, 10, 30, 45])
def test_a_level_camera_sees_the_rows_vanish_as_far_aside_as_it_is_turned(yaw: float) -> None:
    shown = texts(pitch=0, yaw=yaw, principal_x=20)
    assert pair(shown["v1"]) == pytest.approx((220 - 320 * tangent(yaw), 150), abs=0.6)
    assert pair(shown["v2"]) == pytest.approx((220 + 320 / tangent(yaw), 150), abs=0.6)


def test_uprights_vanish_below_a_camera_that_looks_down() -> None:
    assert pair(texts(pitch=40)["v3"]) == pytest.approx((200, 150 + 320 / tangent(40)), abs=0.6)


@pytest.mark.parametrize(
    "given",
    [{}, {"pitch": 60, "roll": 30}, {"yaw": 0, "pitch": -20}, {"principal_x": 150, "yaw": -60}],
)
def test_the_picture_alone_gives_the_right_angle_and_the_height_of_the_box(
    given: dict[str, object],
) -> None:
    shown = texts(**given, box_height=2.3, box_x=0.5, box_y=8)
    assert shown["angle"] == "90.0"
    assert shown["box"] == "2.30"


def test_a_box_as_high_as_the_camera_reaches_the_horizon_wherever_it_stands() -> None:
    for x, y in ((2.2, 4.2), (0.0, 12.0), (3.0, 3.0)):
        shown = frame(box_height=1.6, box_x=x, box_y=y, roll=0)
        assert shown.description.endswith("with its top on the horizon."), (x, y)
        (top,) = (place for place in shown.handles if place.name == "top")
        assert top.y - 0.5 == pytest.approx(150 - 320 * tangent(12), abs=0.01)


def test_the_field_of_view_counts_from_a_principal_point_beside_the_middle() -> None:
    left, right = math.atan(350.5 / 320), math.atan(49.5 / 320)
    assert float(texts(principal_x=150)["view"]) == pytest.approx(
        math.degrees(left + right), abs=0.06
    )


def test_drawn_lines_of_the_box_run_through_their_vanishing_point() -> None:
    overlay = frame(pitch=20).panels[1].overlay
    found = re.search(r'class="ray thin dashed" d="([^"]+)"', overlay)
    assert found is not None
    x, y = pair(texts(pitch=20)["v1"])
    goal = np.array([(x + 400.5) / 3, (y + 300.5) / 3])
    lines = [
        np.array([spot.split(",") for spot in line.split("L")], float)
        for line in found.group(1)[1:].split("M")
    ]
    ends = [line for line in lines if np.linalg.norm(line[1] - goal) < 0.5]
    assert len(ends) == 3


def test_the_box_is_put_where_the_pointer_meets_the_floor() -> None:
    """Looking level, 80 px below the horizon, the floor is 320 · 1.6 / 80 = 6.4 m away."""
    settings = SCENE.check({"pitch": 0, "yaw": 0})
    values = SCENE.pull(settings, "box", (200.5 + 50, 150.5 + 80))
    assert values == {"box_x": 1.0, "box_y": 6.4}


def test_the_wide_panel_holds_the_picture_in_its_middle() -> None:
    picture, plane = (pixels_of(frame(), panel) for panel in (0, 1))
    inner = plane[120:240, 160:320]
    np.testing.assert_allclose(inner[..., :3].mean(), picture[..., :3].mean(), atol=1.0)
    assert plane[..., 3].sum() == 255 * inner.shape[0] * inner.shape[1]


def test_the_floor_is_drawn_finer_at_rest_than_while_the_camera_moves() -> None:
    drafts = SCENE.drafts_of("")
    assert {name for name in ("pitch", "box_x", "lines") if name in drafts} == {"pitch", "box_x"}
    rest, moved = (pixels_of(frame(tier), 0) for tier in ("", drafts["pitch"]))
    assert rest.shape[1] == 2 * moved.shape[1]
    halved = rest.reshape(240, 2, 320, 2, 4).mean(axis=(1, 3))
    assert np.abs(halved - moved).mean() < 4
    small = [pixels_of(frame(tier), 1) for tier in ("", drafts["pitch"])]
    assert small[0].shape == small[1].shape
