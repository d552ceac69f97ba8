"""What may be left out: the camera with a switch for each of seven effects, what each costs in the
picture when it is left out, and, measured where the figure runs, how long it takes.

Errors are of the mean picture as displayed, not rounded to codes. Noise is no error: counts of
electrons are compared at the same random numbers, the least RMS that turns one distribution into
the other.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.drafting import box
from simulations.engine.drawing import line, text
from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.ladder import Clock
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.engine.settings import action, choice, controls_of, slider, toggle, values_of
from simulations.engine.stages import Outputs, Stage, StageCache, run
from simulations.models.arrays import Planes
from simulations.models.color.srgb import encode_srgb
from simulations.models.distortion.lens_model import Distortion, undistort_clamped
from simulations.models.error_measures import root_mean_square
from simulations.models.lens.vignetting import vignetting_cos4
from simulations.models.sensor.photon_counting import ShotModel, shot_noise
from simulations.scenes._still_life_camera import (
    PITCH_MM,
    SENSOR_HEIGHT_MM,
    SENSOR_WIDTH_MM,
    Rays,
    defocus,
    drawing_of,
    overlay,
    pinhole_rays,
    principal_mm,
)
from simulations.scenes._wipe import over_wipe, wipe_handle, wiped
from simulations.scenes.camera.lens import Settings as Camera
from simulations.scenes.camera.lens import after_step, bend_rays, blur_of
from simulations.scenes.camera.stages import vignette
from simulations.world import still_life
from simulations.world.layers import LitScene, light
from simulations.world.surfaces import FLOOR_DARK, FLOOR_LIGHT, Surface, surfaces

HALF_A_CODE = 0.5
MAGNIFY = 32  # of the difference, in which half a code can then be seen
DRAWS = 4  # of the shot noise, for its cost
ROUNDS = 9  # of measuring times
WIDTH, HEIGHT = 400.0, 267.0
FIRST, ROW = 42.0, 37.0  # of the list: baseline of the first name, distance of the next
LIST_HEIGHT = 320.0
BAR, BAR_WIDTH, CODES_END, MS_END = 170.0, 112.0, 334.0, 394.0
LEAST, MOST = 0.01, 100.0  # codes at the ends of the bars


@dataclass(frozen=True, slots=True)
class Photo:
    """A photograph to be taken of the still life."""

    label: str
    camera: Camera
    k2: float = 0.03
    white_e: float = 10_000.0
    """Electrons of a full well."""
    floor: float = 1.0
    """How bright the floor is, and so what it sends back."""
    origin_m: float = 10.0
    """Distance of the world's origin."""


AT_F22 = Camera(focal_length=35.0, aperture=22.0, k1=-0.1)
PHOTOS: Mapping[str, Photo] = {
    "room": Photo("Room, small aperture", AT_F22),
    "afar": Photo("From afar, with a long lens", Camera(aperture=16.0, k1=-0.05, back=30.0), 0.02),
    "portrait": Photo(
        "Portrait, wide open", Camera(focal_length=85.0, aperture=1.4, k1=-0.05), 0.02
    ),
    "night": Photo("Night, a few electrons", replace(AT_F22, aperture=2.0), white_e=12.0),
    "stage": Photo("Stage with a black floor", AT_F22, floor=0.04),
    "map": Photo("Room on a map, its origin 1000 km away", AT_F22, origin_m=1e6),
}


@dataclass(frozen=True, slots=True)
class Settings:
    photo: str = choice("Photograph", {name: photo.label for name, photo in PHOTOS.items()})
    split: float = slider("Complete model shown", 0.5, 0, 1, 0.01, unit="of the picture")
    small: int = action("Leave out all below half a code", effect="set")
    blur: bool = toggle("Blur", default=True)
    k2: bool = toggle("Distortion k₂", default=True)
    falloff: bool = toggle("cos⁴", default=True)
    bounce: bool = toggle("Second bounce", default=True)
    poisson: bool = toggle("Poisson", default=True)
    area: bool = toggle("Area of the pixel", default=True)
    double: bool = toggle("Float64", default=True)


EFFECTS: Mapping[str, str] = {
    "blur": "defocus",
    "k2": "bent rays",
    "falloff": "falloff",
    "bounce": "light",
    "poisson": "counted",
    "area": "surfaces",
    "double": "surfaces",
}
"""The switches, and the stage of `MODEL` that reads each."""
LABELS = {each.name: each.label for each in controls_of(Settings) if each.name in EFFECTS}


def omitted_effects(settings: Settings, _tier: str = "") -> dict[str, str]:
    """The names of the effects that are switched off, as one parameter."""
    return {"left": " ".join(name for name in EFFECTS if not getattr(settings, name))}


def parameters(photo: str, left: str = "") -> dict[str, Value]:
    """Of the stages of `MODEL`, without some of the effects."""
    it, now = PHOTOS[photo], after_step(PHOTOS[photo].camera)
    return {
        **values_of(now),
        **{"k2": it.k2, "white_e": it.white_e, "floor": it.floor, "origin_m": it.origin_m},
        **{"reduction": 1, "margin_columns": 0, "margin_rows": 0},
        **drawing_of(False, now.focal_length, now.focus),
        **{f"with_{name}": name not in left.split() for name in EFFECTS},
    }


def bend(rays: Rays, k1: float, k2: float, with_k2: bool) -> Rays:
    return bend_rays(rays, k1, k2 if with_k2 else 0.0)


def find_surfaces(
    rays: Rays, back: float, origin_m: float, with_area: bool, with_double: bool
) -> tuple[Surface, ...]:
    view = still_life.view(rays.directions, rays.valid, back)
    stored = None if with_double else origin_m
    return surfaces(replace(view, area=with_area, float32_from=stored))


def shade(
    parts: tuple[Surface, ...], light_angle: float, floor: float, with_bounce: bool
) -> LitScene:
    wall, ground, *items = parts
    darker = replace(ground, albedo=np.float32(floor) * ground.albedo)
    return light((wall, darker, *items), light_angle, floor if with_bounce else 0.0)


def no_blur(with_blur: bool) -> str:
    return "" if with_blur else "blur is left out"


def no_falloff(with_falloff: bool) -> str:
    return "" if with_falloff else "cos⁴ is left out"


def count_electrons(
    irradiance: Planes, white_e: float, with_poisson: bool, draw: int = 0
) -> Planes:
    """Electrons, as a share of white: quantiles of Poisson's distribution, or of a rounded
    Gaussian, at the same random numbers."""
    model: ShotModel = "quantile" if with_poisson else "gaussian"
    mean, rng = irradiance * np.float32(white_e), np.random.default_rng(draw)
    return np.asarray(shot_noise(mean, rng, white_e, model) / np.float32(white_e))


MODEL = (
    Stage("rays", pinhole_rays),
    Stage("bent rays", bend, ("rays",)),
    Stage("surfaces", find_surfaces, ("bent rays",)),
    Stage("light", shade, ("surfaces",)),
    Stage("defocus", defocus, ("light",), neutral=no_blur),
    Stage("overlay", overlay, ("defocus",)),
    Stage("falloff", vignette, ("overlay",), neutral=no_falloff),
    Stage("counted", count_electrons, ("falloff",)),
)


def codes(irradiance: Planes) -> Planes:
    """Codes of 255, not rounded."""
    return np.asarray(255.0 * encode_srgb(np.clip(irradiance, 0.0, 1.0)))


@dataclass(frozen=True, slots=True)
class Complete:
    """The picture of the complete model, and what leaving out one effect costs."""

    counted: Planes
    """(3, H, W) share of white."""
    mean: Planes
    """(3, H, W) codes without noise."""
    noise: Planes
    """(3, H, W) codes by which a Gaussian differs from Poisson's counts, in the first draw."""
    costs: Mapping[str, float]
    """RMS in codes, by the name of the effect."""


def complete_model(photo: str) -> Complete:
    cache = StageCache(depth=len(EFFECTS))

    def mean(left: str = "") -> Planes:
        return np.asarray(run(MODEL, parameters(photo, left), cache).outputs["falloff"])

    def counted(poisson: bool, draw: int) -> Planes:
        return codes(count_electrons(mean(), PHOTOS[photo].white_e, poisson, draw))

    noise = [counted(False, draw) - counted(True, draw) for draw in range(DRAWS)]
    truth = codes(mean())
    costs = {name: root_mean_square(codes(mean(name)) - truth) for name in EFFECTS}
    complete = count_electrons(mean(), PHOTOS[photo].white_e, True)
    return Complete(complete, truth, noise[0], {**costs, "poisson": root_mean_square(noise)})


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
    outputs = run(MODEL, parameters(photo, left), StageCache()).outputs
    off = codes(outputs["falloff"]) - complete.mean
    rms = root_mean_square(off)
    if "poisson" in left:
        off, rms = off + complete.noise, math.hypot(rms, complete.costs["poisson"])
    return Taken(outputs["counted"], off, rms)


STAGES = (Stage("complete", complete_model), Stage("taken", take, ("complete",)))


def reasons(photo: str) -> dict[str, str]:
    """What the cost of each effect depends on."""
    it, now = PHOTOS[photo], after_step(PHOTOS[photo].camera)
    principal = principal_mm(now.focal_length, now.focus)
    corner = np.array([[SENSOR_WIDTH_MM / 2, SENSOR_HEIGHT_MM / 2]]) / principal
    ideal_places = [
        undistort_clamped(corner, Distortion(k1=now.k1, k2=k2))[0] for k2 in (it.k2, 0.0)
    ]
    moved = float(np.linalg.norm(ideal_places[0] - ideal_places[1])) * principal / PITCH_MM
    dimmer = 1.0 - float(vignetting_cos4(np.linalg.norm(corner)))
    reflected = it.floor * float(np.mean([FLOOR_LIGHT, FLOOR_DARK]))
    far = f"{it.origin_m / 1000:.0f} km" if it.origin_m >= 1000 else f"{it.origin_m:.0f} m"
    return {
        "blur": f"discs to {format_number(blur_of(now), 1)} px",
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
    yield text((MS_END, FIRST - 24), "ms", "muted small", "end")
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
    planes = (reference.counted, taken.counted, taken.off)
    before, after, off = (np.moveaxis(each, 0, -1) for each in planes)
    complete, simpler = (to_rgba8(encode_srgb(picture)) for picture in (before, after))
    photograph = wiped(complete, simpler, settings.split)
    difference = to_rgba8(0.5 + MAGNIFY / 255 * off)
    names = over_wipe(settings.split, WIDTH, HEIGHT, ("complete", "simpler"))
    overlay, title = (
        "".join(costs(settings, reference, taken.rms)),
        f"Difference from the complete model, × {MAGNIFY}",
    )
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
        f"{PHOTOS[settings.photo].label}: the still life {words}, "
        f"{format_number(taken.rms, 2)} codes off in RMS.",
    )


def significant_effects(_settings: Settings, outputs: Outputs) -> dict[str, Value]:
    """Each effect in the model or not, by what it costs here."""
    return {name: cost >= HALF_A_CODE for name, cost in outputs["complete"].costs.items()}


def seconds(stage: Stage, outputs: Outputs, clock: Clock, given: Mapping[str, Value]) -> float:
    """The time that a stage takes here."""
    if stage.reason(given):
        return 0.0
    begun = clock()
    stage.compute(*(outputs[name] for name in stage.after), **{n: given[n] for n in stage.reads})
    return clock() - begun


def times(settings: Settings, clock: Clock) -> Iterator[Readout]:
    """The milliseconds that leaving out each effect saves: the stage with it and without it by
    turns, so that a busy moment falls on both; of each, the fastest counts."""
    given, stages = parameters(settings.photo), {stage.name: stage for stage in MODEL}
    outputs = run(MODEL, given, StageCache()).outputs
    complete, without = dict.fromkeys(EFFECTS, math.inf), dict.fromkeys(EFFECTS, math.inf)

    def saved(name: str, *effects: str) -> Readout:
        ms = 1000.0 * sum(complete[each] - without[each] for each in effects)
        return Readout(name, "Time saved", format_number(ms, 1), "ms")

    for _ in range(ROUNDS):
        for name, stage in EFFECTS.items():
            run_here = partial(seconds, stages[stage], outputs, clock)
            complete[name] = min(complete[name], run_here(given))
            without[name] = min(without[name], run_here(parameters(settings.photo, name)))
            yield saved(name, name)
        yield saved("saved", *omitted_effects(settings)["left"].split())


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
