"""A sensor's numbers from pairs of evenly lit frames, each with its error or a reason why not.

EMVA Standard 1288, release 4.0; J. Janesick, *Photon Transfer*, 2007. Against the mean μ above
black, the variance of noise is the line ``read noise² / g² + μ / g``, and the variance of the
pattern is ``DSNU² / g² + PRNU² μ²``, with the conversion gain g in electrons per DN. A response
μ = (λ / g) (1 − b μ / μ_full) that bends by the share b bends the line to
``μ / g (1 − 3 b μ / μ_full)``.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from simulations.models.arrays import Floats, Mask
from simulations.models.require import require
from simulations.models.sensor.photon_transfer import (
    LARGEST_ERROR,
    LEAST_VARIANCE_DN2,
    SATURATED_SHARE,
)
from simulations.models.sensor.photon_transfer_pair import Level

FEWEST_LEVELS = 3
MOST_CLIPPED = 0.001
"""Share of the pixels at an end of the scale, above which part of the noise is cut off."""
MOST_CORRELATED, MOST_SMOOTHED = 0.01, 0.06
"""Correlation of neighbours, above chance: the gain would be some 4 % too large. The latter in raw
files, where the noise that was smoothed away is added again."""
UNSURE = 0.15
"""Standard error of that, as a share: smoothing may reach farther than to the next cells."""
MOST_OFF_LINE = 0.1
"""Largest residual of a variance, as a share of the line."""
SATURATED_NOISE = 0.1
"""Share of shot noise that is left where the well or the converter is full."""
NOT_DARK = (
    "No whole pair is dark, and a file’s own black level may be some codes off: take a pair with "
    "the lens cap on."
)
CLIPPED_DARK = (
    "The darkest pair is clipped at black, and half of its noise is missing: the camera, or its "
    "raw converter, cuts off what lies below."
)
UNSATURATED = "No pair is saturated: take a brighter one."
LARGEST_PATTERN = 0.05
"""Share of the light. No sensor's cells differ more: it is the surface."""
MOST_OFF_BLACK, MOST_OFF_BLACK_DN = 5e-4, 4.0
"""Share of the scale, or so many DN, within which a pair next to a file's black has no light."""
FALLEN = 0.5
"""Share of the largest variance of noise below which that of a brighter, saturated pair lies."""
LOSSY = 1.5
"""Growth of the step between codes, above which a file is lossy."""
BEND = 0.03
"""Standard deviation of b among cameras, before any pair is taken."""
SURE = 2.0
"""Standard errors by which a variance must exceed 0 to be told."""


@dataclass(frozen=True, slots=True)
class Estimate:
    """A number with its standard error, or why it cannot be told."""

    value: float
    error: float = math.nan
    reason: str = ""
    """A sentence for the reader; empty if the number can be told."""
    bound: Literal["", "below", "above"] = ""
    """On which side of ``value`` the number lies, if that is all that can be told."""

    @classmethod
    def unknown(cls, reason: str) -> "Estimate":
        """A number that cannot be told."""
        return cls(math.nan, math.nan, reason)


@dataclass(frozen=True, slots=True)
class Line:
    """y = start + slope · x + curvature · x²."""

    start: float
    slope: float
    covariance: Floats
    """(2, 2), or (3, 3) with that of the curvature."""
    curvature: float = 0.0
    """Coefficient of x²."""

    def at(self, x: Floats) -> Floats:
        """Values (...) at places (...)."""
        return self.start + self.slope * x + self.curvature * x**2


@dataclass(frozen=True, slots=True, kw_only=True)
class SensorEstimate:
    """What the levels say about the sensor."""

    gain: Estimate
    """Electrons per DN."""
    read_noise: Estimate
    """Electrons; with the noise of dark current."""
    saturation: Estimate
    """Electrons at which the well or the converter is full."""
    prnu: Estimate
    """Share of the light by which the cells' responses differ."""
    dsnu: Estimate
    """Electrons by which the cells differ without light."""
    fitted: Mask
    """(N,) the levels used for the line."""
    noise: Line | None
    """Variance in DN² against the mean above black in DN."""
    pattern: Line | None
    """Variance shared by both frames, against the square of that mean."""
    row_noise: Estimate
    """Electrons; that part of the read noise which whole rows share."""
    bend: Estimate
    """Share by which the response at saturation falls short of that in dim light."""


def black_of_dark(levels: Sequence[Level], stated_dn: float, highest_dn: float) -> float:
    """Code without light: mean of the darkest pair if it has none, and otherwise NaN.

    ``stated_dn`` is that of the file. It may be some DN off, which would change the read noise; a
    pair so near to it is taken for dark.
    """
    darkest = min(levels, key=lambda level: level.mean_dn, default=None)
    if darkest is None or _is_clipped_dark(darkest):
        return math.nan
    near = max(MOST_OFF_BLACK * (highest_dn - stated_dn), MOST_OFF_BLACK_DN)
    return darkest.mean_dn if abs(darkest.mean_dn - stated_dn) <= near else math.nan


def saturation_above(levels: Sequence[Level], black_dn: float, highest_dn: float) -> float:
    """DN above black at which the sensor is full: where the light of a pair grows and its noise has
    fallen, and otherwise the end of the scale."""
    noisiest = max(levels, key=lambda level: level.noise_dn2, default=None)
    brightest = max(levels, key=lambda level: level.mean_dn, default=None)
    if noisiest and brightest and brightest.noise_dn2 < FALLEN * noisiest.noise_dn2:
        return max(min(brightest.mean_dn, highest_dn) - black_dn, 1e-9)
    return highest_dn - black_dn


def characterise(
    levels: Sequence[Level],
    black_dn: float,
    highest_dn: float,
    most: float = SATURATED_SHARE,
    *,
    dark: bool = True,
    bend: float = 0.0,
    single: tuple[float, float] | None = None,
) -> SensorEstimate:
    """The sensor of the levels, whose code without light is ``black_dn``.

    If that is only stated (``dark`` false), not measured, there is no read noise: a DN changes it.
    ``bend`` is the standard deviation of b: 0 for a sensor whose response is known to be straight,
    and otherwise `BEND`, which makes the gain less certain. With ``single``, what `single_cells`
    found, variances are those of single cells again.

    Lines are fitted to the levels up to the share ``most`` of saturation, to the nearest per cent.
    Errors are those of random noise, enlarged where levels scatter more about the line. From twelve
    even levels of 256 × 256 pixels of a straight sensor the gain follows to about 0.2 %.
    """
    require("most", most, 0 < most <= 1, "above 0, to 1")
    require("black_dn", black_dn, 0 <= black_dn < highest_dn, f"0 to below {highest_dn:g}")
    mean = np.array([level.mean_dn for level in levels]) - black_dn
    fitted = np.array([_has_all_noise(level) for level in levels], bool)
    full = saturation_above(levels, black_dn, highest_dn)
    within = mean <= (most + 0.005) * full
    fitted &= within
    chosen = [level for level, use in zip(levels, fitted, strict=True) if use]
    if len(chosen) < FEWEST_LEVELS or np.ptp(mean[fitted]) == 0:
        return _silent(_too_few(levels, fitted, within), fitted)
    share, share_error = single or (1.0, 0.0)
    noise = _times(_noise_line(mean[fitted], chosen, 3 * bend / full), share, share_error)
    bent = _bend(noise, full)
    straightened = mean[fitted] * (1 - bent.value * mean[fitted] / full)
    pattern = _times(_pattern_line(straightened, chosen), share, share_error)
    most_alike = MOST_SMOOTHED if single else MOST_CORRELATED
    reason = _why_no_gain(mean[fitted], chosen, noise, share, most_alike)
    if reason:
        return _silent(reason, fitted, noise, pattern)
    gain = Estimate(1 / noise.slope, math.sqrt(noise.covariance[1, 1]) / noise.slope**2)
    return SensorEstimate(
        gain=gain,
        read_noise=_read_noise(noise, share) if dark else Estimate.unknown(_why_not_dark(levels)),
        saturation=_saturation(mean, levels, noise, share),
        prnu=_prnu(pattern, chosen[0].pixels, 0.5 * most * bent.error),
        dsnu=_dsnu(pattern, gain.value, chosen[0].pixels),
        fitted=fitted,
        noise=noise,
        pattern=pattern,
        row_noise=_row_noise(chosen, gain.value),
        bend=bent,
    )


def single_cells(levels: Sequence[Level]) -> tuple[float, float]:
    """Variance of the noise of single cells by that of raw files that some cameras smooth, and its
    standard error: a mean over neighbours leaves the sum of all covariances as it was.

    ``levels`` are those of all planes.
    """
    whole = [level for level in levels if _has_all_noise(level)]
    if not whole:
        return 1.0, 0.0
    near = float(np.mean([level.neighbours for level in whole]))
    far = float(np.mean([level.farther for level in whole]))
    chance = 4 / math.sqrt(sum(level.pixels for level in whole))  # of four lags, twice
    beyond = max(abs(far) - math.sqrt(2) * chance, 0.0)  # of eight lags
    return 1 + near, math.hypot(chance, UNSURE * near, beyond)


def _has_all_noise(level: Level) -> bool:
    """Whether all of the noise is in the codes."""
    return level.clipped <= MOST_CLIPPED and level.noise_in_codes >= LEAST_VARIANCE_DN2


def refused(sensor: SensorEstimate, reason: str) -> SensorEstimate:
    """The same lines, without numbers."""
    return _silent(reason, sensor.fitted, sensor.noise, sensor.pattern)


def _silent(
    reason: str, fitted: Mask, noise: Line | None = None, pattern: Line | None = None
) -> SensorEstimate:
    unknown = Estimate.unknown(reason)
    numbers = ("gain", "read_noise", "saturation", "prnu", "dsnu", "row_noise", "bend")
    return SensorEstimate(
        **dict.fromkeys(numbers, unknown), fitted=fitted, noise=noise, pattern=pattern
    )


def _too_few(levels: Sequence[Level], fitted: Mask, within: Mask) -> str:
    used = int(np.count_nonzero(fitted))
    clipped = sum(level.clipped > MOST_CLIPPED for level in levels)
    steady = sum(level.noise_in_codes < LEAST_VARIANCE_DN2 for level in levels)
    beyond = int(np.count_nonzero(~within))
    count = f"{used} of {len(levels)} pairs can be used, and a line needs three exposures"
    if not levels:
        return "There is no pair: take two pictures at each of three exposures or more."
    if beyond > max(steady, clipped):
        return f"{count}: {beyond} lie beyond the end of the fit."
    if clipped >= max(steady, 1):
        return f"{count}: {clipped} are clipped at black or white, so expose between."
    if steady:
        return f"{count}: in {steady} the noise is less than a code, so raise the ISO."
    return f"{count}: take two pictures at each of more exposures."


def _noise_line(mean: Floats, levels: Sequence[Level], bend: float) -> Line:
    noise = np.array([level.noise_dn2 for level in levels])
    relative = np.array([level.noise_error_dn2 / max(level.noise_dn2, 1e-300) for level in levels])
    # Errors in proportion to the line, as those in proportion to the measured variances would give
    # the smaller ones more weight.
    return _settled(mean, noise, lambda expected: relative * expected, bend)


def _pattern_line(mean: Floats, levels: Sequence[Level]) -> Line:
    pattern = np.array([level.pattern_dn2 for level in levels])
    error = np.array([level.pattern_error_dn2 for level in levels])
    return _settled(mean**2, pattern, lambda _expected: error)


def _settled(x: Floats, y: Floats, error_of: Callable[[Floats], Floats], bend: float = 0.0) -> Line:
    """Weighted fit, whose errors may depend on it."""
    smallest = max(0.5 * float(y.min()), 1e-6 * float(np.abs(y).max()), 1e-300)
    line = _fit(x, y, error_of(np.maximum(y, smallest)))
    for _ in range(3):
        line = _fit(x, y, error_of(np.maximum(line.at(x), smallest)), bend * abs(line.slope))
    return line


def _fit(x: Floats, y: Floats, error: Floats, curvature: float = 0.0) -> Line:
    """Covariances are enlarged by the reduced χ² where that is above 1 (Birge's ratio).

    ``curvature`` is the standard deviation of that of the line, which is straight if it is 0.
    """
    scale, terms = float(x.max()) or 1.0, 3 if curvature else 2
    rows = (x[:, None] / scale) ** np.arange(terms) / error[:, None]
    known = np.zeros((terms, terms))
    if curvature:
        known[2, 2] = (curvature * scale**2) ** -2
    inverse = np.linalg.inv(rows.T @ rows + known)
    found = inverse @ rows.T @ (y / error)
    spare = len(x) - float(np.trace(inverse @ rows.T @ rows))  # what is known counts for a part
    scatter = np.sum((y / error - rows @ found) ** 2) / max(spare, 1.0)
    to_units = scale ** -np.arange(0.0, terms)
    covariance = inverse * np.outer(to_units, to_units) * max(1.0, float(scatter))
    start, slope, curve = np.append(found * to_units, 0.0)[:3].tolist()
    return Line(start, slope, covariance, curve)


def _times(line: Line, share: float, error: float) -> Line:
    """A line of variances times a share that has a standard error."""
    found = np.array([line.start, line.slope, line.curvature])[: len(line.covariance)]
    covariance = share**2 * line.covariance + error**2 * np.outer(found, found)
    return Line(share * line.start, share * line.slope, covariance, share * line.curvature)


def _why_no_gain(
    mean: Floats, levels: Sequence[Level], line: Line, share: float, most_alike: float
) -> str:
    """What speaks against the line as that of a sensor; empty if nothing does. Its variances are
    those of the levels times a share."""
    correlation = float(np.mean([level.correlation for level in levels]))
    chance = 4 / math.sqrt(2 * sum(level.pixels for level in levels))
    if abs(correlation) > most_alike + chance:
        return (
            f"Neighbouring pixels share {100 * correlation:.0f} % of their noise: the file was "
            "interpolated, smoothed or sharpened. Only a raw file has the noise of the cells."
        )
    if not line.slope > 0:
        return "The noise does not rise with the light: the file was smoothed, or is saturated."
    noise = share * np.array([level.noise_dn2 for level in levels])
    expected = line.at(mean)
    off = float(np.max(np.abs(noise - expected) / np.maximum(expected, line.slope)))
    if off > MOST_OFF_LINE:
        return (
            f"The variances lie up to {100 * off:.0f} % off a line: the brightest pairs are "
            "saturated, or the file has another tone curve."
        )
    share = math.sqrt(line.covariance[1, 1]) / line.slope
    if share > LARGEST_ERROR:
        return f"The exposures are too alike: they tell the gain to {100 * share:.0f} % only."
    return ""


def _why_not_dark(levels: Sequence[Level]) -> str:
    darkest = min(levels, key=lambda level: level.mean_dn)
    return CLIPPED_DARK if _is_clipped_dark(darkest) else NOT_DARK


def _is_clipped_dark(level: Level) -> bool:
    """Also where the noise is less than a code, of which nothing lies below the most frequent."""
    return level.clipped > MOST_CLIPPED or level.lowest > 0.5


def _read_noise(line: Line, share: float) -> Estimate:
    """Rounding may have undone the smoothing in the dark, so its error has all that was added."""
    start, slope = line.start, line.slope
    error = math.sqrt(line.covariance[0, 0])
    if start < SURE * error:
        most = math.sqrt(max(start, 0.0) + SURE * error) / slope
        reason = (
            "The noise in the dark is too small, or no pair is dark: take one with the lens cap on."
        )
        return Estimate(most, math.nan, reason, "below")
    root = math.sqrt(start)
    by = np.array([0.5 / (root * slope), -root / slope**2])
    error = math.sqrt(by @ line.covariance[:2, :2] @ by)
    return Estimate(root / slope, math.hypot(error, 0.5 * (share - 1) * root / slope))


def _row_noise(levels: Sequence[Level], gain: float) -> Estimate:
    """Root of the weighted mean of the rows' variances."""
    weight = np.array([1 / max(level.row_error_dn2, 1e-9) ** 2 for level in levels])
    shared = float(np.average([level.row_dn2 for level in levels], weights=weight))
    error = 1 / math.sqrt(float(weight.sum()))
    most = gain * math.sqrt(max(shared, 0.0) + SURE * error)
    if shared < SURE * error:
        return Estimate(most, math.nan, "Rows share no more noise than by chance.", "below")
    root = gain * math.sqrt(shared)
    return Estimate(root, 0.5 * root * error / shared)


def _bend(line: Line, full: float) -> Estimate:
    """b = −curvature · μ_full / (3 slope)."""
    if len(line.covariance) < 3:
        return Estimate(0.0, 0.0)
    share = full / (3 * abs(line.slope) or 1.0)
    return Estimate(-share * line.curvature, share * math.sqrt(line.covariance[2, 2]))


def _saturation(mean: Floats, levels: Sequence[Level], line: Line, share: float) -> Estimate:
    noise = share * np.array([level.noise_dn2 for level in levels])
    full = noise < line.start + SATURATED_NOISE * line.slope * mean
    full &= mean > 0
    full &= mean == mean.max()
    most = electrons(line, float(mean.max()))
    if not full.any():
        return replace(most, error=math.nan, reason=UNSATURATED, bound="above")
    return most


def electrons(line: Line, mean_dn: float) -> Estimate:
    """Electrons that give a mean, μ (g + b g μ / μ_full), by the line of the noise."""
    share = line.curvature * mean_dn / (3 * line.slope)
    value = mean_dn / line.slope
    by = value / line.slope * np.array([0.0, 2 * share - 1, -mean_dn / 3])[: len(line.covariance)]
    return Estimate(value * (1 - share), math.sqrt(by @ line.covariance @ by))


def _prnu(line: Line, pixels: int, share: float) -> Estimate:
    """Its error has a share of it that is due to the bend of the response."""
    found = _root_of(line.slope, math.sqrt(line.covariance[1, 1]), pixels)
    found = replace(found, error=math.hypot(found.error, share * found.value))
    if found.value > LARGEST_PATTERN and not found.reason:
        return Estimate.unknown(
            f"The frames share a pattern of {100 * found.value:.0f} % of the light: that is the "
            "surface, so defocus, and move the camera away from it."
        )
    return found


def _dsnu(line: Line, gain: float, pixels: int) -> Estimate:
    found = _root_of(line.start, math.sqrt(line.covariance[0, 0]), pixels)
    return replace(found, value=gain * found.value, error=gain * found.error)


def _root_of(variance: float, error: float, pixels: int) -> Estimate:
    """A standard deviation among so many cells."""
    if variance < SURE * error:
        most = math.sqrt(max(variance, 0.0) + SURE * error)
        return Estimate(most, math.nan, "The noise of two frames hides the pattern.", "below")
    root = math.sqrt(variance)
    return Estimate(root, math.hypot(0.5 * error / root, root / math.sqrt(2 * pixels)))
