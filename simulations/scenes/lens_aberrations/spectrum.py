"""The channels of the lens-aberrations figure, and the wavelengths that sample each of them.

The channels are bell-shaped bands of the spectrum about the Fraunhofer lines C, d and F.
"""

from collections.abc import Mapping

from simulations.models.lens.chromatic_aberration import LINE_C_UM, LINE_D_UM, LINE_F_UM
from simulations.models.lens.spectral_bands import Band, chosen_wavelengths, even_wavelengths
from simulations.models.require import require_one_of

LINES_UM = (LINE_C_UM, LINE_D_UM, LINE_F_UM)
"""Peaks of the red, green and blue channel ..."""
WIDTH_UM = 0.03
"""... and the standard deviation of each."""
REACH = 3.8
"""Standard deviations beyond the outer peaks that evenly spaced wavelengths cover."""


def _chosen(count: int) -> tuple[Band, ...]:
    """Wavelengths of its own for each channel."""
    return tuple(chosen_wavelengths(line, WIDTH_UM, count) for line in LINES_UM)


def _even(count: int) -> tuple[Band, ...]:
    """The same wavelengths for all channels."""
    first, last = min(LINES_UM) - REACH * WIDTH_UM, max(LINES_UM) + REACH * WIDTH_UM
    return even_wavelengths(LINES_UM, WIDTH_UM, first, last, count)


BANDS: Mapping[str, tuple[Band, ...]] = {
    "gauss-1": _chosen(1),
    "gauss-3": _chosen(3),
    "even-9": _even(9),
    "gauss-5": _chosen(5),
    "even-16": _even(16),
    "even-31": _even(31),
}
"""The red, green and blue channel in each tier, a rung of the ladder `chromatic-aberration`."""


def bands(tier: str, glass: str) -> tuple[Band, ...]:
    """The wavelengths of the red, green and blue channel; one each if the glass has no dispersion.
    Raises ValueError for a tier that is not in `BANDS`.
    """
    require_one_of("tier", tier, BANDS)
    return BANDS["gauss-1" if glass == "ideal" else tier]
