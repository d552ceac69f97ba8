"""The two views: the numbers of a lamp are those of similar triangles."""

import math
import re

import numpy as np
import pytest
from support.frames import frame_of, pixels_of, texts_of

from simulations.scenes.two_views.scene import SCENE, above, view_of


@pytest.mark.parametrize("toe_in", [0, 12, 30])
def test_rays_meet_in_the_lamp_and_its_image_is_on_the_drawn_line(toe_in: float) -> None:
    given = {"toe_in": toe_in, "left_up": 70, "left_x": -44}
    overlay = frame_of(SCENE, **given).panels[1].overlay
    found = re.search(r'class="ray thin faint" points="([^"]+)"', overlay)
    assert found is not None
    (x0, y0), (x1, y1) = (map(float, spot.split(",")) for spot in found.group(1).split())
    for depth in (2, 5, 20):
        view = view_of(SCENE.check({**given, "depth": depth}))
        assert view.pair.depth(view.left, view.right) == pytest.approx(depth)
        assert view.nearest < depth < view.farthest
        x, y = 200 + 2 * view.right[0], 150 + 2 * view.right[1]
        off = (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)
        assert abs(off) / math.hypot(x1 - x0, y1 - y0) < 0.02


def test_the_essential_matrix_is_the_baseline_crossed_with_the_turn() -> None:
    rows = texts_of(frame_of(SCENE, baseline=1, toe_in=30))["E"].replace("−", "-").split("\n")
    cos, sin = math.cos(math.radians(30)), math.sin(math.radians(30))
    R = np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])
    expected = np.cross([-cos, 0, sin], R, axisb=0, axisc=0)
    np.testing.assert_allclose(
        np.array([row.split() for row in rows], float), expected, atol=0.0051
    )


def test_both_cameras_see_the_tile_under_the_post_where_they_see_its_foot() -> None:
    """The raster of the right picture is that of the left one, moved by the foot's disparity."""
    right, left = (pixels_of(frame_of(SCENE, baseline=0.5), panel) for panel in (1, 2))
    row = 120 + round(1.6 * 160 * 1.5 / 4.0)  # the floor 4 m away
    shift = round(1.6 * 160 * 0.5 / 4.0)
    near = np.abs(left[row, shift:, :3].astype(int) - right[row, :-shift, :3]).mean()
    still = np.abs(left[row, :, :3].astype(int) - right[row, :, :3]).mean()
    assert near < 0.25 * still


def test_the_picture_is_the_same_in_fewer_pixels_while_the_focal_length_moves() -> None:
    draft = SCENE.drafts_of("")["focal_length"]
    rest, moving = frame_of(SCENE, focal_length=200), frame_of(SCENE, draft, focal_length=200)
    assert texts_of(moving) == texts_of(rest)
    for panel in (1, 2):
        fine, coarse = (pixels_of(frame, panel) for frame in (rest, moving))
        assert coarse.size < fine.size / 2
        sharp, rough = (
            [half.mean() for half in np.array_split(each, 2)] for each in (fine, coarse)
        )
        assert sharp == pytest.approx(rough, abs=2)


def test_depths_left_open_by_the_match_are_marked_on_the_axis() -> None:
    view = view_of(SCENE.check({}))
    overlay = frame_of(SCENE).panels[0].overlay
    marked = re.findall(r'<line class="error bold" x1="([^"]+)"[^>]*x2="([^"]+)"', overlay)
    expected = [above(depth, 0.0)[0] for depth in (view.nearest, view.farthest)]
    assert [float(end) for end in marked[-1]] == pytest.approx(expected, abs=0.01)
    assert "error" not in frame_of(SCENE, matching_error=0).panels[0].overlay
    assert texts_of(frame_of(SCENE, depth=20, matching_error=4))["interval"].endswith("∞")
    assert not texts_of(frame_of(SCENE, depth=20, matching_error=3.9))["interval"].endswith("∞")
