"""The two views: what the figure says of a lamp is what similar triangles say."""

import math
import re
from functools import partial

import numpy as np
import pytest
from numpy.typing import NDArray
from support.frames import frame_of, pixels_of, texts_of

from simulations.scenes.two_views import plan
from simulations.scenes.two_views.scene import SCENE
from simulations.scenes.two_views.view import view_of

frame = partial(frame_of, SCENE)


def texts(**given: object) -> dict[str, str]:
    return {name: text.replace("−", "-") for name, text in texts_of(frame(**given)).items()}


@pytest.mark.parametrize(
    ("depth", "focal", "baseline"), [(8, 160, 0.5), (2, 80, 1.0), (20, 320, 0.1)]
)
def test_disparity_is_focal_length_times_baseline_over_depth(
    depth: float, focal: float, baseline: float
) -> None:
    for left_x in (-20, 0, 35):
        shown = texts(depth=depth, focal_length=focal, baseline=baseline, left_x=left_x)
        assert float(shown["d"]) == pytest.approx(focal * baseline / depth, abs=0.051)
        assert float(shown["parallel"]) == pytest.approx(depth, abs=0.051)
        assert float(shown["off_row"]) == 0.0


def test_an_error_as_large_as_the_disparity_leaves_the_depth_open() -> None:
    for error in (4.0, 3.9):
        far = texts(depth=20, matching_error=error)["interval"]
        assert far.endswith("∞") is (error == 4.0)


def test_turned_cameras_are_told_wrong_depths_by_the_formula_for_parallel_ones() -> None:
    """The right image moves right by the turn: x' = f tan(atan(x/f) + θ)."""
    right = 160 * math.tan(math.atan((30 - 10) / 160) + math.radians(3))
    shown = texts(toe_in=3)
    assert float(shown["d"]) == pytest.approx(30 - right, abs=0.051)
    assert float(shown["parallel"]) == pytest.approx(80 / (30 - right), abs=0.051)


def test_while_the_focal_length_moves_the_same_is_shown_in_fewer_pixels() -> None:
    (draft,) = {SCENE.drafts_of("")["focal_length"]}
    rest, moving = frame(focal_length=200), frame_of(SCENE, draft, focal_length=200)
    assert texts_of(moving) == texts_of(rest)
    for panel in (1, 2):
        fine, coarse = pixels_of(rest, panel), pixels_of(moving, panel)
        assert coarse.size < fine.size / 2
        assert [fine[at].mean() for at in halves(fine)] == pytest.approx(
            [coarse[at].mean() for at in halves(coarse)], abs=2
        )


def halves(picture: NDArray[np.uint8]) -> list[tuple[slice, slice]]:
    """Upper and lower, each left and right."""
    rows, columns = (size // 2 for size in picture.shape[:2])
    return [
        (down, across)
        for down in (slice(rows), slice(rows, None))
        for across in (slice(columns), slice(columns, None))
    ]


def test_the_two_rays_meet_in_the_lamp_however_the_camera_is_turned() -> None:
    for toe_in in (0, 7, 30):
        view = view_of(SCENE.check({"toe_in": toe_in, "left_x": -44}))
        assert view.pair.depth(view.left, view.right) == pytest.approx(8.0)
        assert view.nearest < 8.0 < view.farthest


@pytest.mark.parametrize("toe_in", [0, 12, 30])
def test_at_any_depth_the_right_image_is_on_the_drawn_line(toe_in: float) -> None:
    overlay = frame(toe_in=toe_in, left_up=70).panels[1].overlay
    found = re.search(r'class="ray thin faint" points="([^"]+)"', overlay)
    assert found is not None
    (x0, y0), (x1, y1) = (map(float, spot.split(",")) for spot in found.group(1).split())
    for depth in (2, 5, 20):
        view = view_of(SCENE.check({"toe_in": toe_in, "left_up": 70, "depth": depth}))
        x, y = 200 + 2 * view.right[0], 150 + 2 * view.right[1]
        off = (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)
        assert abs(off) / math.hypot(x1 - x0, y1 - y0) < 0.02


def test_the_essential_matrix_is_the_baseline_crossed_with_the_turn() -> None:
    rows = texts(baseline=1, toe_in=30)["E"].split("\n")
    entries = np.array([row.split() for row in rows], float)
    cos, sin = math.cos(math.radians(30)), math.sin(math.radians(30))
    t = -1.0 * np.array([cos, 0, -sin])
    cross = np.array([[0, -t[2], t[1]], [t[2], 0, -t[0]], [-t[1], t[0], 0]])
    R = np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])
    np.testing.assert_allclose(entries, cross @ R, atol=0.0051)


def test_both_cameras_see_the_tile_under_the_post_where_they_see_its_foot() -> None:
    """The raster of the right picture is that of the left one, moved by the foot's disparity."""
    right, left = (pixels_of(frame(baseline=0.5), panel) for panel in (1, 2))
    row = 120 + round(1.6 * 160 * 1.5 / 4.0)  # the floor 4 m away
    shift = round(1.6 * 160 * 0.5 / 4.0)
    near = np.abs(left[row, shift:, :3].astype(int) - right[row, :-shift, :3]).mean()
    still = np.abs(left[row, :, :3].astype(int) - right[row, :, :3]).mean()
    assert near < 0.25 * still


def test_an_image_outside_the_right_picture_offers_none_to_the_hand() -> None:
    outside = {"depth": 2, "baseline": 1, "left_x": -50}
    assert "right" not in {place.name for place in frame(**outside).handles}


def test_the_depths_left_open_by_the_match_are_marked_on_the_axis() -> None:
    view = view_of(SCENE.check({}))
    marked = re.findall(
        r'<line class="error bold" x1="([^"]+)"[^>]*x2="([^"]+)"', overlay_of_plan()
    )
    left, right = map(float, marked[-1])
    assert left == pytest.approx(plan.above(view.nearest, 0.0)[0], abs=0.01)
    assert right == pytest.approx(plan.above(view.farthest, 0.0)[0], abs=0.01)


def test_without_an_error_no_depths_are_left_open() -> None:
    assert "error" not in overlay_of_plan(matching_error=0)


def overlay_of_plan(**given: object) -> str:
    return frame(**given).panels[0].overlay
