"""What pages cost: times, bytes and memory, from ``content/costs.json``.

``make bench`` writes it: objects within objects, down to numbers whose names end in their unit,
``start.cold.book_ms``. What is said of the machine stands under ``machine``.
"""

import json
import statistics
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from simulations.engine.controls import ControlError
from simulations.engine.scene import Scene
from site_builder.diagnostics.diagnostic import cause, unknown
from site_builder.figures.frames import reports_at

DATA = Path("content") / "costs.json"
UNITS = {"ms": "ms", "kb": "KB", "mb": "MB", "s": "s"}
"""What a name may end in, and the unit as the book writes it. 1 KB is 1000 bytes."""


class CostError(ValueError):
    """There is no such measurement; the message lists the legal names."""


@dataclass(frozen=True, slots=True)
class Cost:
    """One number."""

    value: float
    unit: str
    """Nothing of a ratio or a count."""


@dataclass(frozen=True, slots=True)
class Costs:
    """All that was measured."""

    known: Mapping[str, Any] = field(default_factory=dict)

    def find(self, path: str) -> Cost | str:
        """The value at ``path``, names with spaces between them. Raises `CostError`."""
        at: Any = self.known
        for name in path.split():
            if not isinstance(at, dict) or name not in at:
                expected = tuple(at) if isinstance(at, dict) else ()
                raise CostError(unknown("cost", name, expected))
            at = at[name]
        if isinstance(at, dict):
            raise CostError(f"{path!r} is no single cost; go on with one of {', '.join(at)}")
        if isinstance(at, str):
            return at
        return Cost(float(at), UNITS.get(path.split()[-1].rpartition("_")[2], ""))


def read_costs(root: Path) -> Costs:
    """Raises `CostError` where nothing was measured."""
    try:
        return Costs(json.loads((root / DATA).read_text(encoding="utf-8")))
    except (OSError, ValueError):
        raise CostError(f"{DATA} cannot be read; run `make bench`") from None


STAGE_DATA = Path("content") / "stage-costs.json"
REMEASURE = "run `PYTHONPATH=tests python -m bench.stage_costs`"


class StageCostError(ValueError):
    """The data do not fit the scene; the message says how to measure again."""


@dataclass(frozen=True, slots=True)
class MoveCost:
    """One control moved by a step."""

    label: str
    """Label of the control."""
    again: tuple[str, ...]
    """Stages that are computed again."""
    reused: int
    skipped: int
    milliseconds: float
    share: float
    """Its share of the time of a whole frame."""


@dataclass(frozen=True, slots=True)
class StageCosts:
    """The moves of one scene, and what a whole frame costs."""

    scene: Scene[Any]
    stages: int
    whole_ms: float
    moves: tuple[MoveCost, ...]


def read_stage_costs(root: Path, scene: Scene[Any]) -> StageCosts:
    """Raises `StageCostError` where nothing, or something else, was measured."""
    try:
        entry = json.loads((root / STAGE_DATA).read_text(encoding="utf-8"))[scene.id]
    except (OSError, ValueError, KeyError, TypeError):
        raise StageCostError(f"{STAGE_DATA} has no scene {scene.id!r}; {REMEASURE}") from None
    try:
        start, costs = entry["start"], entry["moves"]
        moves = tuple(_move(scene, start, control, cost) for control, cost in costs.items())
        whole_ms = statistics.median_high(cost["whole_ms"] for cost in costs.values())
        return StageCosts(scene, len(reports_at(scene, start, {})), whole_ms, moves)
    except (ControlError, KeyError, TypeError, statistics.StatisticsError) as error:
        reason = str(error) if isinstance(error, ControlError) else cause(error)
        raise StageCostError(f"{STAGE_DATA}: {scene.id}: {reason}; {REMEASURE}") from None


def _move(
    scene: Scene[Any], start: Mapping[str, object], control: str, cost: Mapping[str, Any]
) -> MoveCost:
    reports = reports_at(scene, start, {control: cost["to"]})
    labels = {item.name: item.label for item in scene.controls}
    status = [report.status for report in reports]
    return MoveCost(
        label=labels[control],
        again=tuple(report.name for report in reports if report.status == "computed"),
        reused=status.count("reused"),
        skipped=status.count("skipped"),
        milliseconds=cost["ms"],
        share=cost["share"],
    )
