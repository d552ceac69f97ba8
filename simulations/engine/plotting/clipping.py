"""The parts of a curve that lie within a plot, cut exactly at its edges."""

import numpy as np

type Place = tuple[float, float]
type Run = list[Place]
type Span = tuple[float, float]
"""Lower and upper bound of a coordinate."""

EDGE = 1e-6
"""Tolerance for rounding at the edges."""


def runs_inside(across: np.ndarray, down: np.ndarray, x: Span, y: Span) -> list[Run]:
    """The runs of a curve (n,), (n,) within a rectangle, interrupted where it is not finite."""
    known = np.isfinite(across) & np.isfinite(down)
    inside = known & _within(across, x) & _within(down, y)
    places = list(zip(across.tolist(), down.tolist(), strict=True))
    if inside.all():
        return [places] if len(places) > 1 else []
    runs: list[Run] = [[]]
    visible, finite = inside.tolist(), known.tolist()
    for n, place in enumerate(places[1:], start=1):
        piece: tuple[Place, Place] | None = None
        if visible[n - 1] and visible[n]:
            piece = places[n - 1], place
        elif finite[n - 1] and finite[n]:
            piece = clipped(places[n - 1], place, x, y)
        if piece is None:
            runs.append([])
        elif runs[-1] and runs[-1][-1] == piece[0]:
            runs[-1].append(piece[1])
        else:
            runs.append(list(piece))
    return [run for run in runs if len(run) > 1]


def _within(values: np.ndarray, span: Span) -> np.ndarray:
    with np.errstate(invalid="ignore"):
        return np.asarray((values >= span[0] - EDGE) & (values <= span[1] + EDGE))


def clipped(start: Place, end: Place, x: Span, y: Span) -> tuple[Place, Place] | None:
    """The part of a segment within a rectangle (Liang and Barsky), or None."""
    first, last = 0.0, 1.0
    dx, dy = end[0] - start[0], end[1] - start[1]
    for origin, step, (low, high) in ((start[0], dx, x), (start[1], dy, y)):
        if step == 0.0:
            if not low - EDGE <= origin <= high + EDGE:
                return None
            continue
        enters, leaves = sorted(((low - origin) / step, (high - origin) / step))
        first, last = max(first, enters), min(last, leaves)
    if first >= last:
        return None
    return (
        start if first == 0.0 else (start[0] + first * dx, start[1] + first * dy),
        end if last == 1.0 else (start[0] + last * dx, start[1] + last * dy),
    )
