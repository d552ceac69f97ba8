"""From light to numbers: exposure, electrons, noise, gain and quantisation.

Szeliski, 2nd ed., section 2.3. The chain is: photons per second -> mean electrons (exposure,
quantum efficiency, dark current) -> counted electrons (Poisson, full well) -> volts in units
of codes (read noise, conversion gain, black level) -> whole codes (ADC). DN is a code, a *digital
number*.
"""

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats, as_floats
from simulations.models.require import require, require_one_of
from simulations.models.sensor.poisson_quantile import poisson_from_normal

type ShotModel = Literal["poisson", "quantile", "skewed", "gaussian"]

SHOT_MODELS: tuple[ShotModel, ...] = ("gaussian", "skewed", "quantile", "poisson")
"""Models of shot noise, from rough to exact."""

LARGEST_WELL_E = 1e13
"""Largest mean count for samplers: the variance of numpy's is 2 % too large at 3e13 and 10 % at
3e14, although float64 represents every count up to 9e15."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensor:
    """One kind of pixel and its converter."""

    full_well_e: float = 20_000.0
    """Electrons that a pixel can hold; more spill over and are lost. Inf: no limit."""
    read_noise_e: float = 3.0
    """Standard deviation of the amplifier's noise, in electrons."""
    dark_current_e_per_s: float = 0.1
    """Electrons per second that heat frees without light."""
    gain_e_per_dn: float = 5.0
    """Conversion gain, in electrons per code: twice the amplification (the ISO) halves it."""
    bits: int = 12
    """Bits of the analogue-to-digital converter, 1 to 16."""
    black_level_dn: float = 64.0
    """Code of no light: above 0, so that noise below it is not cut off."""
    quantum_efficiency: float = 0.5
    """Electrons freed per photon, 0 to 1."""

    def __post_init__(self) -> None:
        _check_well(self.full_well_e)
        noise, dark, gain = self.read_noise_e, self.dark_current_e_per_s, self.gain_e_per_dn
        require("read_noise_e", noise, 0 <= noise <= 1e15, "0 to 1e15")
        require("dark_current_e_per_s", dark, 0 <= dark <= 1e30, "0 to 1e30")
        # Its reciprocal is finite in float32 too.
        require("gain_e_per_dn", gain, 1e-30 <= gain <= 1e30, "1e-30 to 1e30")
        _check_bits(self.bits)
        black, top = self.black_level_dn, self.highest_dn
        require("black_level_dn", black, 0 <= black < top, f"0 to below {top}")
        efficiency = self.quantum_efficiency
        require("quantum_efficiency", efficiency, 0 <= efficiency <= 1, "0 to 1")

    @property
    def highest_dn(self) -> int:
        """The largest code."""
        return (1 << int(self.bits)) - 1


def with_iso(sensor: Sensor, iso: float, base_iso: float = 100.0) -> Sensor:
    """The sensor at another ISO: twice the ISO, half the electrons per code.

    The well stays the same, but the converter saturates before it is full.
    """
    require("iso", iso, iso > 0, "above 0")
    return replace(sensor, gain_e_per_dn=sensor.gain_e_per_dn * base_iso / float(iso))


def expose(photons_per_s: ArrayLike, exposure_s: float, sensor: Sensor) -> Floats:
    """Mean electrons (...) freed in each pixel by light and heat during the exposure.

    Not yet limited to the full well: see `shot_noise`. Raises `ValueError` for light that is
    negative or undefined, and for an exposure that is negative or infinite.
    """
    require("exposure_s", exposure_s, 0 <= exposure_s < np.inf, "0 or more, finite")
    # Infinite light times zero time would be undefined.
    rate = np.minimum(_light("photons_per_s", photons_per_s), 1e30)
    freed = rate * sensor.quantum_efficiency + sensor.dark_current_e_per_s
    with np.errstate(over="ignore"):  # infinite light is legal and fills every well
        return freed * exposure_s


def shot_noise(
    mean_e: ArrayLike,
    rng: np.random.Generator,
    full_well_e: float = np.inf,
    model: ShotModel = "poisson",
) -> Floats:
    """Electrons counted (...), where the mean is ``mean_e``: whole numbers, at most the full well.

    ``poisson`` is exact: electrons arrive independently, the variance equals the mean. ``quantile``
    makes each count of one normal deviate, see `poisson_from_normal`: its counts are
    indistinguishable from exact ones, and the same deviates have the same grain in any light.
    ``gaussian`` rounds a normal of the same mean and variance, and is visibly wrong below some 20
    electrons; ``skewed`` adds the second term of the Cornish-Fisher expansion, ``(z^2 - 1) / 6``,
    which gives the normal the Poisson's skew to the right. Below one electron its mean is too
    large: 0.047 electrons where almost none are expected.

    If the mean is ten standard deviations above the full well, the result is the full well without
    sampling, as samplers fail for huge means.
    """
    cap = _brightest_mean(full_well_e)
    mean = np.minimum(_light("mean_e", mean_e), cap)
    if model == "poisson":
        counted, drawn = np.array(mean), mean < cap
        counted[drawn] = rng.poisson(mean[drawn])
        return np.minimum(counted, full_well_e)
    require_one_of("model", model, SHOT_MODELS)
    z = rng.standard_normal(mean.shape, np.float32 if mean.dtype == np.float32 else np.float64)
    if model == "quantile":
        return shot_noise_from_normal(mean, z, full_well_e)
    return _normal_counts(mean, z, full_well_e, skewed=model == "skewed")


def shot_noise_from_normal(mean_e: ArrayLike, z: ArrayLike, full_well_e: float = np.inf) -> Floats:
    """The ``quantile`` model of `shot_noise`, from standard normals ``z`` (...) drawn beforehand.

    The grain of a picture then stays the same as its light changes, and no new samples are needed.
    """
    mean = np.minimum(_light("mean_e", mean_e), _brightest_mean(full_well_e))
    counted = poisson_from_normal(mean, as_floats(z))
    return np.minimum(counted, float(full_well_e), out=counted)


def _brightest_mean(full_well_e: float) -> float:
    """The mean from which on every sample fills the well."""
    _check_well(full_well_e)
    # A Python float: a numpy one would convert float32 pictures to float64.
    well = min(float(full_well_e), LARGEST_WELL_E)
    return well + 10 * math.sqrt(well) + 100


def _normal_counts(mean: Floats, z: Floats, full_well_e: float, *, skewed: bool) -> Floats:
    counted: Floats = np.asarray(np.sqrt(mean) * z)
    counted += mean
    if skewed:
        counted += (z * z - 1) / 6
    np.clip(np.rint(counted, out=counted), 0, full_well_e, out=counted)
    # Without light no electron is freed, even if the approximation has tails.
    counted[mean == 0] = 0
    return counted


def read_out(electrons: ArrayLike, sensor: Sensor, rng: np.random.Generator) -> Floats:
    """The amplified signal (...) in codes, not yet rounded: read noise, conversion, black level."""
    e = as_floats(electrons)
    with np.errstate(over="ignore"):  # the converter maps ∞ to its top code
        if sensor.read_noise_e > 0:
            kind = np.float32 if e.dtype == np.float32 else np.float64
            e = e + sensor.read_noise_e * rng.standard_normal(e.shape, kind)
        return e / sensor.gain_e_per_dn + sensor.black_level_dn


def quantise(signal_dn: ArrayLike, bits: int) -> NDArray[np.uint16]:
    """Nearest whole code (...), clipped to the converter's range [0, 2^bits - 1].

    NaN becomes 0: a cast of NaN is undefined and differs between processors. Rounding adds an error
    of variance 1/12 to a signal that spans several codes.
    """
    _check_bits(bits)
    top = 2 ** int(bits) - 1
    # fmax, unlike clip, replaces NaN.
    clipped = np.minimum(np.fmax(as_floats(signal_dn), 0), top)
    return np.rint(clipped).astype(np.uint16)


def develop(raw_dn: ArrayLike, sensor: Sensor) -> Floats:
    """Codes (...) to linear light: 0 at the black level, 1 at the top; noise may be below 0."""
    span = sensor.highest_dn - sensor.black_level_dn
    return (as_floats(raw_dn) - sensor.black_level_dn) / span


def signal_to_noise(mean_e: ArrayLike, sensor: Sensor) -> Floats:
    """Mean over standard deviation (...) of one pixel: shot, read and quantisation noise together.

    Rises with the square root of the light once shot noise prevails. It is 0 without light and ∞
    for infinite light.
    """
    mean = _light("mean_e", mean_e)
    fixed = math.hypot(sensor.read_noise_e, sensor.gain_e_per_dn / math.sqrt(12))
    with np.errstate(invalid="ignore"):
        ratio = mean / np.hypot(np.sqrt(mean), fixed)
    return np.where(np.isinf(mean), np.inf, ratio)


def _check_well(full_well_e: float) -> None:
    legal = 0 < full_well_e <= LARGEST_WELL_E or full_well_e == math.inf
    require("full_well_e", full_well_e, legal, f"above 0, to {LARGEST_WELL_E:g}, or inf")


def _check_bits(bits: int) -> None:
    whole = isinstance(bits, int | np.integer)
    require("bits", bits, whole and 1 <= bits <= 16, "whole numbers, 1 to 16")


def _light(name: str, values: ArrayLike) -> Floats:
    light = as_floats(values)
    if not np.all(light >= 0):
        raise ValueError(f"{name} has values below 0 or undefined; legal: 0 or more")
    return light
