"""The thin lens: one distance of the still life is sharp, the others are blurred.

The picture is the camera simulator's without its sensor, so that only the lens softens it. It grows
as the focus comes nearer and the sensor moves away from the lens.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from simulations.engine.accuracy import Accuracy
from simulations.engine.controls import Value
from simulations.engine.drawing import text
from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.engine.settings import action, slider
from simulations.engine.stages import Outputs
from simulations.models.lens import thin_lens
from simulations.scenes.depth_of_field import drawing, stages
from simulations.scenes.depth_of_field.stages import HEIGHT, WIDTH
from simulations.world.depth import ray_depth
from simulations.world.still_life_camera import (
    COLUMNS,
    HANDLE_TANGENT,
    PITCH_MM,
    ROWS,
    SCALED,
    SENSOR_HEIGHT_MM,
    SENSOR_WIDTH_MM,
    drawing_of,
    principal_mm,
)

LARGEST_DRAWN_PX = 48.0  # largest disc that is drawn: wider ones blur everything and take seconds
UNLIT = np.full((round(ROWS / stages.FINE), round(COLUMNS / stages.FINE)), 0.35)
"""The picture if the lens forms none."""


@dataclass(frozen=True, slots=True)
class Settings:
    focal_length: float = slider("Focal length", 50, 24, 135, 1, unit="mm")
    aperture: float = slider("Aperture", 1.4, 1.4, 22, 0.1, prefix="f/")
    focus: float = slider("Focus distance", 3.2, 0.05, 10, 0.05, unit="m", arrival=1.8)
    rack: int = action("Sweep the focus", "Pause", drives="focus", effect="play", seconds=10.0)

    @property
    def has_image(self) -> bool:
        """Whether the light of the distance in focus meets behind the lens."""
        return 1000 * self.focus > self.focal_length


def diagram_f_number(settings: Settings) -> float:
    """The aperture, or stopped down until no disc in the picture is over `LARGEST_DRAWN_PX`.

    The widths of all discs are proportional to the aperture, so the focus and the sizes of objects
    stay the same.
    """
    widest = stages.widest_px(settings.focal_length, settings.aperture, settings.focus)
    return settings.aperture * max(widest / LARGEST_DRAWN_PX, 1.0)


def parameters(settings: Settings, level: str) -> dict[str, Value] | None:
    """The parameters of the stages, fixed or computed; None if there is no picture."""
    if not settings.has_image:
        return None
    f_number = diagram_f_number(settings)
    return {
        **stages.FIXED,
        **drawing_of(level == SCALED, settings.focal_length, settings.focus),
        "repeated": 2 if level in stages.COSTLY else 1,
        "aperture": f_number,
        "largest_blur": stages.widest_px(settings.focal_length, f_number, settings.focus),
    }


def draw(settings: Settings, outputs: Outputs) -> Frame:
    focal, f_number, focus = settings.focal_length, settings.aperture, settings.focus
    hyperfocal_m = thin_lens.hyperfocal(focal, f_number, PITCH_MM) / 1000
    if not settings.has_image:
        note = text((WIDTH / 2, HEIGHT / 2), "no real image", "strong ground", "middle")
        panels = side_by_side(drawing.virtual_diagram(focus, focal / 1000), to_rgba8(UNLIT), note)
        return Frame(panels, readouts(None, hyperfocal_m), describe_refusal(settings))
    sharp, drawn, marks = stages.sharpness(focal, f_number, focus), diagram_f_number(settings), ""
    if drawn > f_number:
        capped = f"drawn at f/{drawn:.3g}: no disc over {LARGEST_DRAWN_PX:.0f} px"
        marks = text((WIDTH / 2, HEIGHT - 12), capped, "ground", "middle")
    marks = outputs["plane of focus"] + marks
    panels = side_by_side(drawing.lens_diagram(sharp, focus), outputs["encoded"], marks)
    return Frame(panels, readouts(sharp, hyperfocal_m), describe(settings, sharp))


def side_by_side(diagram: str, picture: Raster, marks: str) -> tuple[Panel, Panel]:
    title = "Light through the lens, not to scale"
    return (
        Panel("picture", "What the camera sees", WIDTH, HEIGHT, picture, marks, lead=True),
        Panel("lens", title, WIDTH, HEIGHT, overlay=diagram),
    )


def readouts(sharp: stages.Sharpness | None, hyperfocal_m: float) -> tuple[Readout, ...]:
    """The readouts; without an image all but the last are "none"."""
    near, far = (sharp.near_blur_mm, sharp.far_blur_mm) if sharp else (0.0, 0.0)
    image, *limits = (
        (sharp.image_mm, sharp.near_limit_m, sharp.far_limit_m) if sharp else (0.0, 0.0, 0.0)
    )
    rows = (
        ("near_px", "Blur of the red ball", near / PITCH_MM, 1, "px", "error"),
        ("far_px", "Blur of the wall", far / PITCH_MM, 1, "px", "world"),
        ("sensor", "Lens to sensor", image, 2, "mm", "camera"),
        ("near_limit", "Sharp from", limits[0], 2, "m", "ray"),
        ("far_limit", "Sharp to", limits[1], 2, "m", "ray"),
    )
    return (
        *(
            Readout(name, label, format_number(value, digits) if sharp else "none", unit, role=role)
            for name, label, value, digits, unit, role in rows
        ),
        readout("hyperfocal", "Hyperfocal distance", hyperfocal_m, "m"),
    )


def describe_refusal(settings: Settings) -> str:
    """Why a focus at the focal length or nearer has no picture."""
    focal, focus_mm = settings.focal_length, 1000 * settings.focus
    place, behaviour = ("at", "parallel") if focus_mm == focal else ("inside", "spreading")
    return (
        f"No picture: an object at {focus_mm:.0f} mm lies {place} the focal length of "
        f"{focal:.0f} mm. Its light leaves the lens {behaviour}, and no sensor can catch an image."
    )


def describe(settings: Settings, sharp: stages.Sharpness) -> str:
    near_limit, far_limit = (
        format_number(limit, 2) for limit in (sharp.near_limit_m, sharp.far_limit_m)
    )
    onwards = math.isinf(sharp.far_limit_m)
    reach = f"from {near_limit} m onwards" if onwards else f"from {near_limit} to {far_limit} m"
    near, far = (
        format_number(blur / PITCH_MM, 1) for blur in (sharp.near_blur_mm, sharp.far_blur_mm)
    )
    visible = " and ".join(
        f"the {name} {'sharp' if blur <= PITCH_MM else 'blurred'}"
        for name, blur in (("red ball", sharp.near_blur_mm), ("wall", sharp.far_blur_mm))
    )
    return (
        f"Balls and boxes on a chequered floor, {visible}. At {settings.focal_length:.0f} mm and "
        f"f/{settings.aperture:.1f} the lens is focused at {settings.focus:.2f} m and sharp "
        f"{reach}; points of the red ball spread to discs of {near} pixels, those of the wall to "
        f"{far}."
    )


def estimate(settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """Error of the picture against rays through the whole lens, if there is a picture."""
    if not settings.has_image:
        yield Readout("error", "Error", "no picture", "", role="error")
        return
    setting = (settings.focal_length, diagram_f_number(settings), settings.focus)
    yield from stages.estimates(outputs["encoded"], outputs["pinhole rays"], *setting)


def floor_mark(settings: Settings, _outputs: Outputs) -> Point | None:
    focal, focus = settings.focal_length, settings.focus
    row = stages.floor_row(focal, focus) if settings.has_image else None
    across = HANDLE_TANGENT * stages.units_per_tangent(focal, focus) if row is not None else 0.0
    return None if row is None else (min(WIDTH / 2 + across, WIDTH), row)


def rim_mark(settings: Settings, _outputs: Outputs) -> Point | None:
    """The upper end of the opening, if the lens forms an image."""
    half = drawing.half_opening(settings.focal_length / settings.aperture)
    return (drawing.LENS_X, drawing.AXIS_Y - half) if settings.has_image else None


def focus_on(settings: Settings, place: Point) -> dict[str, Value]:
    """Focus on the object at a place of the picture; not available without an image."""
    if not settings.has_image:
        return {}
    across = (place[0] / WIDTH - 0.5) * SENSOR_WIDTH_MM
    down = (place[1] / HEIGHT - 0.5) * SENSOR_HEIGHT_MM
    principal = principal_mm(settings.focal_length, settings.focus)
    return {"focus": ray_depth((across / principal, down / principal, 1.0))}


def middle(_settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return WIDTH / 2, HEIGHT / 2


def focus_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return drawing.column(settings.focus), drawing.AXIS_Y


APERTURE, FOCUS = ("aperture",), ("focus",)
HANDLES: tuple[Handle[Settings], ...] = (
    Handle("aim", "picture", "Object to focus on", FOCUS, middle, focus_on, reach="aim"),
    Handle("floor", "picture", "Plane of focus", FOCUS, floor_mark, role="ray"),
    Handle("focus", "lens", "Point in focus", FOCUS, focus_at, role="ray", reversed=FOCUS),
    Handle(
        "rim", "lens", "Rim of the opening", APERTURE, rim_mark, role="camera", reversed=APERTURE
    ),
)
SCENE = Scene(
    "depth-of-field",
    "Depth of Field",
    Settings,
    draw,
    stages.STAGES,
    HANDLES,
    accuracy=Accuracy(
        levels=stages.LEVELS,
        default="layered",
        ladder="depth-of-field",
        estimate=estimate,
        unit="codes",
    ),
    parameters=parameters,
    formula=thin_lens.circle_of_confusion_mm,
)
