"""What moving one control costs of a whole frame: measured times, and stages as they are now.

The times come from ``content/stage-costs.json``, which ``tests/bench/stage_costs.py`` writes; which
stages run again is found anew at every build, by moving the control.
"""

import json
import statistics
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from simulations.engine.controls import ControlError
from simulations.engine.scene import Scene
from site_builder.diagnostics.diagnostic import cause
from site_builder.figures.frames import reports_at

DATA = Path("content") / "stage-costs.json"
REMEASURE = "run `PYTHONPATH=tests python -m bench.stage_costs`"


class StageCostError(ValueError):
    """The data do not fit the scene; the message says how to measure again."""


@dataclass(frozen=True, slots=True)
class MoveCost:
    """One control moved by a step."""

    label: str
    """Of the control."""
    again: tuple[str, ...]
    """Stages that are computed again."""
    reused: int
    skipped: int
    milliseconds: float
    share: float
    """Of the time of a whole frame."""


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
        entry = json.loads((root / DATA).read_text(encoding="utf-8"))[scene.id]
    except (OSError, ValueError, KeyError, TypeError):
        raise StageCostError(f"{DATA} has no scene {scene.id!r}; {REMEASURE}") from None
    try:
        start, costs = entry["start"], entry["moves"]
        moves = tuple(_move(scene, start, control, cost) for control, cost in costs.items())
        whole_ms = statistics.median_high(cost["whole_ms"] for cost in costs.values())
        return StageCosts(scene, len(reports_at(scene, start, {})), whole_ms, moves)
    except (ControlError, KeyError, TypeError, statistics.StatisticsError) as error:
        reason = str(error) if isinstance(error, ControlError) else cause(error)
        raise StageCostError(f"{DATA}: {scene.id}: {reason}; {REMEASURE}") from None


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
