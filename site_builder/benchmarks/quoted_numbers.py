"""Numbers quoted in chapters: readouts of figures, and measured costs of pages and stages.

``make bench`` writes ``content/costs.json``, times, bytes and memory: objects within objects, down
to numbers whose names end in their unit, ``start.cold.book_ms``. The machine is described under
``machine``.
"""

import json
import statistics
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from simulations.engine.controls import ControlError
from simulations.engine.frame import Frame, Readout
from simulations.engine.scene import Scene
from site_builder.benchmarks.judgements import with_unit
from site_builder.benchmarks.measurements import MeasurementError
from site_builder.diagnostics.diagnostic import cause, unknown
from site_builder.figures.frames import frame_at, reports_at
from site_builder.pool.loading import loaded


class ReadoutError(MeasurementError):
    """No such readout; the message says what is legal."""


@dataclass(frozen=True, slots=True)
class Readouts:
    """Readouts of scenes; each frame is computed once."""

    load_scene: Callable[[str], Scene[Any]]
    frames: dict[tuple[str, str, object], Frame] = field(default_factory=dict)
    """By scene, tier and settings."""

    def text(self, scene_id: str, name: str, settings: Mapping[str, str], *, bare: bool) -> str:
        """The readout at ``settings``: values of controls, and ``tier``; with its unit unless
        ``bare``. Raises `ReadoutError`."""
        scene = loaded("simulation", scene_id, self.load_scene, ReadoutError)
        tier = settings.get("tier", scene.accuracy.default)
        if tier not in scene.accuracy.names and tier != scene.accuracy.default:
            raise ReadoutError(unknown(f"tier of {scene_id}", tier, scene.accuracy.names))
        controls = {control: value for control, value in settings.items() if control != "tier"}
        shown = _find(scene_id, name, self._frame(scene, tier, controls))
        if "\n" in shown.text:
            raise ReadoutError(f"{scene_id} {name!r} is a matrix; legal: a readout of one line")
        return shown.text if bare else with_unit(shown.text, shown.unit)

    def _frame(self, scene: Scene[Any], tier: str, given: Mapping[str, str]) -> Frame:
        try:
            settings = scene.check(given)
        except ControlError as error:
            raise ReadoutError(f"{scene.id}: {error}") from error
        key = (scene.id, tier, settings)
        if key not in self.frames:
            try:
                self.frames[key] = frame_at(scene, settings, tier)
            except Exception as error:  # whatever a scene's own code may raise
                message = f"simulation {scene.id!r} cannot be drawn: {cause(error)}"
                raise ReadoutError(message) from error
        return self.frames[key]


def _find(scene_id: str, name: str, frame: Frame) -> Readout:
    readouts = {readout.name: readout for readout in frame.readouts}
    if name not in readouts:
        raise ReadoutError(unknown(f"readout of {scene_id}", name, readouts))
    return readouts[name]


DATA = Path("content") / "costs.json"
UNITS = {"ms": "ms", "kb": "KB", "mb": "MB", "s": "s", "pct": "%"}
"""What a name may end in, and the unit as the book writes it. 1 KB is 1000 bytes."""


@dataclass(frozen=True, slots=True)
class Cost:
    value: float
    unit: str
    """Nothing of a ratio or a count."""


def read_cost(root: Path, asked: str) -> Cost | str:
    """The value at ``asked``, names with spaces between them. Raises `MeasurementError`."""
    try:
        at: Any = json.loads((root / DATA).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        raise MeasurementError(f"{DATA} cannot be read; run `make bench`") from None
    for name in asked.split():
        if not isinstance(at, dict) or name not in at:
            raise MeasurementError(unknown("cost", name, at if isinstance(at, dict) else ()))
        at = at[name]
    if isinstance(at, dict):
        raise MeasurementError(f"{asked!r} is no single cost; go on with one of {', '.join(at)}")
    if isinstance(at, str):
        return at
    return Cost(float(at), UNITS.get(asked.split()[-1].rpartition("_")[2], ""))


STAGE_DATA = Path("content") / "stage-costs.json"
REMEASURE = "run `PYTHONPATH=tests python -m bench.stage_costs`"


@dataclass(frozen=True, slots=True, kw_only=True)
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
    """Raises `MeasurementError` where nothing, or something else, was measured."""
    try:
        entry = json.loads((root / STAGE_DATA).read_text(encoding="utf-8"))[scene.id]
    except (OSError, ValueError, KeyError, TypeError):
        raise MeasurementError(f"{STAGE_DATA} has no scene {scene.id!r}; {REMEASURE}") from None
    try:
        start, costs = entry["start"], entry["moves"]
        moves = tuple(_move(scene, start, control, cost) for control, cost in costs.items())
        whole_ms = statistics.median_high(cost["whole_ms"] for cost in costs.values())
        return StageCosts(scene, len(reports_at(scene, start, {})), whole_ms, moves)
    except (ControlError, KeyError, TypeError, statistics.StatisticsError) as error:
        reason = str(error) if isinstance(error, ControlError) else cause(error)
        raise MeasurementError(f"{STAGE_DATA}: {scene.id}: {reason}; {REMEASURE}") from None


type LevelCosts = Mapping[str, Mapping[str, float]]
"""Milliseconds of a frame by level and by the control that moved; of no control, from scratch."""


def read_level_costs(root: Path, scene_id: str) -> LevelCosts:
    """What the page expects of a device at first; empty where nothing was measured."""
    try:
        return json.loads((root / STAGE_DATA).read_text(encoding="utf-8"))[scene_id]["levels"]  # type: ignore[no-any-return]
    except (OSError, ValueError, KeyError, TypeError):
        return {}


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
