"""What Resolution Is: a point, waves and a star, through lens, plate and pixels."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.drawing import cased, circle, dot, line, path, rectangle, text
from simulations.engine.frame import Frame, Panel, format_number, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.letters import width_of
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.lens.diffraction import lens_transfer
from simulations.scenes.resolution.links import (
    CLOSE_UM,
    STAGES,
    Lens,
    Settings,
    columns,
    links,
    mtf50,
    radius_um,
)

NOTHING = 0.005  # contrast below which the eye sees nothing
SIZE = WIDTH, HEIGHT = 400.0, 300.0
MIDDLE = (WIDTH / 2, HEIGHT / 2)
ROOM_FOR_NAME = 32.0  # radius from which on a circle of the star holds its name, in units
PER_UM = WIDTH / CLOSE_UM[0]  # units of the picture of the spot

HIGHEST = 500.0  # cycles/mm
PLOT = Plot(Axis(0.0, HIGHEST, 34.0, 388.0), Axis(0.0, 1.0, 214.0, 40.0))  # and contrast
ACROSS = Scale("frequency", "cycles per mm", (0, 250, 500), style="small", tick_style="muted small")
UP = Scale(ticks=(0, 0.5, 1), grid=(0.5, 1), tick_style="muted small")
LIMITS = 28.0  # row of the names of the limits
FREQUENCIES = np.linspace(0.0, HIGHEST, 501)


def star_scale(settings: Settings) -> float:
    """Units per micrometre, for which whole pixels fill the panel."""
    return WIDTH / (columns(settings.pitch) * settings.pitch)


def nyquist_at(settings: Settings, _outputs: object = None) -> Point:
    """The place on the left of the star's middle with the Nyquist frequency."""
    return MIDDLE[0] - star_scale(settings) * radius_um(settings.nyquist), MIDDLE[1]


def cutoff_at(settings: Settings, _outputs: object = None) -> Point:
    """The place on the right of the star's middle with the frequency of the cut-off."""
    return MIDDLE[0] + star_scale(settings) * radius_um(settings.cutoff), MIDDLE[1]


def spot_at(settings: Settings, _outputs: object = None) -> Point:
    """The right of the first dark ring."""
    return MIDDLE[0] + PER_UM * settings.spot_um / 2.0, MIDDLE[1]


def wave_at(settings: Settings, outputs: Outputs) -> Point:
    """The marked frequency on the curve of all links."""
    left = links(settings, outputs["lens"], settings.frequency).together
    return PLOT.at(settings.frequency, abs(float(left)))


def star_overlay(settings: Settings) -> str:
    """Circles in the star of Nyquist's frequency and of the cut-off, and their handles. The name
    of the inner one is inside it, or else below both."""
    per_um = star_scale(settings)
    rings = [
        (per_um * radius_um(settings.nyquist), "Nyquist", "camera"),
        (per_um * radius_um(settings.cutoff), "cut-off", "ray"),
    ]
    parts = []
    for radius, _, role in rings:
        parts.append(cased(circle, MIDDLE, radius, style=f"{role} dashed"))
    (inner, *inside), (outer, *around) = sorted(rings)
    below = MIDDLE[1] + (5 if inner > ROOM_FOR_NAME else outer + 16)
    for row, (name, role) in ((below, inside), (MIDDLE[1] - outer - 7, around)):
        if 12.0 < row < HEIGHT - 4:
            aside = 5 if name == "Nyquist" else -5  # away from its handle
            parts.append(text((MIDDLE[0] + aside, row), name, f"{role} small ground", "middle"))
    parts += [dot(nyquist_at(settings), "camera", 5), dot(cutoff_at(settings), "ray", 5)]
    return "".join((*parts, *length_scale(100 * per_um, "0.1 mm")))


def spot_overlay(settings: Settings) -> str:
    """The grid of pixels, the middle one, and the first dark ring."""
    step, radius = PER_UM * settings.pitch, PER_UM * settings.spot_um / 2.0
    grid = []
    for middle, upright in zip(MIDDLE, (True, False), strict=True):
        count = math.floor(middle / step - 0.5)
        for at in (middle + step * (np.arange(-count - 1, count + 1) + 0.5)).tolist():
            if 0 <= at <= 2 * middle:
                grid.append([(at, 0), (at, HEIGHT)] if upright else [(0, at), (WIDTH, at)])
    corner = (MIDDLE[0] - step / 2, MIDDLE[1] - step / 2)
    return "".join(
        (
            path(grid, "camera thin faint"),
            cased(rectangle, corner, step, step, style="camera"),
            cased(circle, MIDDLE, radius, style="ray dashed"),
            dot(spot_at(settings), "ray", 5),
            *length_scale(10.0 * PER_UM, "10 µm"),
        )
    )


def length_scale(units: float, label: str) -> Iterator[str]:
    left, row = 12.0, HEIGHT - 12
    yield rectangle((left - 6, row - 27), units + 12, 34, "casing solid")
    yield line((left, row), (left + units, row), "bold")
    yield text((left, row - 10), label, "small")


def curves(settings: Settings, lens: Lens) -> Iterator[str]:
    """The transfer functions of all links, and their product."""
    nyquist, each = settings.nyquist, links(settings, lens, FREQUENCIES)
    together, resolved = np.abs(each.together), nyquist >= FREQUENCIES
    yield PLOT.region(x=(min(nyquist, HIGHEST), HIGHEST))
    yield PLOT.frame(ACROSS, UP)
    if settings.plate:
        yield PLOT.curve(FREQUENCIES, np.abs(each.plate), "muted")
    yield PLOT.curve(FREQUENCIES, np.abs(each.pixel), "camera")
    yield PLOT.curve(FREQUENCIES, np.abs(each.lens), "ray dashed")
    yield PLOT.curve(FREQUENCIES[resolved], together[resolved], "image bold")
    yield PLOT.curve(FREQUENCIES[~resolved], together[~resolved], "error bold")
    yield from limits(settings)
    yield PLOT.upright(settings.frequency, "world thin")
    x, late = PLOT.x.place(settings.frequency), settings.frequency > 0.9 * HIGHEST
    name = (x - 6 if late else x + 6, PLOT.y.start - 7)
    yield text(name, "f", "world small ground", "end" if late else "start")
    yield dot(wave_at(settings, {"lens": lens}), "world", 5)
    entries = [
        Entry("lens", "ray dashed"),
        Entry("pixel", "camera"),
        Entry("together", "image bold"),
        Entry("false", "error bold"),
        Entry("plate", "muted", visible=settings.plate),
    ]
    yield legend((PLOT.x.start, 282), entries, "small", PLOT.x.end - PLOT.x.start)


def limits(settings: Settings) -> Iterator[str]:
    """The Nyquist frequency and the cut-off: the lower one is named left of its line, the other
    right of it, or above it where that is at the border."""
    ends = [("Nyquist", settings.nyquist, "camera"), ("cut-off", settings.cutoff, "ray")]
    ends.sort(key=lambda end: end[1])
    for (name, frequency, role), side in zip(ends, ("end", "start"), strict=True):
        if frequency > HIGHEST:
            yield text((PLOT.x.end, 12.0), f"{name} →", f"{role} small", "end")
            continue
        x = PLOT.x.place(frequency)
        yield line((x, PLOT.y.start), (x, LIMITS), f"{role} thin dashed")
        if side == "start" and x + 6 + width_of(name, "small") > WIDTH:
            yield text((PLOT.x.end, 12.0), name, f"{role} small", "end")
        else:
            yield text((x + (6 if side == "start" else -6), LIMITS), name, f"{role} small", side)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The picture of a star, the spot on the pixels, and the transfer functions."""
    lens: Lens = outputs["lens"]
    factors = links(settings, lens, settings.frequency)
    each = factors.lens, factors.pixel, factors.together
    of_lens, of_pixel, together = (abs(float(factor)) for factor in each)
    half = mtf50(settings, lens)
    star, over_star = outputs["picture"], star_overlay(settings)
    close, over_spot = outputs["close"], spot_overlay(settings)
    title, plot = "What is left of a wave’s contrast", "".join(curves(settings, lens))
    unit, subject = "cycles/mm", outputs["subject"]
    return Frame(
        (
            Panel(
                "picture",
                "The picture of a star of 48 rays",
                *SIZE,
                star,
                overlay=over_star,
                pixelated=True,
                lead=True,
            ),
            Panel("subject", "A cat on the same piece of sensor", *SIZE, subject, pixelated=True),
            Panel("spot", "The image of a point, on the pixels", *SIZE, close, over_spot),
            Panel("curves", title, *SIZE, overlay=plot),
        ),
        (
            readout("lens", "Contrast at f: lens", of_lens, role="ray"),
            readout("pixel", "Contrast at f: pixel", of_pixel, role="camera"),
            readout("together", "Contrast at f: together", together, role="image"),
            readout(
                "nyquist", "Nyquist frequency", settings.nyquist, unit, digits=1, role="camera"
            ),
            readout("cutoff", "Cut-off frequency", settings.cutoff, unit, digits=1, role="ray"),
            readout("mtf50", "Half contrast at (MTF50)", half, unit, digits=1, role="image"),
            readout("spot", "Diameter of the spot", settings.spot_um, "µm", role="ray"),
        ),
        describe(settings, float(factors.together)),
    )


def describe(settings: Settings, left: float) -> str:
    """The contrast ``left`` of the marked wave, and the link that limits the picture."""
    wave = f"Of a wave of {format_number(settings.frequency, 0)} cycles per mm "
    if settings.frequency >= settings.cutoff:
        wave += "nothing passes the lens"
    elif abs(left) < NOTHING:
        wave += "hardly anything is left"
    else:
        wave += f"{format_number(100 * abs(left), 0)} % of the contrast is left"
        if left < 0:
            wave += ", with dark and light exchanged"
    if settings.frequency > settings.nyquist and abs(left) >= NOTHING:
        wave += ", and it shows as a false, coarser one"
    grid = (
        "the lens stops all waves that are too fine for the pixels"
        if settings.cutoff <= settings.nyquist
        else "the lens passes waves that are too fine for the pixels, and false patterns appear "
        "around the middle of the star"
    )
    return f"A star of dark and light rays that fade towards its middle. {wave}; {grid}."


SCENE = Scene(
    "resolution",
    "What Resolution Is",
    Settings,
    draw,
    STAGES,
    (
        Handle(
            "nyquist",
            "picture",
            "Circle of Nyquist",
            drives=("pitch",),
            at=nyquist_at,
            role="camera",
            reversed=("pitch",),
        ),
        Handle("cutoff", "picture", "Circle of the cut-off", ("aperture",), cutoff_at, role="ray"),
        Handle("spot", "spot", "Edge of the spot", ("aperture",), spot_at, role="ray"),
        Handle(
            "wave",
            "curves",
            "Frequency of the wave",
            drives=("frequency",),
            at=wave_at,
            reach="press",
            role="world",
        ),
    ),
    formula=lens_transfer,
)
