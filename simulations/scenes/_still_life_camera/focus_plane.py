"""The plane of focus: where it cuts the floor, and the line that shows it in the picture."""

import numpy as np

from simulations.engine.drawing import path
from simulations.pictures.still_life import things as still_life
from simulations.pictures.still_life.light import LitScene

HANDLE_TANGENT = 0.095
"""Column of the line's handle, to the right of the axis: a lane of floor that is free up to the
wall."""
UP = still_life.WORLD_TO_CAMERA[:3, 2]  # the vertical in the camera's frame


def floor_tangent(depth: float) -> float:
    """Tangent of the angle from the axis down to the floor ``depth`` metres away."""
    return float(-(still_life.EYE[2] / depth + UP[2]) / UP[1])


def floor_depth(tangent: float) -> float:
    """The inverse: the depth of the floor, metres; ∞ from the horizon upwards."""
    falling = -UP[1] * tangent - UP[2]
    return float(still_life.EYE[2] / falling) if falling > 0 else np.inf


def line_on_floor(
    lit: LitScene, row: float, width: float, height: float, enlarged: float = 1.0
) -> str:
    """SVG of the line along a row of a view box, where no thing of the picture hides it. The
    picture is magnified ``enlarged`` times about its middle."""
    rows, columns = lit.base_depth.shape
    place = int(((row / height - 0.5) / enlarged + 0.5) * rows)
    hidden = np.zeros(columns, bool)
    for layer in lit.layers:
        _, layer_rows, layer_columns = layer.planes.shape
        if layer.top <= place < layer.top + layer_rows:
            left, right = max(layer.left, 0), min(layer.left + layer_columns, columns)
            cover = layer.planes[3, place - layer.top, left - layer.left : right - layer.left]
            hidden[left:right] |= cover > 0.5
    edges = np.flatnonzero(np.diff(hidden, prepend=True, append=True)) / columns
    ends = np.clip((edges - 0.5) * enlarged + 0.5, 0.0, 1.0) * width
    pieces = [[(start, row), (end, row)] for start, end in ends.reshape(-1, 2) if end > start]
    return path(pieces, "casing") + path(pieces, "ray")
