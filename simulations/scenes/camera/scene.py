"""Interactive Camera Simulator: every stage of image formation at once, on a still life."""

import math
from collections.abc import Iterator
from dataclasses import asdict

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.error_measures import decibels
from simulations.models.lens import thin_lens
from simulations.models.lens.aperture_grid import aperture_grid
from simulations.scenes._still_life_camera.picture import SCALED, drawing_of, through_lens
from simulations.scenes._still_life_camera.rays import (
    COLUMNS,
    PITCH_MM,
    ROWS,
    largest_blur_px,
    principal_mm,
    sensor_rays,
)
from simulations.scenes.camera.dolly import after_step
from simulations.scenes.camera.handles import HANDLES
from simulations.scenes.camera.lens import bend_rays, half_view_tangent, margin_px, widest_barrel
from simulations.scenes.camera.plan import PLAN_HEIGHT, PLAN_WIDTH, PlanView, draw_plan
from simulations.scenes.camera.sensor import develop_ideal, expose, shutter_s, vignette
from simulations.scenes.camera.settings import STRONGEST_BARREL, Settings
from simulations.scenes.camera.stages import BOWED, STAGES, TIERS

REFERENCE_GRID = 7
"""Points across the lens of the picture that errors are measured against: 37 in all."""


def parameters(settings: Settings, tier: str) -> dict[str, Value]:
    """The parameters of the stages: set by the tier, or computed from the settings."""
    draft, now = tier == SCALED, after_step(settings)
    accuracy, across, down = TIERS[tier if tier in TIERS else "layers"], 0, 0
    if not accuracy.bent_rays:
        lens = now.focal_length, now.focus
        widest = widest_barrel(*lens, STRONGEST_BARREL) if tier == BOWED else now.k1
        across, down = margin_px(*lens, widest)
    return {
        **asdict(accuracy),
        **drawing_of(draft, now.focal_length, now.focus),
        "focal_length": now.focal_length,
        "focus": now.focus,
        "margin_columns": across,
        "margin_rows": down,
        "largest_blur": blur_of(now),
    }


def blur_of(settings: Settings) -> float:
    """The widest disc of confusion in the picture, in pixels."""
    focal, aperture, focus = settings.focal_length, settings.aperture, settings.focus
    return largest_blur_px(focal, aperture, focus, settings.k1, settings.back)


def depth_of_field_m(settings: Settings) -> tuple[float, float]:
    """Nearest and farthest depth whose blur is at most one pixel, metres."""
    near, far = thin_lens.depth_of_field(
        settings.focal_length, settings.aperture, settings.focus * 1000.0, PITCH_MM
    )
    return near / 1000.0, far / 1000.0


def view_of(settings: Settings) -> float:
    """Angle that the sensor sees from left to right, radians."""
    return 2.0 * math.atan(half_view_tangent(settings.focal_length, settings.focus, settings.k1))


def shutter_text(seconds: float) -> str:
    """The time as on a camera's dial: ``1/60`` to two digits, or seconds from a third upwards."""
    return f"1/{float(f'{1 / seconds:.2g}'):.0f}" if seconds < 0.3 else format_number(seconds, 1)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """A photograph of the still life, and a plan of the scene."""
    photograph: Raster = outputs["sRGB"]
    now = after_step(settings)
    view_rad = view_of(now)
    near, far = depth_of_field_m(now)
    quality = decibels((rms_codes(photograph, outputs["noiseless picture"]) / 255.0) ** 2)
    plan = draw_plan(
        PlanView(
            focus=settings.focus,
            light_angle=settings.light_angle,
            focal_length=now.focal_length,
            view_rad=view_rad,
            near=near,
            far=far,
            back=now.back,
        )
    )
    return Frame(
        panels=(
            Panel(
                "photograph",
                "What the camera records",
                PLAN_WIDTH,
                PLAN_HEIGHT,
                photograph,
                lead=True,
            ),
            Panel("plan", "From above", PLAN_WIDTH, PLAN_HEIGHT, overlay=plan),
        ),
        readouts=_readouts(now, view_rad, near, far, quality),
        description=_describe(now, view_rad, near, far, quality),
    )


def estimate(settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """Error of the noiseless picture against rays through the whole lens.

    Each step adds a ray per pixel; the rays form a grid that no tier uses.
    """
    picture: Raster = outputs["noiseless picture"]
    rays = len(aperture_grid(REFERENCE_GRID))
    for count, truth in enumerate(references(after_step(settings)), start=1):
        codes = format_number(rms_codes(picture, truth), 2)
        label = f"RMS error against {count} of {rays} rays through the lens"
        yield Readout("error", label, codes, "codes of 255", "error")


def references(settings: Settings) -> Iterator[Raster]:
    """The noiseless picture seen through more and more points of the lens."""
    focal, aperture, focus = settings.focal_length, settings.aperture, settings.focus
    rays = bend_rays(sensor_rays(focal, focus), settings.k1)
    total = np.zeros((3, ROWS, COLUMNS), np.float32)
    for count, at in enumerate(aperture_grid(REFERENCE_GRID), start=1):
        total += through_lens(rays, at, settings.light_angle, focal, aperture, focus, settings.back)
        light = vignette(total / np.float32(count), focal, focus)
        yield develop_ideal(expose(light, settings.exposure))


def rms_codes(picture: Raster, truth: Raster) -> float:
    """Root mean square of the difference in 8-bit codes; both are opaque."""
    error = np.subtract(picture, truth, dtype=np.float32)
    return math.sqrt(float(np.vdot(error, error)) / (0.75 * error.size))


def _readouts(
    settings: Settings, view_rad: float, near: float, far: float, quality: float
) -> tuple[Readout, ...]:
    focal, focus = settings.focal_length, settings.focus
    shutter = shutter_s(focal, settings.aperture, focus, settings.exposure)
    sensor_mm = principal_mm(focal, focus)
    return (
        readout("sensor_distance", "Lens to sensor", sensor_mm, "mm", digits=1, role="camera"),
        readout(
            "field_of_view", "Field of view", math.degrees(view_rad), "°", digits=1, role="camera"
        ),
        Readout(
            "depth_of_field", "Sharp from", f"{_metres(near)} to {_metres(far)}", "m", role="ray"
        ),
        readout("largest_blur", "Largest blur", blur_of(settings), "px", digits=1, role="ray"),
        Readout("shutter", "Shutter", shutter_text(shutter), "s", role="light"),
        readout("psnr", "PSNR against no noise", quality, "dB", digits=1, role="error"),
    )


def _metres(depth: float) -> str:
    """Metres, to a centimetre below 10 m, as the depth of field may be as small."""
    return format_number(depth, 2 if depth < 10 else 1)


def _describe(settings: Settings, view_rad: float, near: float, far: float, quality: float) -> str:
    k1 = settings.k1
    lines = "stay straight" if k1 == 0 else f"bow {'outwards' if k1 < 0 else 'inwards'}"
    beyond = "onwards" if math.isinf(far) else f"to {_metres(far)} m"
    noise = "no noise" if math.isinf(quality) else f"noise at {quality:.0f} dB PSNR"
    step = f", {settings.back:.1f} m farther back," if settings.back else ""
    return (
        f"At {settings.focal_length:.0f} mm and f/{settings.aperture:.1f}{step} the camera sees "
        f"{math.degrees(view_rad):.0f}° of a still life of balls and boxes; it is sharp from "
        f"{_metres(near)} m {beyond}, straight lines {lines}, and the picture has {noise}."
    )


SCENE = Scene(
    id="camera",
    title="Interactive Camera Simulator",
    settings=Settings,
    draw=draw,
    stages=STAGES,
    handles=HANDLES,
    parameters=parameters,
    tiers=tuple(TIERS),
    default_tier="layers",
    draft_tier="draft",
    drafted=("focal_length", "light_angle", "back"),
    drafted_in={"aperture-rays": ("aperture",)},
    own_drafts={SCALED: ("focus",), BOWED: ("k1",)},
    tier_labels={
        "draft": "Draft: a ray for four pixels",
        "layers": "Bent picture, blurred layers",
        "bent-rays": "Bent rays, blurred layers",
        "aperture-rays": "12 bent rays a pixel",
    },
    estimate=estimate,
)
