"""The stages of the pinhole: the picture on the wall, blurred by the hole, then its brightness.

The scene is far away, so that one transfer function, of hole and diffraction, applies to the whole
picture, for a wavelength of each colour.
"""

import numpy as np

from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats, Planes
from simulations.models.color.srgb import encode_srgb_table
from simulations.models.lens.pinhole import pinhole_transfer
from simulations.pictures.balloon import HEIGHT, WIDTH, balloon
from simulations.scenes.pinhole.settings import WIDEST_MM

DEPTH_MM = 100.0
"""Distance from the hole to the wall."""
WALL_MM = 30.0
"""Width of the picture on the wall."""
PIXEL_MM = WALL_MM / WIDTH
WAVELENGTHS_UM = (0.61, 0.55, 0.465)
"""Wavelengths of red, green and blue."""
MARGIN = 24
"""Pixels by which the picture is extended, more than the widest spot reaches."""
TABLE = 600
"""Count of frequencies at which the transfer function is computed; it is interpolated in
between."""


def share_of_light(hole_mm: float) -> float:
    """Light on the wall relative to that of the widest hole: proportional to the area."""
    return (hole_mm / WIDEST_MM) ** 2


def _frequencies(rows: int, columns: int) -> Floats:
    """Frequencies (rows, columns // 2 + 1) in cycles per millimetre, in numpy's order."""
    return np.hypot(np.fft.fftfreq(rows, PIXEL_MM)[:, None], np.fft.rfftfreq(columns, PIXEL_MM))


def _blurred(hole: float) -> Planes:
    """The picture (3, H, W) through the hole, as bright as the scene."""
    planes = balloon().transpose(2, 0, 1)
    padded = np.pad(planes, ((0, 0), (MARGIN, MARGIN), (MARGIN, MARGIN)), mode="edge")
    rows, columns = padded.shape[1:]
    at = _frequencies(rows, columns)
    table = np.linspace(0.0, float(at.max()), TABLE)
    spectrum = np.fft.rfft2(padded)
    for plane, wavelength in zip(spectrum, WAVELENGTHS_UM, strict=True):
        plane *= np.interp(at, table, pinhole_transfer(table, hole, DEPTH_MM, wavelength))
    whole = np.fft.irfft2(spectrum, s=(rows, columns))
    inner = whole[:, MARGIN : MARGIN + HEIGHT, MARGIN : MARGIN + WIDTH]
    return np.asarray(np.clip(inner, 0.0, 1.0), np.float32)


def _picture(blurred: Planes, hole: float, longer: bool) -> Raster:
    """The picture rotated by 180°, in the brightness of the light through the hole."""
    light = blurred if longer else blurred * np.float32(share_of_light(hole))
    return to_rgba8(encode_srgb_table(light[:, ::-1, ::-1].transpose(1, 2, 0)))


STAGES = (
    Stage("blurred", _blurred),
    Stage("picture", _picture, ("blurred",)),
)
