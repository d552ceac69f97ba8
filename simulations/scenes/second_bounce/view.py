"""The second panel of the second-bounce figure: both planes seen from the front."""

import math

import numpy as np

from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats, Mask
from simulations.models.color.srgb import encode_srgb
from simulations.scenes.second_bounce.stages import PLACES, Planes

WIDTH, HEIGHT = 400, 320
CAMERA = 2.6
"""Distance of the camera from the edge, in lengths of a plane; it is on the line that bisects the
angle between them."""
FOCAL = 340.0
"""Focal length in px, equal to units of the view box."""
HALF_WIDTH = 0.95
"""Visible length of the planes along their edge."""


def view(planes: Planes, opening_deg: float) -> Raster:
    """The picture (H, W, 4); red light in red, blue light in green and blue."""
    half = math.radians(opening_deg) / 2
    down = (np.arange(HEIGHT) + 0.5 - HEIGHT / 2) / FOCAL
    steep = np.abs(down)
    along = steep * CAMERA / (math.sin(half) + steep * math.cos(half))
    reach = FOCAL * HALF_WIDTH / (CAMERA - along * math.cos(half))
    red, blue = (_rows(each, along, down > 0) for each in planes.all_light)
    rows = to_rgba8(encode_srgb(np.stack([red, blue, blue], axis=-1)[None]))[0]
    across = np.abs(np.arange(WIDTH) + 0.5 - WIDTH / 2)
    covered = np.clip(reach[:, None] - across + 0.5, 0.0, 1.0) * (along <= 1.0)[:, None]
    picture = np.repeat(rows[:, None], WIDTH, axis=1)
    picture[..., 3] = np.rint(255.0 * covered)
    return picture


def _rows(brightness: Floats, along: Floats, floor: Mask) -> Floats:
    """(H,) brightness of the rows: of the floor below the edge, of the wall above it."""
    lower, upper = (np.interp(along, PLACES, each) for each in brightness)
    return np.where(floor, lower, upper)
