"""The stages of the lens-aberrations figure: a picture for each wavelength, summed by channel.

The channels are bell-shaped bands of the spectrum about the Fraunhofer lines C, d and F. The tier
sets how many wavelengths sample each of them; the error of the enlarged corner is against the sum
over the whole spectrum.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from simulations.engine.frame import Raster, Readout, format_magnitude
from simulations.engine.photograph import Photograph
from simulations.engine.raster import of_planes
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats, Planes, centred
from simulations.models.color.srgb import decode_srgb, encode_srgb_codes
from simulations.models.error_measures import root_mean_square
from simulations.models.lens.chromatic_aberration import (
    LINE_C_UM,
    LINE_D_UM,
    LINE_F_UM,
    Glass,
    axial_chromatic_mm,
    lateral_chromatic_scale,
)
from simulations.models.lens.disc_blur import disc_blur
from simulations.models.lens.spectral_bands import Band, chosen_wavelengths, even_wavelengths
from simulations.models.lens.vignetting import mechanical_vignetting, vignetting_cos4
from simulations.models.require import require_one_of
from simulations.models.sampling.magnification import magnify
from simulations.pictures.resolution_chart import resolution_chart
from simulations.pictures.twigs import twigs

WIDTH_PX, HEIGHT_PX = 320, 240
CLOSE_TOP, CLOSE_LEFT = HEIGHT_PX - 48, WIDTH_PX - 64  # the close-up: the last 64 × 48 px
FOCAL_MM, FOCAL_PX = 24.0, 200.0
PITCH_MM = FOCAL_MM / FOCAL_PX
RIM_MM = 9.0  # radius of the lens barrel's front rim: just wider than the widest opening
GLASSES = {
    "ideal": Glass(abbe_number=math.inf),
    "crown": Glass(),
    "flint": Glass(index_d=1.62, abbe_number=36.4),
}
MARGIN = 8  # of the subject on all sides, in pixels: no colour is reduced by more
PADDED_PX = (WIDTH_PX + 2 * MARGIN, HEIGHT_PX + 2 * MARGIN)
SMALLEST_SHARE = 1e-4
"""Least share of a wavelength in a channel; those left out are at most a fortieth of one code."""

LINES_UM = (LINE_C_UM, LINE_D_UM, LINE_F_UM)  # peaks of the red, green and blue channel
WIDTH_UM = 0.03  # the standard deviation of each
SUBDIVISIONS = 5  # reference wavelengths per standard deviation
FIRST_ROUND = 9  # least count of reference wavelengths: with fewer a channel would have no light


def channel_wavelengths(count: int) -> tuple[Band, ...]:
    """Wavelengths for each channel separately."""
    return tuple(chosen_wavelengths(line, WIDTH_UM, count) for line in LINES_UM)


def shared_wavelengths(count: int) -> tuple[Band, ...]:
    """The same wavelengths for all channels, to 3.8 standard deviations beyond the outer peaks."""
    first, last = min(LINES_UM) - 3.8 * WIDTH_UM, max(LINES_UM) + 3.8 * WIDTH_UM
    return even_wavelengths(LINES_UM, WIDTH_UM, first, last, count)


BANDS: Mapping[str, tuple[Band, ...]] = {
    "gauss-1": channel_wavelengths(1),
    "gauss-3": channel_wavelengths(3),
    "even-9": shared_wavelengths(9),
    "gauss-5": channel_wavelengths(5),
    "even-16": shared_wavelengths(16),
    "even-31": shared_wavelengths(31),
}
"""The red, green and blue channel in each tier, a rung of the ladder `chromatic-aberration`."""


@dataclass(frozen=True, slots=True)
class Ghost:
    """The picture of one channel in light of one wavelength."""

    channel: int
    wavelength_um: float
    share: float
    plane: NDArray[np.float32]  # (H, W) linear light


def bands(tier: str, glass: str) -> tuple[Band, ...]:
    """The wavelengths of the red, green and blue channel; one each if the glass has no dispersion.
    Raises ValueError for a tier that is not in `BANDS`.
    """
    require_one_of("tier", tier, BANDS)
    return BANDS["gauss-1" if glass == "ideal" else tier]


def scales(glass: str, stop_mm: float, wavelengths_um: Floats) -> Floats:
    """Sizes (n,) of the images relative to the green one."""
    return lateral_chromatic_scale(GLASSES[glass], FOCAL_MM, stop_mm, wavelengths_um)


def discs_px(glass: str, aperture: float, wavelengths_um: Floats) -> Floats:
    """Diameters (n,) of the discs that a point becomes in light of these wavelengths."""
    return axial_chromatic_mm(GLASSES[glass], FOCAL_MM, aperture, wavelengths_um) / PITCH_MM


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


def padded(picture: str, photograph: Photograph | None) -> Planes:
    """(3, H, W) linear light, wider than the picture by the margin."""
    width, height = PADDED_PX
    if photograph:
        light = decode_srgb(np.float32(1 / 255) * photograph.codes)
    elif picture == "twigs":
        light = twigs(width, height)
    else:
        light = resolution_chart(width, height, FOCAL_PX)
    return np.ascontiguousarray(light.transpose(2, 0, 1))


def lateral(subject: Planes, glass: str, stop: float, tier: str) -> tuple[Ghost, ...]:
    """Magnify each wavelength's picture by its own factor."""
    ghosts = []
    for channel, band in enumerate(bands(tier, glass)):
        sizes = scales(glass, stop, band.wavelengths_um).tolist()
        for wavelength, share, scale in zip(
            band.wavelengths_um.tolist(), band.shares.tolist(), sizes, strict=True
        ):
            if share >= SMALLEST_SHARE:
                plane = magnify(subject[channel], scale)[MARGIN:-MARGIN, MARGIN:-MARGIN]
                ghosts.append(Ghost(channel, wavelength, share, plane))
    return tuple(ghosts)


def axial(ghosts: tuple[Ghost, ...], glass: str, aperture: float) -> tuple[Ghost, ...]:
    """Blur each wavelength's picture by its own disc."""
    wavelengths = np.array([ghost.wavelength_um for ghost in ghosts])
    radii = (discs_px(glass, aperture, wavelengths) / 2).tolist()
    return tuple(
        replace(ghost, plane=disc_blur(ghost.plane[None], radius)[0])
        for ghost, radius in zip(ghosts, radii, strict=True)
    )


def all_sharp(glass: str, aperture: float, tier: str) -> str:
    widest = max(
        discs_px(glass, aperture, band.wavelengths_um[band.shares >= SMALLEST_SHARE]).max()
        for band in bands(tier, glass)
    )
    return "" if widest > 1 else "no colour’s disc is wider than a pixel"


def channels(ghosts: tuple[Ghost, ...]) -> Planes:
    """(3, H, W) the channels, summed over the wavelengths."""
    planes = np.zeros((3, HEIGHT_PX, WIDTH_PX), np.float32)
    whole = np.zeros(3)
    for ghost in ghosts:
        planes[ghost.channel] += np.float32(ghost.share) * ghost.plane
        whole[ghost.channel] += ghost.share
    planes /= whole[:, None, None]
    return planes


def vignetting(aperture: float, rim: float, natural: bool) -> NDArray[np.float32]:
    """(H, W) vignetting factor; the rim's part is read from a table of the radius."""
    radius = field_tangents()
    tangents = np.linspace(0, 1.01, 256)
    _, open_share = light(tangents, aperture, rim, natural)
    factor = np.interp(radius, tangents, open_share)
    if natural:
        factor *= vignetting_cos4(radius)
    return factor.astype(np.float32)


def encode(planes: Planes, factor: Floats) -> Raster:
    return of_planes(encode_srgb_codes(planes * factor))


STAGES = (
    Stage("subject", padded),
    Stage("lateral", lateral, ("subject",)),
    Stage("axial", axial, ("lateral",), neutral=all_sharp),
    Stage("channels", channels, ("axial",)),
    Stage("vignetting", vignetting),
    Stage("encoded", encode, ("channels", "vignetting")),
)


def corner_errors(
    picture: Raster,
    subject: Planes,
    glass: str,
    stop: float,
    aperture: float,
    rim: float,
    natural: bool,
) -> Iterator[Readout]:
    """RMS of the close-up of ``picture``, in even, small steps: each adds a wavelength for all
    channels."""
    measured = picture[CLOSE_TOP:, CLOSE_LEFT:, :3].astype(np.float32)
    cos4, open_share = light(field_tangents()[CLOSE_TOP:, CLOSE_LEFT:], aperture, rim, natural)
    factor = np.asarray(cos4 * open_share, np.float32)
    total, weights = np.zeros((3, *measured.shape[:2])), np.zeros((3, 1, 1))
    wavelengths = reference_wavelengths()
    for count, wavelength in enumerate(wavelengths, start=1):
        sensitivity = np.exp(-0.5 * ((wavelength - np.array(LINES_UM)) / WIDTH_UM) ** 2)[
            :, None, None
        ]
        total += sensitivity * corner_in(subject, glass, stop, aperture, wavelength)
        weights += sensitivity
        truth = encode(np.asarray(total / weights, np.float32), factor)
        off = measured - truth[..., :3]
        text = format_magnitude(root_mean_square(off), 1e-3)
        label = f"RMS error of the corner against {count} of {len(wavelengths)} wavelengths"
        enough = count >= FIRST_ROUND
        yield Readout(
            "error", label, text if enough else "…", "codes of 255" * enough, role="error"
        )


def reference_wavelengths() -> list[float]:
    """Evenly spaced wavelengths, first a coarse series and then those in between."""
    first, last = min(LINES_UM) - 4 * WIDTH_UM, max(LINES_UM) + 4 * WIDTH_UM
    count = round((last - first) / WIDTH_UM * SUBDIVISIONS) + 1
    steps = np.linspace(first, last, count).tolist()
    return [step for begin in (0, 4, 2, 6, 1, 5, 3, 7) for step in steps[begin::8]]


def corner_in(
    subject: Planes, glass: str, stop: float, aperture: float, wavelength_um: float
) -> Planes:
    """(3, 48, 64) the close-up in light of one wavelength."""
    wavelength = np.array([wavelength_um])
    (scale,) = scales(glass, stop, wavelength).tolist()
    (disc,) = discs_px(glass, aperture, wavelength).tolist()
    window = (slice(CLOSE_TOP, -MARGIN), slice(CLOSE_LEFT, -MARGIN))  # with a margin for the discs
    planes = np.stack([magnify(plane, scale)[window] for plane in subject])
    return disc_blur(planes, disc / 2)[:, MARGIN:, MARGIN:]
