"""3D Rotation: Euler angles and their lock, and three ways to blend two orientations.

R = Rz(yaw) Ry(pitch) Rx(roll), moving axes, x forward, y right, z down. The second panel goes
from level flight, R = I, to the attitude of the first.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from simulations.engine.controls import Action, Choice, Slider, Values
from simulations.engine.frame import (
    Frame,
    Panel,
    Readout,
    format_magnitude,
    format_number,
    matrix_readout,
    readout,
)
from simulations.engine.scene import Scene
from simulations.engine.stages import Stage, StageCache, run
from simulations.models.geometry import euler, quaternions
from simulations.models.geometry.quaternion_blends import BLENDS, bisected_arc, turn_between_rad
from simulations.models.geometry.rotation_paths import off_great_circle, rate_axes
from simulations.scenes.rotation_3d import rings, sphere
from simulations.scenes.rotation_3d.aircraft import Floats
from simulations.scenes.rotation_3d.sphere import LABELS, LEVEL, Way

LOST = 1e-6
"""Singular value below which a direction of turning counts as lost."""
DEFAULT_TIER = "slerp"
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
    return sphere.ways(here.angles_rad, here.R, here.q, tier)


STAGES = (
    Stage("attitude", attitude),
    Stage("rings", lambda here: rings.draw(*here.angles_rad), ("attitude",)),
    Stage("ways", ways, ("attitude",)),
    Stage("traces", sphere.traces_of, ("ways",)),
)


def render(values: Values, tier: str, cache: StageCache) -> Frame:
    """The attitude in its rings, and the aircraft on its way there."""
    done = run(STAGES, values, cache, {"tier": tier or DEFAULT_TIER})
    here: Attitude = done.outputs["attitude"]
    there: dict[str, Way] = done.outputs["ways"]
    share, chosen = values.number("t"), values.choice("blend")
    blend = there[chosen](share)
    off_rad = off_great_circle(quaternions.from_matrix(there["euler"](share)), LEVEL, here.q)
    return Frame(
        panels=(
            Panel(
                "attitude",
                "Yaw, pitch and roll, each on its ring",
                rings.WIDTH,
                rings.HEIGHT,
                overlay=done.outputs["rings"],
            ),
            Panel(
                "blend",
                "From level flight to that attitude: the way of the nose",
                sphere.WIDTH,
                sphere.HEIGHT,
                overlay=sphere.draw(there, done.outputs["traces"], chosen, share),
            ),
        ),
        readouts=_readouts(here, blend, off_rad),
        description=describe(values, here.smallest, off_rad, blend),
        stages=done.reports,
    )


def error(values: Values, tier: str, cache: StageCache) -> Iterator[Readout]:
    """How far the quaternions' way, as drawn, is from even speed on the arc; found at once."""
    here: Attitude = run(STAGES[:1], values, cache).outputs["attitude"]
    share = np.linspace(0.0, 1.0, sphere.STEPS + 1)
    off_rad = turn_between_rad(
        BLENDS[tier](LEVEL, here.q, share), bisected_arc(LEVEL, here.q, share)
    )
    text = format_magnitude(math.degrees(float(off_rad.max())), 1e-12)
    yield Readout("error", "Largest error on the quaternions’ way", text, "°", "error")


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
    shrunk = f", shrunk to {format_number(100 * volume, 0)}\u00a0% of its volume"
    fault = shrunk if volume < 0.995 else ""
    return (
        f"An aircraft at yaw {yaw}°, pitch {pitch}°, roll {roll}°. {locked}. On the way there by "
        f"{LABELS[chosen]} it is at {share}\u00a0%{fault}; the Euler angles miss the shortest way "
        f"by {format_number(math.degrees(off_rad), 1)}°."
    )


SCENE = Scene(
    id="rotation-3d",
    title="3D Rotation",
    controls=CONTROLS,
    render=render,
    tiers=tuple(BLENDS),
    default_tier=DEFAULT_TIER,
    draft_tier=DEFAULT_TIER,
    ladder="rotation-interpolation",
    error=error,
)
