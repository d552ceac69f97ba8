"""Measuring a ladder: with a clock that the test winds, every number is known beforehand."""

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.engine.ladder import Ladder, Metric, Tier, measure_tier, pareto_front
from simulations.registry import LADDER_MODULES, UnknownIdError, load_ladder


class WoundClock:
    """A clock that only moves when a tier works."""

    def __init__(self, tick: float = 0.0) -> None:
        self.now = 0.0
        self.tick = tick
        """Readings are rounded down to this many seconds."""
        self.runs = 0

    def __call__(self) -> float:
        return self.now // self.tick * self.tick if self.tick else self.now

    def worker(self, *seconds: float) -> Any:
        """A tier's ``run`` whose n-th call takes the n-th of ``seconds``, in rotation."""

        def run(workload: float) -> float:
            self.now += seconds[self.runs % len(seconds)]
            self.runs += 1
            return workload + 1.0

        return run


def ladder(run: Any) -> Ladder:
    metric = Metric("gap", "Gap", "px", lambda r, ref, _w: abs(r - ref))
    return Ladder(
        id="toy",
        title="Toy",
        workload="a number",
        prepare=lambda: 1.0,
        tiers=(Tier("only", "Only", "1 addition", run),),
        reference=lambda workload: workload + 3.0,
        reference_label="arithmetic",
        metrics=(metric,),
        default_tier="only",
    )


def measure(clock: WoundClock, run: Any, **options: Any) -> Any:
    return measure_tier(ladder(run), "only", 1.0, 4.0, clock, **options)


def test_the_time_is_the_median_and_the_spread_its_quartiles() -> None:
    clock = WoundClock()
    run = clock.worker(0.010, 0.010, 0.010, 0.020, 0.030, 0.040, 0.050)
    # Call 1 warms up and call 2 sizes the sample: the five samples are calls 3 to 7.
    result = measure(clock, run, budget_s=0.0)
    assert result.milliseconds == pytest.approx(30.0)
    assert (result.low_ms, result.high_ms) == pytest.approx((20.0, 40.0))
    assert result.repeats == 5


def test_a_slow_tier_is_run_at_least_five_times_whatever_the_budget() -> None:
    clock = WoundClock()
    assert measure(clock, clock.worker(10.0), budget_s=0.1).repeats == 5


def test_sampling_ends_when_the_budget_is_spent() -> None:
    clock = WoundClock()
    assert measure(clock, clock.worker(0.01), budget_s=0.1).repeats in (10, 11)


def test_sampling_ends_at_its_limit() -> None:
    clock = WoundClock()
    assert measure(clock, clock.worker(0.01), budget_s=1e9, at_most=12).repeats == 12


def test_a_coarse_clock_measures_a_quick_tier_right() -> None:
    clock = WoundClock(tick=1e-4)
    result = measure(clock, clock.worker(7e-6), budget_s=0.2)
    assert result.milliseconds == pytest.approx(0.007, rel=0.03)


def test_a_clock_that_never_moves_does_not_hang_the_measurement() -> None:
    clock = WoundClock()
    result = measure(clock, clock.worker(0.0), at_most=6)
    assert result.milliseconds == 0.0


def test_the_error_is_the_metric_of_result_and_reference() -> None:
    clock = WoundClock()
    assert measure(clock, clock.worker(0.01)).errors == {"gap": 2.0}


def test_workload_and_reference_are_taken_as_given_and_never_timed() -> None:
    def again(*_: object) -> float:
        raise AssertionError("prepared anew")

    clock = WoundClock()
    toy = replace(ladder(clock.worker(0.01)), prepare=again, reference=again)
    assert measure_tier(toy, "only", 1.0, 4.0, clock).errors == {"gap": 2.0}


def test_the_front_leaves_out_what_is_slower_and_worse() -> None:
    points = [(1.0, 9.0), (2.0, 3.0), (3.0, 4.0), (4.0, 1.0)]
    assert pareto_front(points) == (True, True, False, True)


def test_equal_points_do_not_beat_each_other() -> None:
    assert pareto_front([(1.0, 1.0), (1.0, 1.0)]) == (True, True)


@given(st.lists(st.tuples(*[st.integers(0, 9).map(float)] * 2), min_size=1, max_size=12))
def test_whatever_is_off_the_front_is_beaten_by_something_on_it(
    points: list[tuple[float, float]],
) -> None:
    front = pareto_front(points)
    best = [point for point, on in zip(points, front, strict=True) if on]
    assert best
    for x, y in (point for point, on in zip(points, front, strict=True) if not on):
        assert any(bx <= x and by <= y and (bx, by) != (x, y) for bx, by in best)


def test_an_unknown_tier_is_named_with_the_legal_ones() -> None:
    with pytest.raises(ValueError, match="ladder 'toy' has no tier 'other'; legal: only"):
        ladder(None).tier("other")


def test_two_tiers_of_one_id_are_refused() -> None:
    toy = ladder(None)
    with pytest.raises(ValueError, match="ladder 'toy'"):
        replace(toy, tiers=toy.tiers * 2)


def test_a_default_that_is_no_tier_is_refused() -> None:
    with pytest.raises(ValueError, match="default 'none'"):
        replace(ladder(None), default_tier="none")


@pytest.mark.parametrize("ladder_id", LADDER_MODULES)
def test_every_registered_ladder_is_found_under_its_own_id(ladder_id: str) -> None:
    assert load_ladder(ladder_id).id == ladder_id


def test_an_unknown_ladder_is_answered_with_the_nearest_name() -> None:
    known = next(iter(LADDER_MODULES))
    with pytest.raises(UnknownIdError, match=rf"unknown ladder '{known}x'.*did you mean '{known}'"):
        load_ladder(f"{known}x")
