"""The gimbal figure: what its numbers claim, and that the lock can be seen in the rings."""

from functools import partial

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.frames import frame_of, texts_of

from simulations.engine.stages import StageCache
from simulations.models.geometry import euler
from simulations.models.projection.pinhole import look_at
from simulations.scenes._turned_camera import body
from simulations.scenes.gimbal import sight
from simulations.scenes.gimbal.rings import rings
from simulations.scenes.gimbal.scene import SCENE
from simulations.scenes.gimbal.sight import CENTRE, FOCAL, towards

frame = partial(frame_of, SCENE)


def test_the_chapters_example_of_lock_gives_the_same_matrix() -> None:
    locked, other = frame(pan=40, tilt=90, roll=10), frame(pan=30, tilt=90, roll=0)
    assert texts_of(locked)["axes"] == texts_of(other)["axes"]


@pytest.mark.parametrize("tilt", [-90, 90])
def test_locked_rings_lie_in_one_plane(tilt: float) -> None:
    pan_ring, _, roll_ring = rings(0.7, np.radians(tilt), -1.2)
    assert abs(pan_ring.axis @ roll_ring.axis) == pytest.approx(1)


def test_the_axes_end_where_the_beads_of_the_rings_say() -> None:
    angles = np.radians([50, 25, -70])
    pan_ring, tilt_ring, roll_ring = rings(*angles)
    C = euler.to_matrix("YXZ", angles)
    right, forward = C[:, 0], C[:, 2]
    np.testing.assert_allclose(tilt_ring.at(angles[1]) / tilt_ring.radius, forward, atol=1e-12)
    np.testing.assert_allclose(roll_ring.at(angles[2]) / roll_ring.radius, right, atol=1e-12)
    np.testing.assert_allclose(pan_ring.at(angles[0]) / pan_ring.radius, tilt_ring.zero, atol=1e-12)


def test_faces_are_painted_from_far_to_near() -> None:
    """Seen from ahead, the glass of the lens hides what is behind it, and is painted last."""
    drawn = body.draw(np.eye(3), body.view_from(0, 0), (0.0, 0.0), 100.0)
    assert drawn.rindex("image") > drawn.rindex("camera")


@pytest.mark.parametrize(("azimuth", "elevation"), [(0, 0), (51, 28), (-130, 75)])
def test_the_view_is_that_of_a_distant_eye_that_looks_at_the_camera(
    azimuth: float, elevation: float
) -> None:
    """Straight ahead is z, to the right x; y points down."""
    eye = Rotation.from_euler("YX", [azimuth, elevation], degrees=True).apply([0.0, 0.0, 1.0])
    expected = look_at(100 * eye, (0, 0, 0), (0, -1, 0))[:3, :3]
    np.testing.assert_allclose(body.view_from(azimuth, elevation), expected, atol=1e-12)


def test_what_is_near_follows_the_finger_that_turns_the_view() -> None:
    settings = SCENE.check({})
    near = -body.view_from(settings.azimuth, settings.elevation)[2]
    x, y = 2 * settings.azimuth, 2 * settings.elevation
    for place, axis in (((x + 10, y), 0), ((x, y + 10), 1)):
        turned = SCENE.check(SCENE.pull(settings, "view", place))
        seen = body.view_from(turned.azimuth, turned.elevation) @ near
        assert seen[axis] > 0.05


def test_the_view_goes_all_the_way_round() -> None:
    settings = SCENE.check({"azimuth": 179})
    assert SCENE.pull(settings, "view", (2 * 182, 56))["azimuth"] == -178


def test_a_bead_on_a_ring_seen_edge_on_stays_on_its_side() -> None:
    """From the side, pan 60° and pan 120° have one place; from 60° it is led to 50°."""
    given = {"pan": 60, "tilt": 0, "roll": 0, "azimuth": 90, "elevation": 0}
    there = SCENE.render(SCENE.check(given | {"pan": 50}), "", StageCache())
    place = next(handle for handle in there.handles if handle.name == "pan")
    assert SCENE.pull(SCENE.check(given), "pan", (place.x, place.y)) == {"pan": 50}
    assert SCENE.pull(SCENE.check(given | {"pan": -60}), "pan", (place.x, place.y)) == {"pan": -50}


def test_the_picture_has_what_the_camera_looks_at_in_its_middle() -> None:
    """Pan to the right and tilt upwards are azimuth and elevation of the line of sight."""
    C = euler.to_matrix("YXZ", np.radians([60, 30, -20]))
    np.testing.assert_allclose(sight.place(C, towards(60, 30)), CENTRE, atol=1e-9)
    assert np.isnan(sight.place(C, towards(-120, -30))).all(), "behind the camera"


def test_the_picture_of_a_level_camera_is_upright_and_not_mirrored() -> None:
    aside, above = sight.place(np.eye(3), towards(np.array([10, 0]), np.array([0, 10])))
    np.testing.assert_allclose(aside - CENTRE, [FOCAL * np.tan(np.radians(10)), 0], atol=1e-9)
    np.testing.assert_allclose(above - CENTRE, [0, -FOCAL * np.tan(np.radians(10))], atol=1e-9)


def test_at_the_lock_pan_and_roll_undo_each_other_in_the_picture() -> None:
    start, both = (
        frame(pan=pan, tilt=90, roll=roll).panels[1] for pan, roll in ((60, -20), (100, 20))
    )
    assert start.overlay == both.overlay
    assert start.overlay != frame(pan=100, tilt=90, roll=-20).panels[1].overlay


def test_only_the_lock_fills_the_band_between_the_rings() -> None:
    assert "error solid" in frame(tilt=-90).panels[0].overlay
    assert "error solid" not in frame(tilt=89).panels[0].overlay
