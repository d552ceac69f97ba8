"""What a tier costs for each pixel or point, of a frame, and for the noise that it leaves."""

from site_builder.measured.measurements import MeasuredLadder, MeasuredTier

FRAME_MS = 1000 / 30
"""Time between two frames, at the rate at which a drag still looks smooth."""

ROUNDING = 1e-12
"""Errors below it are of rounding, and no noise of a sample."""


def nanoseconds_each(measured: MeasuredLadder, item: MeasuredTier, side: str) -> float:
    """Time for one item of the workload. Raises `ZeroDivisionError` where these are not counted."""
    return item.times[side].ms * 1e6 / measured.ladder.items


def frame_percent(item: MeasuredTier, side: str) -> float:
    """Share of a frame that the whole workload takes, in per cent."""
    return 100 * item.times[side].ms / FRAME_MS


def efficiency(measured: MeasuredLadder, item: MeasuredTier, side: str) -> float | None:
    """1/(variance × time) in units of the ladder's first tier: how much less time a tier takes for
    the noise of the other, since a sample's variance falls with the work (Pharr, Jakob and
    Humphreys, *Physically Based Rendering*, 4th ed., 2.2). None where there is no noise."""
    first = measured.tiers[0]
    variances = [_variance(measured, each) for each in (first, item)]
    if not measured.ladder.sampled or not all(variances):
        return None
    return (variances[0] * first.times[side].ms) / (variances[1] * item.times[side].ms)


def _variance(measured: MeasuredLadder, item: MeasuredTier) -> float:
    metric = measured.ladder.metrics[0]
    error = item.errors[metric.id]
    if error is None or (metric.unit != "dB" and error < ROUNDING):
        return 0.0
    return float(10 ** (-error / 10) if metric.unit == "dB" else error**2)
