"""The rotation figure: three ways to blend two orientations, by tier."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.frames import estimates_of, frame_of

from simulations.scenes.rotation_3d import SCENE, orientation, paths, turned_deg


@pytest.mark.parametrize("angles", [(105, 40, -40), (-150, -20, 120), (30, 90, 10)])
def test_the_end_is_that_of_moving_axes_y_x_z(angles: tuple[float, float, float]) -> None:
    here = orientation(*angles)
    expected = Rotation.from_euler("YXZ", angles, degrees=True)
    np.testing.assert_allclose(here.C, expected.as_matrix(), atol=1e-14)
    w_last = np.roll(here.q, -1)
    assert abs(w_last @ expected.as_quat()) == pytest.approx(1)


@pytest.mark.parametrize("pan", [180.0, np.nextafter(180.0, 360.0)])
def test_half_a_turn_does_not_depend_on_rounding(pan: float) -> None:
    np.testing.assert_array_equal(orientation(pan, 0.0, 0.0).q, [0, 0, 1, 0])


@pytest.mark.parametrize("tier", SCENE.tiers)
def test_the_camera_is_where_the_tier_puts_it(tier: str) -> None:
    """Away from the middle, where all of them agree; at 170° a straight line errs by degrees."""
    turned = paths(orientation(170.0, 0.0, 0.0), tier)["slerp"](0.2)
    angle_deg = np.degrees(np.arctan2(turned[0, 2], turned[2, 2]))
    arc = np.radians(170 / 2)
    chord_deg = np.degrees(2 * np.arctan2(0.2 * np.sin(arc), 0.8 + 0.2 * np.cos(arc)))
    expected, within = {"nlerp": (chord_deg, 1e-9), "paced-nlerp": (34, 0.05)}.get(tier, (34, 1e-9))
    assert angle_deg == pytest.approx(expected, abs=within)
    # The line of sight stays under the pointer: from 0.2 to 0.35.
    shares = [{"pan": 170, "tilt": 20, "t": share} for share in (0.2, 0.35)]
    there = frame_of(SCENE, tier, **shares[1]).handles
    place = next((handle.x, handle.y) for handle in there if handle.name == "sight")
    assert SCENE.pull(SCENE.check(shares[0]), "sight", place, tier) == {"t": 0.35}


def test_errors_of_the_tiers_are_those_of_chords_and_of_none() -> None:
    """Half a turn: the places at share s of the chord are seen at atan2(s, 1 - s) of the arc."""
    shares = np.linspace(0, 1, 61)
    off = np.degrees(2 * np.abs(np.arctan2(shares, 1 - shares) - shares * np.pi / 2))

    def judged(tier: str, **given: float) -> str:
        return estimates_of(SCENE, tier, **given)[-1].text

    assert judged("nlerp", pan=180, tilt=0, roll=0) == f"{off.max():.2f}"
    below, _, straight, *_ = (judged(tier, pan=3, tilt=0, roll=0) for tier in SCENE.tiers)
    assert below == straight, "3° is below the threshold: the straight line"
    assert [judged(tier, pan=120) for tier in SCENE.tiers[2:]] == ["under 10⁻¹²"] * 2


@pytest.mark.parametrize("share", [0.0, 0.2, 0.5, 0.9, 1.0])
def test_the_plot_has_the_angles_of_the_three_paths(share: float) -> None:
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
