"""Wagon Wheel: a turning wheel, the film of it, and the motion that the film shows."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.accuracy import Accuracy, tiers
from simulations.engine.controls import Value
from simulations.engine.drawing import arrow, circle, dot, line, path, polyline, text
from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.clipping import clipped
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.sampling.aliasing import apparent_wheel_speed, box_mtf
from simulations.scenes.wagon_wheel.film import FRAMES, STAGES, TIERS, Settings, estimate

STILL = 1e-9  # speed in turns per second below which the filmed wheel stands
SIZE = 400.0, 300.0
CENTRE, RADIUS = (200.0, 150.0), 115.0
HEAD = 9.0
# Distance of the dial of speeds from the rim, its end as an angle from the top, and the largest
# speed.
DIAL, DIAL_END, FASTEST = 18.0, math.radians(80.0), 6.0
BEFORE, AFTER = 6.0, 2.0  # frames of the past and the future that the plot shows
ROWS = 3.0  # spoke spacings on its other axis
PLOT = Plot(Axis(-BEFORE, AFTER, 48.0, 386.0), Axis(0.0, ROWS, 246.0, 44.0))
UNITS_PER_FRAME = (PLOT.x.end - PLOT.x.start) / (BEFORE + AFTER)
LEGEND = (
    Entry("spokes", "world"),
    Entry("frames", "image", "dot"),
    Entry("what it seems", "error dashed"),
)


def point_about_wheel(angle_rad: float, radius: float) -> Point:
    """A place at an angle about the wheel's centre, clockwise from the right."""
    return CENTRE[0] + radius * math.cos(angle_rad), CENTRE[1] + radius * math.sin(angle_rad)


def on_dial(speed: float) -> Point:
    """Place of a speed, in turns per second, on the dial, whose scale is wider for slow ones."""
    turned = math.copysign(math.sqrt(min(abs(speed) / FASTEST, 1.0)), speed)
    return point_about_wheel(-math.pi / 2 + turned * DIAL_END, RADIUS + DIAL)


def wheel(spokes: int, angle_rad: float, speed: float) -> str:
    """The wheel at this moment; one spoke is marked, which the film does not record."""
    ends = [angle_rad + 2 * math.pi * index / spokes for index in range(spokes)]
    bars = [[point_about_wheel(end, 14), point_about_wheel(end, RADIUS - 4)] for end in ends]
    arc = [
        point_about_wheel(-math.pi / 2 + DIAL_END * step / 24, RADIUS + DIAL)
        for step in range(-24, 25)
    ]
    whole = [on_dial(float(speed)) for speed in range(-int(FASTEST), int(FASTEST) + 1)]
    outwards = 1.0 + 5.0 / (RADIUS + DIAL)
    ticks = [
        [(x, y), (CENTRE[0] + (x - CENTRE[0]) * outwards, CENTRE[1] + (y - CENTRE[1]) * outwards)]
        for x, y in whole
    ]
    mark = on_dial(speed)
    right = mark[0] >= CENTRE[0]
    name = (mark[0] + (14 if right else -14), mark[1] - 4)
    return "".join(
        (
            circle(CENTRE, RADIUS, "world bold"),
            circle(CENTRE, RADIUS - 9, "world thin"),
            path(bars[1:], "world bold"),
            path(bars[:1], "ray bold"),
            dot(point_about_wheel(angle_rad, RADIUS - 4), "ray", 6),
            circle(CENTRE, 14, "world fill"),
            polyline(arc, "muted thin faint"),
            path(ticks, "muted thin"),
            dial_arrow(speed, "world bold"),
            dot(mark, "world", 5),
            text(name, "speed", "world small ground", "start" if right else "end"),
        )
    )


def over_film(apparent: float, certain: bool) -> str:
    """The apparent motion of the frames; in both senses where nothing distinguishes them."""
    return "".join(
        dial_arrow(seen, style)
        for seen in ((apparent,) if certain else (apparent, -apparent))
        if abs(seen) > 1e-9
        for style in ("casing", "error bold")
    )


def dial_arrow(speed: float, style: str) -> str:
    """An arrow along the dial from the top to a speed; without head if it is shorter than that."""
    end, top = on_dial(speed), -math.pi / 2
    angle = math.atan2(end[1] - CENTRE[1], end[0] - CENTRE[0])
    arc = [point_about_wheel(top + (angle - top) * step / 24, RADIUS + DIAL) for step in range(25)]
    before_head = [point for point in arc if math.dist(point, end) > HEAD]
    if not before_head:
        return polyline(arc, style)
    return polyline(before_head, style) + arrow(before_head[-1], end, style, HEAD)


def track(per_frame: float, seen_per_frame: float, certain: bool, time: float) -> Iterator[str]:
    """Positions of the spokes over time: lines for the truth, dots for the frames.

    ``per_frame`` and ``seen_per_frame`` are in spoke spacings per frame; the spokes are equal, so
    that the picture repeats at every whole spacing.
    """
    start, last = time - BEFORE, math.floor(time + 1e-9)
    frames = [frame for frame in range(math.ceil(start - 1e-9), last + 1) if frame >= 0]
    yield from track_axes(time)
    yield slanted_lines(per_frame, 0.0, time, start, time + AFTER, "world thin")
    for slope in [seen_per_frame] if certain else [seen_per_frame, -seen_per_frame]:
        # Through the dots: on frame n the two waves differ by a whole number of spacings.
        shift = (per_frame - slope) * (frames[-1] if frames else 0)
        yield slanted_lines(slope, shift, time, start, float(last), "error dashed")
    for frame in frames:  # the spokes in each frame taken so far
        u = per_frame * frame
        # Rounded, so that a dot exactly on the edge is on the same side on every machine.
        first = math.ceil(round(-u, 9))
        places = np.arange(first, math.floor(round(ROWS - u, 9)) + 1) + u
        yield from (dot(PLOT.at(frame - time, place), "image", 4.0) for place in places.tolist())
    yield legend((PLOT.x.start, 17.0), LEGEND)


def slanted_lines(
    slope: float, shift: float, now: float, start: float, end: float, style: str
) -> str:
    """All lines u = slope t + shift + whole number, cut to the plot."""
    start = max(start, 0.0)
    if end <= start:
        return ""
    ends = (slope * start + shift, slope * end + shift)
    pieces = []
    for whole in range(math.ceil(-max(ends)), math.floor(ROWS - min(ends)) + 1):
        first, last = (start, ends[0] + whole), (end, ends[1] + whole)
        piece = clipped(first, last, (start, end), (0.0, ROWS))
        if piece:
            pieces.append([PLOT.at(t - now, u) for t, u in piece])
    return path(pieces, style) if pieces else ""


def track_axes(now: float) -> Iterator[str]:
    frames = range(max(math.ceil(now - BEFORE), 0), math.floor(now + AFTER) + 1)
    # A label in a corner would be cut in half as it appears or disappears.
    clear = [frame for frame in frames if -BEFORE + 0.1 < frame - now < AFTER - 0.1]
    ticks = [(frame - now, "" if frame % 2 else str(frame)) for frame in clear]
    yield PLOT.frame(Scale("time", "frames", ticks), Scale(ticks=(0, 1)))
    x, foot = PLOT.at(0, 0)
    yield line((x, foot + 4), (x, PLOT.y.end), "muted dashed")
    yield text((x, PLOT.y.end - 7), "now", "muted small ground", "middle")
    yield text((PLOT.x.start - 34, foot + 41), "↑ turn, in spoke spacings")


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The current frame, the wheel now, and the spokes' positions over time."""
    spokes, rate, speed = settings.spokes, settings.frame_rate, settings.speed
    time, shutter = settings.time, settings.shutter
    speed_shown, certain = apparent_wheel_speed(speed, spokes, rate)
    apparent, sure = float(speed_shown), bool(certain)
    per_frame, blur = spokes * speed / rate, 360 * (abs(speed) / rate * shutter)
    contrast = float(box_mtf(per_frame, shutter))
    signed = ("+" if apparent > 0.005 else "") + format_number(apparent)
    if not sure:
        signed, direction = f"±{format_number(abs(apparent))}", "either way"
    elif abs(apparent) < STILL:
        direction = "not at all"
    else:
        direction = "clockwise" if apparent > 0 else "anticlockwise"
    over = over_film(apparent, sure)
    now = wheel(spokes, 2 * math.pi * speed * time / rate, speed)
    plot = "".join(track(per_frame, apparent * spokes / rate, sure, time))
    return Frame(
        (
            Panel("film", "What the film shows", *SIZE, outputs["film"], over, lead=True),
            Panel("wheel", "The wheel, one spoke marked", *SIZE, overlay=now),
            Panel("track", "Where the spokes are, frame by frame", *SIZE, overlay=plot),
        ),
        (
            Readout("direction", "Appears to turn", direction, "", role="error"),
            Readout("apparent", "Speed in the film", signed, "turns/s", role="error"),
            readout("passing", "Spokes passing", spokes * speed, "per s", digits=1, role="world"),
            readout("nyquist", "Half the frame rate", rate / 2, "per s", digits=1, role="image"),
            readout("step", "Turn from frame to frame", per_frame, "spacings", role="image"),
            readout("blur", "Blur of a spoke", blur, "°", digits=1, role="light"),
            readout("contrast", "Contrast left by blur", contrast, role="light"),
        ),
        describe(settings, apparent, sure, contrast),
    )


def describe(settings: Settings, apparent: float, certain: bool, contrast: float) -> str:
    """Wheel and film in words."""
    speed = settings.speed
    if speed == 0:
        effect = "; it stands, and so it does in the film"
    elif not certain:
        effect = (
            "; each spoke moves half a spacing from frame to frame, and nothing in the film says "
            "which way"
        )
    elif abs(apparent) < STILL:
        effect = (
            "; each spoke takes the place of another from frame to frame, and it seems to stand"
        )
    elif math.isclose(apparent, speed):
        effect = ", which is fast enough to show the true motion"
    else:
        direction = "backwards" if apparent * speed < 0 else "forwards"
        effect = f"; it seems to turn {direction}, {format_number(abs(apparent))} times a second"
    blurred = " Motion blur hides the spokes." if contrast < 0.1 else ""
    rate = format_number(settings.frame_rate, 0)
    return (
        f"A coach’s wheel of {settings.spokes} spokes that turns {format_number(speed)} times a "
        f"second is filmed at {rate} frames a second{effect}.{blurred}"
    )


def speed_at(settings: Settings, _outputs: Outputs) -> Point:
    return on_dial(settings.speed)


def spoke_at(settings: Settings, _outputs: Outputs) -> Point | None:
    """None for a wheel that does not turn, which time does not move."""
    turned = settings.turn_per_frame * settings.time
    return point_about_wheel(turned, RADIUS - 4) if settings.speed else None


def spoke_pulled(settings: Settings, place: Point) -> dict[str, Value]:
    """The time nearest to the present one at which the spoke points to a place; otherwise the end
    of the film that is closest."""
    turn, now = settings.turn_per_frame, settings.time
    if not turn:
        return {}
    angle = math.atan2(place[1] - CENTRE[1], place[0] - CENTRE[0])

    def missing(time: float) -> float:
        """The angle from the spoke to the place, from -π to π."""
        return math.remainder(angle - turn * time, 2 * math.pi)

    times = [now + missing(now) / turn + rounds * 2 * math.pi / abs(turn) for rounds in (-1, 0, 1)]
    within = [time for time in times if -1e-9 <= time <= FRAMES + 1e-9]
    if within:
        return {"time": min(within, key=lambda time: abs(time - now))}
    return {"time": min((0.0, float(FRAMES)), key=lambda time: abs(missing(time)))}


def time_at(settings: Settings, _outputs: Outputs) -> Point:
    """Place of frame 0, in a plot without a left end."""
    return (-settings.time * UNITS_PER_FRAME, 0.0)


SCENE = Scene(
    "wagon-wheel",
    "Wagon Wheel",
    Settings,
    draw,
    STAGES,
    (
        Handle("speed", "wheel", "Speed", ("speed",), speed_at, role="world"),
        Handle("spoke", "wheel", "Marked spoke", ("time",), spoke_at, spoke_pulled, role="ray"),
        Handle(
            "time", "track", "Row of frames", ("time",), time_at, reach="drag", reversed=("time",)
        ),
    ),
    accuracy=Accuracy(
        levels=tiers(*TIERS), default="integral", ladder="exposure-blur", estimate=estimate
    ),
    parameters=lambda settings, _: {"frame": settings.frame},
    formula=apparent_wheel_speed,
)
