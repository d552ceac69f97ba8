"""Shot noise: the Poisson distribution, and approximations by a normal one."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.sensor.photon_counting import ShotModel, shot_noise

LEVELS_E = (0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 1000.0)
"""Mean electrons, from near darkness to a well-lit wall, for which all tiers agree."""
HIGHEST = 1400
"""End of the cumulative distributions: more than 12 standard deviations above the brightest
mean."""
SAMPLES = 65_536
"""Pixels of each level. An exact sampler's own distance is about 0.87 / √65 536 = 0.003."""
SEED = 20


@dataclass(frozen=True, slots=True)
class Workload:
    """Flat fields to be counted."""

    mean_e: Floats
    """(levels, samples) float32, each row one of ``levels_e``."""
    levels_e: tuple[float, ...]
    seed: int


def workload_of(levels_e: tuple[float, ...], seed: int) -> Workload:
    rows = np.repeat(np.array(levels_e, np.float32)[:, None], SAMPLES, axis=1)
    return Workload(rows, levels_e, seed)


def prepare() -> Workload:
    return workload_of(LEVELS_E, SEED)


def draw(index: int) -> Workload:
    """Other seeds, with the levels as they are or 1.2, 1.5 or 1.9 times as bright."""
    brighter = (1.0, 1.2, 1.5, 1.9)[index % 4]
    levels = tuple(min(brighter * level, LEVELS_E[-1]) for level in LEVELS_E)
    return workload_of(levels, SEED + 1 + index // 4)


def reference(workload: Workload) -> Floats:
    """P(N ≤ k), (levels, HIGHEST): the sums of the terms e^−λ λᵏ/k!."""
    terms = [
        [math.exp(k * math.log(mean) - mean - math.lgamma(k + 1)) for k in range(HIGHEST)]
        for mean in workload.levels_e
    ]
    return np.cumsum(terms, axis=1)


def distances(result: Floats, truth: Floats) -> Floats:
    """Kolmogorov–Smirnov distance (levels,): the largest gap between the two cumulatives."""
    bins = truth.shape[1]
    gaps = []
    for counted, cumulative in zip(result, truth, strict=True):
        clipped = np.clip(counted, 0, bins - 1).astype(np.int64)
        share = np.cumsum(np.bincount(clipped, minlength=bins)) / counted.size
        gaps.append(np.abs(share - cumulative).max())
    return np.array(gaps)


def worst_distance(result: Floats, truth: Floats, _workload: Workload) -> float:
    return float(distances(result, truth).max())


def worst_bias_percent(result: Floats, _truth: Floats, workload: Workload) -> float:
    """The mean of a Poisson distribution is its parameter."""
    means = result.mean(axis=1, dtype=np.float64)
    return float(100.0 * np.abs(means / np.array(workload.levels_e) - 1.0).max())


def _count(workload: Workload, model: ShotModel) -> Floats:
    return shot_noise(workload.mean_e, np.random.default_rng(workload.seed), model=model)


TIERS: tuple[tuple[ShotModel, str, str], ...] = (
    ("gaussian", "Rounded Gaussian", "1 normal deviate"),
    ("skewed", "Skew-corrected Gaussian", "1 normal deviate, 1 square"),
    ("quantile", "Quantile of a normal", "1 normal deviate, λ + 1 sums below λ = 10, then 3 terms"),
    ("poisson", "Exact Poisson", "up to λ + 1 uniform deviates below λ = 10, then about 2"),
)
LADDER = Ladder(
    id="shot-noise",
    title="Shot noise",
    workload="65 536 pixels at each of eight levels, from 0.1 to 1000 electrons, float32",
    prepare=prepare,
    tiers=tuple(
        Tier(model, label, cost, partial(_count, model=model)) for model, label, cost in TIERS
    ),
    reference=reference,
    reference_label="the sum of the Poisson probabilities, float64",
    metrics=(
        Metric("ks", "Largest gap between cumulatives", "probability", worst_distance),
        Metric("bias", "Largest bias of the mean", "%", worst_bias_percent),
    ),
    default_tier="quantile",
    draw=draw,
    items=524_288,
)
