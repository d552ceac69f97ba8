"""Wagon Wheel: a turning wheel, the film of it, and the motion that the film shows.

Angles are clockwise, as for a wheel that rolls to the right. Time counts in film frames, so that
one step of it is one frame; a frame is exposed from its start for the shutter's share of the frame
time, and then shown until the next.
"""

import math
from collections.abc import Iterator

from simulations.engine.controls import Value
from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.sampling.aliasing import apparent_wheel_speed, box_mtf
from simulations.scenes.wagon_wheel import drawing
from simulations.scenes.wagon_wheel.film import STAGES, TIERS, estimates, frame_at
from simulations.scenes.wagon_wheel.handles import HANDLES
from simulations.scenes.wagon_wheel.settings import Settings

STILL = 1e-9
"""Speed in turns per second below which the filmed wheel stands."""


def parameters(settings: Settings, _tier: str) -> dict[str, Value]:
    """The film changes from frame to frame, not continuously."""
    return {"frame": frame_at(settings.time)}


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The current frame, the wheel now, and the spokes' positions over time."""
    spokes, rate, speed = settings.spokes, settings.frame_rate, settings.speed
    time = settings.time
    seen, certain = apparent_wheel_speed(speed, spokes, rate)
    apparent, sure = float(seen), bool(certain)
    per_frame = spokes * speed / rate
    blur = abs(speed) / rate * settings.shutter
    contrast = float(box_mtf(per_frame, settings.shutter))
    width, height = drawing.WIDTH, drawing.HEIGHT
    return Frame(
        panels=(
            Panel(
                "film",
                "What the film shows",
                width,
                height,
                outputs["film"],
                drawing.over_film(apparent, sure),
                lead=True,
            ),
            Panel(
                "wheel",
                "The wheel, one spoke marked",
                width,
                height,
                overlay=drawing.wheel(spokes, 2 * math.pi * speed * time / rate, speed),
            ),
            Panel(
                "track",
                "Where the spokes are, frame by frame",
                width,
                height,
                overlay=drawing.track(per_frame, apparent * spokes / rate, sure, time),
            ),
        ),
        readouts=(
            Readout("direction", "Appears to turn", direction(apparent, sure), "", "error"),
            Readout("apparent", "Speed in the film", _signed(apparent, sure), "turns/s", "error"),
            readout("passing", "Spokes passing", spokes * speed, "per s", digits=1, role="world"),
            readout("nyquist", "Half the frame rate", rate / 2, "per s", digits=1, role="image"),
            readout("step", "Turn from frame to frame", per_frame, "spacings", role="image"),
            readout("blur", "Blur of a spoke", 360 * blur, "°", digits=1, role="light"),
            readout("contrast", "Contrast left by blur", contrast, role="light"),
        ),
        description=describe(settings, apparent, sure, contrast),
    )


def _signed(apparent: float, certain: bool) -> str:
    """The speed with its sign, or with both signs at the tie."""
    if not certain:
        return f"±{format_number(abs(apparent))}"
    plus = "+" if apparent > 0.005 else ""
    return plus + format_number(apparent)


def direction(apparent: float, certain: bool) -> str:
    """The apparent motion of the film."""
    if not certain:
        return "either way"
    if abs(apparent) < STILL:
        return "not at all"
    return "clockwise" if apparent > 0 else "anticlockwise"


def describe(settings: Settings, apparent: float, certain: bool, contrast: float) -> str:
    """Wheel and film in words."""
    speed, spokes = settings.speed, settings.spokes
    rate = format_number(settings.frame_rate, 0)
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


def estimate(settings: Settings, outputs: Outputs, tier: str) -> Iterator[Readout]:
    """Error of the current frame against the integral over its exposure."""
    per_frame = 2 * math.pi * settings.speed / settings.frame_rate
    return estimates(
        outputs["canvas"], settings.spokes, per_frame, settings.shutter, settings.time, tier
    )


SCENE = Scene(
    id="wagon-wheel",
    title="Wagon Wheel",
    settings=Settings,
    draw=draw,
    formula=apparent_wheel_speed,
    stages=STAGES,
    handles=HANDLES,
    parameters=parameters,
    tiers=TIERS,
    default_tier="integral",
    # Few instants are useful while the wheel turns; more are too slow.
    draft_tier="instants-16",
    ladder="exposure-blur",
    estimate=estimate,
)
