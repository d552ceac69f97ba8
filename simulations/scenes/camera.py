"""Interactive Camera Simulator: every stage of image formation at once, on a still life."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.controls import Action, Slider, Toggle, Values
from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.pipeline import Run, StageCache, run
from simulations.engine.scene import Scene
from simulations.models import optics
from simulations.models.aperture_grid import aperture_grid
from simulations.models.distortion import Distortion, undistort_clamped
from simulations.scenes.camera_lens import (
    COLUMNS,
    PITCH_MM,
    ROWS,
    SENSOR_WIDTH_MM,
    bend_rays,
    largest_blur_px,
    pinhole_rays,
    principal_mm_of,
)
from simulations.scenes.camera_plan import PLAN_HEIGHT, PLAN_WIDTH, draw_plan
from simulations.scenes.camera_sensor import develop_ideal, expose, shutter_s, vignette
from simulations.scenes.camera_stages import STAGES, TIERS, parameters, through_lens

DEFAULT_TIER = "layers"
REFERENCE_GRID = 7
"""Points across the lens of the picture that errors are measured against: 37 in all."""

CONTROLS = (
    Slider(
        name="focal_length",
        label="Focal length",
        default=50.0,
        minimum=24.0,
        maximum=135.0,
        step=1.0,
        unit="mm",
    ),
    Slider(
        name="aperture",
        label="Aperture",
        default=5.6,
        minimum=1.4,
        maximum=22.0,
        step=0.1,
        prefix="f/",
    ),
    Slider(
        name="focus",
        label="Focus distance",
        default=3.2,
        minimum=1.0,
        maximum=10.0,
        step=0.1,
        unit="m",
    ),
    Slider(name="k1", label="Distortion k₁", default=0.0, minimum=-0.4, maximum=0.4, step=0.01),
    Slider(
        name="light_angle",
        label="Light angle",
        default=40.0,
        minimum=-80.0,
        maximum=80.0,
        step=1.0,
        unit="°",
    ),
    Slider(
        name="exposure",
        label="Exposure",
        default=0.0,
        minimum=-3.0,
        maximum=3.0,
        step=0.1,
        unit="EV",
    ),
    Slider(
        name="noise_sigma",
        label="Read noise σ",
        default=5.0,
        minimum=0.0,
        maximum=40.0,
        step=1.0,
        unit="codes",
    ),
    Toggle(name="shot_noise", label="Photon shot noise", default=True),
    Action(name="new_noise", labels=("Take it again",) * 8),
)


def depth_of_field_m(values: Values) -> tuple[float, float]:
    """Nearest and farthest depth whose blur is at most one pixel, metres."""
    near, far = optics.depth_of_field(
        values.number("focal_length"),
        values.number("aperture"),
        values.number("focus") * 1000.0,
        PITCH_MM,
    )
    return near / 1000.0, far / 1000.0


def view_of(values: Values) -> float:
    """Angle that the sensor sees from left to right, radians, along the rays that the lens bends.

    Past the fold of a barrel, as far as any ray reaches.
    """
    edge = SENSOR_WIDTH_MM / 2 / principal_mm_of(values)
    ideal, _ = undistort_clamped([(edge, 0.0)], Distortion(k1=values.number("k1")))
    return 2.0 * math.atan(float(ideal[0, 0]))


def psnr_db(picture: Raster, ideal: Raster) -> float:
    """Peak signal-to-noise ratio of two pictures in 8-bit codes; ∞ where they are the same."""
    error = rms_codes(picture, ideal)
    return 20.0 * math.log10(255.0 / error) if error > 0 else math.inf


def shutter_text(seconds: float) -> str:
    """As on a camera's dial: ``1/60`` to two digits, or seconds from a third upwards."""
    return f"1/{float(f'{1 / seconds:.2g}'):.0f}" if seconds < 0.3 else format_number(seconds, 1)


def run_tier(values: Values, tier: str, cache: StageCache) -> Run:
    """All stages, with the parameters that the tier sets."""
    return run(STAGES, values, cache, parameters(values, tier or DEFAULT_TIER))


def render(values: Values, tier: str, cache: StageCache) -> Frame:
    """A photograph of the still life, and the plan of where everything stood."""
    result = run_tier(values, tier, cache)
    photograph: Raster = result.outputs["sRGB"]
    view_rad = view_of(values)
    near, far = depth_of_field_m(values)
    quality = psnr_db(photograph, result.outputs["noiseless picture"])
    return Frame(
        panels=(
            Panel("photograph", "Captured image", PLAN_WIDTH, PLAN_HEIGHT, photograph),
            Panel(
                "plan",
                "From above",
                PLAN_WIDTH,
                PLAN_HEIGHT,
                overlay=draw_plan(values, view_rad, near, far),
            ),
        ),
        readouts=_readouts(values, view_rad, near, far, quality),
        description=_describe(values, view_rad, near, far, quality),
        stages=result.reports,
    )


def error(values: Values, tier: str, cache: StageCache) -> Iterator[Readout]:
    """How far the noiseless picture is from one whose every pixel looks through the whole lens.

    One ray a pixel more with each step; the rays stand on a grid that no tier uses.
    """
    picture: Raster = run_tier(values, tier, cache).outputs["noiseless picture"]
    rays = len(aperture_grid(REFERENCE_GRID))
    for count, truth in enumerate(references(values), start=1):
        codes = format_number(rms_codes(picture, truth), 2)
        label = f"RMS error against {count} of {rays} rays through the lens"
        yield Readout("error", label, codes, "codes of 255", "error")


def references(values: Values) -> Iterator[Raster]:
    """The noiseless picture seen through more and more points of the lens."""
    setting = {n: values.number(n) for n in ("light_angle", "focal_length", "aperture", "focus")}
    rays = bend_rays(pinhole_rays(setting["focal_length"], setting["focus"]), values.number("k1"))
    total = np.zeros((3, ROWS, COLUMNS), np.float32)
    for count, at in enumerate(aperture_grid(REFERENCE_GRID), start=1):
        total += through_lens(rays, at, **setting)
        light = vignette(total / np.float32(count), setting["focal_length"], setting["focus"])
        yield develop_ideal(expose(light, values.number("exposure")))


def rms_codes(picture: Raster, truth: Raster) -> float:
    """Root mean square of the difference in 8-bit codes; both are opaque."""
    error = np.subtract(picture, truth, dtype=np.float32)
    return math.sqrt(float(np.vdot(error, error)) / (0.75 * error.size))


def _readouts(
    values: Values, view_rad: float, near: float, far: float, quality: float
) -> tuple[Readout, ...]:
    setting = (values.number(n) for n in ("focal_length", "aperture", "focus", "exposure"))
    shutter = shutter_s(*setting)
    sensor_mm = principal_mm_of(values)
    return (
        readout("sensor_distance", "Lens to sensor", sensor_mm, "mm", digits=1, role="camera"),
        readout(
            "field_of_view", "Field of view", math.degrees(view_rad), "°", digits=1, role="camera"
        ),
        Readout(
            "depth_of_field", "Sharp from", f"{_metres(near)} to {_metres(far)}", "m", role="ray"
        ),
        readout(
            "largest_blur", "Largest blur", largest_blur_px(values), "px", digits=1, role="ray"
        ),
        Readout("shutter", "Shutter", shutter_text(shutter), "s", role="light"),
        readout("psnr", "PSNR against no noise", quality, "dB", digits=1, role="error"),
    )


def _metres(depth: float) -> str:
    """To a centimetre where that may be as much as the depth of field."""
    return format_number(depth, 2 if depth < 10 else 1)


def _describe(values: Values, view_rad: float, near: float, far: float, quality: float) -> str:
    k1 = values.number("k1")
    lines = "stay straight" if k1 == 0 else f"bow {'outwards' if k1 < 0 else 'inwards'}"
    beyond = "onwards" if math.isinf(far) else f"to {_metres(far)} m"
    noise = "no noise" if math.isinf(quality) else f"noise at {quality:.0f} dB PSNR"
    focal, f_number = values.number("focal_length"), values.number("aperture")
    return (
        f"At {focal:.0f} mm and f/{f_number:.1f} the camera sees {math.degrees(view_rad):.0f}° of "
        "a still life of balls and boxes; it is sharp from "
        f"{_metres(near)} m {beyond}, straight lines {lines}, and the picture has {noise}."
    )


SCENE = Scene(
    id="camera",
    title="Interactive Camera Simulator",
    controls=CONTROLS,
    render=render,
    tiers=tuple(TIERS),
    default_tier=DEFAULT_TIER,
    draft_tier="draft",
    # Not the focus: a coarse picture would look out of focus everywhere.
    drafted=("focal_length", "light_angle"),
    drafted_in={"bent-rays": ("k1",), "aperture-rays": ("aperture", "focus", "k1")},
    tier_labels={
        "draft": "Draft: a ray for four pixels",
        "layers": "Bent picture, blurred layers",
        "bent-rays": "Bent rays, blurred layers",
        "aperture-rays": "12 bent rays a pixel",
    },
    error=error,
)
