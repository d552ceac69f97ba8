"""What a camera may leave out of photographs that no figure shows: nothing, effects one by one, or
the best of all choices; and each choice photographed.

A plan gets what each effect costs and what it saves, one at a time (`budget_costs`), and names
those to leave out, so that the picture stays within a tolerance.
"""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import combinations
from typing import Any

import numpy as np

from simulations.models.arrays import Planes
from simulations.world.budget_costs import FOUND
from simulations.world.omissions import (
    EFFECTS,
    Photo,
    codes,
    error_without,
    run_without,
)

TOLERANCES = (6.0, 12.0, 0.5, 2.0)
"""Codes; one photograph after the other has the next."""
REDUCTION = 2
"""Photographs of 132 × 88 pixels."""
COUNT = 20
WITHIN = "within its tolerance"
ENOUGH = 0.95
"""Share of the time that the best choices save from which on no better one is asked for."""

type Plan = Callable[[Mapping[str, float], Mapping[str, float], float], Collection[str]]
"""Names to leave out, of costs in codes, savings in milliseconds, and a tolerance in codes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Task:
    """A photograph, and what is known of it before it is taken."""

    photo: Photo
    costs: Mapping[str, float]
    """RMS in codes without one effect, by its name."""
    saved: Mapping[str, float]
    """Milliseconds, by name."""
    tolerance: float
    """Codes."""
    best: tuple[str, ...]
    """Of all 128 choices whose picture stays within the tolerance, the one that saves most."""
    errors: Mapping[tuple[str, ...], float]
    """RMS in codes of the picture without several effects, for the choices of known plans."""

    @property
    def most(self) -> float:
        """Milliseconds that the best choice saves."""
        return time_saved(self.saved, self.best)


def drawn_photo(seed: int) -> Photo:
    """A photograph at random, between the ends of the camera's sliders."""
    rng = np.random.default_rng(seed)

    def between(low: float, high: float) -> float:
        """Equally likely in each ratio."""
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    return Photo(
        focal_length=between(24.0, 135.0),
        aperture=between(1.4, 22.0),
        light_angle=float(rng.uniform(-80.0, 80.0)),
        floor=between(0.04, 1.0),
        origin_m=between(10.0, 1e6),
        white_e=between(12.0, 10_000.0),
        reduction=REDUCTION,
    )


def tolerance_of(seed: int) -> float:
    return TOLERANCES[seed % len(TOLERANCES)]


@cache
def prepare() -> tuple[Task, ...]:
    return tuple(
        Task(
            photo=drawn_photo(seed),
            costs=dict(zip(EFFECTS, costs, strict=True)),
            saved=dict(zip(EFFECTS, saved, strict=True)),
            tolerance=tolerance_of(seed),
            best=best,
            errors=errors,
        )
        for seed, (costs, saved, best, errors) in enumerate(FOUND)
    )


def in_order(names: Collection[str]) -> tuple[str, ...]:
    """Names of effects in the order of `EFFECTS`."""
    return tuple(name for name in EFFECTS if name in names)


def time_saved(saved: Mapping[str, float], names: Collection[str]) -> float:
    """Milliseconds."""
    return sum(saved[name] for name in names)


def leave_nothing(
    _costs: Mapping[str, float], _saved: Mapping[str, float], _tolerance: float
) -> Collection[str]:
    return ()


def in_squares(costs: Mapping[str, float], names: Collection[str]) -> float:
    """The error without effects that have nothing to do with each other."""
    return float(np.hypot.reduce([costs[name] for name in names], initial=0.0))


def edges_added(costs: Mapping[str, float], names: Collection[str]) -> float:
    """In squares, but blur and the pixel's area as they are: both soften the same edges."""
    edges = sum(costs[name] for name in names if name in ("blur", "area"))
    rest = in_squares(costs, [name for name in names if name not in ("blur", "area")])
    return float(np.hypot(edges, rest))


def one_by_one(
    costs: Mapping[str, float], _saved: Mapping[str, float], tolerance: float
) -> Collection[str]:
    """The cheapest first, as long as the error is within the tolerance."""
    chosen: list[str] = []
    for name in sorted(costs, key=lambda each: costs[each]):
        if edges_added(costs, [*chosen, name]) > tolerance:
            break
        chosen.append(name)
    return chosen


def best_choice(
    costs: Mapping[str, float], saved: Mapping[str, float], tolerance: float
) -> Collection[str]:
    """Of all choices within the tolerance the one that saves most."""
    return _best_within(costs, saved, tolerance, edges_added)


def best_in_squares(
    costs: Mapping[str, float], saved: Mapping[str, float], tolerance: float
) -> Collection[str]:
    """The same, if all errors added in squares."""
    return _best_within(costs, saved, tolerance, in_squares)


def _best_within(
    costs: Mapping[str, float],
    saved: Mapping[str, float],
    tolerance: float,
    error: Callable[[Mapping[str, float], Collection[str]], float],
) -> Collection[str]:
    choices = (names for count in range(8) for names in combinations(costs, count))
    within = (names for names in choices if error(costs, names) <= tolerance)
    return max(within, key=lambda names: time_saved(saved, names))


def given(task: Task) -> tuple[dict[str, float], dict[str, float], float]:
    """The arguments of a plan."""
    return dict(task.costs), dict(task.saved), task.tolerance


def asked(number: int) -> dict[str, Any]:
    """What an exercise says of a photograph."""
    task = prepare()[number]
    costs, saved, tolerance = given(task)
    return {"number": number, "tolerance": tolerance, "costs": costs, "saved": saved}


PLANS: Mapping[str, Plan] = {
    "nothing": leave_nothing,
    "single": one_by_one,
    "squares": best_in_squares,
    "added": best_choice,
}
"""Plans whose pictures are recorded."""


@cache
def _truth(number: int) -> Planes:
    """(3, H, W) the complete picture, in codes without noise."""
    return codes(run_without(prepare()[number].photo)["falloff"])


@cache
def error_in_picture(number: int, left: tuple[str, ...]) -> float:
    """RMS in codes of a photograph of the exercise without some effects."""
    task = prepare()[number]
    light = run_without(task.photo, left)["falloff"]
    return error_without(left, light, _truth(number), task.costs["poisson"])


def photographed(plan: Plan, task: Mapping[str, Any]) -> str | None:
    """What becomes of a plan for one photograph: a sentence, the same for all that are right."""
    left = plan(dict(task["costs"]), dict(task["saved"]), task["tolerance"])
    if left is None:
        return None
    if unknown := sorted(set(left) - set(EFFECTS)):
        return f"without {', '.join(map(str, unknown))}, which is no effect"
    names = in_order(left)
    error = error_in_picture(task["number"], names)
    if error <= task["tolerance"]:
        return WITHIN
    return f"{error:.3g} codes off without {', '.join(names)}"


def count_beyond(plan: Plan) -> int:
    """Photographs of the exercise whose picture is beyond its tolerance."""
    found = [photographed(plan, asked(number)) for number in range(COUNT)]
    return COUNT - found.count(WITHIN)


def saved_of_best(plan: Plan) -> str:
    """What a plan saves on all photographs of the exercise, of what the best choices save."""
    tasks = prepare()
    saved = sum(time_saved(task.saved, plan(*given(task))) for task in tasks)
    share = saved / sum(task.most for task in tasks)
    return f"{ENOUGH:.0%} or more" if share >= ENOUGH else f"{share:.1%}"
