"""The rotation figure: three ways to blend two orientations, and what its numbers claim."""

from functools import partial

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.frames import estimates_of, frame_of, texts_of

from simulations.engine.stages import StageCache
from simulations.scenes.rotation_3d.progress import PLOT, turned_deg
from simulations.scenes.rotation_3d.scene import SCENE
from simulations.scenes.rotation_3d.stages import orientation, paths

frame = partial(frame_of, SCENE)


def judged(tier: str, **values: object) -> str:
    """The last estimate of the error, as shown."""
    *_, last = estimates_of(SCENE, tier, **values)
    assert last.unit == "°"
    return last.text


@pytest.mark.parametrize("angles", [(105, 40, -40), (-150, -20, 120), (30, 90, 10)])
def test_the_matrix_is_that_of_moving_axes_y_x_z(angles: tuple[float, float, float]) -> None:
    here = orientation(*angles)
    expected = Rotation.from_euler("YXZ", angles, degrees=True)
    np.testing.assert_allclose(here.C, expected.as_matrix(), atol=1e-14)
    w_last = np.roll(here.q, -1)
    assert abs(w_last @ expected.as_quat()) == pytest.approx(1)


def test_at_the_lock_one_orientation_has_two_ways_of_the_angles() -> None:
    np.testing.assert_allclose(orientation(100, 90, 100).C, orientation(0, 90, 0).C, atol=1e-14)
    locked, other = frame(pan=100, tilt=90, roll=100), frame(pan=0, tilt=90, roll=0)
    assert texts_of(locked)["off"] != texts_of(other)["off"]


def test_the_right_half_turn_does_not_hang_on_rounding() -> None:
    exact, rounded = (orientation(pan, 0.0, 0.0).q for pan in (180.0, np.nextafter(180.0, 360.0)))
    np.testing.assert_array_equal(exact, [0, 0, 1, 0])
    np.testing.assert_array_equal(rounded, [0, 0, 1, 0])


@pytest.mark.parametrize("tier", SCENE.tiers)
def test_the_camera_is_where_the_tier_puts_it(tier: str) -> None:
    """Away from the middle, where all of them agree; at 170° a straight line errs by degrees."""
    here = orientation(170.0, 0.0, 0.0)
    turned = paths(here, tier)["slerp"](0.2)
    angle_deg = np.degrees(np.arctan2(turned[0, 2], turned[2, 2]))
    arc = np.radians(170 / 2)
    chord_deg = np.degrees(2 * np.arctan2(0.2 * np.sin(arc), 0.8 + 0.2 * np.cos(arc)))
    expected, within = {"nlerp": (chord_deg, 1e-9), "paced-nlerp": (34, 0.05)}.get(tier, (34, 1e-9))
    assert angle_deg == pytest.approx(expected, abs=within)


@pytest.mark.parametrize("tier", SCENE.tiers)
def test_the_sight_stays_under_the_pointer_in_every_tier(tier: str) -> None:
    """The way is shown at 0.2, and the pointer goes to where the sight is at 0.35."""
    start, end = (SCENE.check({"pan": 170, "tilt": 20, "t": share}) for share in (0.2, 0.35))
    sight = next(p for p in SCENE.render(end, tier, StageCache()).handles if p.name == "sight")
    assert SCENE.pull(start, "sight", (sight.x, sight.y), tier) == {"t": 0.35}


def test_the_error_of_a_straight_line_is_that_of_its_chord() -> None:
    """Half a turn: the places at share s of the chord are seen at atan2(s, 1 - s) of the arc."""
    shares = np.linspace(0, 1, 61)
    off = np.degrees(2 * np.abs(np.arctan2(shares, 1 - shares) - shares * np.pi / 2))
    assert judged("nlerp", pan=180, tilt=0, roll=0) == f"{off.max():.2f}"


def test_each_rung_errs_less_than_the_one_before() -> None:
    errors = [judged(tier, pan=3, tilt=0, roll=0) for tier in SCENE.tiers]
    assert errors[0] == errors[2], "3° is below the threshold: the straight line"
    assert [judged(tier, pan=120) for tier in SCENE.tiers[2:]] == ["under 10⁻¹²"] * 2


@pytest.mark.parametrize("share", [0.0, 0.2, 0.5, 0.9, 1.0])
def test_the_plot_has_the_angles_of_the_three_paths(share: float) -> None:
    """Slerp turns at a steady speed; a blend of entries as its chord is seen from the centre."""
    here = orientation(105, 40, -40)
    there = paths(here, "slerp")
    whole = np.degrees(Rotation.from_matrix(here.C).magnitude())
    assert turned_deg(there["slerp"](share)) == pytest.approx(share * whole)
    blended = there["euler"](share)
    assert turned_deg(blended) == pytest.approx(
        np.degrees(Rotation.from_matrix(blended).magnitude())
    )
    u, _, v = np.linalg.svd(there["matrix"](share))
    nearest = Rotation.from_matrix(u @ v).magnitude()
    assert turned_deg(there["matrix"](share)) == pytest.approx(np.degrees(nearest), abs=1e-9)


def test_a_pull_in_the_plot_sets_the_progress() -> None:
    x, _ = PLOT.at(0.8, 0.0)
    assert SCENE.pull(SCENE.check({}), "progress", (x, 100.0)) == {"t": 0.8}
