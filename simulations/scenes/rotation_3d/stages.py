"""What the rotation scene computes: the attitude, its rings, the ways there from level flight."""

import math
from dataclasses import dataclass

import numpy as np

from simulations.engine.frame import Readout, format_magnitude
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.geometry import euler, quaternions
from simulations.models.geometry.quaternion_blends import BLENDS, bisected_arc, turn_between_rad
from simulations.models.geometry.rotation_paths import rate_axes
from simulations.scenes.rotation_3d import rings, sphere
from simulations.scenes.rotation_3d.aircraft import view_from
from simulations.scenes.rotation_3d.sphere import LEVEL, Way


@dataclass(frozen=True, slots=True)
class Attitude:
    """What follows from the three angles alone."""

    angles_rad: tuple[float, float, float]
    """Yaw, pitch, roll."""
    R: Floats
    """(3, 3) body to world."""
    q: Floats
    """(4,) the same as a unit quaternion."""
    smallest: float
    """Smallest singular value of the Jacobian of the angles."""


def attitude(yaw: float, pitch: float, roll: float) -> Attitude:
    """The orientation of three angles in degrees."""
    angles_rad = (math.radians(yaw), math.radians(pitch), math.radians(roll))
    R = euler.to_matrix("ZYX", angles_rad)
    q = quaternions.from_matrix(R)
    # Exactly half a turn has two shortest ways; rounding must not be what picks one.
    q = quaternions.canonical(np.where(np.abs(q) < 1e-12, 0.0, q))
    smallest = float(np.linalg.svd(rate_axes("ZYX", angles_rad))[1][2])
    return Attitude(angles_rad, R, q, smallest)


def ways(here: Attitude, tier: str) -> dict[str, Way]:
    """From level flight to the attitude, by name."""
    return sphere.ways(here.angles_rad, here.R, here.q, BLENDS[tier])


def ringed(here: Attitude, view: Floats) -> str:
    """The first panel's markup."""
    yaw_rad, pitch_rad, roll_rad = here.angles_rad
    return rings.draw(yaw_rad, pitch_rad, roll_rad, view)


STAGES = (
    Stage("attitude", attitude),
    Stage("view", view_from),
    Stage("rings", ringed, ("attitude", "view")),
    Stage("ways", ways, ("attitude",)),
    Stage("traces", sphere.traces_of, ("ways", "view")),
)


def judge(here: Attitude, tier: str) -> Readout:
    """How far the quaternions' way, as drawn, is from even speed on the arc."""
    share = np.linspace(0.0, 1.0, sphere.STEPS + 1)
    off_rad = turn_between_rad(
        BLENDS[tier](LEVEL, here.q, share), bisected_arc(LEVEL, here.q, share)
    )
    text = format_magnitude(math.degrees(float(off_rad.max())), 1e-12)
    return Readout("error", "Largest error on the quaternions’ way", text, "°", "error")
