"""The rotation figure: what its numbers claim, and that gimbal lock can be seen in the rings."""

from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.frames import texts_of

from simulations.engine.frame import Frame
from simulations.engine.stages import StageCache
from simulations.ladders.rotation_interpolation import LADDER
from simulations.models.projection.pinhole import look_at
from simulations.scenes.rotation_3d import aircraft
from simulations.scenes.rotation_3d.rings import rings
from simulations.scenes.rotation_3d.scene import SCENE
from simulations.scenes.rotation_3d.stages import attitude, ways

VIEW = aircraft.view_from(51, 28)


def frame(cache: StageCache | None = None, /, tier: str = "", **values: object) -> Frame:
    return SCENE.render(SCENE.check(values), tier, cache or StageCache())


def judged(tier: str, **values: object) -> str:
    """The last estimate of the error, as shown."""
    *_, last = SCENE.estimates(SCENE.check(values), tier, StageCache())
    assert last.unit == "°"
    return last.text


@pytest.mark.parametrize("angles", [(105, 40, -40), (-150, -20, 120), (30, 90, 10)])
def test_the_matrix_is_that_of_moving_axes_z_y_x(angles: tuple[float, float, float]) -> None:
    here = attitude(*angles)
    expected = Rotation.from_euler("ZYX", angles, degrees=True)
    np.testing.assert_allclose(here.R, expected.as_matrix(), atol=1e-14)
    w_last = np.roll(here.q, -1)
    assert abs(w_last @ expected.as_quat()) == pytest.approx(1)


def test_the_chapters_example_of_lock_gives_the_same_attitude() -> None:
    locked, other = (
        texts_of(frame(yaw=10, pitch=90, roll=40)),
        texts_of(frame(yaw=0, pitch=90, roll=30)),
    )
    assert locked["matrix"] == other["matrix"]
    assert locked["quaternion"] == other["quaternion"]
    assert locked["off"] != other["off"], "the blended angles take another way all the same"


@pytest.mark.parametrize("pitch", [-90, 90])
def test_locked_rings_lie_in_one_plane(pitch: float) -> None:
    yaw_ring, _, roll_ring = rings(0.7, np.radians(pitch), -1.2)
    assert abs(yaw_ring.axis @ roll_ring.axis) == pytest.approx(1)
    shown = frame(pitch=pitch)
    assert texts_of(shown)["rank"] == "2 of 3"
    assert texts_of(shown)["smallest"] == "0.000"
    assert "one degree of freedom is lost" in shown.description


def test_one_degree_from_lock_all_directions_are_left() -> None:
    assert texts_of(frame(pitch=89))["rank"] == "3 of 3"


def test_the_nose_ends_where_the_beads_of_the_rings_say() -> None:
    angles = np.radians([50, 25, -70])
    yaw_ring, pitch_ring, roll_ring = rings(*angles)
    R = attitude(50, 25, -70).R
    nose, wing = R[:, 0], R[:, 1]
    np.testing.assert_allclose(pitch_ring.at(angles[1]) / pitch_ring.radius, nose, atol=1e-12)
    np.testing.assert_allclose(roll_ring.at(angles[2]) / roll_ring.radius, wing, atol=1e-12)
    np.testing.assert_allclose(
        yaw_ring.at(angles[0]) / yaw_ring.radius, pitch_ring.zero, atol=1e-12
    )


@pytest.mark.parametrize("blend", ["slerp", "euler"])
def test_blends_that_are_rotations_read_as_such(blend: str) -> None:
    shown = texts_of(frame(blend=blend, t=0.37))
    assert (shown["residual"], shown["determinant"]) == ("under 10⁻¹⁴", "1.000")


def test_blending_the_entries_of_a_quarter_turn_halves_the_volume() -> None:
    shown = texts_of(frame(yaw=90, pitch=0, roll=0, blend="matrix", t=0.5))
    assert (shown["residual"], shown["determinant"]) == ("0.500", "0.500")


@pytest.mark.parametrize("alone", ["yaw", "pitch", "roll"])
def test_one_angle_alone_takes_the_shortest_way(alone: str) -> None:
    angles: dict[str, Any] = dict.fromkeys(("yaw", "pitch", "roll"), 0) | {alone: 80}
    assert texts_of(frame(**angles))["off"] == "0.0"


@pytest.mark.parametrize("yaw", [-180, 0, 180])
@pytest.mark.parametrize("pitch", [-90, 0, 90])
@pytest.mark.parametrize("blend", ["slerp", "euler", "matrix"])
def test_every_extreme_can_be_drawn_in_the_same_layout(
    yaw: float, pitch: float, blend: str
) -> None:
    shown = frame(yaw=yaw, pitch=pitch, roll=180, blend=blend, t=1)
    assert [panel.name for panel in shown.panels] == ["attitude", "blend"]
    assert len(shown.readouts) == 8
    assert not any("nan" in panel.overlay for panel in shown.panels)


def test_the_right_half_turn_does_not_hang_on_rounding() -> None:
    exact, rounded = (attitude(yaw, 0.0, 0.0).q for yaw in (180.0, np.nextafter(180.0, 360.0)))
    np.testing.assert_array_equal(exact, [0, 0, 0, 1])
    np.testing.assert_array_equal(rounded, [0, 0, 0, 1])


def test_faces_are_painted_from_far_to_near() -> None:
    """Seen from ahead, right and above, the right wing of a level aircraft hides no other part."""
    drawn = aircraft.draw(np.eye(3), VIEW, (0.0, 0.0), 100.0, "camera")
    right_wing = np.array([[0.3, 0.12, 0.02]]) @ np.eye(3)
    left_wing = right_wing * [1, -1, 1]
    places = []
    for wing in (left_wing, right_wing):
        x, y, _ = aircraft.screen(wing, VIEW, (0.0, 0.0), 100.0)[0]
        places.append(drawn.index(f"{x:.2f}".rstrip("0") + "," + f"{y:.2f}".rstrip("0")))
    assert places[0] < places[1]


def test_moving_along_the_way_leaves_the_rings_alone() -> None:
    cache = StageCache()
    before, after = frame(cache, t=0.2), frame(cache, t=0.7)
    assert after.panels[0].overlay is before.panels[0].overlay
    assert {stage.status for stage in after.stages} == {"reused"}
    assert after.panels[1].overlay != before.panels[1].overlay


def test_the_tiers_are_the_rungs_of_the_ladder_and_start_at_its_default() -> None:
    assert SCENE.tiers == tuple(tier.id for tier in LADDER.tiers)
    assert SCENE.default_tier == LADDER.default_tier == SCENE.draft_tier
    assert frame().panels == frame(tier=LADDER.default_tier).panels


@pytest.mark.parametrize("tier", SCENE.tiers)
def test_the_aircraft_is_where_the_tier_puts_it(tier: str) -> None:
    """Away from the middle, where all of them agree; at 170° a straight line errs by degrees."""
    here = attitude(170.0, 0.0, 0.0)
    turned = ways(here, tier)["slerp"](0.2)
    angle_deg = np.degrees(np.arctan2(turned[1, 0], turned[0, 0]))
    arc = np.radians(170 / 2)
    chord_deg = np.degrees(2 * np.arctan2(0.2 * np.sin(arc), 0.8 + 0.2 * np.cos(arc)))
    expected, within = {"nlerp": (chord_deg, 1e-9), "paced-nlerp": (34, 0.05)}.get(tier, (34, 1e-9))
    assert angle_deg == pytest.approx(expected, abs=within)


@pytest.mark.parametrize("tier", SCENE.tiers)
def test_the_nose_stays_under_the_pointer_in_every_tier(tier: str) -> None:
    """The way is shown at 0.2, and the pointer goes to where the nose is at 0.35."""
    start, end = (SCENE.check({"yaw": 170, "pitch": 20, "t": share}) for share in (0.2, 0.35))
    nose = next(p for p in SCENE.render(end, tier, StageCache()).handles if p.name == "nose")
    assert SCENE.pull(start, "nose", (nose.x, nose.y), tier) == {"t": 0.35}


def test_the_straight_line_is_seen_to_hurry_and_the_paced_one_is_not() -> None:
    default, straight = (
        frame(tier=tier, yaw=170, pitch=0, roll=0, t=0.2).panels[1].overlay
        for tier in ("slerp", "nlerp")
    )
    assert default != straight
    angles = frame(blend="euler", tier="nlerp", t=0.2), frame(blend="euler", t=0.2)
    assert texts_of(angles[0]) == texts_of(angles[1]), "another way's numbers are untouched"


def test_the_error_of_a_straight_line_is_that_of_its_chord() -> None:
    """Half a turn: the places at share s of the chord are seen at atan2(s, 1 - s) of the arc."""
    shares = np.linspace(0, 1, 61)
    off = np.degrees(2 * np.abs(np.arctan2(shares, 1 - shares) - shares * np.pi / 2))
    assert judged("nlerp", yaw=180, pitch=0, roll=0) == f"{off.max():.2f}"


def test_slerp_errs_by_rounding_alone() -> None:
    level = {"yaw": 0, "pitch": 0, "roll": 0}
    for angles in ({}, level | {"yaw": 180}, level):
        assert judged("slerp", **angles) == "under 10⁻¹²"


def test_each_rung_errs_less_than_the_one_before() -> None:
    errors = [judged(tier, yaw=3, pitch=0, roll=0) for tier in SCENE.tiers]
    assert errors[0] == errors[2], "3° is below the threshold: the straight line"
    assert [judged(tier, yaw=120) for tier in SCENE.tiers[2:]] == ["under 10⁻¹²"] * 2


@pytest.mark.parametrize(("azimuth", "elevation"), [(0, 0), (51, 28), (-130, 75)])
def test_the_view_is_that_of_a_distant_camera_that_looks_at_the_aircraft(
    azimuth: float, elevation: float
) -> None:
    """Straight ahead is x, to the right y; z points down."""
    eye = Rotation.from_euler("ZY", [azimuth, elevation], degrees=True).apply([1.0, 0.0, 0.0])
    expected = look_at(100 * eye, (0, 0, 0), (0, 0, -1))[:3, :3]
    np.testing.assert_allclose(aircraft.view_from(azimuth, elevation), expected, atol=1e-12)


def test_what_is_near_follows_the_finger_that_turns_the_view() -> None:
    settings = SCENE.check({})
    near = -aircraft.view_from(settings.azimuth, settings.elevation)[2]
    x, y = 2 * settings.azimuth, 2 * settings.elevation
    for place, axis in (((x + 10, y), 0), ((x, y + 10), 1)):
        turned = SCENE.check(SCENE.pull(settings, "view-attitude", place))
        seen = aircraft.view_from(turned.azimuth, turned.elevation) @ near
        assert seen[axis] > 0.05


def test_the_view_goes_all_the_way_round() -> None:
    settings = SCENE.check({"azimuth": 179})
    assert SCENE.pull(settings, "view-blend", (2 * 182, 56))["azimuth"] == -178


def test_a_bead_on_a_ring_seen_edge_on_stays_on_its_side() -> None:
    """From the side, yaw 60° and yaw 120° have one place; from 60° it is led to 50°."""
    given = {"yaw": 60, "pitch": 0, "roll": 0, "azimuth": 90, "elevation": 0}
    there = SCENE.render(SCENE.check(given | {"yaw": 50}), "", StageCache())
    place = next(handle for handle in there.handles if handle.name == "yaw")
    assert SCENE.pull(SCENE.check(given), "yaw", (place.x, place.y)) == {"yaw": 50}
    assert SCENE.pull(SCENE.check(given | {"yaw": -60}), "yaw", (place.x, place.y)) == {"yaw": -50}
