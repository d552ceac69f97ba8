"""Interpolation of orientations at constant speed along the great circle, with and without
sines."""

from dataclasses import dataclass

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.geometry import quaternions
from simulations.models.geometry.quaternion_blends import BLENDS, bisected_arc, turn_between_rad

PAIRS, SHARES = 180, 32
SMALL_DEG = 10.0


@dataclass(frozen=True, slots=True)
class Workload:
    """Pairs of orientations, and the shares to interpolate by."""

    start: Floats
    """(pairs, 1, 4) unit quaternions."""
    end: Floats
    """(pairs, 1, 4) unit quaternions on the same hemisphere as ``start``."""
    angle_deg: Floats
    """(pairs,) angles of the rotations between the two, 0° to 179°; half a turn has two ways."""
    share: Floats
    """(shares,) from 0 to 1."""


def prepare(seed: int = 7) -> Workload:
    """The ladder's workload; each draw has another seed and so other axes and other starts."""
    rng = np.random.default_rng(seed)
    angle_deg = np.arange(float(PAIRS))
    axes = rng.standard_normal((PAIRS, 3))
    axes /= np.linalg.norm(axes, axis=-1, keepdims=True)
    turn = quaternions.from_rotation_vector(np.radians(angle_deg)[:, None] * axes)
    start = quaternions.normalise(rng.standard_normal((PAIRS, 4)))
    end = quaternions.normalise(quaternions.multiply(turn, start))
    return Workload(start[:, None], end[:, None], angle_deg, np.linspace(0.0, 1.0, SHARES))


def reference(workload: Workload) -> Floats:
    return bisected_arc(workload.start, workload.end, workload.share)


def errors_deg(result: Floats, truth: Floats) -> Floats:
    """(pairs, shares): angle of the rotation between two unit quaternions."""
    return np.degrees(turn_between_rad(result, truth))


def worst_deg(result: Floats, truth: Floats, _workload: Workload) -> float:
    return float(errors_deg(result, truth).max())


def worst_small_deg(result: Floats, truth: Floats, workload: Workload) -> float:
    small = workload.angle_deg <= SMALL_DEG
    return float(errors_deg(result, truth)[small].max())


def _tier(tier_id: str, label: str, cost: str) -> Tier:
    blend = BLENDS[tier_id]
    return Tier(tier_id, label, cost, lambda work: blend(work.start, work.end, work.share))


LADDER = Ladder(
    id="rotation-interpolation",
    title="Between two orientations",
    workload="180 pairs of orientations 0° to 179° apart, 32 steps each",
    prepare=prepare,
    tiers=(
        _tier("nlerp", "Straight line", "1 norm"),
        _tier("paced-nlerp", "Straight line, paced", "1 norm, 2 polynomials"),
        _tier("slerp-threshold", "Great circle, threshold", "2 sines, 1 arccosine, 1 norm"),
        _tier("slerp", "Great circle, sinc", "2 sines, 1 arctangent, 1 norm"),
    ),
    reference=reference,
    reference_label="forty bisections of the arc in extended precision",
    metrics=(
        Metric("worst", "Largest error up to 179°", "°", worst_deg),
        Metric("worst-small", "Largest error up to 10°", "°", worst_small_deg),
    ),
    draw=prepare,
    default_tier="slerp",
    items=5_760,
    item="rotation",
)
