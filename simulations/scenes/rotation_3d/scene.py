"""3D Rotation: Euler angles and their lock, and three ways to blend two orientations.

R = Rz(yaw) Ry(pitch) Rx(roll), moving axes, x forward, y right, z down. The second panel goes
from level flight, R = I, to the attitude of the first.
"""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.frame import (
    Frame,
    Panel,
    Readout,
    format_number,
    matrix_readout,
    readout,
)
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.geometry import quaternions
from simulations.models.geometry.quaternion_blends import BLENDS
from simulations.models.geometry.rotation_paths import off_great_circle
from simulations.scenes.rotation_3d import rings, sphere
from simulations.scenes.rotation_3d.handles import HANDLES
from simulations.scenes.rotation_3d.settings import Settings
from simulations.scenes.rotation_3d.sphere import LABELS, LEVEL, Way
from simulations.scenes.rotation_3d.stages import STAGES, Attitude, judge

LOST = 1e-6
"""Singular value below which a direction of turning counts as lost."""
ROUNDING = 1e-14
"""Departure from a rotation that rounding explains; the digits below differ by machine."""


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The attitude in its rings, and the aircraft on its way there."""
    here: Attitude = outputs["attitude"]
    there: dict[str, Way] = outputs["ways"]
    share, chosen = settings.t, settings.blend
    blend = there[chosen](share)
    off_rad = off_great_circle(quaternions.from_matrix(there["euler"](share)), LEVEL, here.q)
    return Frame(
        panels=(
            Panel(
                "attitude",
                "Yaw, pitch and roll, each on its ring",
                rings.WIDTH,
                rings.HEIGHT,
                overlay=outputs["rings"],
            ),
            Panel(
                "blend",
                "From level flight to that attitude: the way of the nose",
                sphere.WIDTH,
                sphere.HEIGHT,
                overlay=sphere.draw(there, outputs["traces"], outputs["view"], chosen, share),
            ),
        ),
        readouts=_readouts(here, blend, off_rad),
        description=describe(settings, here.smallest, off_rad, blend),
    )


def _readouts(here: Attitude, blend: Floats, off_rad: float) -> tuple[Readout, ...]:
    rank = 3 if here.smallest > LOST else 2
    return (
        matrix_readout("matrix", "R of the attitude", here.R.tolist(), role="camera"),
        Readout("quaternion", "Its quaternion (w, x, y, z)", _quaternion(here.q), role="camera"),
        readout("turn", "Turn θ from level flight", _turn_deg(here.q), "°", digits=1, role="ray"),
        readout("smallest", "Smallest singular value of J", here.smallest, digits=3),
        Readout("rank", "Rank of J", f"{rank} of 3"),
        readout("off", "Euler way off the arc", math.degrees(off_rad), "°", digits=1, role="error"),
        Readout("residual", "RᵀR − I of the blend", _residual(blend)),
        readout("determinant", "det R of the blend", float(np.linalg.det(blend)), digits=3),
    )


def _quaternion(q: Floats) -> str:
    return "(" + ", ".join(format_number(float(part), 2) for part in q) + ")"


def _turn_deg(q: Floats) -> float:
    return math.degrees(float(np.linalg.norm(quaternions.to_rotation_vector(q))))


def _residual(blend: Floats) -> str:
    largest = float(np.abs(blend.T @ blend - np.eye(3)).max())
    return "under 10⁻¹⁴" if largest < ROUNDING else format_number(largest, 3)


def describe(settings: Settings, smallest: float, off_rad: float, blend: Floats) -> str:
    """Both panels in one or two sentences."""
    angles = (settings.yaw, settings.pitch, settings.roll)
    yaw, pitch, roll = (format_number(angle, 0) for angle in angles)
    if smallest > LOST:
        locked = (
            f"All three angles still steer (smallest singular value {format_number(smallest, 2)})"
        )
    else:
        locked = (
            "The yaw and roll rings lie in one plane: both turn about the same axis, and one "
            "degree of freedom is lost"
        )
    share = format_number(100 * settings.t, 0)
    volume = float(np.linalg.det(blend))
    shrunk = f", shrunk to {format_number(100 * volume, 0)}\u00a0% of its volume"
    fault = shrunk if volume < 0.995 else ""
    return (
        f"An aircraft at yaw {yaw}°, pitch {pitch}°, roll {roll}°. {locked}. On the way there by "
        f"{LABELS[settings.blend]} it is at {share}\u00a0%{fault}; the Euler angles miss the "
        f"shortest way by {format_number(math.degrees(off_rad), 1)}°."
    )


def estimate(_settings: Settings, outputs: Outputs, tier: str) -> Iterator[Readout]:
    """How far the quaternions' way is from even speed on the arc; found at once."""
    yield judge(outputs["attitude"], tier)


SCENE = Scene(
    id="rotation-3d",
    title="3D Rotation",
    settings=Settings,
    draw=draw,
    stages=STAGES,
    handles=HANDLES,
    tiers=tuple(BLENDS),
    default_tier="slerp",
    ladder="rotation-interpolation",
    estimate=estimate,
)
