"""Stages: computed if something they read has changed, reused if not, skipped if neutral.

The signature of a stage's function states what the stage reads: first the outputs of the stages
named in ``after``, then parameters by name. A neutral stage passes on the object that it received,
not a copy, so that the stages after it are reused as well. Outputs that only neutral stages would
read are not computed.
"""

import inspect
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field
from functools import lru_cache
from typing import Any

from simulations.engine.controls import Value
from simulations.engine.frame import StageReport
from simulations.engine.message import Message
from simulations.engine.photograph import Photograph
from simulations.engine.reading import Readings

type Parameter = Value | Photograph | Readings | None
"""A value that a stage may read: a setting, the tier, or the reader's pictures."""
type Key = tuple[str, tuple[tuple[str, Parameter], ...], tuple[Key, ...]]
"""A stage's name, the parameters that it read, and the keys of its inputs."""
type Outputs = Mapping[str, Any]
"""Output of each stage by its name, and what `simulations.engine.scene.Scene.run` adds."""


UNNEEDED = (Message("stage_report.unneeded"),)
UNCHANGED = (Message("stage_report.unchanged"),)


@dataclass(frozen=True, slots=True)
class Stage:
    """One step of a simulation."""

    name: str
    compute: Callable[..., Any]
    """Takes the outputs of ``after`` in order, then the parameters it reads, by name. The engine
    does not set arguments that have a default."""
    after: tuple[str, ...] = ()
    """Names of earlier stages."""
    _: KW_ONLY
    neutral: Callable[..., str] | None = None
    """Takes parameters by name. Returns why the stage would change nothing, or an empty string if
    it would change something."""
    passes_on: str = ""
    """The earlier stage whose output is passed on if this one is neutral; ``compute`` need not take
    it. By default the first of ``after``."""

    def __post_init__(self) -> None:
        if self.neutral and not self.source:
            raise ValueError(f"stage {self.name!r} has neutral; legal: with an input to pass on")
        if self.passes_on and not self.neutral:
            raise ValueError(
                f"stage {self.name!r} passes on {self.passes_on!r}; legal: where it can be neutral"
            )
        if len(_arguments(self.compute)) < len(self.after):
            raise ValueError(
                f"stage {self.name!r} comes after {self.after}; "
                f"legal: as many as it has arguments, {_arguments(self.compute)}"
            )

    @property
    def reads(self) -> tuple[str, ...]:
        """Names of the parameters that the result depends on."""
        return _arguments(self.compute)[len(self.after) :]

    @property
    def source(self) -> str:
        """The stage whose output is passed on if this one is neutral; empty for none."""
        return self.passes_on or next(iter(self.after), "")

    def takes(self, neutral: bool) -> tuple[str, ...]:
        """Names of the stages whose outputs are needed."""
        return (self.source,) if neutral else self.after

    def reason(self, parameters: Mapping[str, Parameter]) -> str:
        """Why the stage would change nothing; empty if it would change something."""
        if self.neutral is None:
            return ""
        values = _selected(self.neutral, parameters, f"stage {self.name!r}: neutral reads")
        reason = self.neutral(**values)
        if not isinstance(reason, str):
            raise TypeError(
                f"stage {self.name!r}: neutral returns {reason!r}; legal: why, as text, or ''"
            )
        return reason


@lru_cache(maxsize=1024)
def _arguments(function: Callable[..., Any]) -> tuple[str, ...]:
    """Names of the arguments that have no default."""
    parameters = inspect.signature(function).parameters.values()
    return tuple(item.name for item in parameters if item.default is inspect.Parameter.empty)


def _selected(
    function: Callable[..., Any], parameters: Mapping[str, Parameter], who: str
) -> dict[str, Parameter]:
    names = _arguments(function)
    _require(names, parameters, who)
    return {name: parameters[name] for name in names}


@dataclass(slots=True)
class StageCache:
    """The most recent outputs of each stage, for one figure."""

    depth: int = 2
    """Outputs cached per stage: by default one while something moves and one at rest."""
    entries: dict[str, dict[Key, Any]] = field(default_factory=dict)
    """Stage to key to output, the least recently used first."""

    def get(self, name: str, key: Key) -> tuple[bool, Any]:
        """Whether the output is cached, and the output."""
        cached = self.entries.get(name, {})
        if key not in cached:
            return False, None
        cached[key] = cached.pop(key)
        return True, cached[key]

    def put(self, name: str, key: Key, output: Any) -> None:
        cached = self.entries.setdefault(name, {})
        cached[key] = output
        while len(cached) > self.depth:
            cached.pop(next(iter(cached)))


@dataclass(frozen=True, slots=True)
class Run:
    """The outputs of all stages that were needed, and a report of each stage."""

    outputs: Outputs
    reports: tuple[StageReport, ...]


class LazyOutputs(Mapping[str, Any]):
    """Outputs that are computed when the first of them is read."""

    def __init__(self, compute: Callable[[], Outputs]) -> None:
        self._compute = lru_cache(compute)

    def __getitem__(self, name: str) -> Any:
        return self._compute()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._compute())

    def __len__(self) -> int:
        return len(self._compute())


def run(stages: Sequence[Stage], parameters: Mapping[str, Parameter], cache: StageCache) -> Run:
    """Evaluate ``stages`` in order.

    A stage that others read is evaluated only if one of them uses its output. A stage that no other
    reads is always evaluated.

    Raises `KeyError` if a stage reads a parameter or follows a stage that does not exist.
    """
    reasons = {stage.name: stage.reason(parameters) for stage in stages}
    needed = _needed(stages, reasons)
    outputs: dict[str, Any] = {}
    keys: dict[str, Key] = {}
    reports: list[StageReport] = []
    for stage in stages:
        _require(stage.reads, parameters, f"stage {stage.name!r} reads")
        reason = reasons[stage.name]
        if stage.name not in needed:
            reports.append(StageReport(stage.name, "skipped", reason or UNNEEDED))
            continue
        _require(stage.takes(bool(reason)), outputs, f"stage {stage.name!r} follows")
        if reason:
            outputs[stage.name], keys[stage.name] = outputs[stage.source], keys[stage.source]
            reports.append(StageReport(stage.name, "skipped", reason))
            continue
        read = {name: parameters[name] for name in stage.reads}
        key: Key = (stage.name, tuple(read.items()), tuple(keys[name] for name in stage.after))
        found, output = cache.get(stage.name, key)
        if found:
            reports.append(StageReport(stage.name, "reused", UNCHANGED))
        else:
            output = stage.compute(*(outputs[name] for name in stage.after), **read)
            reports.append(StageReport(stage.name, "computed", _why(stage, key, cache)))
            cache.put(stage.name, key, output)
        outputs[stage.name], keys[stage.name] = output, key
    return Run(outputs, tuple(reports))


def _needed(stages: Sequence[Stage], reasons: Mapping[str, str]) -> set[str]:
    """Names of the stages that no other reads, and of all stages that those need."""
    named = {name for stage in stages for name in (*stage.after, stage.source)}
    needed = {stage.name for stage in stages if stage.name not in named}
    for stage in reversed(stages):
        if stage.name in needed:
            needed.update(stage.takes(bool(reasons[stage.name])))
    return needed


def _require(names: Sequence[str], known: Mapping[str, object], who: str) -> None:
    for name in names:
        if name not in known:
            raise KeyError(f"{who} {name!r}; legal: {', '.join(known) or 'none'}")


def _why(stage: Stage, key: Key, cache: StageCache) -> tuple[Message, ...]:
    """The changes since the most similar cached result.

    If there is none, the parameters and stages that the stage depends on.
    """
    cached = cache.entries.get(stage.name, {})
    changes = min((_changes(stage, key, old) for old in cached), key=len, default=())
    if changes:
        return (Message("stage_report.changed", _named(changes)),)
    reads = (Message("stage_report.reads", _named(stage.reads)),) if stage.reads else ()
    follows = (Message("stage_report.follows", _named(stage.after)),) if stage.after else ()
    return (*reads, *follows) or (Message("stage_report.independent"),)


def _changes(stage: Stage, key: Key, cached: Key) -> tuple[str, ...]:
    """Names of the parameters and inputs that have changed."""
    (_, reads, inputs), (_, old_reads, old_inputs) = key, cached
    named_inputs = zip(stage.after, inputs, strict=True)
    return (
        *(name for name, value in reads if (name, value) not in old_reads),
        *(name for name, made_from in named_inputs if made_from not in old_inputs),
    )


def _named(names: Sequence[str]) -> dict[str, str]:
    return {"names": ", ".join(name.replace("_", " ") for name in names)}
