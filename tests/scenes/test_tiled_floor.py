"""The tiled floor: its box, its lines, and its rasters."""

import math
import re

import numpy as np
import pytest
from support.frames import frame_of, outputs_of, pixels_of

from simulations.scenes.tiled_floor.scene import SCENE


@pytest.mark.parametrize("place", [(2.2, 4.2), (0.0, 12.0), (3.0, 3.0)])
def test_a_box_as_high_as_the_camera_reaches_the_horizon(place: tuple[float, float]) -> None:
    shown = frame_of(SCENE, box_height=1.6, box_x=place[0], box_y=place[1])
    assert shown.description.endswith("with its top on the horizon.")
    (top,) = (place for place in shown.handles if place.name == "top")
    assert top.y - 0.5 == pytest.approx(150 - 320 * math.tan(math.radians(12)), abs=0.01)


def test_drawn_lines_of_the_box_run_through_their_vanishing_point() -> None:
    overlay = frame_of(SCENE, pitch=20).panels[1].overlay
    found = re.search(r'class="ray thin dashed" d="M([^"]+)"', overlay)
    assert found is not None
    ends = [line.split("L")[-1].split(",") for line in found.group(1).split("M")]
    (x, y), _, _ = outputs_of(SCENE, pitch=20)["camera"].vanishing[0]
    goal = (x + 400.5) / 3, (y + 300.5) / 3
    assert sum(math.dist(map(float, end), goal) < 0.02 for end in ends) == 3


def test_the_box_is_put_where_the_pointer_meets_the_floor() -> None:
    """Looking level, 80 px below the horizon, the floor is 320 · 1.6 / 80 = 6.4 m away."""
    settings = SCENE.check({"pitch": 0, "yaw": 0})
    values = SCENE.pull(settings, "box", (200.5 + 50, 150.5 + 80))
    assert values == {"box_x": 1.0, "box_y": 6.4}


def test_the_floor_is_half_as_fine_while_the_camera_moves_and_small_in_the_plane() -> None:
    drafts = SCENE.drafts_of("")
    assert {name for name in ("pitch", "box_x", "lines") if name in drafts} == {"pitch", "box_x"}
    rest, moved = frame_of(SCENE), frame_of(SCENE, drafts["pitch"])
    fine, coarse = pixels_of(rest, 0), pixels_of(moved, 0)
    halved = fine.reshape(240, 2, 320, 2, 4).mean(axis=(1, 3))
    assert np.abs(halved - coarse).mean() < 4
    for frame in (rest, moved):
        plane = pixels_of(frame, 1)
        inner = plane[120:240, 160:320]
        np.testing.assert_allclose(inner[..., :3].mean(), fine[..., :3].mean(), atol=1.0)
        assert plane[..., 3].sum() == 255 * inner.shape[0] * inner.shape[1]
