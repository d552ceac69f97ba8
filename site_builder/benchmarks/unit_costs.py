"""What a tier costs for each pixel or point, of a frame, and for the noise that it leaves."""

from site_builder.benchmarks.measurements import MeasuredLadder, MeasuredTier

FRAME_MS = 1000 / 30
"""Time between two frames, at the rate at which a drag still looks smooth."""


def nanoseconds_each(measured: MeasuredLadder, item: MeasuredTier, side: str) -> float:
    """Time for one item of the workload. Raises `ZeroDivisionError` where these are not counted."""
    return item.times[side].ms * 1e6 / measured.ladder.items


def frame_percent(item: MeasuredTier, side: str) -> float:
    """Share of a frame that the whole workload takes, in per cent."""
    return 100 * item.times[side].ms / FRAME_MS


def efficiency(measured: MeasuredLadder, item: MeasuredTier, side: str) -> float | None:
    """1/(variance × time) in units of the ladder's first sampled tier: how much less time a tier
    takes for the same noise, since a sample's variance falls with the work (Pharr, Jakob and
    Humphreys, *Physically Based Rendering*, 4th ed., 2.2). None where a tier is not sampled."""
    if item.tier.id not in measured.ladder.sampled:
        return None
    unit = measured[measured.ladder.sampled[0]]
    return _cost_of_noise(measured, unit, side) / _cost_of_noise(measured, item, side)


def _cost_of_noise(measured: MeasuredLadder, item: MeasuredTier, side: str) -> float:
    metric = measured.ladder.metrics[0]
    error = item.errors[metric.id] or 0.0
    variance = 10 ** (-error / 10) if metric.unit == "dB" else error**2
    return float(variance * item.times[side].ms)
