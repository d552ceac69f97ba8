"""Stages: computed when an input has changed, otherwise reused; skipped where they are neutral."""

from collections import Counter
from collections.abc import Sequence
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.engine.message import Message
from simulations.engine.stages import Stage, StageCache, run

CALLS: Counter[str] = Counter()


def counted(name: str, output: Any) -> Any:
    CALLS[name] += 1
    return output


GAIN = (
    Stage("source", lambda size: counted("source", [1.0] * int(size))),
    Stage(
        "gain",
        lambda x, factor: counted("gain", [factor * item for item in x]),
        ("source",),
        neutral=lambda factor: "the factor is one" if factor == 1 else "",
    ),
    Stage("sum", lambda x: counted("sum", sum(x)), ("gain",)),
)
"""A source, a gain that is neutral at one, and their sum."""
NOISE = (
    Stage("rays", lambda: counted("rays", 1.0)),
    Stage("surfaces", lambda rays: counted("surfaces", rays + 1.0), ("rays",)),
    Stage(
        "lens",
        lambda rays, lens_rays: counted("lens", rays * lens_rays),
        ("rays",),
        neutral=lambda lens_rays: "" if lens_rays else "one ray",
        passes_on="surfaces",
    ),
    Stage("grain", lambda: counted("grain", 0.25)),
    Stage(
        "noise",
        lambda light, grain, sigma: counted("noise", light + sigma * grain),
        ("lens", "grain"),
        neutral=lambda sigma: "" if sigma else "no noise",
    ),
)
"""A stage whose result two others may use, and a stage that may bypass earlier ones."""


@pytest.fixture(autouse=True)
def _reset_counts() -> None:
    CALLS.clear()


def values(**given: float) -> dict[str, Any]:
    return {"size": 3.0, "factor": 2.0, **given}


def statuses(cache: StageCache, **given: float) -> list[str]:
    return [report.status for report in run(GAIN, values(**given), cache).reports]


def test_only_stages_after_a_change_are_computed() -> None:
    cache = StageCache()
    assert run(GAIN, values(), cache).outputs["sum"] == 6.0
    assert statuses(cache) == ["reused"] * 3
    assert CALLS == {"source": 1, "gain": 1, "sum": 1}
    assert statuses(cache, factor=5) == ["reused", "computed", "computed"]


def test_neutral_stage_passes_its_input_on_and_reports_why() -> None:
    done = run(GAIN, values(factor=1), StageCache())
    assert done.outputs["gain"] is done.outputs["source"]
    assert CALLS["gain"] == 0
    assert (done.reports[1].status, done.reports[1].reason) == ("skipped", "the factor is one")


@given(st.lists(st.tuples(st.integers(1, 4), st.integers(1, 4)), max_size=12))
def test_cache_changes_no_output_and_keeps_its_depth(requested: list[tuple[int, int]]) -> None:
    cache = StageCache(depth=2)
    for size, factor in requested:
        given_values = values(size=size, factor=factor)
        warm, cold = (run(GAIN, given_values, c).outputs for c in (cache, StageCache()))
        assert warm == cold
    assert all(len(kept) <= 2 for kept in cache.entries.values())


def test_cache_evicts_the_least_recently_used_result() -> None:
    """A B A C A computes A once."""
    cache = StageCache(depth=2)
    for factor in (2, 3, 2, 4, 2):
        run(GAIN, values(factor=factor), cache)
    assert CALLS["gain"] == 3
    assert statuses(cache, factor=4)[1] == "reused"
    assert statuses(cache, factor=3)[1] == "computed"


@pytest.mark.parametrize(
    ("sigma", "lens_rays", "made", "result"),
    [
        (0.0, 0.0, ("rays", "surfaces"), 2.0),
        (2.0, 0.0, ("rays", "surfaces", "grain", "noise"), 2.5),
        (0.0, 3.0, ("rays", "lens"), 3.0),
        (2.0, 3.0, ("rays", "lens", "grain", "noise"), 3.5),
    ],
)
def test_stage_whose_output_is_unused_is_not_computed(
    sigma: float, lens_rays: float, made: tuple[str, ...], result: float
) -> None:
    done = run(NOISE, values(sigma=sigma, lens_rays=lens_rays), StageCache())
    assert tuple(CALLS) == made
    assert done.outputs["noise"] == result
    assert set(done.outputs) == {"noise", "lens", *made}
    idle = {report.name: report.reason for report in done.reports if report.status == "skipped"}
    own = {"lens": "one ray", "noise": "no noise"}
    unneeded = (Message("stage_report.unneeded"),)
    assert idle == {s.name: own.get(s.name, unneeded) for s in NOISE if s.name not in made}


def written_out(reason: str | Sequence[Message]) -> str:
    """``reads a, b; unneeded``"""
    assert not isinstance(reason, str)
    parts = (
        (part.key.removeprefix("stage_report."), part.values.get("names", "")) for part in reason
    )
    return "; ".join(" ".join(filter(None, part)) for part in parts)


def test_report_names_dependencies_or_changes_of_a_stage() -> None:
    """Compared with the most similar cached result, so that only the moved control is named."""
    cache = StageCache()
    rows: list[tuple[dict[str, float], str]] = [
        ({}, "reads size / reads factor; follows source / follows gain"),
        ({"factor": 5}, "unchanged / changed factor / changed gain"),
        ({"factor": 5, "size": 2}, "changed size / changed source / changed gain"),
        ({"factor": 6, "size": 2}, "unchanged / changed factor / changed gain"),
    ]
    for given_values, expected in rows:
        reports = run(GAIN, values(**given_values), cache).reports
        assert " / ".join(written_out(report.reason) for report in reports) == expected
    cache = StageCache()
    for factor, size in ((5, 3), (7, 90), (6, 3)):
        reports = run(GAIN, values(factor=factor, size=size), cache).reports
    assert written_out(reports[1].reason) == "changed factor"


def test_stage_of_the_same_name_may_read_fewer_parameters() -> None:
    """A tier may compute the same output from other parameters."""
    cache = StageCache()
    run((Stage("source", lambda size, factor: size * factor),), values(), cache)
    stage = Stage("source", lambda size, factor=10: size * factor)
    done = run((stage,), values(), cache)
    assert stage.reads == ("size",)
    assert done.outputs["source"] == 30.0
    assert (done.reports[0].status, written_out(done.reports[0].reason)) == (
        "computed",
        "reads size",
    )


FIRST = Stage("first", lambda: 1)
CARELESS: Any = lambda: False  # noqa: E731


@pytest.mark.parametrize(
    ("stage", "message"),
    [
        (lambda: Stage("a", lambda sise: sise), "stage 'a' reads 'sise'; legal: size, factor"),
        (lambda: Stage("b", lambda x: x, ("source",)), "stage 'b' follows 'source'; legal: first"),
        (
            lambda: Stage("c", lambda x: x, ("first",), neutral=lambda depth: str(depth)),
            "neutral reads 'depth'",
        ),
        (lambda: Stage("a", lambda x: x, ("first",), neutral=CARELESS), "neutral returns False"),
        (lambda: Stage("a", lambda x: x, ("first", "second")), "legal: as many as it has arg"),
        (lambda: Stage("a", lambda: 1, neutral=lambda: "always"), "legal: with an input"),
        (lambda: Stage("a", lambda: 1, passes_on="b"), "legal: where it can be neutral"),
        (
            lambda: Stage("a", lambda: 1, neutral=lambda: "always", passes_on="b"),
            "stage 'a' follows 'b'; legal: first",
        ),
    ],
)
def test_stage_that_contradicts_itself_is_refused(stage: Any, message: str) -> None:
    with pytest.raises((KeyError, TypeError, ValueError), match=message):
        run((FIRST, stage()), values(), StageCache())
