"""The thin lens: one distance is sharp, and the still life shows what becomes of the others.

The picture is the camera simulator's without its sensor, so that nothing but the lens can soften
it. Like the camera's it grows as the focus comes nearer and the sensor moves away from the lens.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.controls import Slider, Values
from simulations.engine.drawing import text
from simulations.engine.frame import Frame, Panel, Readout, format_number
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache, run
from simulations.models.lens import thin_lens
from simulations.pictures.still_life.things import THINGS, WALL_DISTANCE, thing_depth
from simulations.scenes.camera.lens import COLUMNS, PITCH_MM, ROWS, largest_blur_px
from simulations.scenes.depth_of_field import drawing
from simulations.scenes.depth_of_field.stages import FIXED, STAGES, TIERS, judge

NEAR_M, FAR_M = thing_depth(THINGS[0]), WALL_DISTANCE
"""The red ball in front and the wall behind: the two ends of the still life."""
DEFAULT_TIER = "layered"
LARGEST_DRAWN_PX = 48.0
"""Wider discs leave nothing to recognise, and take seconds to draw: the picture stops here."""
UNLIT = np.full((ROWS, COLUMNS), 0.35)
"""What stands for a picture where the lens forms none."""

CONTROLS = (
    Slider(
        name="focal_length",
        label="Focal length",
        default=50,
        minimum=24,
        maximum=135,
        step=1,
        unit="mm",
    ),
    Slider(
        name="aperture",
        label="Aperture",
        default=1.4,
        minimum=1.4,
        maximum=22,
        step=0.1,
        prefix="f/",
    ),
    Slider(
        name="focus",
        label="Focus distance",
        default=3.2,
        minimum=0.05,
        maximum=10,
        step=0.05,
        unit="m",
    ),
)


@dataclass(frozen=True, slots=True)
class Sharpness:
    """What the lens makes of the still life at one setting; lengths in millimetres."""

    aperture_mm: float
    """Diameter of the opening."""
    image_mm: float
    """From the lens to the sensor."""
    near_blur_mm: float
    """Disc of the red ball on the sensor."""
    far_blur_mm: float
    """Disc of the wall."""
    near_limit_m: float
    """Nearest distance whose disc is at most a pixel."""
    far_limit_m: float
    """Farthest; ∞ from the hyperfocal distance on."""


def sharpness(focal_mm: float, f_number: float, focus_m: float) -> Sharpness:
    """Raises ValueError for a focus at the focal length or nearer, which has no real image."""
    focus_mm = 1000 * focus_m
    blur = thin_lens.circle_of_confusion_mm(
        focal_mm, f_number, focus_mm, np.array([1000 * NEAR_M, 1000 * FAR_M])
    )
    limits = thin_lens.depth_of_field(focal_mm, f_number, focus_mm, PITCH_MM)
    return Sharpness(
        focal_mm / f_number,
        float(thin_lens.thin_lens_image_distance(focal_mm, focus_mm)),
        float(blur[0]),
        float(blur[1]),
        limits[0] / 1000,
        limits[1] / 1000,
    )


def as_drawn(values: Values) -> Values:
    """The same, or stopped down until no disc in the picture is over `LARGEST_DRAWN_PX`.

    Every disc is as wide as the aperture, so all of them shrink alike, and what is sharp and how
    large things are stays as it is.
    """
    excess = largest_blur_px(Values({**values, **FIXED})) / LARGEST_DRAWN_PX
    f_number = values.number("aperture") * max(excess, 1.0)
    return Values({**values, "aperture": f_number})


def render(values: Values, tier: str, cache: StageCache) -> Frame:
    focal, f_number = values.number("focal_length"), values.number("aperture")
    focus = values.number("focus")
    hyperfocal_m = thin_lens.hyperfocal(focal, f_number, PITCH_MM) / 1000
    if 1000 * focus <= focal:
        return _refuse(values, hyperfocal_m)
    sharp = sharpness(focal, f_number, focus)
    drawn = as_drawn(values)
    done = run(STAGES, drawn, cache, {**FIXED, "tier": tier or DEFAULT_TIER})
    lens = drawing.Lens(
        aperture_mm=sharp.aperture_mm,
        focus_m=focus,
        near=drawing.Blurred("red ball", NEAR_M, sharp.near_blur_mm),
        far=drawing.Blurred("wall", FAR_M, sharp.far_blur_mm),
        sharp_m=(sharp.near_limit_m, sharp.far_limit_m),
    )
    texts = (
        format_number(sharp.near_blur_mm, 3),
        format_number(sharp.near_blur_mm / PITCH_MM, 1),
        format_number(sharp.far_blur_mm, 3),
        format_number(sharp.far_blur_mm / PITCH_MM, 1),
        format_number(sharp.image_mm, 2),
        format_number(sharp.near_limit_m, 2),
        format_number(sharp.far_limit_m, 2),
        format_number(hyperfocal_m, 2),
    )
    capped = f"drawn at f/{drawn.number('aperture'):.3g}: no disc over {LARGEST_DRAWN_PX:.0f} px"
    note = text((drawing.WIDTH / 2, drawing.HEIGHT - 12), capped, "halo", "middle")
    is_capped = drawn.number("aperture") > f_number
    panels = _panels(drawing.lens_diagram(lens), done.outputs["encoded"], note if is_capped else "")
    return Frame(panels, _readouts(texts), describe(values, sharp), done.reports)


def _panels(diagram: str, picture: NDArray[np.uint8], note: str) -> tuple[Panel, Panel]:
    width, height = drawing.WIDTH, drawing.HEIGHT
    return (
        Panel("lens", "The cones of light, schematic", width, height, overlay=diagram),
        Panel("picture", "The picture", width, height, picture, note),
    )


def _readouts(texts: tuple[str, ...]) -> tuple[Readout, ...]:
    names = (
        ("near_mm", "Disc of the ball", "mm", "world"),
        ("near_px", "Disc of the ball", "px", "world"),
        ("far_mm", "Disc of the wall", "mm", "light"),
        ("far_px", "Disc of the wall", "px", "light"),
        ("sensor", "Lens to sensor", "mm", "camera"),
        ("near_limit", "Sharp from", "m", "ray"),
        ("far_limit", "Sharp to", "m", "ray"),
        ("hyperfocal", "Hyperfocal distance", "m", ""),
    )
    return tuple(
        Readout(name, label, shown, unit, role)
        for (name, label, unit, role), shown in zip(names, texts, strict=True)
    )


def _refuse(values: Values, hyperfocal_m: float) -> Frame:
    """The frame for a focus at the focal length or nearer."""
    focal, focus = values.number("focal_length"), values.number("focus")
    place, way = ("at", "parallel") if 1000 * focus == focal else ("inside", "spreading")
    note = text((drawing.WIDTH / 2, drawing.HEIGHT / 2), "no real image", "strong halo", "middle")
    texts = (*("—",) * 7, format_number(hyperfocal_m, 2))
    panels = _panels(drawing.virtual_diagram(focus, focal / 1000), to_rgba8(UNLIT), note)
    description = (
        f"No picture: an object at {1000 * focus:.0f} mm lies {place} the focal length of "
        f"{focal:.0f} mm. Its light leaves the lens {way}, and no sensor can catch an image."
    )
    return Frame(panels, _readouts(texts), description)


def describe(values: Values, sharp: Sharpness) -> str:
    """The picture in one sentence."""
    reach = (
        f"from {format_number(sharp.near_limit_m, 2)} m onwards"
        if math.isinf(sharp.far_limit_m)
        else f"from {format_number(sharp.near_limit_m, 2)} to "
        f"{format_number(sharp.far_limit_m, 2)} m"
    )
    near, far = (
        format_number(blur / PITCH_MM, 1) for blur in (sharp.near_blur_mm, sharp.far_blur_mm)
    )
    focal, f_number = values.number("focal_length"), values.number("aperture")
    return (
        f"At {focal:.0f} mm and f/{f_number:.1f} the lens is focused at "
        f"{values.number('focus'):.2f} m and sharp {reach}; points of the red ball spread to "
        f"discs of {near} pixels, those of the wall to {far}."
    )


def error(values: Values, tier: str, cache: StageCache) -> Iterator[Readout]:
    """How far the picture is from one of rays through the whole lens; of no picture, nothing."""
    focal, focus = values.number("focal_length"), values.number("focus")
    if 1000 * focus <= focal:
        yield Readout("error", "Error", "no picture", "", "error")
        return
    yield from judge(as_drawn(values), tier, cache)


SCENE = Scene(
    id="depth-of-field",
    title="Depth of Field",
    controls=CONTROLS,
    render=render,
    tiers=TIERS,
    default_tier=DEFAULT_TIER,
    # A coarse picture would look like defocus; the dearer tiers are what needs a draft.
    draft_tier=DEFAULT_TIER,
    ladder="depth-of-field",
    error=error,
)
