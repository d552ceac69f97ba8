"""Wagon Wheel: a turning wheel, the film of it, and the motion that the film shows.

Angles grow clockwise, as a wheel turns that rolls to the right. Time counts in film frames, so
that one step of it is one frame; a frame is exposed from its start for the shutter's share of
the frame time, and then shown until the next.
"""

import math

from simulations.engine.controls import Action, Slider, Values
from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.pipeline import StageCache, run
from simulations.engine.scene import Scene
from simulations.models.sampling.aliasing import apparent_wheel_speed, box_mtf
from simulations.scenes.wagon_wheel import drawing as drawing
from simulations.scenes.wagon_wheel.film import STAGES, TIERS, error, frame_at

DEFAULT_TIER = "integral"

STILL = 1e-9
"""Speed in turns per second below which the filmed wheel stands."""

CONTROLS = (
    Action(name="play", labels=("Play", "Pause"), drives="time", effect="play", seconds=20.0),
    Slider(name="time", label="Time", default=5, minimum=0, maximum=48, step=0.05, unit="frames"),
    Slider(
        name="speed",
        label="True speed",
        default=2.9,
        minimum=-6,
        maximum=6,
        step=0.05,
        unit="turns/s",
    ),
    Slider(name="spokes", label="Spokes", default=8, minimum=2, maximum=16, step=1),
    Slider(
        name="frame_rate",
        label="Frame rate",
        default=24,
        minimum=8,
        maximum=60,
        step=1,
        unit="frames/s",
    ),
    Slider(
        name="shutter",
        label="Shutter open for",
        default=0.1,
        minimum=0,
        maximum=1,
        step=0.05,
        unit="of a frame",
    ),
)


def render(values: Values, tier: str, cache: StageCache) -> Frame:
    """The wheel now, the frame on show, and the spokes' positions against time."""
    spokes, rate = round(values.number("spokes")), values.number("frame_rate")
    speed, time = values.number("speed"), values.number("time")
    done = run(STAGES, values, cache, {"frame": frame_at(time), "tier": tier or DEFAULT_TIER})
    seen, certain = apparent_wheel_speed(speed, spokes, rate)
    apparent, sure = float(seen), bool(certain)
    per_frame = spokes * speed / rate
    blur = abs(speed) / rate * values.number("shutter")
    contrast = float(box_mtf(per_frame, values.number("shutter")))
    width, height = drawing.WIDTH, drawing.HEIGHT
    return Frame(
        panels=(
            Panel(
                "wheel",
                "The wheel",
                width,
                height,
                overlay=drawing.wheel(spokes, 2 * math.pi * speed * time / rate, speed),
            ),
            Panel(
                "film",
                "The frame on show",
                width,
                height,
                done.outputs["film"],
                drawing.over_film(frame_at(time), apparent, sure),
            ),
            Panel(
                "track",
                "Spokes against time",
                width,
                height,
                overlay=drawing.track(per_frame, apparent * spokes / rate, sure, time),
            ),
        ),
        readouts=(
            readout("speed", "True speed", speed, "turns/s", role="world"),
            Readout("apparent", "Speed in the film", _signed(apparent, sure), "turns/s", "error"),
            Readout("direction", "It seems to", direction(apparent, sure), "", "error"),
            readout("passing", "Spokes passing", spokes * speed, "per s", digits=1, role="world"),
            readout("nyquist", "Half the frame rate", rate / 2, "per s", digits=1, role="image"),
            readout("step", "Turn from frame to frame", per_frame, "spacings", role="image"),
            readout("blur", "Blur of a spoke", 360 * blur, "°", digits=1, role="light"),
            readout("contrast", "Contrast left by blur", contrast, role="light"),
        ),
        description=describe(values, apparent, sure, contrast),
        stages=done.reports,
    )


def _signed(apparent: float, certain: bool) -> str:
    """With its sign; with both at the tie."""
    if not certain:
        return f"±{format_number(abs(apparent))}"
    plus = "+" if apparent > 0.005 else ""
    return plus + format_number(apparent)


def direction(apparent: float, certain: bool) -> str:
    """What the film seems to show."""
    if not certain:
        return "turn either way"
    if abs(apparent) < STILL:
        return "stand still"
    return "turn clockwise" if apparent > 0 else "turn anticlockwise"


def describe(values: Values, apparent: float, certain: bool, contrast: float) -> str:
    """Wheel and film in words."""
    speed, spokes = values.number("speed"), round(values.number("spokes"))
    rate = format_number(values.number("frame_rate"), 0)
    true = (
        f"A wheel of {spokes} spokes that turns {format_number(speed)} times a second is filmed "
        f"at {rate} frames a second"
    )
    if speed == 0:
        shown = "; it stands, and so it does in the film"
    elif not certain:
        shown = (
            "; each spoke moves half a spacing from frame to frame, and nothing in the film says "
            "which way"
        )
    elif abs(apparent) < STILL:
        shown = "; each spoke takes the place of another from frame to frame, and it seems to stand"
    elif math.isclose(apparent, speed):
        shown = ", which is fast enough to show the true motion"
    else:
        way = "backwards" if apparent * speed < 0 else "forwards"
        shown = f"; it seems to turn {way}, {format_number(abs(apparent))} times a second"
    blurred = " Motion blur hides the spokes." if contrast < 0.1 else ""
    return f"{true}{shown}.{blurred}"


SCENE = Scene(
    id="wagon-wheel",
    title="Wagon Wheel",
    controls=CONTROLS,
    render=render,
    tiers=TIERS,
    default_tier=DEFAULT_TIER,
    # Fewer instants are a thing to look at while the wheel turns; more are too slow for that.
    draft_tier="instants-16",
    ladder="exposure-blur",
    error=error,
)
