"""The functions that the browser's worker calls."""

import io
import json
import sys
import time
from collections.abc import Iterator
from contextlib import redirect_stdout
from dataclasses import asdict, dataclass
from functools import lru_cache
from math import isfinite
from typing import Any

from simulations.editing.shared import restore_modules
from simulations.engine.frame import Frame, Raster, Readout, Samples, to_json
from simulations.engine.ladder import measure_tier
from simulations.engine.photograph import Photograph, photograph_from_page
from simulations.engine.raster import opaque, png
from simulations.engine.reading import Reading, Readings, UnfitError
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from simulations.late_imports import fetch_missing as fetch_missing
from simulations.registry import load_ladder, load_scene, scene_module
from simulations.script import script as script

_caches: dict[str, StageCache] = {}
_photographs: dict[str, Photograph] = {}
"""The reader's photograph, by figure."""
_readings: dict[str, Readings] = {}
"""Readings of the reader's photographs, by figure."""
_estimates: dict[str, tuple[object, Iterator[Readout]]] = {}
"""For each figure: the call, and its estimates to come."""


@dataclass(frozen=True, slots=True)
class Reply:
    """A frame as sent to the page."""

    meta: str
    """`simulations.engine.frame.to_json` of the frame."""
    rasters: tuple[Raster, ...]
    """Pixels of the panels that have any, in the panels' order."""
    sound: Samples | None = None


@dataclass(frozen=True, slots=True)
class EditedReply:
    """The result of a reader's edits of a figure's Python."""

    frame: Reply | None
    """None if it failed."""
    problem: str
    """JSON of a `simulations.editing.problems.Problem`, or ``null``."""
    printed: str
    """Printed output of the code, at most `MOST_PRINTED` characters."""


MOST_PRINTED = 10_000
_last_edits: list[str] = []


def render(figure: str, scene_id: str, values: str, tier: str) -> Reply:
    """One frame of ``scene_id`` for the figure named ``figure``.

    ``values`` is a JSON object of control values; values left out take their defaults and numbers
    out of range are clamped. Raises `UnknownIdError` and `ControlError`.
    """
    scene, request = _request(figure, scene_id, values, tier)
    return _reply(scene.render(*request))


def render_edited(figure: str, scene_id: str, values: str, tier: str, edits: str) -> EditedReply:
    """Like `render`, by a copy of the program with the reader's ``edits``.

    ``edits`` is a JSON object from definitions, ``MODULE:NAME``, to texts. Errors in them are
    returned, not raised. Other edits than those of the last call find all modules as they were.
    """
    if sys.platform == "emscripten" and _last_edits != [edits]:  # elsewhere others use them too
        restore_modules()
        _last_edits[:] = [edits]
    from simulations.editing.copies import problem_with  # most readers never need it

    reply, problem = None, None
    printed = io.StringIO()
    try:
        with redirect_stdout(printed):
            scene, request = _request(figure, scene_id, values, tier, edits)
            reply = _reply(scene.render(*request))
    except BaseException as error:  # the reader's code may raise anything, `SystemExit` too
        problem = asdict(problem_with(error, edits))
    text = json.dumps(problem, ensure_ascii=False)
    return EditedReply(reply, text, printed.getvalue()[:MOST_PRINTED])


def exercise(program: str, edits: str, stage: str) -> str:
    """JSON of the results of a stage of an exercise for the reader's text ``edits``.

    ``program`` is JSON of a `simulations.editing.exercise.Exercise`. Errors in the text are
    returned, as ``problem``; ``printed`` is its output.
    """
    if sys.platform == "emscripten" and _last_edits != [edits]:
        restore_modules()
        _last_edits[:] = [edits]
    from simulations.editing.exercise import Exercise, findings, place_of  # most never need it
    from simulations.editing.problems import problem_of

    task = Exercise(**json.loads(program))
    printed = io.StringIO()
    found: dict[str, Any] = {}
    try:
        with redirect_stdout(printed):
            found = findings(task, edits, stage, load_ladder, time.perf_counter)
    except BaseException as error:  # the reader's code may raise anything, `SystemExit` too
        found = {"problem": asdict(problem_of(error, [place_of(task, edits)]))}
    found["printed"] = printed.getvalue()[:MOST_PRINTED]
    return json.dumps(found, ensure_ascii=False)


def prepare(scene_id: str) -> None:
    """Import a scene in advance. Raises `UnknownIdError`."""
    load_scene(scene_id)


def _cache_of(figure: str) -> StageCache:
    """The figure's cache, for the outputs at rest and of two levels while something moves."""
    if figure not in _caches:
        _caches[figure] = StageCache(depth=3)
    return _caches[figure]


def _reply(frame: Frame) -> Reply:
    rasters = tuple(panel.raster for panel in frame.panels if panel.raster is not None)
    return Reply(to_json(frame), rasters, frame.sound.samples if frame.sound else None)


def error(figure: str, scene_id: str, values: str, tier: str, edits: str = "") -> str:
    """The next, better estimate of the error of the frame at these values, or of its times.

    JSON of a `Readout`, or ``null`` if there is no better one. A call with other values starts
    anew. Raises `UnknownIdError` and `ControlError`.
    """
    photographs = (_photographs.get(figure), _readings.get(figure, ()))
    call = (scene_id, values, tier, edits, photographs)
    begun, estimates = _estimates.get(figure, (None, iter(())))
    if begun != call:
        scene, request = _request(figure, scene_id, values, tier, edits)
        estimates = scene.estimates(*request, clock=time.perf_counter)
        _estimates[figure] = (call, estimates)
    estimate = next(estimates, None)
    return json.dumps(None if estimate is None else asdict(estimate), ensure_ascii=False)


def judge(figure: str, scene_id: str, values: str, tier: str, conditions: str) -> int | None:
    """The index of the first of the ``conditions``, a JSON list, that holds for a figure's state.

    Raises `UnknownIdError`, `ControlError` and `ExpressionError`.
    """
    from simulations.engine.conditions import first_true  # most readers never need it

    scene, request = _request(figure, scene_id, values, tier)
    return first_true(json.loads(conditions), request[0], scene.render(*request))


def pull(
    figure: str, scene_id: str, values: str, tier: str, handle: str, x: float, y: float
) -> str:
    """JSON of the control values that bring a handle as near to a place of its panel as possible.

    ``x`` and ``y`` are in view box units. Raises `UnknownIdError`, `ControlError`, `KeyError` for
    an unknown handle and `ValueError` for a place that is not finite.
    """
    scene, request = _request(figure, scene_id, values, tier)
    settings, tier, cache, photograph, readings = request
    moved = scene.pull(settings, handle, (x, y), tier, photograph, readings, cache)
    return json.dumps(moved)


def photograph(figure: str, picture: Any) -> None:
    """Use the reader's picture for the frames of ``figure`` from now on; ``None`` removes it.

    See `photograph_from_page`.
    """
    if picture is None:
        _photographs.pop(figure, None)
    else:
        _photographs[figure] = photograph_from_page(picture)


def read(scene_id: str, picture: Any) -> str:
    """A scene's reading of a photograph, at full resolution: JSON of ``data`` or ``unfit``.

    ``unfit`` is the sentence of an `UnfitError`. Raises `UnknownIdError`, and `TypeError` for a
    scene that reads none or data that are not JSON.
    """
    scene = load_scene(scene_id)
    if scene.instrument.read is None:
        raise TypeError(f"scene {scene_id!r} reads no photographs; legal: one with `read`")
    try:
        data = dict(scene.instrument.read(photograph_from_page(picture)))
    except UnfitError as error:
        return json.dumps({"unfit": str(error)}, ensure_ascii=False)
    return json.dumps({"data": data}, ensure_ascii=False, allow_nan=False)


def sample(scene_id: str, name: str) -> bytes:
    """PNG of a simulated photograph to try a scene with. Raises `KeyError` for an unknown name."""
    return png(opaque(load_scene(scene_id).instrument.samples[name]()))


def readings(figure: str, kept: str) -> None:
    """Use readings of the reader's photographs for ``figure`` from now on.

    ``kept`` is a JSON list of objects with ``number``, ``name`` and ``data``; an empty one brings
    the book's pictures back.
    """
    _readings[figure] = tuple(Reading(**entry) for entry in json.loads(kept))


def export(figure: str, scene_id: str, values: str, tier: str, name: str) -> str:
    """The text of one of the scene's files. Raises `KeyError` for an unknown name."""
    scene, request = _request(figure, scene_id, values, tier)
    makers = {entry.name: entry.make for entry in scene.instrument.exports}
    if name not in makers:
        raise KeyError(f"export {name!r}; legal: {', '.join(makers) or 'none'}")
    return makers[name](request[0], scene.run(*request).outputs)


def sheet(figure: str, scene_id: str, values: str, tier: str) -> str:
    """JSON of ``lines``, the `Readout`s of the data sheet, and of ``measured``.

    ``lines`` is empty if the scene has no sheet; ``measured``, the numbers of the readings that the
    lines are of, is ``null`` if they are of all.
    """
    scene, request = _request(figure, scene_id, values, tier)
    outputs = scene.run(*request).outputs
    lines = scene.instrument.sheet(request[0], outputs) if scene.instrument.sheet else ()
    measured = scene.instrument.measured(outputs) if scene.instrument.measured else None
    return json.dumps({"lines": [asdict(line) for line in lines], "measured": measured})


def develop(figure: str, scene_id: str, values: str, tier: str, picture: Any) -> Raster:
    """A photograph made anew at the settings of a figure; the figure's own picture stays.

    Raises `TypeError` if the scene cannot.
    """
    scene, request = _request(figure, scene_id, values, tier)
    if scene.instrument.develop is None:
        raise TypeError(f"scene {scene_id!r} develops no photographs; legal: one with `develop`")
    outputs = scene.run(*request).outputs
    return opaque(scene.instrument.develop(photograph_from_page(picture), request[0], outputs))


def _request(
    figure: str, scene_id: str, values: str, tier: str, edits: str = ""
) -> tuple[Scene[Any], tuple[Any, str, StageCache, Photograph | None, Readings]]:
    """The scene that draws a figure, the book's or the reader's, and what `Scene.run` takes."""
    if edits:
        from simulations.editing.copies import copy_of

        scene, cache = copy_of(figure, scene_module(scene_id), edits)
    else:
        scene = load_scene(scene_id)
        cache = _cache_of(figure)
    settings = scene.clamp(json.loads(values))
    return scene, (settings, tier, cache, _photographs.get(figure), _readings.get(figure, ()))


def forget(figure: str) -> None:
    """Free the memory of a figure that left the page."""
    _caches.pop(figure, None)
    _photographs.pop(figure, None)
    _readings.pop(figure, None)
    _estimates.pop(figure, None)


def measure(ladder_id: str, tier_id: str, budget_s: float) -> str:
    """Measure a tier of a ladder on this machine; JSON of its `TierResult`.

    Infinite values, of errors too small for the metric, become null. Raises `UnknownIdError`, and
    `ValueError` for an unknown tier.
    """
    ladder = load_ladder(ladder_id)
    workload, reference = _prepared(ladder_id)
    clock = time.perf_counter
    result = asdict(measure_tier(ladder, tier_id, workload, reference, clock, budget_s=budget_s))
    errors = result["errors"].items()
    result["errors"] = {name: value if isfinite(value) else None for name, value in errors}
    return json.dumps(result)


@lru_cache(maxsize=1)
def _prepared(ladder_id: str) -> tuple[Any, Any]:
    """Workload and reference, cached while the tiers of one ladder are measured."""
    ladder = load_ladder(ladder_id)
    workload = ladder.prepare()
    return workload, ladder.reference(workload)
