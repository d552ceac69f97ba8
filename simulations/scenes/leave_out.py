"""What may be left out: the camera with a switch for each of seven effects, what each costs in the
picture when it is left out, and, measured where the figure runs, how long it takes."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import cycle

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.drafting import box
from simulations.engine.drawing import line, text
from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.ladder import Clock
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.engine.settings import action, choice, controls_of, slider, toggle
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Planes
from simulations.models.color.srgb import encode_srgb
from simulations.models.distortion.lens_model import Distortion, undistort_clamped
from simulations.models.lens.vignetting import vignetting_cos4
from simulations.scenes._wipe import over_wipe, wipe_handle, wiped
from simulations.world.omissions import (
    EFFECTS,
    Complete,
    Photo,
    codes,
    complete_model,
    error_without,
    run_without,
    savings,
)
from simulations.world.still_life_camera import (
    PITCH_MM,
    SENSOR_HEIGHT_MM,
    SENSOR_WIDTH_MM,
    largest_blur_px,
    principal_mm,
    step_back,
)
from simulations.world.surfaces import FLOOR_DARK, FLOOR_LIGHT

HALF_A_CODE = 0.5
MAGNIFY = 32  # of the difference, in which half a code can then be seen
ROUNDS = 9  # of measuring times
WIDTH, HEIGHT = 400.0, 267.0
FIRST, ROW = 42.0, 37.0  # of the list: baseline of the first name, distance of the next
LIST_HEIGHT = 320.0
BAR, BAR_WIDTH, CODES_END, MS_END = 170.0, 112.0, 334.0, 394.0
LEAST, MOST = 0.01, 100.0  # codes at the ends of the bars


AT_F22 = Photo(focal_length=35.0, aperture=22.0)
PHOTOS: Mapping[str, tuple[str, Photo]] = {
    "room": ("Room, small aperture", AT_F22),
    "afar": (
        "From afar, with a long lens",
        Photo(focal_length=50.0, aperture=16.0, k1=-0.05, k2=0.02, back=30.0),
    ),
    "portrait": (
        "Portrait, wide open",
        Photo(focal_length=85.0, aperture=1.4, k1=-0.05, k2=0.02),
    ),
    "night": ("Night, a few electrons", replace(AT_F22, aperture=2.0, white_e=12.0)),
    "stage": ("Stage with a black floor", replace(AT_F22, floor=0.04)),
    "map": ("Room on a map, its origin 1000 km away", replace(AT_F22, origin_m=1e6)),
}
"""Labels and photographs."""


@dataclass(frozen=True, slots=True)
class Settings:
    photo: str = choice("Photograph", {name: label for name, (label, _) in PHOTOS.items()})
    split: float = slider("Complete model shown", 0.5, 0, 1, 0.01, unit="of the picture")
    small: int = action("Leave out all below half a code", effect="set")
    blur: bool = toggle("Blur", default=True)
    k2: bool = toggle("Distortion k₂", default=True)
    falloff: bool = toggle("cos⁴", default=True)
    bounce: bool = toggle("Second bounce", default=True)
    poisson: bool = toggle("Poisson", default=True)
    area: bool = toggle("Area of the pixel", default=True)
    double: bool = toggle("Float64", default=True)


LABELS = {each.name: each.label for each in controls_of(Settings) if each.name in EFFECTS}


def omitted_effects(settings: Settings, _tier: str = "") -> dict[str, str]:
    """The names of the effects that are switched off, as one parameter."""
    return {"left": " ".join(name for name in EFFECTS if not getattr(settings, name))}


def photographed(photo: str) -> Complete:
    return complete_model(PHOTOS[photo][1])


@dataclass(frozen=True, slots=True)
class Taken:
    """The picture of the model with the effects that are switched on."""

    counted: Planes
    """(3, H, W) share of white."""
    off: Planes
    """(3, H, W) codes by which it differs from the complete model's."""
    rms: float
    """Codes; the noise's share, which is independent, is added in squares."""


def take(complete: Complete, photo: str, left: str) -> Taken:
    effects = left.split()
    outputs, noise = run_without(PHOTOS[photo][1], effects), complete.costs["poisson"]
    off = codes(outputs["falloff"]) - complete.mean
    rms = error_without(effects, outputs["falloff"], complete.mean, noise)
    return Taken(outputs["counted"], off + complete.noise if "poisson" in effects else off, rms)


def pictures(complete: Complete, taken: Taken) -> tuple[Raster, Raster, Raster]:
    """The photographs by the complete model and by this one, and their difference, magnified."""
    planes = (complete.counted, taken.counted, taken.off)
    before, after, off = (np.moveaxis(each, 0, -1) for each in planes)
    difference = to_rgba8(0.5 + MAGNIFY / 255 * off)
    return to_rgba8(encode_srgb(before)), to_rgba8(encode_srgb(after)), difference


STAGES = (
    Stage("complete", photographed),
    Stage("taken", take, ("complete",)),
    Stage("pictures", pictures, ("complete", "taken")),
)


def reasons(photo: str) -> dict[str, str]:
    """What the cost of each effect depends on."""
    it = PHOTOS[photo][1]
    focal_length, focus = step_back(it.focal_length, it.focus, it.back)
    principal = principal_mm(focal_length, focus)
    blur = largest_blur_px(focal_length, it.aperture, focus, it.k1, it.back)
    corner = np.array([[SENSOR_WIDTH_MM / 2, SENSOR_HEIGHT_MM / 2]]) / principal
    ideal_places = [
        undistort_clamped(corner, Distortion(k1=it.k1, k2=k2))[0] for k2 in (it.k2, 0.0)
    ]
    moved = float(np.linalg.norm(ideal_places[0] - ideal_places[1])) * principal / PITCH_MM
    dimmer = 1.0 - float(vignetting_cos4(np.linalg.norm(corner)))
    reflected = it.floor * float(np.mean([FLOOR_LIGHT, FLOOR_DARK]))
    far = f"{it.origin_m / 1000:.0f} km" if it.origin_m >= 1000 else f"{it.origin_m:.0f} m"
    return {
        "blur": f"discs to {format_number(blur, 1)} px",
        "k2": f"corners move {format_number(moved, 1)} px",
        "falloff": f"corners lose {100 * dimmer:.0f} %",
        "bounce": f"the floor reflects {100 * reflected:.0f} %",
        "poisson": f"white is {it.white_e:,.0f} electrons".replace(",", "\u2009"),
        "area": "or its middle alone",
        "double": f"the origin is {far} away",
    }


def share(codes: float) -> float:
    """Length of a bar, from 0 to 1."""
    return min(max(math.log(max(codes, 1e-9) / LEAST) / math.log(MOST / LEAST), 0.0), 1.0)


def measured_time(name: str, row: float, style: str) -> str:
    """A number that `times` finds."""
    number = text((MS_END, row), "–", style, "end")
    return number.replace("<text", f'<text data-estimate="{name}"', 1)


def costs(settings: Settings, complete: Complete, rms: float) -> Iterator[str]:
    """The list: what leaving out each effect costs here, and what it takes."""
    half, low = BAR + BAR_WIDTH * share(HALF_A_CODE), FIRST + ROW * (len(EFFECTS) - 1) + 18
    yield line((half, FIRST - 18), (half, low), "muted thin dashed")
    yield text((half, FIRST - 24), "½", "muted small", "middle")
    yield text((CODES_END, FIRST - 24), "codes", "error small", "end")
    yield text((MS_END, FIRST - 24), "ms saved", "muted small", "end")
    for index, (name, reason) in enumerate(reasons(settings.photo).items()):
        row, cost, inside = FIRST + ROW * index, complete.costs[name], getattr(settings, name)
        yield text((6, row), LABELS[name], "strong" if inside else "muted")
        yield text((6, row + 15), reason, "muted small")
        style = "error fill" if inside else "error solid"
        yield box((BAR, row - 7), max(BAR_WIDTH * share(cost), 1.5), 12, 2, style)
        yield text((CODES_END, row + 4), format_number(cost, 2 if cost < 10 else 1), "", "end")
        yield measured_time(name, row + 4, "")
    yield line((6, low + 6), (MS_END, low + 6), "muted thin")
    yield text((6, low + 26), "left out, together", "strong")
    yield text((CODES_END, low + 26), format_number(rms, 2), "error strong", "end")
    yield measured_time("saved", low + 26, "strong")


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The photograph, its difference from the complete model's, and the list of costs."""
    reference, taken = outputs["complete"], outputs["taken"]
    missing = [LABELS[name] for name in EFFECTS if not getattr(settings, name)]
    complete, simpler, difference = outputs["pictures"]
    photograph = wiped(complete, simpler, settings.split)
    names = over_wipe(settings.split, WIDTH, HEIGHT, ("complete", "simpler"))
    overlay = "".join(costs(settings, reference, taken.rms))
    title = f"Difference from the complete model, × {MAGNIFY}"
    words = f"without {', '.join(missing)}" if missing else "by the complete model"
    return Frame(
        (
            Panel(
                "photograph", "The photograph", WIDTH, HEIGHT, photograph, overlay=names, lead=True
            ),
            Panel("costs", "Left out, each costs and saves", WIDTH, LIST_HEIGHT, overlay=overlay),
            Panel("difference", title, WIDTH, HEIGHT, difference),
        ),
        (
            readout("rms", "Error of the picture", taken.rms, "codes", role="error"),
            readout("missing", "Effects left out", len(missing), digits=0),
            *(
                readout(f"cost_{name}", LABELS[name], cost, "codes", role="error")
                for name, cost in reference.costs.items()
            ),
        ),
        f"{PHOTOS[settings.photo][0]}: the still life {words}, "
        f"{format_number(taken.rms, 2)} codes off in RMS.",
    )


def significant_effects(_settings: Settings, outputs: Outputs) -> dict[str, Value]:
    """Each effect in the model or not, by what it costs here."""
    return {name: cost >= HALF_A_CODE for name, cost in outputs["complete"].costs.items()}


def times(settings: Settings, clock: Clock) -> Iterator[Readout]:
    """The milliseconds that leaving out each effect saves, and all that are left out."""
    measured, left = savings(PHOTOS[settings.photo][1], clock, ROUNDS), omitted_effects(settings)

    def time(name: str, ms: float) -> Readout:
        return Readout(name, "Time saved", format_number(ms, 1) if ms >= 0.05 else "none", "ms")

    for name, saved in zip(cycle(EFFECTS), measured, strict=False):
        yield time(name, saved[name])
        if name == [*EFFECTS][-1]:
            yield time("saved", sum(saved[each] for each in left["left"].split()))


SCENE = Scene(
    "leave-out",
    "What May Be Left Out",
    Settings,
    draw,
    STAGES,
    handles=(wipe_handle("photograph", "split", WIDTH, HEIGHT),),
    sets={"small": significant_effects},
    times=times,
    parameters=omitted_effects,
)
