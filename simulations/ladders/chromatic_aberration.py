"""Lateral colour: how many wavelengths a picture needs for smooth fringes.

Each wavelength forms its own picture, a little larger or smaller than the next. A pixel sums them
by its sensitivity. Three pictures show sharp coloured ghosts; the reference is a smear.
"""

from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats, centred
from simulations.models.error_measures import root_mean_square
from simulations.models.lens.chromatic_aberration import Glass, lateral_chromatic_scale
from simulations.models.lens.spectral_bands import chosen_wavelengths, even_wavelengths
from simulations.pictures.patterns import checker

SIZE = 192
TILE_PX = 14.0
PIXEL = np.float32(1.0)
LENS = Glass(index_d=1.62, abbe_number=36.4)
"""Flint, F2."""
FOCAL_MM, STOP_MM = 50.0, 60.0
"""A magnifier with its stop far from the lens: red and blue are three pixels apart at the sides."""

PEAKS_UM = (0.60, 0.54, 0.46)
"""Peaks of the red, green and blue sensitivities, bell curves on white light."""
WIDTH_UM = 0.03
"""Standard deviation of each."""
FIRST_UM, LAST_UM = 0.345, 0.715
"""Range of wavelengths: nearly four standard deviations beyond the outer peaks."""


@dataclass(frozen=True, slots=True)
class Workload:
    """The target's coordinates at the d line."""

    x: Floats
    """(1, 192) pixels from the optical axis."""
    y: Floats
    """(192, 1)."""


def prepare() -> Workload:
    return _workload(0.0)


def draw(index: int) -> Workload:
    """Other places of the tiles on the grid, right and down from the axis."""
    return _workload(float(np.random.default_rng(index).uniform(-0.5, 0.5) * TILE_PX))


def _workload(shift_px: float) -> Workload:
    along = (centred(SIZE) + shift_px).astype(np.float32)
    return Workload(along[None, :], along[:, None])


def _chequers(workload: Workload, scale: float) -> Floats:
    """The target magnified by a lens, averaged over each pixel: (192, 192)."""
    zoom = np.float32(1.0 / scale)
    x, y = workload.x * zoom, workload.y * zoom
    return checker(x, y, TILE_PX, PIXEL * zoom, PIXEL * zoom)


def _scale(wavelength_um: float) -> float:
    return float(lateral_chromatic_scale(LENS, FOCAL_MM, STOP_MM, wavelength_um))


def _per_channel(workload: Workload, *, nodes: int) -> Floats:
    """Each colour with its own few wavelengths."""
    colours = np.zeros((3, SIZE, SIZE), np.float32)
    for colour, peak in zip(colours, PEAKS_UM, strict=True):
        band = chosen_wavelengths(peak, WIDTH_UM, nodes)
        shares = band.shares.astype(np.float32)
        for wavelength, share in zip(band.wavelengths_um, shares, strict=True):
            colour += share * _chequers(workload, _scale(wavelength))
    return colours


def _spread(workload: Workload, *, count: int) -> Floats:
    """``count`` evenly spaced wavelengths, shared by all three colours."""
    bands = even_wavelengths(PEAKS_UM, WIDTH_UM, FIRST_UM, LAST_UM, count)
    shares = np.stack([band.shares for band in bands]).astype(np.float32)
    colours = np.zeros((3, SIZE, SIZE), np.float32)
    for wavelength, share in zip(bands[0].wavelengths_um, shares.T, strict=True):
        colours += share[:, None, None] * _chequers(workload, _scale(float(wavelength)))
    return colours


def reference(workload: Workload) -> Floats:
    """Simpson's rule over ±6 standard deviations, 801 wavelengths a colour, in float64.

    Cauchy's law, the lens and the target are written out here, the target as overlaps of intervals
    along x and along y, for all wavelengths at once.
    """
    steps = np.linspace(-6.0, 6.0, 801)
    simpson = np.where(np.arange(801) % 2, 4.0, 2.0)
    simpson[[0, -1]] = 1.0
    weights = simpson * np.exp(-(steps**2) / 2)
    colours = [
        _weighted_chequers(workload.x.ravel().astype(float), _magnification(peak + 0.03 * steps), w)
        for peak, w in ((peak, weights / weights.sum()) for peak in PEAKS_UM)
    ]
    return np.array(colours)


def _magnification(wavelength_um: Floats) -> Floats:
    """1 + t (1/F_d − 1/F): the lens's power follows n − 1, with n = A + B/λ²."""
    slope = (1.62 - 1.0) / 36.4 / (0.4861**-2 - 0.6563**-2)
    extra_power = slope * (wavelength_um**-2 - 0.5876**-2) / (1.62 - 1.0) / 50.0
    return 1.0 - 60.0 * extra_power


def _weighted_chequers(at: Floats, magnification: Floats, weights: Floats) -> Floats:
    """Mean of the chequerboard for each magnification: a product of light and dark along x and
    y."""
    sign = _sign_along(at, magnification)
    return 0.5 + 0.5 * np.einsum("w,wy,wx->yx", weights, sign, sign, optimize=True)


def _sign_along(at: Floats, magnification: Floats) -> Floats:
    """(W, N) mean over a pixel of +1 on tiles centred on even multiples of 14, −1 on odd."""
    low, high = ((at + edge) / magnification[:, None] / 14.0 + 0.5 for edge in (-0.5, 0.5))
    border = np.floor(high)  # no pixel has more than one border
    first = np.where(np.floor(low) % 2 == 0, 1.0, -1.0)
    after = np.clip((high - border) / (high - low), 0.0, 1.0)
    crossed = border > np.floor(low)
    return np.where(crossed, first * (1.0 - 2.0 * after), first)


def rms(result: Floats, truth: Floats, _workload: Workload) -> float:
    return root_mean_square(result - truth)


def worst(result: Floats, truth: Floats, _workload: Workload) -> float:
    return float(np.abs(result - truth).max())


def _gauss_tier(nodes: int) -> Tier:
    label = f"{nodes} chosen wavelengths a colour" if nodes > 1 else "1 wavelength a colour"
    return Tier(
        f"gauss-{nodes}", label, f"{3 * nodes} pictures", partial(_per_channel, nodes=nodes)
    )


def _even_tier(count: int) -> Tier:
    cost = f"{count} pictures, seen by 3 colours"
    return Tier(f"even-{count}", f"{count} even wavelengths", cost, partial(_spread, count=count))


LADDER = Ladder(
    id="chromatic-aberration",
    title="Colours of different size",
    workload="chequers on 192 × 192 pixels in white light through a flint magnifier",
    prepare=prepare,
    tiers=(
        *(_gauss_tier(nodes) for nodes in (1, 3)),
        _even_tier(9),
        _gauss_tier(5),
        *(_even_tier(count) for count in (16, 31)),
    ),
    reference=reference,
    reference_label="Simpson's rule with 801 wavelengths a colour, the optics written out",
    metrics=(
        Metric("rms", "RMS error", "of range", rms),
        Metric("worst", "Largest error", "of range", worst),
    ),
    draw=draw,
    default_tier="even-16",
    items=36_864,
)
