"""The stages of the lens-aberrations figure: a picture for each wavelength, summed by channel.

The tier sets how many wavelengths sample each channel.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats, Planes
from simulations.models.color.srgb import encode_srgb_table
from simulations.models.lens.chromatic_aberration import (
    Glass,
    axial_chromatic_mm,
    lateral_chromatic_scale,
)
from simulations.models.lens.disc_blur import disc_blur
from simulations.models.lens.vignetting import mechanical_vignetting, vignetting_cos4
from simulations.models.pixel_grid import centred
from simulations.models.sampling.magnification import magnify
from simulations.pictures.resolution_chart import resolution_chart
from simulations.scenes.lens_aberrations.spectrum import bands

WIDTH_PX, HEIGHT_PX = 320, 240
FOCAL_MM, FOCAL_PX = 24.0, 200.0
PITCH_MM = FOCAL_MM / FOCAL_PX
RIM_MM = 9.0
"""Radius of the lens barrel's front rim: just wider than the widest opening."""
GLASSES = {
    "ideal": Glass(abbe_number=math.inf),
    "crown": Glass(),
    "flint": Glass(index_d=1.62, abbe_number=36.4),
}
SMALLEST_SHARE = 1e-4
"""Least share of a wavelength in a channel; those left out are at most a fortieth of one code."""
MARGIN = 8
"""Margin of the chart on all sides, in pixels: no colour is reduced by more."""


@dataclass(frozen=True, slots=True)
class Ghost:
    """The picture of one channel in light of one wavelength."""

    channel: int
    wavelength_um: float
    share: float
    plane: NDArray[np.float32]
    """(H, W) linear light."""


def disc_px(glass: str, aperture: float, wavelength_um: float) -> float:
    """Diameter of the disc that a point becomes in light of one wavelength."""
    disc_mm = axial_chromatic_mm(GLASSES[glass], FOCAL_MM, aperture, wavelength_um)
    return float(disc_mm) / PITCH_MM


def light(
    tan_field: Floats, f_number: float, rim_mm: float, natural: bool
) -> tuple[Floats, Floats]:
    """Natural and mechanical vignetting (...) at tangents of the field angle: factors in [0, 1]."""
    opening_mm = FOCAL_MM / f_number / 2
    cos4 = vignetting_cos4(tan_field) if natural else np.ones_like(tan_field)
    return cos4, mechanical_vignetting(tan_field, opening_mm, RIM_MM, rim_mm)


def field_tangents() -> Floats:
    """(H, W) tangent of the angle of each pixel's ray from the axis."""
    x, y = centred(WIDTH_PX) / FOCAL_PX, centred(HEIGHT_PX) / FOCAL_PX
    return np.hypot(x, y[:, None])


def _chart() -> Planes:
    """(3, H, W), wider than the picture by the margin."""
    chart = resolution_chart(WIDTH_PX + 2 * MARGIN, HEIGHT_PX + 2 * MARGIN, FOCAL_PX)
    return np.ascontiguousarray(chart.transpose(2, 0, 1))


def _lateral(chart: Planes, glass: str, stop: float, tier: str) -> tuple[Ghost, ...]:
    """Magnify each wavelength's picture by its own factor."""
    ghosts = []
    for channel, band in enumerate(bands(tier, glass)):
        scales = lateral_chromatic_scale(GLASSES[glass], FOCAL_MM, stop, band.wavelengths_um)
        for wavelength, share, scale in zip(
            band.wavelengths_um.tolist(), band.shares.tolist(), scales.tolist(), strict=True
        ):
            if share >= SMALLEST_SHARE:
                plane = magnify(chart[channel], scale)[MARGIN:-MARGIN, MARGIN:-MARGIN]
                ghosts.append(Ghost(channel, wavelength, share, plane))
    return tuple(ghosts)


def _axial(ghosts: tuple[Ghost, ...], glass: str, aperture: float) -> tuple[Ghost, ...]:
    """Blur each wavelength's picture by its own disc."""
    radii = [disc_px(glass, aperture, ghost.wavelength_um) / 2 for ghost in ghosts]
    return tuple(
        replace(ghost, plane=disc_blur(ghost.plane[None], radius)[0])
        for ghost, radius in zip(ghosts, radii, strict=True)
    )


def _channels(ghosts: tuple[Ghost, ...]) -> Planes:
    """(3, H, W) the channels, summed over the wavelengths."""
    planes = np.zeros((3, HEIGHT_PX, WIDTH_PX), np.float32)
    whole = np.zeros(3)
    for ghost in ghosts:
        planes[ghost.channel] += np.float32(ghost.share) * ghost.plane
        whole[ghost.channel] += ghost.share
    planes /= whole[:, None, None]
    return planes


def _vignetting(aperture: float, rim: float, natural: bool) -> NDArray[np.float32]:
    """(H, W) vignetting factor; that of the rim is read from a table of the radius."""
    radius = field_tangents()
    tangents = np.linspace(0, 1.01, 256)
    _, open_share = light(tangents, aperture, rim, natural)
    factor = np.interp(radius, tangents, open_share)
    if natural:
        factor *= vignetting_cos4(radius)
    return factor.astype(np.float32)


def encode(planes: Planes, factor: Floats) -> Raster:
    return to_rgba8(encode_srgb_table(np.clip(planes * factor, 0, 1).transpose(1, 2, 0)))


def _all_sharp(glass: str, aperture: float, tier: str) -> str:
    widest = max(
        disc_px(glass, aperture, wavelength)
        for band in bands(tier, glass)
        for wavelength in band.wavelengths_um[band.shares >= SMALLEST_SHARE].tolist()
    )
    return "" if widest > 1 else "no colour’s disc is wider than a pixel"


STAGES = (
    Stage("chart", _chart),
    Stage("lateral", _lateral, ("chart",)),
    Stage("axial", _axial, ("lateral",), _all_sharp),
    Stage("channels", _channels, ("axial",)),
    Stage("vignetting", _vignetting),
    Stage("encoded", encode, ("channels", "vignetting")),
)
