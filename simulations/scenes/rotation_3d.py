"""3D Rotation: Euler angles and their lock, and three ways to blend two orientations.

R = Rz(yaw) Ry(pitch) Rx(roll), moving axes, x forward, y right, z down. The second panel goes
from level flight, R = I, to the attitude of the first.
"""

import math

import numpy as np

from simulations.engine.controls import Action, Choice, Slider, Values
from simulations.engine.frame import (
    Frame,
    Panel,
    Readout,
    format_number,
    matrix_readout,
    readout,
)
from simulations.engine.pipeline import StageCache
from simulations.engine.scene import Scene
from simulations.models import euler, quaternions
from simulations.models.rotation_paths import euler_blend, off_great_circle, rate_axes
from simulations.scenes import rotation_rings, rotation_sphere
from simulations.scenes.aircraft import Floats
from simulations.scenes.rotation_sphere import LABELS, LEVEL

LOST = 1e-6
"""Singular value below which a direction of turning counts as lost."""
ROUNDING = 1e-14
"""Departure from a rotation that rounding explains; the digits below differ by machine."""

CONTROLS = (
    Slider(name="yaw", label="Yaw α", default=105, minimum=-180, maximum=180, step=1, unit="°"),
    Slider(name="pitch", label="Pitch β", default=40, minimum=-90, maximum=90, step=1, unit="°"),
    Slider(name="roll", label="Roll γ", default=-40, minimum=-180, maximum=180, step=1, unit="°"),
    Choice(name="blend", label="Blend", default="slerp", options=LABELS),
    Slider(name="t", label="Share s of the way", default=0.5, minimum=0, maximum=1, step=0.01),
    Action(name="play", labels=("Play", "Pause"), drives="t", effect="play", seconds=6.0),
)


def attitude(angles_rad: tuple[float, float, float]) -> tuple[Floats, Floats]:
    """R (3, 3) and the unit quaternion (4,) of the three angles."""
    R = euler.to_matrix("ZYX", angles_rad)
    q = quaternions.from_matrix(R)
    # Exactly half a turn has two shortest ways; rounding must not be what picks one.
    q = quaternions.canonical(np.where(np.abs(q) < 1e-12, 0.0, q))
    return R, q


def render(values: Values, tier: str, cache: StageCache) -> Frame:
    """The attitude in its rings, and the aircraft on its way there."""
    del tier, cache
    yaw, pitch, roll = (math.radians(values.number(name)) for name in ("yaw", "pitch", "roll"))
    angles, share, chosen = (yaw, pitch, roll), values.number("t"), values.choice("blend")
    R, q = attitude(angles)
    ways = rotation_sphere.ways(angles, R, q)
    smallest = float(np.linalg.svd(rate_axes("ZYX", angles))[1][2])
    euler_q = quaternions.from_matrix(euler_blend("ZYX", (0.0, 0.0, 0.0), angles, share))
    off_rad = off_great_circle(euler_q, LEVEL, q)
    blend = ways[chosen](share)
    return Frame(
        panels=(
            Panel(
                "attitude",
                "Yaw, pitch and roll, each on its ring",
                rotation_rings.WIDTH,
                rotation_rings.HEIGHT,
                overlay=rotation_rings.draw(*angles),
            ),
            Panel(
                "blend",
                "From level flight to that attitude: the way of the nose",
                rotation_sphere.WIDTH,
                rotation_sphere.HEIGHT,
                overlay=rotation_sphere.draw(ways, chosen, share),
            ),
        ),
        readouts=(
            matrix_readout("matrix", "R of the attitude", _rounded(R), role="camera"),
            Readout("quaternion", "Its quaternion (w, x, y, z)", _quaternion(q), role="camera"),
            readout("turn", "Turn θ from level flight", _turn_deg(q), "°", digits=1, role="ray"),
            readout("smallest", "Smallest singular value of J", smallest, digits=3),
            Readout("rank", "Rank of J", f"{3 if smallest > LOST else 2} of 3"),
            readout(
                "off", "Euler way off the arc", math.degrees(off_rad), "°", digits=1, role="error"
            ),
            Readout("residual", "Largest entry of RᵀR − I, blend", _residual(blend)),
            readout("determinant", "det R, blend", float(np.linalg.det(blend)), digits=3),
        ),
        description=describe(values, smallest, off_rad, blend),
    )


def _rounded(R: Floats) -> list[list[float]]:
    return [[float(entry) for entry in row] for row in R]


def _quaternion(q: Floats) -> str:
    return "(" + ", ".join(format_number(float(part), 2) for part in q) + ")"


def _turn_deg(q: Floats) -> float:
    return math.degrees(float(np.linalg.norm(quaternions.to_rotation_vector(q))))


def _residual(blend: Floats) -> str:
    largest = float(np.abs(blend.T @ blend - np.eye(3)).max())
    return "< 10⁻¹⁴" if largest < ROUNDING else format_number(largest, 3)


def describe(values: Values, smallest: float, off_rad: float, blend: Floats) -> str:
    """Both panels in one or two sentences."""
    yaw, pitch, roll = (format_number(values.number(n), 0) for n in ("yaw", "pitch", "roll"))
    if smallest > LOST:
        locked = (
            f"All three angles still steer (smallest singular value {format_number(smallest, 2)})"
        )
    else:
        locked = (
            "The yaw and roll rings lie in one plane: both turn about the same axis, and one "
            "degree of freedom is lost"
        )
    chosen, share = values.choice("blend"), format_number(100 * values.number("t"), 0)
    volume = float(np.linalg.det(blend))
    fault = (
        f", shrunk to {format_number(100 * volume, 0)} % of its volume" if volume < 0.995 else ""
    )
    return (
        f"An aircraft at yaw {yaw}°, pitch {pitch}°, roll {roll}°. {locked}. On the way there by "
        f"{LABELS[chosen]} it is at {share} %{fault}; the Euler angles miss the shortest way by "
        f"{format_number(math.degrees(off_rad), 1)}°."
    )


SCENE = Scene(id="rotation-3d", title="3D Rotation", controls=CONTROLS, render=render)
