"""The thin lens: one distance of the still life is sharp, the others are blurred.

The picture is the camera simulator's without its sensor, so that only the lens softens it. It grows
as the focus comes nearer and the sensor moves away from the lens.
"""

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from simulations.engine.controls import Value
from simulations.engine.drawing import text
from simulations.engine.frame import Frame, Panel, Readout, format_number
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.lens import thin_lens
from simulations.scenes._still_life_camera.picture import SCALED, drawing_of
from simulations.scenes._still_life_camera.rays import COLUMNS, PITCH_MM, ROWS
from simulations.scenes.depth_of_field import drawing
from simulations.scenes.depth_of_field.handles import HANDLES
from simulations.scenes.depth_of_field.settings import Settings, has_image
from simulations.scenes.depth_of_field.sharpness import FAR_M, NEAR_M, Sharpness, sharpness
from simulations.scenes.depth_of_field.stages import (
    COARSE,
    COSTLY,
    FINE,
    FIXED,
    QUICK,
    REDUCTIONS,
    STAGES,
    TIERS,
    estimates,
    widest_px,
)

LARGEST_DRAWN_PX = 48.0
"""Largest disc that is drawn: wider ones blur everything and take seconds."""
UNLIT = np.full((round(ROWS / FINE), round(COLUMNS / FINE)), 0.35)
"""The picture if the lens forms none."""


def drawn_f_number(settings: Settings) -> float:
    """The aperture, or stopped down until no disc in the picture is over `LARGEST_DRAWN_PX`.

    The widths of all discs are proportional to the aperture, so the focus and the sizes of things
    stay the same.
    """
    widest = widest_px(settings.focal_length, settings.aperture, settings.focus)
    return settings.aperture * max(widest / LARGEST_DRAWN_PX, 1.0)


def parameters(settings: Settings, tier: str) -> dict[str, Value] | None:
    """The parameters of the stages, fixed or computed; None if there is no picture."""
    if not has_image(settings):
        return None
    f_number = drawn_f_number(settings)
    widest = widest_px(settings.focal_length, f_number, settings.focus)
    return {
        **FIXED,
        **drawing_of(tier == SCALED, settings.focal_length, settings.focus),
        "reduction": REDUCTIONS.get(tier, FINE),
        "repeated": 2 if tier in COSTLY else 1,
        "aperture": f_number,
        "largest_blur": widest,
    }


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The cones of light, and the still life as the lens shows it."""
    focal, f_number, focus = settings.focal_length, settings.aperture, settings.focus
    hyperfocal_m = thin_lens.hyperfocal(focal, f_number, PITCH_MM) / 1000
    if not has_image(settings):
        return _refuse(settings, hyperfocal_m)
    sharp = sharpness(focal, f_number, focus)
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
    marks = outputs["plane of focus"] + _note(settings)
    panels = _panels(drawing.lens_diagram(lens), outputs["encoded"], marks)
    return Frame(panels, _readouts(texts), describe(settings, sharp))


def _note(settings: Settings) -> str:
    """The note on a picture that is drawn with a smaller aperture than set."""
    drawn = drawn_f_number(settings)
    if drawn <= settings.aperture:
        return ""
    capped = f"drawn at f/{drawn:.3g}: no disc over {LARGEST_DRAWN_PX:.0f} px"
    return text((drawing.WIDTH / 2, drawing.HEIGHT - 12), capped, "ground", "middle")


def _panels(diagram: str, picture: NDArray[np.uint8], marks: str) -> tuple[Panel, Panel]:
    width, height = drawing.WIDTH, drawing.HEIGHT
    return (
        Panel("picture", "What the camera sees", width, height, picture, marks, lead=True),
        Panel("lens", "Light through the lens, not to scale", width, height, overlay=diagram),
    )


def _readouts(texts: tuple[str, ...]) -> tuple[Readout, ...]:
    names = (
        ("near_mm", "Blur of the red ball", "mm", "error"),
        ("near_px", "Blur of the red ball", "px", "error"),
        ("far_mm", "Blur of the wall", "mm", "world"),
        ("far_px", "Blur of the wall", "px", "world"),
        ("sensor", "Lens to sensor", "mm", "camera"),
        ("near_limit", "Sharp from", "m", "ray"),
        ("far_limit", "Sharp to", "m", "ray"),
        ("hyperfocal", "Hyperfocal distance", "m", ""),
    )
    return tuple(
        Readout(name, label, shown, unit, role)
        for (name, label, unit, role), shown in zip(names, texts, strict=True)
    )


def _refuse(settings: Settings, hyperfocal_m: float) -> Frame:
    """The frame for a focus at the focal length or nearer."""
    focal, focus = settings.focal_length, settings.focus
    place, way = ("at", "parallel") if 1000 * focus == focal else ("inside", "spreading")
    note = text((drawing.WIDTH / 2, drawing.HEIGHT / 2), "no real image", "strong ground", "middle")
    texts = (*("none",) * 7, format_number(hyperfocal_m, 2))
    panels = _panels(drawing.virtual_diagram(focus, focal / 1000), to_rgba8(UNLIT), note)
    description = (
        f"No picture: an object at {1000 * focus:.0f} mm lies {place} the focal length of "
        f"{focal:.0f} mm. Its light leaves the lens {way}, and no sensor can catch an image."
    )
    return Frame(panels, _readouts(texts), description)


def describe(settings: Settings, sharp: Sharpness) -> str:
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
    seen = " and ".join(
        f"the {name} {'sharp' if blur <= PITCH_MM else 'blurred'}"
        for name, blur in (("red ball", sharp.near_blur_mm), ("wall", sharp.far_blur_mm))
    )
    return (
        f"Balls and boxes on a chequered floor, {seen}. At {settings.focal_length:.0f} mm and "
        f"f/{settings.aperture:.1f} the lens is focused at {settings.focus:.2f} m and sharp "
        f"{reach}; points of the red ball spread to discs of {near} pixels, those of the wall to "
        f"{far}."
    )


def estimate(settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """Error of the picture against rays through the whole lens, if there is a picture."""
    if not has_image(settings):
        yield Readout("error", "Error", "no picture", "", "error")
        return
    setting = (settings.focal_length, drawn_f_number(settings), settings.focus)
    yield from estimates(outputs["encoded"], outputs["pinhole rays"], *setting)


SCENE = Scene(
    id="depth-of-field",
    title="Depth of Field",
    settings=Settings,
    draw=draw,
    formula=thin_lens.circle_of_confusion_mm,
    stages=STAGES,
    handles=HANDLES,
    parameters=parameters,
    tiers=TIERS,
    default_tier="layered",
    own_drafts={SCALED: ("focus",), COARSE: ("focal_length",), QUICK: ("aperture",)},
    ladder="depth-of-field",
    estimate=estimate,
)
