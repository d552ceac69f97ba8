"""Between two orientations: even speed along the great circle, with and without sines."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models import quaternions
from simulations.models.rotations import nlerp, slerp

type Floats = NDArray[np.floating]

PAIRS, SHARES = 180, 32
SMALL_DEG = 10.0
STRAIGHT = 0.9995
"""Cosine above which `threshold_slerp` takes the straight line."""


@dataclass(frozen=True, slots=True)
class Workload:
    """Pairs of orientations, and how far to go from the first to the second."""

    start: Floats
    """(pairs, 1, 4) unit quaternions."""
    end: Floats
    """(pairs, 1, 4) unit quaternions on the same hemisphere as ``start``."""
    angle_deg: Floats
    """(pairs,) angles of the rotations between the two, 0° to 179°; half a turn has two ways."""
    share: Floats
    """(shares,) from 0 to 1."""


def prepare() -> Workload:
    rng = np.random.default_rng(7)
    angle_deg = np.arange(float(PAIRS))
    axes = rng.standard_normal((PAIRS, 3))
    axes /= np.linalg.norm(axes, axis=-1, keepdims=True)
    turn = quaternions.from_rotation_vector(np.radians(angle_deg)[:, None] * axes)
    start = quaternions.normalise(rng.standard_normal((PAIRS, 4)))
    end = quaternions.normalise(quaternions.multiply(turn, start))
    return Workload(start[:, None], end[:, None], angle_deg, np.linspace(0.0, 1.0, SHARES))


def reference(workload: Workload) -> Floats:
    """Bisection of the arc: the sum of two unit vectors points to the middle between them.

    Forty halvings, each into the half that holds the share, then a straight line along an arc
    by then shorter than 2e−12. No sine, no angle, extended precision.
    """
    shape = (len(workload.angle_deg), len(workload.share), 4)
    low = np.broadcast_to(workload.start, shape).astype(np.longdouble)
    high = np.broadcast_to(workload.end, shape).astype(np.longdouble)
    low, high = _unit(low), _unit(high)
    rest = np.broadcast_to(workload.share[:, None], (*shape[:2], 1)).astype(np.longdouble)
    for _ in range(40):
        middle = _unit(low + high)
        upper = rest >= 0.5
        low, high = np.where(upper, middle, low), np.where(upper, high, middle)
        rest = 2 * rest - upper
    return _unit((1 - rest) * low + rest * high)


def _unit(vectors: Floats) -> Floats:
    square = (vectors * vectors).sum(axis=-1, keepdims=True)
    length = np.sqrt(square.astype(np.float64)).astype(np.longdouble)
    # One Newton step, since a C library's extended square root may be no better than float64's.
    unit: Floats = vectors / ((length + square / length) / 2)
    return unit


def paced_nlerp(workload: Workload) -> Floats:
    """`nlerp` with a share bent so that the speed is nearly even; no sine.

    Coefficients by A. Kapoulkine, "Approximating slerp", 2015, fitted over arcs up to 90°.
    """
    q0, q1, s = workload.start, workload.end, workload.share[:, None]
    dot = np.abs((q0 * q1).sum(axis=-1, keepdims=True))
    a = 1.0904 + dot * (-3.2452 + dot * (3.55645 - dot * 1.43519))
    b = 0.848013 + dot * (-1.06021 + dot * 0.215638)
    off_centre = s - 0.5
    bent = s + s * off_centre * (s - 1.0) * (a * off_centre**2 + b)
    return nlerp(q0, q1, bent[..., 0])


def threshold_slerp(workload: Workload) -> Floats:
    """The slerp of many code bases: Ω = acos(q₀·q₁), and a straight line where that is near 1.

    The line avoids 0/0, but the customary 0.9995 hands it all rotations up to 3.6°.
    """
    q0, q1, s = workload.start, workload.end, workload.share[:, None]
    dot = (q0 * q1).sum(axis=-1, keepdims=True)
    q1, dot = np.where(dot < 0.0, -q1, q1), np.abs(dot)
    straight = dot > STRAIGHT
    arc = np.arccos(np.where(straight, 0.0, dot))
    weight0 = np.where(straight, 1.0 - s, np.sin((1.0 - s) * arc) / np.sin(arc))
    weight1 = np.where(straight, s, np.sin(s * arc) / np.sin(arc))
    return quaternions.normalise(weight0 * q0 + weight1 * q1)


def errors_deg(result: Floats, truth: Floats) -> Floats:
    """(pairs, shares): angle of the rotation between two unit quaternions.

    The chord c of an arc φ is 2 sin φ/2, and the rotation turns by 2φ.
    """
    other = np.minimum(
        ((result - truth) ** 2).sum(axis=-1), ((result + truth) ** 2).sum(axis=-1)
    ).astype(np.float64)
    angle: Floats = np.degrees(4.0 * np.arcsin(np.minimum(np.sqrt(other) / 2.0, 1.0)))
    return angle


def worst_deg(result: Floats, truth: Floats, _workload: Workload) -> float:
    return float(errors_deg(result, truth).max())


def worst_small_deg(result: Floats, truth: Floats, workload: Workload) -> float:
    small = workload.angle_deg <= SMALL_DEG
    return float(errors_deg(result, truth)[small].max())


LADDER = Ladder(
    id="rotation-interpolation",
    title="Between two orientations",
    workload="180 pairs of orientations 0° to 179° apart, 32 steps each",
    prepare=prepare,
    tiers=(
        Tier(
            "nlerp",
            "Straight line",
            "1 norm",
            lambda work: nlerp(work.start, work.end, work.share),
        ),
        Tier("paced-nlerp", "Straight line, paced", "1 norm, 2 polynomials", paced_nlerp),
        Tier(
            "slerp-threshold",
            "Great circle, threshold",
            "2 sines, 1 arccosine, 1 norm",
            threshold_slerp,
        ),
        Tier(
            "slerp",
            "Great circle, sinc",
            "2 sines, 1 arctangent, 1 norm",
            lambda work: slerp(work.start, work.end, work.share),
        ),
    ),
    reference=reference,
    reference_label="forty bisections of the arc in extended precision",
    metrics=(
        Metric("worst", "Largest error up to 179°", "°", worst_deg),
        Metric("worst-small", "Largest error up to 10°", "°", worst_small_deg),
    ),
    default_tier="slerp",
)
