"""Figures of camera poses: one camera turned, one moved, and a pair."""

import math
import re

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.frames import estimates_of, frame_of, outputs_of, texts_of

from simulations.models.geometry import euler
from simulations.models.geometry.quaternion_blends import BLENDS
from simulations.models.projection.pinhole import intrinsics, look_at, pixel_rays
from simulations.scenes._turned_camera import view_from
from simulations.scenes.camera_pose import HEIGHT, WALLS, WIDTH, space, standpoint, to_camera
from simulations.scenes.gimbal import FOCAL, MIDDLE, rings_of, towards, view_box_places
from simulations.scenes.rotation_3d import SCENE as ROTATION
from simulations.scenes.rotation_3d import orientation, paths, turned_deg
from simulations.scenes.tiled_floor.scene import SCENE as FLOOR
from simulations.scenes.two_views.scene import SCENE as TWO_VIEWS
from simulations.scenes.two_views.scene import view_of
from simulations.scenes.two_views.view import Pair, pose_of
from simulations.world.room import look


@pytest.mark.parametrize("pan", [-180, -90, -55, 0, 33, 90])
@pytest.mark.parametrize("place", [(0, -2), (0, 6), (12, -2), (12, 6), (4, 2.5)])
def test_pan_turns_a_level_camera_whose_field_ends_at_the_walls(
    pan: float, place: tuple[float, float]
) -> None:
    here = standpoint(pan, *place)
    centre = np.array([place[0], 0.0, place[1]])
    ahead = np.array([np.sin(np.radians(pan)), 0.0, np.cos(np.radians(pan))])
    np.testing.assert_allclose(here.pose, look_at(centre, centre + ahead, (0, -1, 0)), atol=1e-12)
    np.testing.assert_allclose(here.centre, centre, atol=1e-12)
    field = here.in_camera_axes(here.field)
    assert (np.abs(field[:, 0]) <= np.tan(np.radians(30)) * field[:, 2] + 1e-9).all()
    assert (here.field >= WALLS.min(axis=0) - 1e-9).all()
    assert (here.field <= WALLS.max(axis=0) + 1e-9).all()
    above = space(0.0, 90.0)
    for panel in (above.all, to_camera(here, above)):
        corners = panel(WALLS)
        assert (corners > 0.0).all(), "the whole room is shown"
        assert (corners < [WIDTH, HEIGHT]).all()


@pytest.mark.parametrize("angles", [(50, 25, -70), (40, 90, -69), (0, -90, 10)])
def test_beads_lie_where_pan_tilt_and_roll_turn_their_rings(
    angles: tuple[float, float, float],
) -> None:
    rings = pan, tilt, roll = rings_of(*angles)
    C = euler.to_matrix("YXZ", np.radians(angles))
    for ring, expected in zip(rings, (tilt.zero, C[:, 2], C[:, 0]), strict=True):
        np.testing.assert_allclose(ring.at(ring.angle_rad) / ring.radius, expected, atol=1e-12)
    assert abs(pan.axis @ roll.axis) == pytest.approx(abs(np.sin(np.radians(angles[1]))))


@pytest.mark.parametrize(("azimuth", "elevation"), [(0, 0), (51, 28), (-130, 75)])
def test_orbited_view_equals_the_view_from_a_distant_eye(azimuth: float, elevation: float) -> None:
    """Straight ahead is z, to the right x; y points down."""
    eye = Rotation.from_euler("YX", [azimuth, elevation], degrees=True).apply([0.0, 0.0, 1.0])
    expected = look_at(100 * eye, (0, 0, 0), (0, -1, 0))[:3, :3]
    np.testing.assert_allclose(view_from(azimuth, elevation), expected, atol=1e-12)


@pytest.mark.parametrize(
    ("angles", "direction", "expected"),
    [
        ((60, 30, -20), (60, 30), (0, 0)),  # pan and tilt are azimuth and elevation of the sight
        ((60, 30, -20), (-120, -30), (np.nan, np.nan)),  # behind the camera
        ((0, 0, 0), (10, 0), (np.tan(np.radians(10)), 0)),  # upright and not mirrored
        ((0, 0, 0), (0, 10), (0, -np.tan(np.radians(10)))),
    ],
)
def test_directions_are_pictured_where_the_turned_camera_sees_them(
    angles: tuple[float, ...], direction: tuple[float, float], expected: tuple[float, float]
) -> None:
    C = euler.to_matrix("YXZ", np.radians(angles))
    place = view_box_places(C, towards(*direction))
    np.testing.assert_allclose(place, MIDDLE + FOCAL * np.array(expected), atol=1e-9)


@pytest.mark.parametrize("angles", [(105, 40, -40), (-150, -20, 120), (30, 90, 10)])
def test_orientation_composes_turns_about_moving_axes_y_x_z(
    angles: tuple[float, float, float],
) -> None:
    here = orientation(*angles)
    expected = Rotation.from_euler("YXZ", angles, degrees=True)
    np.testing.assert_allclose(here.C, expected.as_matrix(), atol=1e-14)
    w_last = np.roll(here.q, -1)
    assert abs(w_last @ expected.as_quat()) == pytest.approx(1)


@pytest.mark.parametrize("pan", [180.0, np.nextafter(180.0, 360.0)])
def test_half_a_turn_does_not_depend_on_rounding(pan: float) -> None:
    np.testing.assert_array_equal(orientation(pan, 0.0, 0.0).q, [0, 0, 1, 0])


@pytest.mark.parametrize("tier", BLENDS)
def test_camera_follows_the_arc_or_the_chord_of_its_tier(tier: str) -> None:
    """At a fifth of the way, as all tiers agree at half; at 170° a chord errs by degrees."""
    turned = paths(orientation(170.0, 0.0, 0.0), tier)["slerp"](0.2)
    angle_deg = np.degrees(np.arctan2(turned[0, 2], turned[2, 2]))
    arc = np.radians(170 / 2)
    chord_deg = np.degrees(2 * np.arctan2(0.2 * np.sin(arc), 0.8 + 0.2 * np.cos(arc)))
    expected, within = {"nlerp": (chord_deg, 1e-9), "paced-nlerp": (34, 0.05)}.get(tier, (34, 1e-9))
    assert angle_deg == pytest.approx(expected, abs=within)
    # The line of sight stays under the pointer: from 0.2 to 0.35.
    shares = [{"pan": 170, "tilt": 20, "t": share} for share in (0.2, 0.35)]
    there = frame_of(ROTATION, tier, **shares[1]).handles
    place = next((handle.x, handle.y) for handle in there if handle.name == "sight")
    assert ROTATION.pull(ROTATION.check(shares[0]), "sight", place, tier) == {"t": 0.35}


def test_error_of_nlerp_follows_the_chord_and_exact_tiers_have_none() -> None:
    """Half a turn: the places at share s of the chord are seen at atan2(s, 1 - s) of the arc."""
    shares = np.linspace(0, 1, 61)
    off = np.degrees(2 * np.abs(np.arctan2(shares, 1 - shares) - shares * np.pi / 2))

    def error_of(tier: str, **given: float) -> str:
        return estimates_of(ROTATION, tier, **given)[-1].text

    assert error_of("nlerp", pan=180, tilt=0, roll=0) == f"{off.max():.2f}"
    below, _, straight, *_ = (error_of(tier, pan=3, tilt=0, roll=0) for tier in BLENDS)
    assert below == straight, "3° is below the threshold: the straight line"
    assert [error_of(tier, pan=120) for tier in list(BLENDS)[2:]] == ["under 10⁻¹²"] * 2


@pytest.mark.parametrize("share", [0.0, 0.2, 0.5, 0.9, 1.0])
def test_angle_turned_on_each_path_is_its_rotations_magnitude(share: float) -> None:
    """Slerp turns at a steady speed; a blend of entries as its nearest rotation."""
    here = orientation(105, 40, -40)
    there = {name: way(share) for name, way in paths(here, "slerp").items()}
    u, _, v = np.linalg.svd(there["matrix"])
    expected = {
        "slerp": share * np.degrees(Rotation.from_matrix(here.C).magnitude()),
        "euler": np.degrees(Rotation.from_matrix(there["euler"]).magnitude()),
        "matrix": np.degrees(Rotation.from_matrix(u @ v).magnitude()),
    }
    assert {name: turned_deg(C) for name, C in there.items()} == pytest.approx(expected, abs=1e-9)


def test_drawn_lines_of_the_box_run_through_their_vanishing_point() -> None:
    overlay = frame_of(FLOOR, pitch=20).panels[1].overlay
    found = re.search(r'class="ray thin dashed" d="M([^"]+)"', overlay)
    assert found is not None
    ends = [line.split("L")[-1].split(",") for line in found.group(1).split("M")]
    (x, y), _, _ = outputs_of(FLOOR, pitch=20)["camera"].vanishing[0]
    goal = (x + 400.5) / 3, (y + 300.5) / 3
    assert sum(math.dist(map(float, end), goal) < 0.02 for end in ends) == 3


def test_box_is_put_where_the_pointer_meets_the_floor() -> None:
    """Looking level, 80 px below the horizon, the floor is 320 · 1.6 / 80 = 6.4 m away."""
    settings = FLOOR.check({"pitch": 0, "yaw": 0})
    values = FLOOR.pull(settings, "box", (200.5 + 50, 150.5 + 80))
    assert values == {"box_x": 1.0, "box_y": 6.4}


@pytest.mark.parametrize("toe_in", [0, 12, 30])
def test_lamp_is_triangulated_and_its_image_lies_on_the_epipolar_line(toe_in: float) -> None:
    given = {"toe_in": toe_in, "left_up": 40, "left_x": -44}
    overlay = frame_of(TWO_VIEWS, **given).panels[1].overlay
    found = re.search(r'class="ray thin faint" points="([^"]+)"', overlay)
    assert found is not None
    (x0, y0), (x1, y1) = (map(float, spot.split(",")) for spot in found.group(1).split())
    for depth in (2, 5, 9):
        view = view_of(TWO_VIEWS.check({**given, "depth": depth}))
        assert view.pair.depth(view.left, view.right) == pytest.approx(depth)
        assert view.nearest < depth < view.farthest
        x, y = 200 + 2 * view.right[0], 150 + 2 * view.right[1]
        off = (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)
        assert abs(off) / math.hypot(x1 - x0, y1 - y0) < 0.02


def test_essential_matrix_is_the_baseline_crossed_with_the_rotation() -> None:
    rows = texts_of(frame_of(TWO_VIEWS, baseline=1, toe_in=30))["E"].replace("−", "-").split("\n")
    cos, sin = math.cos(math.radians(30)), math.sin(math.radians(30))
    R = np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])
    expected = np.cross([-cos, 0, sin], R, axisb=0, axisc=0)
    np.testing.assert_allclose(
        np.array([row.split() for row in rows], float), expected, atol=0.0051
    )


@pytest.mark.parametrize("toe_in", [0, 12])
def test_both_photographs_show_a_place_where_the_pair_projects_it(toe_in: float) -> None:
    pair, columns = Pair(160.0, 0.5, math.radians(toe_in)), 200
    K = intrinsics(160.0, (99.5, 74.5))
    left, right = (look(K, pose_of(pair, side), columns, 150) for side in (False, True))
    rays = pixel_rays(K, columns, 150)
    pixels = np.rint(99.5 + pair.right(rays * left.depth[..., None]) - (0.0, 25.0)).astype(int)
    inside = np.all((pixels >= 0) & (pixels < (columns, 150)), axis=-1)
    x, y = pixels[inside].T
    off = np.linalg.norm(right.points[y, x] - left.points[inside], axis=-1)
    assert inside.mean() > 0.5
    assert np.mean(off < 0.1) > 0.8, "the rest is hidden from the right camera"
