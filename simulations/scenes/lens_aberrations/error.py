"""Error of the enlarged corner against the sum over the whole spectrum."""

from collections.abc import Callable, Iterator

import numpy as np

from simulations.engine.frame import Raster, Readout, format_magnitude
from simulations.models.arrays import Floats, Planes
from simulations.models.error_measures import root_mean_square
from simulations.models.lens.chromatic_aberration import lateral_chromatic_scale
from simulations.models.lens.disc_blur import disc_blur
from simulations.models.sampling.magnification import magnify
from simulations.scenes.lens_aberrations.spectrum import LINES_UM, WIDTH_UM
from simulations.scenes.lens_aberrations.stages import (
    FOCAL_MM,
    GLASSES,
    HEIGHT_PX,
    MARGIN,
    WIDTH_PX,
    disc_px,
    encode,
    field_tangents,
    light,
)

CLOSE_TOP, CLOSE_LEFT = HEIGHT_PX - 48, WIDTH_PX - 64
"""The close-up: the last 64 × 48 px."""
SUBDIVISIONS = 5
"""Reference wavelengths per standard deviation."""
FIRST_ROUND = 9
"""Least count of reference wavelengths: with fewer a channel would have no light."""


def estimates(
    picture: Raster, corner_of: Callable[[float], Planes], factor: Floats
) -> Iterator[Readout]:
    """RMS of the close-up of ``picture``, in even, small steps.

    Each step adds a wavelength for all channels: ``corner_of`` returns the close-up in its light,
    and ``factor`` (48, 64) is the vignetting.
    """
    shown = picture[CLOSE_TOP:, CLOSE_LEFT:, :3].astype(np.float32)
    total, weights = np.zeros((3, *shown.shape[:2])), np.zeros((3, 1, 1))
    wavelengths = reference_wavelengths()
    for count, wavelength in enumerate(wavelengths, start=1):
        seen = np.exp(-0.5 * ((wavelength - np.array(LINES_UM)) / WIDTH_UM) ** 2)[:, None, None]
        total += seen * corner_of(wavelength)
        weights += seen
        truth = encode(np.asarray(total / weights, np.float32), factor)
        off = shown - truth[..., :3]
        text = format_magnitude(root_mean_square(off), 1e-3)
        label = f"RMS error of the corner against {count} of {len(wavelengths)} wavelengths"
        enough = count >= FIRST_ROUND
        yield Readout("error", label, text if enough else "…", "codes of 255" * enough, "error")


def reference_wavelengths() -> list[float]:
    """Evenly spaced wavelengths, first a coarse series and then those in between."""
    first, last = min(LINES_UM) - 4 * WIDTH_UM, max(LINES_UM) + 4 * WIDTH_UM
    count = round((last - first) / WIDTH_UM * SUBDIVISIONS) + 1
    steps = np.linspace(first, last, count).tolist()
    return [step for begin in (0, 4, 2, 6, 1, 5, 3, 7) for step in steps[begin::8]]


def corner_in(
    chart: Planes, glass: str, stop: float, aperture: float, wavelength_um: float
) -> Planes:
    """(3, 48, 64) the close-up in light of one wavelength."""
    scale = float(lateral_chromatic_scale(GLASSES[glass], FOCAL_MM, stop, wavelength_um))
    window = (slice(CLOSE_TOP, -MARGIN), slice(CLOSE_LEFT, -MARGIN))  # with a margin for the discs
    planes = np.stack([magnify(plane, scale)[window] for plane in chart])
    radius = disc_px(glass, aperture, wavelength_um) / 2
    return disc_blur(planes, radius)[:, MARGIN:, MARGIN:]


def corner_light(aperture: float, rim: float, natural: bool) -> Floats:
    """(48, 64) vignetting of the close-up, by the formulas."""
    tangents = field_tangents()[CLOSE_TOP:, CLOSE_LEFT:]
    cos4, open_share = light(tangents, aperture, rim, natural)
    return np.asarray(cos4 * open_share, np.float32)
