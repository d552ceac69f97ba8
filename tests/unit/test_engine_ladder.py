"""Measuring a ladder with a manual clock, so that every time is known beforehand."""

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.engine.ladder import Ladder, Metric, Tier, measure_tier, pareto_front


class ManualClock:
    """A clock that only moves when a tier works."""

    def __init__(self, tick: float = 0.0) -> None:
        self.now = 0.0
        self.tick = tick
        """Readings are rounded down to this many seconds."""
        self.runs = 0

    def __call__(self) -> float:
        return self.now // self.tick * self.tick if self.tick else self.now

    def measure(self, *seconds: float, **options: Any) -> Any:
        """Measure a tier whose n-th run takes the n-th of ``seconds``, in rotation."""

        def run(workload: float) -> float:
            self.now += seconds[self.runs % len(seconds)]
            self.runs += 1
            return workload + 1.0

        return measure_tier(ladder(run), "only", 1.0, 4.0, self, **options)


def fail(*_: object) -> float:
    raise AssertionError("workload and reference are taken as given")


def ladder(run: Any = None) -> Ladder:
    return Ladder(
        id="toy",
        title="Toy",
        workload="a number",
        prepare=fail,
        tiers=(Tier("only", "Only", "1 addition", run),),
        reference=fail,
        reference_label="arithmetic",
        metrics=(Metric("gap", "Gap", "px", lambda r, ref, _w: abs(r - ref)),),
        default_tier="only",
    )


def test_time_is_the_median_and_spread_the_quartiles() -> None:
    """Call 1 warms up and call 2 sizes the sample: the five samples are calls 3 to 7."""
    seconds = (0.010, 0.010, 0.010, 0.020, 0.030, 0.040, 0.050)
    result = ManualClock().measure(*seconds, budget_s=0.0)
    assert result.milliseconds == pytest.approx(30.0)
    assert (result.low_ms, result.high_ms) == pytest.approx((20.0, 40.0))
    assert (result.repeats, result.errors) == (5, {"gap": 2.0})


@pytest.mark.parametrize(
    ("run_s", "options", "repeats"),
    [
        (10.0, {"budget_s": 0.1}, {5}),  # at least five, whatever the budget
        (0.01, {"budget_s": 0.1}, {10, 11}),
        (0.01, {"budget_s": 1e9, "at_most": 12}, {12}),
        (0.0, {"at_most": 6}, {6}),  # a clock that never moves
    ],
)
def test_sampling_ends_when_budget_or_limit_is_reached(
    run_s: float, options: dict[str, Any], repeats: set[int]
) -> None:
    assert ManualClock().measure(run_s, **options).repeats in repeats


def test_coarse_clock_measures_a_quick_tier_correctly() -> None:
    result = ManualClock(tick=1e-4).measure(7e-6, budget_s=0.2)
    assert result.milliseconds == pytest.approx(0.007, rel=0.03)


@given(st.lists(st.tuples(*[st.integers(0, 9).map(float)] * 2), min_size=1, max_size=12))
def test_point_off_the_pareto_front_is_dominated_by_one_on_it(
    points: list[tuple[float, float]],
) -> None:
    front = pareto_front(points)
    best = [point for point, on in zip(points, front, strict=True) if on]
    for x, y in (point for point, on in zip(points, front, strict=True) if not on):
        assert any(bx <= x and by <= y and (bx, by) != (x, y) for bx, by in best)
    assert best


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda toy: toy.tier("other"), "ladder 'toy' has no tier 'other'; legal: only"),
        (lambda toy: replace(toy, tiers=toy.tiers * 2), "ladder 'toy'"),
        (lambda toy: replace(toy, default_tier="none"), "default 'none'"),
    ],
)
def test_ladder_that_contradicts_itself_is_refused(make: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make(ladder())
