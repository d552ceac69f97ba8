"""Stages with declared inputs: computed when something they read changed, else reused or skipped.

A stage at its neutral parameter hands on *the same object* it received, and its output keeps
the identity of that input, so that everything downstream of it is reused as well.
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

    def __post_init__(self) -> None:
        if self.neutral and not self.inputs:
            raise ValueError(f"stage {self.name!r} is neutral; legal: with an input to hand on")


@dataclass(slots=True)
class StageCache:
    """The last outputs of each stage. Belongs to one figure; dropping it loses only time."""

    depth: int = 2
    """Outputs kept per stage: the draft's and the settled one's."""
    entries: dict[str, dict[Key, Any]] = field(default_factory=dict)

    def get(self, name: str, key: Key) -> tuple[bool, Any]:
        kept = self.entries.get(name, {})
        return (True, kept[key]) if key in kept else (False, None)

    def put(self, name: str, key: Key, output: Any) -> None:
        kept = self.entries.setdefault(name, {})
        kept[key] = output
        while len(kept) > self.depth:
            kept.pop(next(iter(kept)))


@dataclass(frozen=True, slots=True)
class Run:
    """The outputs of all stages and what was done to get them."""

    outputs: Mapping[str, Any]
    reports: tuple[StageReport, ...]


def run(
    stages: Sequence[Stage],
    values: Values,
    cache: StageCache,
    extra: Mapping[str, Value] | None = None,
) -> Run:
    """Evaluate ``stages`` in order.

    ``extra`` holds parameters that are no controls, such as the accuracy tier. Raises
    `KeyError` where a stage reads a parameter, or takes an input, that does not exist.
    """
    parameters: dict[str, Value] = {**values, **(extra or {})}
    known = Values(parameters)
    outputs: dict[str, Any] = {}
    keys: dict[str, Key] = {}
    reports: list[StageReport] = []
    for stage in stages:
        reason = stage.neutral(known) if stage.neutral else ""
        _require(stage.inputs, outputs, f"stage {stage.name!r} follows")
        _require(stage.reads, parameters, f"stage {stage.name!r} reads")
        if reason:
            source = stage.inputs[0]
            outputs[stage.name], keys[stage.name] = outputs[source], keys[source]
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
