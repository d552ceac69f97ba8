"""What may be left out of photographs that no figure shows: the recorded costs are those of the
pictures, and a plan is judged by its pictures and by what it saves."""

import pytest
from bench.omissions import Pictures, row

from simulations.world.camera_budget import (
    Plan,
    best_choice,
    best_in_squares,
    count_beyond,
    leave_nothing,
    one_by_one,
    prepare,
    saved_of_best,
)


@pytest.mark.parametrize("number", [3, 8])
def test_recorded_costs_best_choice_and_errors_of_a_photograph_are_those_of_its_pictures(
    number: int,
) -> None:
    task = prepare()[number]
    costs, _, best, errors = row(Pictures.of(task.photo), task.saved, task.tolerance)
    assert costs == pytest.approx([*task.costs.values()], rel=1e-3, abs=1e-6)
    assert best == task.best
    assert errors == pytest.approx(task.errors, rel=1e-3, abs=1e-6)


def all_effects_within(costs: dict[str, float], _saved: object, tolerance: float) -> set[str]:
    return {name for name in costs if costs[name] <= tolerance}


@pytest.mark.parametrize(
    ("plan", "all_within", "saves_enough"),
    [
        (best_choice, True, True),
        (best_in_squares, False, True),
        (all_effects_within, False, True),
        (one_by_one, True, False),
        (leave_nothing, True, False),
    ],
)
def test_plan_is_right_if_all_pictures_are_within_and_it_saves_nearly_as_much_as_the_best(
    plan: Plan, all_within: bool, saves_enough: bool
) -> None:
    assert (count_beyond(plan) == 0) is all_within
    assert saved_of_best(plan).endswith("or more") is saves_enough
