"""Stages: computed when what they read has changed, else reused; skipped where they are neutral."""

from collections import Counter
from collections.abc import Callable, Sequence
from functools import wraps
from typing import Any

import pytest

from simulations.engine.controls import Value
from simulations.engine.message import Message
from simulations.engine.stages import Stage, StageCache, run


class Counting:
    """Two stages that count their calls: a source, and a gain that is neutral at one."""

    def __init__(self) -> None:
        self.calls: Counter[str] = Counter()

    def counted(self, name: str, compute: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(compute)
        def wrapped(*inputs: Any, **parameters: Any) -> Any:
            self.calls[name] += 1
            return compute(*inputs, **parameters)

        return wrapped

    @property
    def stages(self) -> tuple[Stage, ...]:
        return (
            Stage("source", self.counted("source", lambda size: [1.0] * int(size))),
            Stage(
                "gain",
                self.counted("gain", lambda x, factor: [factor * item for item in x]),
                after=("source",),
                neutral=lambda factor: "the factor is one" if factor == 1 else "",
            ),
            Stage("sum", self.counted("sum", sum), after=("gain",)),
        )


@pytest.fixture
def counting() -> Counting:
    return Counting()


def values(**given: float) -> dict[str, Value]:
    return {"size": 3.0, "factor": 2.0, **given}


def statuses(*arguments: Any) -> list[str]:
    return [report.status for report in run(*arguments).reports]


def test_a_second_run_with_the_same_values_computes_nothing(counting: Counting) -> None:
    cache = StageCache()
    assert run(counting.stages, values(), cache).outputs["sum"] == 6.0
    assert statuses(counting.stages, values(), cache) == ["reused"] * 3
    assert counting.calls == {"source": 1, "gain": 1, "sum": 1}


def test_only_what_follows_a_change_is_computed(counting: Counting) -> None:
    cache = StageCache()
    run(counting.stages, values(), cache)
    assert statuses(counting.stages, values(factor=5), cache) == ["reused", "computed", "computed"]


def test_a_neutral_stage_passes_on_the_same_object(counting: Counting) -> None:
    outputs = run(counting.stages, values(factor=1), StageCache()).outputs
    assert outputs["gain"] is outputs["source"]
    assert counting.calls["gain"] == 0


def test_a_skipped_stage_says_why(counting: Counting) -> None:
    report = run(counting.stages, values(factor=1), StageCache()).reports[1]
    assert (report.status, report.reason) == ("skipped", "the factor is one")


def test_a_stage_that_is_neutral_for_no_reason_is_refused() -> None:
    first = Stage("first", lambda: 1)
    careless: Any = lambda factor: factor == 1  # noqa: E731
    with pytest.raises(TypeError, match="stage 'a': neutral returns False; legal: why, as text"):
        run((first, Stage("a", lambda x: x, ("first",), careless)), values(), StageCache())


def test_the_cache_changes_nothing_but_time(counting: Counting) -> None:
    cache = StageCache()
    for factor in (2, 1, 3, 2, 1, 7, 3):
        warm = run(counting.stages, values(factor=factor), cache).outputs
        cold = run(counting.stages, values(factor=factor), StageCache()).outputs
        assert warm == cold


def test_the_cache_keeps_no_more_than_its_depth(counting: Counting) -> None:
    cache = StageCache(depth=2)
    for factor in range(2, 8):
        run(counting.stages, values(factor=factor), cache)
    assert {name: len(kept) for name, kept in cache.entries.items()} == {
        "source": 1, "gain": 2, "sum": 2,
    }  # fmt: skip


def test_what_was_asked_for_last_is_kept_longest(counting: Counting) -> None:
    """A B A C A computes A once: the setting that a reader keeps coming back to."""
    cache = StageCache(depth=2)
    for factor in (2, 3, 2, 4, 2):
        run(counting.stages, values(factor=factor), cache)
    assert counting.calls["gain"] == 3
    assert statuses(counting.stages, values(factor=4), cache)[1] == "reused"
    assert statuses(counting.stages, values(factor=3), cache)[1] == "computed"


def noisy_stages(calls: Counter[str]) -> tuple[Stage, ...]:
    """Grain that two stages may take, and a stage that can do without those before it."""

    def called(name: str, output: Any) -> Any:
        calls[name] += 1
        return output

    return (
        Stage("rays", lambda: called("rays", 1.0)),
        Stage("surfaces", lambda rays: called("surfaces", rays + 1.0), ("rays",)),
        Stage(
            "lens",
            lambda rays, lens_rays: called("lens", rays * lens_rays),
            ("rays",),
            lambda lens_rays: "" if lens_rays else "one ray",
            passes_on="surfaces",
        ),
        Stage("grain", lambda: called("grain", 0.25)),
        Stage(
            "noise",
            lambda light, grain, sigma: called("noise", light + sigma * grain),
            ("lens", "grain"),
            lambda sigma: "" if sigma else "no noise",
        ),
    )


@pytest.mark.parametrize(
    ("sigma", "lens_rays", "made", "result"),
    [
        (0.0, 0.0, ("rays", "surfaces"), 2.0),
        (2.0, 0.0, ("rays", "surfaces", "grain", "noise"), 2.5),
        (0.0, 3.0, ("rays", "lens"), 3.0),
        (2.0, 3.0, ("rays", "lens", "grain", "noise"), 3.5),
    ],
)
def test_what_nothing_takes_is_not_computed(
    sigma: float, lens_rays: float, made: tuple[str, ...], result: float
) -> None:
    calls: Counter[str] = Counter()
    stages, given = noisy_stages(calls), values(sigma=sigma, lens_rays=lens_rays)
    done = run(stages, given, StageCache())
    assert tuple(calls) == made
    assert done.outputs["noise"] == result
    idle = {report.name: report.reason for report in done.reports if report.status == "skipped"}
    own = {"lens": "one ray", "noise": "no noise"}
    assert idle == {
        stage.name: own.get(stage.name, (Message("stage_report.unneeded"),))
        for stage in stages
        if stage.name not in made
    }
    assert set(done.outputs) == {"noise", "lens", *made}


def test_what_has_a_default_is_not_read() -> None:
    stage = Stage("sized", lambda size, factor=10: size * factor)
    assert stage.reads == ("size",)
    assert run((stage,), values(), StageCache()).outputs["sized"] == 30.0


def test_a_stage_needs_an_argument_for_each_that_it_comes_after() -> None:
    with pytest.raises(ValueError, match=r"stage 'a' comes after .*legal: as many as it has arg"):
        Stage("a", lambda x: x, ("first", "second"))


@pytest.mark.parametrize(
    ("stage", "message"),
    [
        (Stage("a", lambda sise: sise), "stage 'a' reads 'sise'; legal: size, factor"),
        (Stage("b", lambda x: x, ("source",)), "stage 'b' follows 'source'; legal: first"),
        (
            Stage("c", lambda x: x, ("first",), lambda depth: f"{depth}"),
            "stage 'c': neutral reads 'depth'; legal: size, factor",
        ),
    ],
)
def test_a_stage_that_asks_for_what_does_not_exist_is_named(stage: Stage, message: str) -> None:
    first = Stage("first", lambda: 1)
    with pytest.raises(KeyError, match=message):
        run((first, stage), values(), StageCache())


def test_a_stage_without_inputs_has_nothing_to_pass_on() -> None:
    with pytest.raises(ValueError, match="stage 'a' has neutral; legal: with an input"):
        Stage("a", lambda: 1, neutral=lambda: "always")


def test_what_is_passed_on_is_passed_on_by_a_stage_that_can_be_neutral() -> None:
    with pytest.raises(ValueError, match="stage 'a' passes on 'b'; legal: where it can be neutral"):
        Stage("a", lambda: 1, passes_on="b")
    first = Stage("first", lambda: 1)
    lost = Stage("a", lambda: 1, neutral=lambda: "always", passes_on="b")
    with pytest.raises(KeyError, match="stage 'a' follows 'b'; legal: first"):
        run((first, lost), values(), StageCache())


def reasons(*arguments: Any) -> list[str]:
    return [spelt(report.reason) for report in run(*arguments).reports]


def spelt(reason: str | Sequence[Message]) -> str:
    """``reads a, b; unneeded``"""
    assert not isinstance(reason, str)
    parts = (
        (part.key.removeprefix("stage_report."), part.values.get("names", "")) for part in reason
    )
    return "; ".join(" ".join(filter(None, part)) for part in parts)


def test_what_is_computed_for_the_first_time_says_what_it_depends_on(counting: Counting) -> None:
    assert reasons(counting.stages, values(), StageCache()) == [
        *("reads size", "reads factor; follows source", "follows gain"),
    ]


def test_what_is_computed_again_says_what_has_changed(counting: Counting) -> None:
    cache = StageCache()
    run(counting.stages, values(), cache)
    nothing = "unchanged"
    assert reasons(counting.stages, values(factor=5), cache) == [
        *(nothing, "changed factor", "changed gain"),
    ]
    assert reasons(counting.stages, values(factor=5, size=2), cache) == [
        *("changed size", "changed source", "changed gain"),
    ]


def test_a_change_is_told_against_the_most_similar_result_that_is_kept(counting: Counting) -> None:
    """After a reference of another size and factor, only the moved control is named."""
    cache = StageCache()
    run(counting.stages, values(factor=5), cache)
    run(counting.stages, values(factor=7, size=90), cache)
    assert reasons(counting.stages, values(factor=6), cache)[1] == "changed factor"


def test_a_stage_may_read_less_than_one_of_its_name_did_before() -> None:
    """As where a tier computes the same thing from other parameters."""
    cache = StageCache()
    run((Stage("source", lambda size, factor: size * factor),), values(), cache)
    report = run((Stage("source", lambda size: size),), values(), cache).reports[0]
    assert (report.status, spelt(report.reason)) == ("computed", "reads size")
