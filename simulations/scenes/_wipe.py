"""Two pictures of the same thing in one panel: one left of an upright line, the other right of it.

The setting of a wipe is the share of the panel's width that lies left of the line, from 0 to 1.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from simulations.engine.drawing import line, text
from simulations.engine.frame import Raster
from simulations.engine.handles import Handle, Point
from simulations.engine.letters import width_of
from simulations.engine.stages import Outputs

HEIGHT_OF_HANDLE = 0.8
"""Place of the handle on the line, as a share of the panel's height from the top."""
MARGIN = 12.0  # least distance of a name from the line and from the panel's border


def wiped(left: Raster, right: Raster, share: float) -> Raster:
    """``left`` up to the line, and ``right`` from it on; both (H, W, 4)."""
    border = round(share * left.shape[1])
    return np.concatenate((left[:, :border], right[:, border:]), axis=1)


def over_wipe(share: float, width: float, height: float, names: tuple[str, str]) -> str:
    """The line, and the names of the two pictures where there is room for them."""
    x = share * width
    lines = [line((x, 0), (x, height), style) for style in ("casing", "image bold")]
    return "".join((*lines, *_names(x, width, height, names)))


def _names(x: float, width: float, height: float, names: tuple[str, str]) -> Iterator[str]:
    row = height - MARGIN
    for name, room, place, anchor in (
        (names[0], x, MARGIN, "start"),
        (names[1], width - x, width - MARGIN, "end"),
    ):
        if room > width_of(name, "small") + 2 * MARGIN:
            yield text((place, row), name, "small ground", anchor)


def wipe_handle(panel: str, setting: str, width: float, height: float) -> Handle[Any]:
    """The handle on the line of a wipe in a panel of this size."""

    def at(settings: object, _outputs: Outputs) -> Point:
        return (float(getattr(settings, setting)) * width, HEIGHT_OF_HANDLE * height)

    return Handle(setting, panel, "Dividing line", (setting,), at, role="image")
