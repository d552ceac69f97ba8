"""The gimbal figure: its rings, its view, its picture, and the lock."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.frames import frame_of

from simulations.models.geometry import euler
from simulations.models.projection.pinhole import look_at
from simulations.scenes._turned_camera import view_from
from simulations.scenes.gimbal import FOCAL, MIDDLE, SCENE, pictured, rings_of, towards


@pytest.mark.parametrize("angles", [(50, 25, -70), (40, 90, -69), (0, -90, 10)])
def test_beads_lie_on_the_axes_that_their_rings_turn(angles: tuple[float, float, float]) -> None:
    rings = pan, tilt, roll = rings_of(*angles)
    C = euler.to_matrix("YXZ", np.radians(angles))
    for ring, expected in zip(rings, (tilt.zero, C[:, 2], C[:, 0]), strict=True):
        np.testing.assert_allclose(ring.at(ring.angle_rad) / ring.radius, expected, atol=1e-12)
    assert abs(pan.axis @ roll.axis) == pytest.approx(abs(np.sin(np.radians(angles[1]))))


@pytest.mark.parametrize(("azimuth", "elevation"), [(0, 0), (51, 28), (-130, 75)])
def test_the_view_is_that_of_a_distant_eye(azimuth: float, elevation: float) -> None:
    """Straight ahead is z, to the right x; y points down."""
    eye = Rotation.from_euler("YX", [azimuth, elevation], degrees=True).apply([0.0, 0.0, 1.0])
    expected = look_at(100 * eye, (0, 0, 0), (0, -1, 0))[:3, :3]
    np.testing.assert_allclose(view_from(azimuth, elevation), expected, atol=1e-12)


def test_near_points_follow_the_finger_that_turns_the_view() -> None:
    settings = SCENE.check({})
    near = -view_from(settings.azimuth, settings.elevation)[2]
    x, y = 2 * settings.azimuth, 2 * settings.elevation
    for place, axis in (((x + 10, y), 0), ((x, y + 10), 1)):
        turned = SCENE.check(SCENE.pull(settings, "view", place))
        assert (view_from(turned.azimuth, turned.elevation) @ near)[axis] > 0.05
    assert SCENE.pull(SCENE.check({"azimuth": 179}), "view", (2 * 182, 56))["azimuth"] == -178


@pytest.mark.parametrize("side", [1, -1])
def test_a_bead_on_a_ring_seen_edge_on_stays_on_its_side(side: int) -> None:
    """From the side, pan 60° and pan 120° have one place; from 60° it is pulled to 50°."""
    given = {"pan": 60, "tilt": 0, "roll": 0, "azimuth": 90, "elevation": 0}
    there = frame_of(SCENE, **given | {"pan": 50}).handles
    place = next((handle.x, handle.y) for handle in there if handle.name == "pan")
    settings = SCENE.check(given | {"pan": side * 60})
    assert SCENE.pull(settings, "pan", place) == {"pan": side * 50}


@pytest.mark.parametrize(
    ("angles", "direction", "expected"),
    [
        ((60, 30, -20), (60, 30), (0, 0)),  # pan and tilt are azimuth and elevation of the sight
        ((60, 30, -20), (-120, -30), (np.nan, np.nan)),  # behind the camera
        ((0, 0, 0), (10, 0), (np.tan(np.radians(10)), 0)),  # upright and not mirrored
        ((0, 0, 0), (0, 10), (0, -np.tan(np.radians(10)))),
    ],
)
def test_the_picture_is_that_of_the_camera(
    angles: tuple[float, ...], direction: tuple[float, float], expected: tuple[float, float]
) -> None:
    C = euler.to_matrix("YXZ", np.radians(angles))
    place = pictured(C, towards(*direction))
    np.testing.assert_allclose(place, MIDDLE + FOCAL * np.array(expected), atol=1e-9)
