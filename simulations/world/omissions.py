"""The camera of the still life with a switch for each of seven effects: what leaving some out costs
in its picture, and saves in time.

Errors are of the mean picture as displayed, not rounded to codes. Noise is no error: counts of
electrons are compared at the same random numbers, the least RMS that turns one distribution into
the other.
"""

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.ladder import Clock
from simulations.engine.stages import Outputs, Stage, StageCache, run
from simulations.models.arrays import Planes
from simulations.models.color.srgb import encode_srgb
from simulations.models.error_measures import root_mean_square
from simulations.models.sensor.photon_counting import ShotModel, shot_noise
from simulations.world import still_life
from simulations.world.layers import LitScene, light
from simulations.world.still_life_camera import (
    Rays,
    bend_rays,
    defocus,
    drawing_of,
    overlay,
    pinhole_rays,
    step_back,
    vignette,
)
from simulations.world.surfaces import Surface, surfaces

DRAWS = 4  # of the shot noise, for its cost

EFFECTS: Mapping[str, str] = {
    "blur": "defocus",
    "k2": "bent rays",
    "falloff": "falloff",
    "bounce": "light",
    "poisson": "counted",
    "area": "surfaces",
    "double": "surfaces",
}
"""The effects, and the stage of `MODEL` that has the switch of each."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Photo:
    """A photograph to be taken of the still life."""

    focal_length: float
    """Millimetres, before the step back."""
    aperture: float
    """The f-number."""
    k1: float = -0.1
    k2: float = 0.03
    focus: float = 3.2
    """Metres, before the step back."""
    back: float = 0.0
    """Metres that the camera steps back."""
    light_angle: float = 40.0
    """Degrees."""
    white_e: float = 10_000.0
    """Electrons of a full well."""
    floor: float = 1.0
    """How bright the floor is, and so what it sends back."""
    origin_m: float = 10.0
    """Distance of the world's origin."""
    reduction: int = 1
    """Pixels of the full picture, 264 × 176, in one of this, each way."""


def stage_values(photo: Photo, left: Collection[str] = ()) -> dict[str, Value]:
    """The parameters of the stages of `MODEL`, without the effects ``left`` out."""
    focal_length, focus = step_back(photo.focal_length, photo.focus, photo.back)
    return {
        **{"focal_length": focal_length, "focus": focus, "aperture": photo.aperture},
        **{"k1": photo.k1, "k2": photo.k2, "back": photo.back, "light_angle": photo.light_angle},
        **{"white_e": photo.white_e, "floor": photo.floor, "origin_m": photo.origin_m},
        **{"reduction": photo.reduction, "margin_columns": 0, "margin_rows": 0},
        **drawing_of(False, focal_length, focus),
        **{f"with_{name}": name not in left for name in EFFECTS},
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


def run_without(
    photo: Photo, left: Collection[str] = (), cache: StageCache | None = None
) -> Outputs:
    """The outputs of `MODEL` without the effects ``left`` out."""
    return run(MODEL, stage_values(photo, left), StageCache() if cache is None else cache).outputs


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


def complete_model(photo: Photo, cache: StageCache | None = None) -> Complete:
    shared = StageCache(depth=len(EFFECTS)) if cache is None else cache
    outputs = run_without(photo, (), shared)
    light, truth = outputs["falloff"], codes(outputs["falloff"])

    def counted(poisson: bool, draw: int) -> Planes:
        return codes(count_electrons(light, photo.white_e, poisson, draw))

    noise = [counted(False, draw) - counted(True, draw) for draw in range(DRAWS)]
    costs = {
        name: root_mean_square(codes(run_without(photo, (name,), shared)["falloff"]) - truth)
        for name in EFFECTS
    }
    costs["poisson"] = root_mean_square(noise)
    return Complete(outputs["counted"], truth, noise[0], costs)


def error_without(left: Collection[str], light: Planes, truth: Planes, poisson: float) -> float:
    """RMS in codes of the ``light`` (3, H, W) of a picture without the effects ``left`` out,
    against the ``truth`` in codes. The noise's share ``poisson``, which is independent, is added in
    squares."""
    return math.hypot(root_mean_square(codes(light) - truth), poisson * ("poisson" in left))


def seconds(stage: Stage, outputs: Outputs, clock: Clock, given: Mapping[str, Value]) -> float:
    """The time that a stage takes here."""
    if stage.reason(given):
        return 0.0
    begun = clock()
    stage.compute(*(outputs[name] for name in stage.after), **{n: given[n] for n in stage.reads})
    return clock() - begun


def savings(photo: Photo, clock: Clock, rounds: int) -> Iterator[dict[str, float]]:
    """The milliseconds that leaving out each effect saves: the stage with it and without it by
    turns, so that a busy moment falls on both; of each, the fastest of all rounds so far counts.
    One more is measured with each result."""
    given, stages = stage_values(photo), {stage.name: stage for stage in MODEL}
    outputs = run_without(photo)
    complete, without = dict.fromkeys(EFFECTS, math.inf), dict.fromkeys(EFFECTS, math.inf)
    saved = dict.fromkeys(EFFECTS, 0.0)
    for _ in range(rounds):
        for name, stage in EFFECTS.items():
            run_here = partial(seconds, stages[stage], outputs, clock)
            complete[name] = min(complete[name], run_here(given))
            without[name] = min(without[name], run_here(stage_values(photo, (name,))))
            saved[name] = 1000.0 * (complete[name] - without[name])
            yield dict(saved)
