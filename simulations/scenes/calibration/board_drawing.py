"""The board as the photographs find it: how far it is from flat, and its squares from square."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import path
from simulations.engine.frame import format_magnitude, format_number, value_with_error
from simulations.models.arrays import Floats
from simulations.models.calibration.model_choice import Trial
from simulations.models.calibration.shape_size import Measured

WIDTH, MIDDLE, BASE = 400.0, 200.0, 118.0
ROOM = (300.0, 40.0)
"""Width of the drawing, and the height to which the board's relief is enlarged."""
LEAN, FLATTENED = 0.35, 0.42
"""How far rows lean to the right, and how low they are seen."""
LEAST, PER_CENT = 1e-3, 100.0
SURE = 3.0
"""Standard errors from which on a board is told to be bent."""
CAPTION, LINE = 232.0, 20.0


def board_drawing(found: Measured, tried: tuple[Trial, ...], side_mm: float) -> str:
    """The board seen from the side, its relief enlarged, and what was measured of it."""
    rows, columns = found.relief.shape
    scale = ROOM[0] / (columns - 1 + LEAN * (rows - 1))
    relief = scale * found.relief
    times = _round(ROOM[1] / max(float(np.ptp(relief)), LEAST))
    flat, bent = (_panel_places(height, scale) for height in (0.0 * relief, times * relief))
    rim = [*flat[0], *flat[:, -1][1:], *flat[-1][::-1][1:], *flat[:, 0][::-1][1:]]
    words = board_words(found, side_mm)
    if found.bent:
        words[0] += f" (drawn × {format_number(times, 0 if times >= 1 else 1)})"
    words += [", ".join(f"{t.shape} {format_number(t.left_out_px, 3)}" for t in tried)]
    words[-1] = f"Error, left out, in px: {words[-1]}" if len(tried) > 1 else ""
    return (
        path([rim], "muted dashed")
        + path([*bent, *np.swapaxes(bent, 0, 1)], "world")
        + "".join(
            label((MIDDLE, CAPTION + LINE * index), line, "small", "middle")
            for index, line in enumerate(words)
        )
    )


def board_words(found: Measured, side_mm: float) -> list[str]:
    """How far the board is from flat, and the sides of its squares, for a reader: in millimetres,
    or in shares of a square's width while that is not given (0)."""
    unit, scale = ("mm", side_mm) if side_mm else ("% of a square’s width", PER_CENT)
    height = value_with_error(scale * found.height, scale * found.height_error)
    is_certain = found.height > SURE * found.height_error
    flat = f"Flat to {format_magnitude(scale * found.height, LEAST)} {unit}"
    down = value_with_error((side_mm or 1.0) * found.aspect, (side_mm or 1.0) * found.aspect_error)
    squares = f"of {side_mm:g} mm × {down} mm" if side_mm else f"{down} times as high as wide"
    return [
        (f"Out of flat by {height} {unit}" if is_certain else flat)
        if found.bent
        else "Taken for flat",
        f"Squares {squares}" if found.bent else "",
    ]


def _panel_places(height: Floats, scale: float) -> Floats:
    """(R, C, 2) places in the panel of corners with heights (R, C) in the panel's units."""
    v, u = np.mgrid[: height.shape[0], : height.shape[1]].astype(float)
    x, y = u + LEAN * (v.max() - v), FLATTENED * v
    x, y = (scale * (along - along.mean()) for along in (x, y))
    return np.stack((MIDDLE + x, BASE + y + height), axis=-1)


def _round(times: float) -> float:
    power = 10.0 ** np.floor(np.log10(times))
    return float(max(step for step in (1.0, 2.0, 5.0) if step * power <= times) * power)
