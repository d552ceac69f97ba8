"""Handles of the lines: their ends, and what the buttons do."""

from collections.abc import Mapping
from functools import partial

import numpy as np

from simulations.engine.controls import PointLists, Value
from simulations.engine.handles import Handle, Point
from simulations.engine.photograph import Photograph
from simulations.engine.stages import Outputs
from simulations.scenes.single_view.fields import whole
from simulations.scenes.single_view.lines import Drawn, current, size_of, start_of
from simulations.scenes.single_view.settings import LISTS, MOST, Settings


def number_of(settings: Settings) -> int:
    """Of the list that is drawn in."""
    return list(LISTS).index(settings.direction)


def _points(settings: Settings, photograph: Photograph | None) -> PointLists:
    return current(settings.lines, settings.picture, settings.sigma, settings.take, photograph)


def _end(end: int, settings: Settings, outputs: Outputs) -> Point | None:
    lines: Drawn = outputs["lines"]
    ends = lines.ends[number_of(settings)].reshape(-1, 2)
    return whole(lines.size).place(ends[end]) if end < len(ends) else None


def _end_pulled(
    end: int, settings: Settings, place: Point, photograph: Photograph | None
) -> Mapping[str, Value]:
    """The nearest pixel."""
    points, size = _points(settings, photograph), size_of(photograph)
    number = number_of(settings)
    ends = list(points.lists[number])
    if end >= len(ends):
        return {}
    shares = (np.rint(np.clip(whole(size).pixel(place), -1.0, np.add(size, 1))) + 0.5) / size
    ends[end] = (float(shares[0]), float(shares[1]))
    return _changed(points, number, ends, end)


def _step(_settings: Settings, outputs: Outputs) -> float:
    """A pixel of the picture."""
    return whole(outputs["lines"].size).scale


def _nowhere(_settings: Settings, _outputs: Outputs) -> None:
    return None


def _added(settings: Settings, _place: Point, photograph: Photograph | None) -> Mapping[str, Value]:
    points, number = _points(settings, photograph), number_of(settings)
    ends = points.lists[number]
    if len(ends) >= 2 * MOST:
        return {}
    return _changed(points, number, [*ends, *start_of(number, len(ends) // 2)], len(ends))


def _cleared(
    settings: Settings, _place: Point, photograph: Photograph | None
) -> Mapping[str, Value]:
    """All lines are taken away."""
    return {"lines": PointLists(_points(settings, photograph).picture, 0, ((),) * len(LISTS)).text}


def _changed(
    points: PointLists, number: int, ends: list[tuple[float, float]], touched: int
) -> Mapping[str, Value]:
    lists = (*points.lists[:number], tuple(ends), *points.lists[number + 1 :])
    return {"lines": PointLists(points.picture, touched, lists).text}


HANDLES: tuple[Handle[Settings], ...] = (
    *(
        Handle(
            f"end-{end}",
            "picture",
            f"{'Other' if end % 2 else 'First'} end of line {end // 2 + 1}",
            ("lines",),
            partial(_end, end),
            partial(_end_pulled, end),
            step=_step,
        )
        for end in range(2 * MOST)
    ),
    Handle("add", "picture", "New line", ("lines",), _nowhere, _added, reach="aim"),
    Handle("clear", "loupe", "All lines", ("lines",), _nowhere, _cleared, reach="aim"),
)
