"""What the lens-aberrations figure computes: a picture for each wavelength, summed by channel.

The channels are bell-shaped bands of the spectrum about the Fraunhofer lines C, d and F. The tier
says by how many wavelengths each is stood for.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from simulations.engine.controls import Values
from simulations.engine.frame import Raster, Readout, format_magnitude
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage, StageCache, run
from simulations.models.color.srgb import encode_srgb_table
from simulations.models.lens.chromatic_aberration import (
    LINE_C_UM,
    LINE_D_UM,
    LINE_F_UM,
    Glass,
    axial_chromatic_mm,
    lateral_chromatic_scale,
)
from simulations.models.lens.disc_blur import Planes, disc_blur
from simulations.models.lens.spectral_bands import Band, chosen_wavelengths, even_wavelengths
from simulations.models.lens.vignetting import mechanical_vignetting, vignetting_cos4
from simulations.models.sampling.resampling import KERNELS
from simulations.pictures.resolution_chart import resolution_chart

type Floats = NDArray[np.floating]

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
LINES_UM = (LINE_C_UM, LINE_D_UM, LINE_F_UM)
"""Peaks of the red, green and blue channel ..."""
WIDTH_UM = 0.03
"""... and the standard deviation of each."""
REACH = 3.8
"""Standard deviations beyond the outer peaks that even wavelengths cover."""
SMALLEST_SHARE = 1e-4
"""Wavelengths that a channel sees less of are left out: a fortieth of one code at most."""
TIERS = ("gauss-1", "gauss-3", "even-9", "gauss-5", "even-16", "even-31")
"""Rungs of the ladder `chromatic-aberration`."""
MARGIN = 8
"""The chart is drawn this much wider all round: no colour is reduced by more, in pixels."""
CLOSE_TOP, CLOSE_LEFT = HEIGHT_PX - 48, WIDTH_PX - 64
"""The close-up: the last 64 × 48 px."""
SUBDIVISIONS = 5
"""Reference wavelengths per standard deviation."""
FIRST_ROUND = 9
"""Of the reference wavelengths: fewer would leave a channel without light of its own."""


@dataclass(frozen=True, slots=True)
class Ghost:
    """The picture of one channel in light of one wavelength."""

    channel: int
    wavelength_um: float
    share: float
    plane: NDArray[np.float32]
    """(H, W) linear light."""


def bands(tier: str, glass: str) -> tuple[Band, ...]:
    """The wavelengths of the red, green and blue channel; one each where glass has no dispersion.

    Raises ValueError for a tier that is not of `TIERS`.
    """
    kind, _, count = ("gauss-1" if glass == "ideal" else tier).partition("-")
    if kind == "gauss":
        return tuple(chosen_wavelengths(line, WIDTH_UM, int(count)) for line in LINES_UM)
    if kind != "even":
        raise ValueError(f"tier {tier!r}; legal: {', '.join(TIERS)}")
    first, last = min(LINES_UM) - REACH * WIDTH_UM, max(LINES_UM) + REACH * WIDTH_UM
    return even_wavelengths(LINES_UM, WIDTH_UM, first, last, int(count))


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


def magnify(plane: NDArray[np.float32], scale: float) -> NDArray[np.float32]:
    """A plane (H, W) scaled about its centre by bicubic interpolation, one axis after the other."""
    if scale == 1.0:
        return plane
    turned = np.ascontiguousarray(_magnify_rows(plane, scale).T)  # rows are quick to gather
    return np.ascontiguousarray(_magnify_rows(turned, scale).T)


def _magnify_rows(plane: NDArray[np.float32], scale: float) -> NDArray[np.float32]:
    size, kernel = plane.shape[0], KERNELS["bicubic"]
    middle = 0.5 * (size - 1)
    position = middle + (np.arange(size) - middle) / scale
    base = np.floor(position)
    result = np.zeros_like(plane)
    for tap in range(-1, 3):
        weight = kernel.weigh(base + tap - position).astype(np.float32)
        result += weight[:, None] * plane[np.clip(base.astype(int) + tap, 0, size - 1)]
    return result


def _chart() -> Planes:
    """(3, H, W), wider than the picture by the margin."""
    chart = resolution_chart(WIDTH_PX + 2 * MARGIN, HEIGHT_PX + 2 * MARGIN, FOCAL_PX)
    return np.ascontiguousarray(chart.transpose(2, 0, 1))


def _lateral(chart: Planes, glass: str, stop: float, tier: str) -> tuple[Ghost, ...]:
    """Each wavelength's picture in its own size."""
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
    """Each in its own sharpness."""
    return tuple(
        replace(
            ghost,
            plane=disc_blur(ghost.plane[None], disc_px(glass, aperture, ghost.wavelength_um) / 2)[
                0
            ],
        )
        for ghost in ghosts
    )


def _channels(ghosts: tuple[Ghost, ...]) -> Planes:
    """(3, H, W) what each channel sees of all."""
    planes = np.zeros((3, HEIGHT_PX, WIDTH_PX), np.float32)
    whole = np.zeros(3)
    for ghost in ghosts:
        planes[ghost.channel] += np.float32(ghost.share) * ghost.plane
        whole[ghost.channel] += ghost.share
    planes /= whole[:, None, None]
    return planes


def _vignetting(aperture: float, rim: float, natural: bool) -> NDArray[np.float32]:
    """(H, W) factor; what the rim cuts is read from a table of the radius."""
    x = (np.arange(WIDTH_PX) - 0.5 * (WIDTH_PX - 1)) / FOCAL_PX
    y = (np.arange(HEIGHT_PX) - 0.5 * (HEIGHT_PX - 1)) / FOCAL_PX
    radius = np.hypot(x, y[:, None])
    tangents = np.linspace(0, 1.01, 256)
    _, open_share = light(tangents, aperture, rim, natural)
    factor = np.interp(radius, tangents, open_share)
    if natural:
        factor *= vignetting_cos4(radius)
    shared: NDArray[np.float32] = factor.astype(np.float32)
    return shared


def _encode(planes: Planes, factor: Floats) -> Raster:
    return to_rgba8(encode_srgb_table(np.clip(planes * factor, 0, 1).transpose(1, 2, 0)))


def _all_sharp(values: Values) -> str:
    glass, aperture = values.choice("glass"), values.number("aperture")
    widest = max(
        disc_px(glass, aperture, wavelength)
        for band in bands(values.choice("tier"), glass)
        for wavelength in band.wavelengths_um[band.shares >= SMALLEST_SHARE].tolist()
    )
    return "" if widest > 1 else "no colour’s disc is wider than a pixel"


STAGES = (
    Stage("chart", _chart),
    Stage("lateral", _lateral, ("chart",)),
    Stage("axial", _axial, ("lateral",), _all_sharp),
    Stage("channels", _channels, ("axial",)),
    Stage("vignetting", _vignetting),
    Stage("encoded", _encode, ("channels", "vignetting")),
)


def error(values: Values, tier: str, cache: StageCache) -> Iterator[Readout]:
    """RMS of the enlarged corner against the sum over the whole spectrum, in even, small steps.

    One wavelength more each time, seen by all channels; the light of each pixel by the formulas.
    """
    outputs = run(STAGES, values, cache, {"tier": tier}).outputs
    shown = outputs["encoded"][CLOSE_TOP:, CLOSE_LEFT:, :3].astype(np.float32)
    factor = _corner_light(values)
    total, weights = np.zeros((3, *shown.shape[:2])), np.zeros((3, 1, 1))
    wavelengths = reference_wavelengths()
    for count, wavelength in enumerate(wavelengths, start=1):
        seen = np.exp(-0.5 * ((wavelength - np.array(LINES_UM)) / WIDTH_UM) ** 2)[:, None, None]
        total += seen * _corner(outputs["chart"], values, wavelength)
        weights += seen
        truth = _encode(np.asarray(total / weights, np.float32), factor)
        off = shown - truth[..., :3]
        text = format_magnitude(math.sqrt(float(np.mean(off * off))), 1e-3)
        label = f"RMS error of the corner against {count} of {len(wavelengths)} wavelengths"
        enough = count >= FIRST_ROUND
        yield Readout("error", label, text if enough else "…", "codes of 255" * enough, "error")


def reference_wavelengths() -> list[float]:
    """Equal steps over the spectrum, a coarse round of them first and the gaps filled after."""
    first, last = min(LINES_UM) - 4 * WIDTH_UM, max(LINES_UM) + 4 * WIDTH_UM
    count = round((last - first) / WIDTH_UM * SUBDIVISIONS) + 1
    steps = np.linspace(first, last, count).tolist()
    return [step for begin in (0, 4, 2, 6, 1, 5, 3, 7) for step in steps[begin::8]]


def _corner(chart: Planes, values: Values, wavelength_um: float) -> Planes:
    """(3, 48, 64) the close-up in light of one wavelength."""
    glass, stop = values.choice("glass"), values.number("stop")
    scale = float(lateral_chromatic_scale(GLASSES[glass], FOCAL_MM, stop, wavelength_um))
    window = (slice(CLOSE_TOP, -MARGIN), slice(CLOSE_LEFT, -MARGIN))  # with room for the discs
    planes = np.stack([magnify(plane, scale)[window] for plane in chart])
    radius = disc_px(glass, values.number("aperture"), wavelength_um) / 2
    return disc_blur(planes, radius)[:, MARGIN:, MARGIN:]


def _corner_light(values: Values) -> Floats:
    """(48, 64) vignetting of the close-up."""
    x = (np.arange(CLOSE_LEFT, WIDTH_PX) - 0.5 * (WIDTH_PX - 1)) / FOCAL_PX
    y = (np.arange(CLOSE_TOP, HEIGHT_PX) - 0.5 * (HEIGHT_PX - 1)) / FOCAL_PX
    aperture, rim = values.number("aperture"), values.number("rim")
    cos4, open_share = light(np.hypot(x, y[:, None]), aperture, rim, values.toggle("natural"))
    return np.asarray(cos4 * open_share, np.float32)
