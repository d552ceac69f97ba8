"""A fall through air in steps: simple ones, ones that ask in the middle, and the classic rule."""

from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.falling import Floats, in_steps, speed

TIME_S = 3.0


def prepare() -> Floats:
    """Terminal speeds (4096,) in m/s."""
    return np.linspace(10.0, 60.0, 4096)


def exact(terminal_m_s: Floats) -> Floats:
    """By the formula: another route than any tier's."""
    return np.array([float(speed(TIME_S, each)) for each in terminal_m_s])


def worst(result: Floats, truth: Floats, _terminal: Floats) -> float:
    return float(1000 * np.abs(result - truth).max())


def _tier(rule: str, steps: int, label: str, asks: int) -> Tier:
    run = partial(in_steps, rule, steps, TIME_S)
    return Tier(f"{rule}-{steps}", f"{label}, {steps} steps", f"{asks * steps} evaluations", run)


LADDER = Ladder(
    id="falling-steps",
    title="A fall in steps",
    workload="4096 balls, 3 s",
    prepare=prepare,
    tiers=(
        _tier("euler", 64, "Simple", 1),
        _tier("middle", 64, "Middle", 2),
        _tier("classic", 64, "Classic", 4),
        _tier("euler", 1024, "Simple", 1),
    ),
    reference=exact,
    reference_label="the formula",
    metrics=(Metric("worst", "Largest error", "mm/s", worst),),
    default_tier="middle-64",
)
