"""Spectra of lights: glowing bodies, daylight, a fluorescent tube, a white diode.

All are relative powers (81,) on the grid of `spectra`, 1 at 560 nm or about it. CIE 15:2004;
Planck's law as in the CIE's illuminant A; Wyszecki and Stiles, Color Science, 2nd ed., 1982.
"""

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.color.spectra import WAVELENGTHS_NM, Bell, bells
from simulations.models.require import require

SECOND_RADIATION_NM_K = 1.438776877e7
"""hc/k, in nm K (CODATA 2018)."""
COLDEST_K, HOTTEST_K = 20.0, 1e9
DAYLIGHT_K = (4000.0, 25000.0)
"""Range of the correlated colour temperatures of the CIE's formula for daylight."""
D65_K = 6504.0
"""Temperature of D65: 6500 K by an older value of the constant above."""

_DAYLIGHT = np.array(
    [
        [
            63.4, 65.8, 94.8, 104.8, 105.9, 96.8, 113.9, 125.6, 125.5, 121.3, 121.3, 113.5, 113.1,
            110.8, 106.5, 108.8, 105.3, 104.4, 100.0, 96.0, 95.1, 89.1, 90.5, 90.3, 88.4, 84.0,
            85.1, 81.9, 82.6, 84.9, 81.3, 71.9, 74.3, 76.4, 63.3, 71.7, 77.0, 65.2, 47.7, 68.6,
            65.0,
        ],
        [
            38.5, 35.0, 43.4, 46.3, 43.9, 37.1, 36.7, 35.9, 32.6, 27.9, 24.3, 20.1, 16.2, 13.2,
            8.6, 6.1, 4.2, 1.9, 0.0, -1.6, -3.5, -3.5, -5.8, -7.2, -8.6, -9.5, -10.9, -10.7,
            -12.0, -14.0, -13.6, -12.0, -13.3, -12.9, -10.6, -11.6, -12.2, -10.2, -7.8, -11.2,
            -10.4,
        ],
        [
            3.0, 1.2, -1.1, -0.5, -0.7, -1.2, -2.6, -2.9, -2.8, -2.6, -2.6, -1.8, -1.5, -1.3, -1.2,
            -1.0, -0.5, -0.3, 0.0, 0.2, 0.5, 2.1, 3.2, 4.1, 4.7, 5.1, 6.7, 7.3, 8.6, 9.8, 10.2, 8.3,
            9.6, 8.5, 7.0, 7.6, 8.0, 6.7, 5.2, 7.4, 6.8,
        ],
    ]
)  # fmt: skip
"""Mean daylight and its two ways to vary, every 10 nm from 380 (CIE 15:2004, table T.2; Judd,
MacAdam and Wyszecki, 1964). The CIE interpolates linearly."""

TUBE: tuple[Bell, ...] = (
    (0.143, 404.9, 3.0, 3.0),
    (0.394, 435.6, 3.0, 3.0),
    (0.168, 489.0, 5.0, 5.0),
    (0.995, 544.7, 4.3, 4.3),
    (0.197, 586.8, 8.7, 8.7),
    (0.781, 611.8, 3.0, 3.0),
    (0.178, 622.4, 11.3, 11.3),
    (0.082, 460.0, 30.0, 30.0),
)
"""A three-band tube after the CIE's F11: two lines of mercury, and those of its phosphors."""
DIODE: tuple[Bell, ...] = ((0.831, 448.0, 8.7, 8.9), (0.882, 589.7, 76.0, 59.0))
"""A white diode after the CIE's LED-B3: a blue diode and a phosphor that glows yellow."""


def planck(temperature_k: float) -> Floats:
    """Power of a glowing body by wavelength, relative to that at 560 nm (Planck's law).

    Only the ratio of the two exponentials e^(c/λT) is computed, as each alone may overflow. Raises
    `ValueError` below 20 K and above 1e9 K.
    """
    legal = f"{COLDEST_K:g} to {HOTTEST_K:g}"
    require("temperature_k", temperature_k, COLDEST_K <= temperature_k <= HOTTEST_K, legal)
    reach = SECOND_RADIATION_NM_K / temperature_k
    ratio = np.exp(reach * (1.0 / 560.0 - 1.0 / WAVELENGTHS_NM))
    left = np.expm1(-reach / 560.0) / np.expm1(-reach / WAVELENGTHS_NM)
    return (560.0 / WAVELENGTHS_NM) ** 5 * ratio * left


def daylight_xy(temperature_k: float) -> tuple[float, float]:
    """Chromaticity of daylight: two cubics in 1/T, and a parabola over them (CIE 15:2004, 3.1)."""
    low, high = DAYLIGHT_K
    legal = f"{low:g} to {high:g}"
    require("temperature_k", temperature_k, low <= temperature_k <= high, legal)
    t = 1000.0 / temperature_k
    if temperature_k <= 7000.0:
        x = ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063
    else:
        x = ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040
    return x, (-3.0 * x + 2.870) * x - 0.275


def daylight(temperature_k: float) -> Floats:
    """Daylight of a correlated colour temperature, relative to 560 nm.

    Raises `ValueError` outside of 4000 to 25 000 K, in which it was measured.
    """
    x, y = daylight_xy(temperature_k)
    scale = 0.0241 + 0.2562 * x - 0.7341 * y
    first = (-1.3515 - 1.7703 * x + 5.9114 * y) / scale
    second = (0.0300 - 31.4424 * x + 30.0717 * y) / scale
    every_10_nm = np.array([1.0, first, second]) @ _DAYLIGHT / 100.0
    return np.interp(WAVELENGTHS_NM, WAVELENGTHS_NM[::2], every_10_nm)


def fluorescent() -> Floats:
    """The three-band tube: nearly all of its light in a few lines."""
    return bells(WAVELENGTHS_NM, TUBE)


def white_diode() -> Floats:
    """The white diode: a blue line, and a broad hill from green to red."""
    return bells(WAVELENGTHS_NM, DIODE)
