"""The stages of the rotation scene: the orientation at the end, and the paths to it."""

import math
from dataclasses import dataclass

import numpy as np

from simulations.engine.frame import Readout, format_magnitude
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.geometry import euler, quaternions
from simulations.models.geometry.quaternion_blends import BLENDS, bisected_arc, turn_between_rad
from simulations.scenes._turned_camera.body import view_from
from simulations.scenes.rotation_3d import progress, sphere
from simulations.scenes.rotation_3d.sphere import START, Path


@dataclass(frozen=True, slots=True)
class Orientation:
    """The orientation of the three angles."""

    angles_rad: tuple[float, float, float]
    """Pan, tilt, roll."""
    C: Floats
    """(3, 3) camera to world: the camera's axes as columns."""
    q: Floats
    """(4,) the same as a unit quaternion."""


def orientation(pan: float, tilt: float, roll: float) -> Orientation:
    """The orientation of three angles in degrees."""
    angles_rad = (math.radians(pan), math.radians(tilt), math.radians(roll))
    C = euler.to_matrix("YXZ", angles_rad)
    q = quaternions.from_matrix(C)
    # Exactly half a turn has two shortest paths; rounding must not decide between them.
    q = quaternions.canonical(np.where(np.abs(q) < 1e-12, 0.0, q))
    return Orientation(angles_rad, C, q)


def paths(here: Orientation, tier: str) -> dict[str, Path]:
    """The paths from straight ahead to the orientation, by name."""
    return sphere.paths(here.angles_rad, here.C, here.q, BLENDS[tier])


STAGES = (
    Stage("orientation", orientation),
    Stage("view", view_from),
    Stage("paths", paths, ("orientation",)),
    Stage("traces", sphere.traces_of, ("paths", "view")),
    Stage("curves", progress.curves_of, ("paths",)),
)


def speed_error(here: Orientation, tier: str) -> Readout:
    """Error of the quaternions' path against constant speed on the arc."""
    share = np.linspace(0.0, 1.0, sphere.STEPS + 1)
    off_rad = turn_between_rad(
        BLENDS[tier](START, here.q, share), bisected_arc(START, here.q, share)
    )
    text = format_magnitude(math.degrees(float(off_rad.max())), 1e-12)
    return Readout("error", "Largest error on the quaternions’ way", text, "°", "error")
