"""A box with a hole: a wide hole blurs the picture, a narrow one darkens it or spreads it by
diffraction.

Far scene, so one transfer function, of hole and diffraction, serves the whole picture, for one
wavelength of each colour: no tiers. Across the axis, hole and spots have the same scale in the
section; along it nothing is to scale.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from simulations.engine import drawing
from simulations.engine.frame import Frame, Panel, Raster, format_number, readout
from simulations.engine.handles import Handle
from simulations.engine.raster import of_planes
from simulations.engine.scene import Scene
from simulations.engine.settings import slider, toggle
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats, Planes
from simulations.models.color.srgb import encode_srgb_codes
from simulations.models.lens.pinhole import pinhole_transfer, spread_mm
from simulations.pictures.balloon import HEIGHT, WIDTH, balloon

WIDEST_MM = 2.0
DEPTH_MM = 100.0  # from the hole to the wall
PIXEL_MM = 30.0 / WIDTH  # the picture on the wall is 30 mm wide
WAVELENGTHS_UM = (0.61, 0.55, 0.465)  # red, green, blue
MARGIN = 24  # pixels by which the picture is extended, more than the widest spot reaches

SECTION = 400.0, 350.0
MIDDLE, HALF_BOX, FRONT, WALL, START = 174.0, 150.0, 196.0, 364.0, 16.0
UNITS_PER_MM, RISE = 72.0, 0.44  # RISE: slope of a beam


@dataclass(frozen=True, slots=True)
class Settings:
    hole: float = slider("Hole width", 1.0, 0.1, WIDEST_MM, 0.01, unit="mm", arrival=0.4)
    longer: bool = toggle("Expose longer")


def diffraction_mm(hole: float) -> float:
    """Width of the spot of green light."""
    return spread_mm(hole, DEPTH_MM, WAVELENGTHS_UM[1])


def share_of_light(hole: float) -> float:
    """Relative to the widest hole."""
    return (hole / WIDEST_MM) ** 2


@cache
def waves() -> tuple[Floats, NDArray[np.intp], Floats, NDArray[np.complexfloating]]:
    """Frequencies (n,) in cycles per mm; which of them is next below that of each wave (H, W) of a
    wider picture, and how far on it is, as a share of their distance; its spectrum (3, H, W)."""
    pad = ((0, 0), (MARGIN, MARGIN), (MARGIN, MARGIN))
    planes = np.pad(balloon().transpose(2, 0, 1), pad, mode="edge")
    rows, columns = planes.shape[1:]
    down, across = np.fft.fftfreq(rows, PIXEL_MM), np.fft.rfftfreq(columns, PIXEL_MM)
    at = np.hypot(down[:, None], across)
    table = np.linspace(0.0, float(at.max()), 600)
    place = np.minimum(at / table[1], len(table) - 2 + 1e-9)
    entry = place.astype(np.intp)
    return table, entry, (place - entry).astype(np.float32), np.fft.rfft2(planes)


def blurred(hole: float) -> Planes:
    """The picture (3, H, W) through the hole, as bright as the scene."""
    table, entry, share, unblurred = waves()
    spectrum, rows, columns = unblurred.copy(), HEIGHT + 2 * MARGIN, WIDTH + 2 * MARGIN
    for plane, wavelength in zip(spectrum, WAVELENGTHS_UM, strict=True):
        left = pinhole_transfer(table, hole, DEPTH_MM, wavelength)
        plane *= left.take(entry) + share * np.diff(left).take(entry)
    whole = np.fft.irfft2(spectrum, s=(rows, columns))
    inner = whole[:, MARGIN : MARGIN + HEIGHT, MARGIN : MARGIN + WIDTH]
    return np.asarray(np.clip(inner, 0.0, 1.0), np.float32)


def picture(blurred: Planes, hole: float, longer: bool) -> Raster:
    """Rotated by 180°, in the brightness of the light through the hole."""
    light = blurred if longer else blurred * np.float32(share_of_light(hole))
    return of_planes(encode_srgb_codes(light)[:, ::-1, ::-1])


def beam(role: str, side: float, half: float, spread: float) -> str:
    """Light of a distant point: the straight beam, and its spread by diffraction."""
    back, on = -side * RISE * (FRONT - START), side * RISE * (WALL - FRONT)
    band = [
        (START, MIDDLE + back - half),
        (WALL, MIDDLE + on - half),
        (WALL, MIDDLE + on + half),
        (START, MIDDLE + back + half),
    ]
    fan = [[(FRONT, MIDDLE), (WALL, MIDDLE + on + end)] for end in (-spread, spread)]
    reach = max(half, spread)
    return (
        drawing.polygon(band, f"{role} fill thin")
        + drawing.path(fan, f"{role} thin dashed")
        + drawing.line((WALL, MIDDLE + on - reach), (WALL, MIDDLE + on + reach), f"{role} bold")
    )


def section(hole: float) -> str:
    half, spread = hole * UNITS_PER_MM / 2.0, diffraction_mm(hole) * UNITS_PER_MM / 2.0
    top, bottom = MIDDLE - HALF_BOX, MIDDLE + HALF_BOX
    box = [(FRONT, MIDDLE - half), (FRONT, top), (WALL + 4.0, top)]
    box += [(WALL + 4.0, bottom), (FRONT, bottom), (FRONT, MIDDLE + half)]
    return "".join(
        (
            beam("world", 1.0, half, spread),
            beam("light", -1.0, half, spread),
            drawing.polyline(box, "camera bold"),
            drawing.text((FRONT, top - 8.0), "hole", "camera small ground", "middle"),
            drawing.text((WALL, top - 8.0), "wall", "camera small ground", "middle"),
            drawing.text((START, 340.0), "from a far scene", "muted small"),
            drawing.text((392.0, 340.0), "dashed: diffraction", "muted small", "end"),
        )
    )


def draw(settings: Settings, outputs: Outputs) -> Frame:
    hole, spread = settings.hole, diffraction_mm(settings.hole)
    light = 100.0 * share_of_light(hole)
    cause = "the width of the hole" if hole >= spread else "diffraction"
    exposure = (
        "exposed as long as it needs"
        if settings.longer
        else f"with {format_number(light, 1)}\u00a0% of the light "
        f"of a hole of {WIDEST_MM:g}\u00a0mm"
    )
    label = f"Light, 100\u00a0% at {WIDEST_MM:g}\u00a0mm"
    return Frame(
        (
            Panel("wall", "The picture on the wall", 400.0, 320.0, outputs["picture"], lead=True),
            Panel("section", "The box from the side", *SECTION, overlay=section(hole)),
        ),
        (
            readout("straight", "Spot, straight rays", hole, "mm", digits=2, role="camera"),
            readout("spread", "Spot, diffraction", spread, "mm", digits=2),
            readout("light", label, light, "%", digits=1, role="light"),
        ),
        f"A balloon over a field of tulips, upside down on the wall of a box, {exposure}. Each "
        f"point makes a spot about {format_number(max(hole, spread), 2)}\u00a0mm wide, "
        f"mostly because of {cause}.",
    )


RIM = Handle[Settings](
    "rim",
    "section",
    "Rim of the hole",
    drives=("hole",),
    at=lambda settings, _: (FRONT, MIDDLE - settings.hole * UNITS_PER_MM / 2.0),
    role="camera",
)
SCENE = Scene(
    "pinhole",
    "A Box with a Hole",
    Settings,
    draw,
    (Stage("blurred", blurred), Stage("picture", picture, ("blurred",))),
    handles=(RIM,),
    formula=pinhole_transfer,
)
