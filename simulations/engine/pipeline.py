"""Stages with declared inputs: computed when something they read changed, else reused or skipped.

A stage at its neutral parameter hands on *the same object* it received, and its output keeps
the identity of that input, so that everything downstream of it is reused as well. What a neutral
stage does not take, and nothing else does, is not computed either.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from simulations.engine.controls import Value, Values
from simulations.engine.frame import StageReport

type Key = tuple[str, tuple[tuple[str, Value], ...], tuple[Key, ...]]
"""A stage's name, the parameters that it read, and the keys of its inputs."""


@dataclass(frozen=True, slots=True)
class Stage:
    """One step of a simulation."""

    name: str
    reads: tuple[str, ...]
    """Names of the parameters that the result depends on."""
    compute: Callable[..., Any]
    """Called with the outputs of ``inputs`` in order, then the read parameters as keywords."""
    inputs: tuple[str, ...] = ()
    """Names of earlier stages."""
    neutral: Callable[[Values], str] | None = None
    """Why the stage would change nothing at these values, or an empty string where it would."""
    hands_on: str = ""
    """Earlier stage whose output a neutral stage hands on, also one that ``compute`` does not
    take; the first of ``inputs`` where none is named."""

    def __post_init__(self) -> None:
        if self.neutral and not self.source:
            raise ValueError(f"stage {self.name!r} is neutral; legal: with an input to hand on")
        if self.hands_on and not self.neutral:
            raise ValueError(
                f"stage {self.name!r} hands on {self.hands_on!r}; legal: where it can be neutral"
            )

    @property
    def source(self) -> str:
        """The stage whose output this one hands on while it is neutral; empty for none."""
        return self.hands_on or next(iter(self.inputs), "")

    def takes(self, neutral: bool) -> tuple[str, ...]:
        """Names of the stages whose outputs are needed now."""
        return (self.source,) if neutral else self.inputs


@dataclass(slots=True)
class StageCache:
    """Outputs of each stage, those asked for last. Belongs to one figure; dropping it loses only
    time."""

    depth: int = 2
    """Outputs kept per stage: the draft's and the settled one's."""
    entries: dict[str, dict[Key, Any]] = field(default_factory=dict)
    """Stage to key to output; what was asked for last comes last."""

    def get(self, name: str, key: Key) -> tuple[bool, Any]:
        """Whether the output is kept, and it."""
        kept = self.entries.get(name, {})
        if key not in kept:
            return False, None
        kept[key] = kept.pop(key)
        return True, kept[key]

    def put(self, name: str, key: Key, output: Any) -> None:
        kept = self.entries.setdefault(name, {})
        kept[key] = output
        while len(kept) > self.depth:
            kept.pop(next(iter(kept)))


@dataclass(frozen=True, slots=True)
class Run:
    """The outputs of all stages that were needed, and what was done to get them."""

    outputs: Mapping[str, Any]
    reports: tuple[StageReport, ...]


def run(
    stages: Sequence[Stage],
    values: Values,
    cache: StageCache,
    extra: Mapping[str, Value] | None = None,
) -> Run:
    """Evaluate ``stages`` in order.

    A stage that another one names is evaluated only where one that is not neutral takes it, or a
    neutral one hands it on; what no other stage names is always wanted.

    ``extra`` holds parameters that are no controls, such as the accuracy tier. Raises
    `KeyError` where a stage reads a parameter, or takes an input, that does not exist.
    """
    parameters: dict[str, Value] = {**values, **(extra or {})}
    known = Values(parameters)
    reasons = {stage.name: stage.neutral(known) if stage.neutral else "" for stage in stages}
    needed = _needed(stages, reasons)
    outputs: dict[str, Any] = {}
    keys: dict[str, Key] = {}
    reports: list[StageReport] = []
    for stage in stages:
        _require(stage.reads, parameters, f"stage {stage.name!r} reads")
        reason = reasons[stage.name]
        if stage.name not in needed:
            reports.append(StageReport(stage.name, "skipped", reason or "nothing takes it"))
            continue
        _require(stage.takes(bool(reason)), outputs, f"stage {stage.name!r} follows")
        if reason:
            outputs[stage.name], keys[stage.name] = outputs[stage.source], keys[stage.source]
            reports.append(StageReport(stage.name, "skipped", reason))
            continue
        read = {name: parameters[name] for name in stage.reads}
        key: Key = (stage.name, tuple(read.items()), tuple(keys[name] for name in stage.inputs))
        found, output = cache.get(stage.name, key)
        if found:
            reports.append(StageReport(stage.name, "reused", "nothing it reads has changed"))
        else:
            output = stage.compute(*(outputs[name] for name in stage.inputs), **read)
            reports.append(StageReport(stage.name, "computed", _why(stage, key, cache)))
            cache.put(stage.name, key, output)
        outputs[stage.name], keys[stage.name] = output, key
    return Run(outputs, tuple(reports))


def _needed(stages: Sequence[Stage], reasons: Mapping[str, str]) -> set[str]:
    """Names of the stages that no other one names, and backwards of all that these take."""
    named = {name for stage in stages for name in (*stage.inputs, stage.source)}
    needed = {stage.name for stage in stages if stage.name not in named}
    for stage in reversed(stages):
        if stage.name in needed:
            needed.update(stage.takes(bool(reasons[stage.name])))
    return needed


def _require(names: Sequence[str], known: Mapping[str, object], who: str) -> None:
    for name in names:
        if name not in known:
            raise KeyError(f"{who} {name!r}; legal: {', '.join(known)}")


def _why(stage: Stage, key: Key, cache: StageCache) -> str:
    """What has changed since the most similar result that is kept, in words for the page.

    Where none is kept, what the stage depends on.
    """
    kept = cache.entries.get(stage.name, {})
    changes = min((_changes(stage, key, old) for old in kept), key=len, default=())
    told = {"changed:": changes} if changes else {"reads": stage.reads, "follows": stage.inputs}
    words = (f"{verb} {_in_words(names)}" for verb, names in told.items() if names)
    return "; ".join(words) or "depends on nothing"


def _changes(stage: Stage, key: Key, kept: Key) -> tuple[str, ...]:
    """Names of the parameters and inputs that are not what they were."""
    (_, reads, inputs), (_, old_reads, old_inputs) = key, kept
    named_inputs = zip(stage.inputs, inputs, strict=True)
    return (
        *(name for name, value in reads if (name, value) not in old_reads),
        *(name for name, made_from in named_inputs if made_from not in old_inputs),
    )


def _in_words(names: Sequence[str]) -> str:
    return ", ".join(name.replace("_", " ") for name in names)
