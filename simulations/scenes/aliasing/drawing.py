"""Twenty pixels of one row with the wave, the filtered wave, the samples and the alias; and the
axis of frequencies, folded at Nyquist."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.drawing import (
    arrow,
    cased,
    circle,
    dot,
    line,
    polygon,
    polyline,
    rectangle,
    text,
)
from simulations.engine.frame import format_number
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats
from simulations.models.sampling.prefilters import Prefilter, prefilter, transfer
from simulations.scenes.aliasing.light import (
    FINE,
    FIRST,
    NYQUIST,
    PHOTOGRAPH_PX,
    SHOWN,
    SPECTRUM_TO,
    Pattern,
    SampledPhotograph,
    sample_count,
)

WIDTH, HEIGHT = 400.0, 300.0
ROW = Plot(Axis(0.0, SHOWN - 1.0, 22.0, 386.0), Axis(-1.15, 1.15, 248.0, 68.0))
PIXELS = Scale(
    "pixels from the left of the frame",
    ticks=[(n, "" if n % 5 else str(n)) for n in range(SHOWN)],
    style="muted small",
    tick_style="muted small",
)
POINTS = 24  # of a curve per pixel

SPECTRUM = Plot(Axis(0.0, SPECTRUM_TO, 40.0, 386.0), Axis(0.0, 1.0, 244.0, 116.0))
# The ticks are clear of the handle of the fold.
FREQUENCIES = Scale("frequency", "cycles per pixel", ticks=(0, 0.25, 0.5, 0.75, 1), gap=9.0)
AMPLITUDES = Scale(ticks=(0, 1), grid=(1,))
LABELS = 92.0  # row of the numbers above the lines
APART = 56.0  # least distance between the centres of two labels
ARC_TOP = 50.0  # row of the arrow from the true to the apparent frequency
HEAD = 7.0


def sample_frame(pattern: Pattern) -> str:
    """The frame around the shown samples, over the picture."""
    unit = WIDTH / pattern.width
    # The middle of an even count of rows is between two of them: the upper one is marked.
    row = (pattern.height - 1) // 2
    return framed(pattern.start * unit, row * unit, sample_count(pattern.rate) * unit, unit)


def pixel_frame(photograph: SampledPhotograph, rate: float) -> str:
    """The frame around the pixels of the reader's picture that are shown."""
    unit = WIDTH / photograph.linear.shape[1]
    return framed(FIRST * rate * unit, photograph.row * unit, SHOWN * rate * unit, unit)


def framed(left: float, top: float, width: float, height: float) -> str:
    corner, size = (left + 1.0, top - 2.0), (width - 2.0, height + 4.0)
    return cased(rectangle, corner, *size, style="ray")


def ring(pattern: Pattern) -> tuple[float, float] | None:
    """The leftmost point of the zone plate's ring at the Nyquist frequency, if there is one."""
    # Half a cycle per sample is at a quarter of the width, over the frequency, from the middle.
    radius = WIDTH / 4 / pattern.frequency if pattern.frequency else math.inf
    return (WIDTH / 2 - radius, HEIGHT / 2) if radius <= WIDTH / 2 else None


def nyquist_ring(pattern: Pattern) -> str:
    place = ring(pattern)
    if place is None:
        return ""
    middle, radius = (WIDTH / 2, HEIGHT / 2), WIDTH / 2 - place[0]
    circles = (circle(middle, radius, f"{style} dashed") for style in ("casing", "camera"))
    label = text((place[0] + 12, place[1] + 4), "Nyquist", "camera ground small")
    return "".join((*circles, dot(place, "camera", 5), label))


def row_of(pattern: Pattern, kernel: Prefilter) -> str:
    """The second panel."""
    x, at = fine_places(pattern.rate), pattern.first + pattern.start
    samples = np.arange(sample_count(pattern.rate))
    filtered = kernel.weights.size > 1
    behind = pattern.wave(kernel, at + x) if filtered else None
    alias, knob = alias_curve(pattern, kernel, at), crest(pattern)
    return "".join(
        (
            *curves(x / pattern.rate, pattern.wave(prefilter("none"), at + x), behind, alias),
            *dots(samples / pattern.rate, pattern.wave(kernel, at + samples)),
            dot(knob, "world", 5) if knob else "",
            row_legend(filtered, alias is not None),
        )
    )


def photograph_row(photograph: SampledPhotograph, filtered: bool) -> str:
    """The second panel for the reader's picture."""
    x = np.linspace(0, SHOWN - 1, photograph.curve.size)
    behind = 2 * photograph.filtered - 1 if filtered else None
    parts = [
        *curves(x, 2 * photograph.curve - 1, behind, None),
        *dots(photograph.places, 2 * photograph.samples - 1),
    ]
    return "".join((*parts, row_legend(filtered, aliased=False, name="light")))


def crest(pattern: Pattern) -> tuple[float, float] | None:
    """The second crest of the stripes, if it is on the panel."""
    if pattern.kind != "stripes" or pattern.frequency == 0.0:
        return None
    pixels = crest_turns(pattern.phase_rad) / (pattern.frequency * pattern.rate)
    return ROW.at(pixels, 1.0) if pixels <= SHOWN - 1 else None


def crest_turns(phase_rad: float) -> float:
    """Cycles of that crest from the left of the panel."""
    return 1.25 - phase_rad / (2 * math.pi)


def fine_places(rate: float) -> Floats:
    """Places of the curves, in samples."""
    return np.linspace(0, SHOWN - 1, POINTS * (SHOWN - 1) + 1) * rate


def curves(x: Floats, wave: Floats, filtered: Floats | None, alias: Floats | None) -> Iterator[str]:
    """``x`` in pixels."""
    yield ROW.level(0.0, "muted thin")
    yield ROW.x_axis(PIXELS)
    yield ROW.curve(x, wave, "world thin" if filtered is None else "world thin faint")
    if filtered is not None:
        yield ROW.curve(x, filtered, "light thin")
    if alias is not None:
        yield ROW.curve(x, alias, "error dashed")


def dots(x: Floats, samples: Floats) -> Iterator[str]:
    for place, value in zip(x.tolist(), samples.tolist(), strict=True):
        yield dot(ROW.at(place, value), "image", 4.0)


def alias_curve(pattern: Pattern, kernel: Prefilter, at: float) -> Floats | None:
    """The slowest wave through the samples, at the places of the curves; None if it is the true
    wave.

    Between two samples the nearest whole frequency k is subtracted. At a sample the phase 2π k (x −
    x_sample) is a whole number of turns, so that the pieces meet there.
    """
    x = fine_places(pattern.rate)
    between = np.minimum(np.floor(x + 1e-9), math.ceil(x[-1] - 1e-9) - 1)
    whole = np.rint(pattern.local_frequency(at + between + 0.5))
    if not whole.any():
        return None
    # exp(-2πi k x) moves the filtered wave's spectrum: exact for pure waves, and accurate enough
    # for the slow chirp of the zone plate.
    local = pattern.local_frequency(at + x) if pattern.chirp else pattern.base
    phase = pattern.phase_rad + math.pi * (at + x) * (2 * pattern.base + pattern.chirp * (at + x))
    return transfer(kernel, local) * np.sin(phase - 2 * math.pi * whole * x)


def row_legend(filtered: bool, aliased: bool, name: str = "wave") -> str:
    """The legend in one line; the places of curves that are not drawn stay empty."""
    entries = (
        Entry(name, "world"),
        Entry("samples", "image", "dot"),
        Entry("alias", "error dashed", visible=aliased),
        Entry(f"filtered {name}", "light", visible=filtered),
    )
    return legend((ROW.x.start, 22.0), entries, room=ROW.x.end - ROW.x.start)


def spectrum(
    pattern: Pattern, kernel: Prefilter, remaining: float, photograph: SampledPhotograph | None
) -> str:
    """The third panel; ``remaining`` is the amplitude in the samples."""
    rate, frequency = pattern.rate, pattern.frequency * pattern.rate
    x, foot = SPECTRUM.at(NYQUIST * rate, 0.0)
    at = np.linspace(0.0, SPECTRUM_TO, 121)
    behind = detail(photograph) if photograph else ""
    if pattern.kind == "zone_plate" and not photograph:  # it has every frequency up to its edge's
        behind = line(SPECTRUM.at(0.0, 0.0), SPECTRUM.at(frequency, 0.0), "world bold")
    return "".join(
        (
            SPECTRUM.region(x=(NYQUIST * rate, SPECTRUM_TO)),
            SPECTRUM.frame(FREQUENCIES, AMPLITUDES),
            line((x, foot), (x, LABELS - 20), "camera dashed"),
            dot((x, foot), "camera", 5),
            text((x, LABELS - 26), "Nyquist", "camera ground", "middle"),
            behind,
            SPECTRUM.curve(at, np.abs(transfer(kernel, at / rate)), "light"),
            *waves(pattern, abs(float(transfer(kernel, pattern.frequency))), remaining),
        )
    )


def detail(photograph: SampledPhotograph) -> str:
    """The spectrum of the reader's picture."""
    frequencies = (np.arange(photograph.detail.size) * FINE / PHOTOGRAPH_PX[0]).tolist()
    shape = [
        SPECTRUM.at(f, a) for f, a in zip(frequencies, photograph.detail.tolist(), strict=True)
    ]
    ends = SPECTRUM.at(frequencies[-1], 0), SPECTRUM.at(0, 0)
    words = text((12, SPECTRUM.y.start + 41), "your picture, by octaves", "world small")
    return polygon([*shape, *ends], "world fill thin") + words


def waves(pattern: Pattern, passed: float, remaining: float) -> Iterator[str]:
    """The wave before the filter, after it, and in the samples."""
    frequency, alias = pattern.frequency * pattern.rate, pattern.alias * pattern.rate
    folded = pattern.frequency > NYQUIST
    foot, end = SPECTRUM.at(frequency, 0), SPECTRUM.at(frequency, 1.0)
    yield line(foot, end, "world dashed")
    yield dot(end, "world", 5)
    yield line(foot, SPECTRUM.at(frequency, passed), "world bold")
    yield dot(SPECTRUM.at(frequency, passed), "world", 4.5)
    if folded:
        yield line(SPECTRUM.at(alias, 0), SPECTRUM.at(alias, remaining), "error bold")
        yield dot(SPECTRUM.at(alias, remaining), "error", 4.5)
        yield from fold(frequency, alias)
    elif not math.isclose(remaining, passed):
        yield dot(SPECTRUM.at(frequency, remaining), "image", 5.5)
    yield from labels(frequency, alias, folded)


def fold(frequency: float, alias: float) -> Iterator[str]:
    """The path from the true to the apparent frequency, through the fold at 1 if there is one."""
    start, end = SPECTRUM.x.place(frequency), SPECTRUM.x.place(alias)
    span = start - end
    rise = min(30.0, 0.35 * span)
    arc = [
        (start - span * step / 24, ARC_TOP - rise * math.sin(math.pi * step / 24))
        for step in range(24)
    ]
    far = [point for point in arc if math.dist(point, (end, ARC_TOP)) > HEAD]
    yield polyline(arc[: len(far) + 1], "error thin")
    if far:
        yield arrow(far[-1], (end, ARC_TOP), "error thin", head=HEAD)


def labels(frequency: float, alias: float, folded: bool) -> Iterator[str]:
    """The frequencies above the lines, without overlap."""
    x, seen = SPECTRUM.x.place(frequency), SPECTRUM.x.place(alias)
    push = max(0.0, 0.5 * (APART - (x - seen))) if folded else 0.0
    place = (min(max(x + push, SPECTRUM.x.start + 24), SPECTRUM.x.end - 22), LABELS)
    yield text(place, f"f = {format_number(frequency)}", "world ground strong", "middle")
    if folded:
        place = (max(seen - push, SPECTRUM.x.start + 16), LABELS)
        yield text(place, format_number(alias), "error ground strong", "middle")
