"""Interactive Camera Simulator: every stage of image formation at once, on a still life, and a plan
of camera, wedge of view, objects, and the planes in focus."""

import math
from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from simulations.engine import drawing
from simulations.engine.accuracy import Accuracy
from simulations.engine.drafting import polar, swatch_polygon
from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.color.srgb import encode_srgb
from simulations.models.distortion.lens_model import Distortion, undistort_clamped
from simulations.models.error_measures import decibels
from simulations.models.lens import thin_lens
from simulations.models.lens.aperture import aperture_grid
from simulations.models.light.raycasting import Box, Sphere
from simulations.scenes.camera.lens import Settings, after_step, blur_of, view_of
from simulations.scenes.camera.stages import (
    LEVELS,
    REFERENCE_GRID,
    STAGES,
    parameters,
    references,
    rms_codes,
    shutter_s,
)
from simulations.world.depth import ray_depth
from simulations.world.still_life import OBJECTS, WALL_DISTANCE, SceneObject
from simulations.world.still_life_camera import (
    PITCH_MM,
    SENSOR_HEIGHT_MM,
    SENSOR_WIDTH_MM,
    principal_mm,
)

SIZE = WIDTH, HEIGHT = 400.0, 267.0  # of both panels: the 3 : 2 of the sensor
UNITS_PER_METRE = 27.0
CAMERA_ROW = HEIGHT - 26.0  # on which the lens is; the floor recedes upwards
UNITS_BEHIND_THE_WALL = 10.0  # per metre of focus behind the wall
FOCUS_COLUMN = WIDTH - 20.0  # of the mark of the distance in focus
EDGE_DEPTH = 7.5  # of the mark of the edge of the field of view, metres: clear of all objects
# Distance of the centre of the lamp's circle, and its radius, metres.
STILL_LIFE_MIDDLE, LAMP_DISTANCE = 3.9, 3.5


def units_per_metre(back: float) -> float:
    """The plan shrinks as the camera steps back by so many metres, so that the wall stays in it."""
    return UNITS_PER_METRE * WALL_DISTANCE / (WALL_DISTANCE + back)


def on_plan(x: float, y: float, back: float = 0.0) -> Point:
    """View box coordinates of a point ``x`` metres to the right, ``y`` metres away from the
    camera's place before its step back."""
    units = units_per_metre(back)
    return WIDTH / 2 + units * x, CAMERA_ROW - units * (y + back)


def focus_at(settings: Settings, _outputs: object = None) -> Point:
    """The mark of the distance in focus; metres are shorter behind the wall."""
    behind = max(settings.focus - WALL_DISTANCE, 0.0)
    row = on_plan(0, settings.focus - behind, settings.back)[1]
    return FOCUS_COLUMN, row - UNITS_BEHIND_THE_WALL * behind


def edge_at(settings: Settings, _outputs: object = None) -> Point:
    """The mark on the left edge of the field of view."""
    half_tan = math.tan(view_of(after_step(settings)) / 2)
    return across_view(EDGE_DEPTH + settings.back, half_tan, settings.back)[0]


def lamp_at(settings: Settings, _outputs: object = None, distance: float = LAMP_DISTANCE) -> Point:
    """The lamp, or a point nearer to the middle of the still life."""
    angle = math.radians(settings.light_angle)
    nearer = distance * math.cos(angle)
    return on_plan(distance * math.sin(angle), STILL_LIFE_MIDDLE - nearer, settings.back)


def across_view(depth: float, half_tan: float, back: float) -> tuple[Point, Point]:
    """Left and right end of the field of view at ``depth`` from the camera."""
    away, reach = depth - back, depth * half_tan
    return on_plan(-reach, away, back), on_plan(reach, away, back)


def plan(
    settings: Settings, focal_length: float, view_rad: float, near: float, far: float
) -> Iterator[str]:
    """Seen from above; ``focal_length`` after the step, depth of field ``near`` to ``far``, in
    metres."""
    half_tan, back = math.tan(view_rad / 2), settings.back
    lens, wall = on_plan(0, 0), on_plan(0, WALL_DISTANCE)[1]
    for end in across_view(WALL_DISTANCE + back, half_tan, back):
        yield drawing.line(lens, end, "camera thin")
    yield drawing.dot(edge_at(settings), "camera")
    yield from in_focus(settings, half_tan, near, far)
    yield drawing.line((8.0, wall), (WIDTH - 8.0, wall), "world bold")
    yield drawing.text((10, wall - 7), f"wall, {WALL_DISTANCE + back:.3g} m", "world small")
    yield swatches(back)
    # The lamp's direction as an arrow to the middle of the still life, on a circle around it.
    start = lamp_at(settings)
    yield drawing.arrow(start, lamp_at(settings, None, 2.3), "light bold")
    yield drawing.circle(start, 5.0, "light solid")
    x, row = lens
    angle = f"{math.degrees(view_rad):.0f}°"
    caption = f"{angle} at {focal_length:.0f} mm" if back else angle
    yield drawing.rectangle((x - 13, row + 5), 26, 15, "camera fill")
    yield drawing.rectangle((x - 6, row - 1), 12, 6, "camera solid")
    yield drawing.text((x + 20, row + 17), caption, "camera strong")


def in_focus(settings: Settings, half_tan: float, near: float, far: float) -> Iterator[str]:
    focus, back = settings.focus, settings.back
    first, last = (min(limit, WALL_DISTANCE + back) for limit in (near, far))
    if last > first:
        front, rear = (across_view(depth, half_tan, back) for depth in (first, last))
        yield drawing.polygon((*front, *reversed(rear)), "ray fill faint")
    if focus <= WALL_DISTANCE:
        yield drawing.line(*across_view(focus + back, half_tan, back), "ray bold")
    wall = on_plan(0, WALL_DISTANCE)[1]
    mark = focus_at(settings)
    row, label = mark[1], f"focus {format_number(focus + back, 1)} m"
    baseline = row - 5 if row > wall + 20 else row + 15  # clear of the wall's line
    if focus <= WALL_DISTANCE:
        yield drawing.line((4, row), (WIDTH - 4, row), "ray thin dashed faint")
    else:
        label, baseline = f"{label}, behind the wall", wall - 7
    yield drawing.text((FOCUS_COLUMN - 16, baseline), label, "ray ground", "end")
    yield drawing.dot(mark, "ray")


@lru_cache(maxsize=2)  # the same until the camera steps back
def swatches(back: float) -> str:
    return "".join(swatch(item, back) for item in OBJECTS)


def swatch(item: SceneObject, back: float) -> str:
    """The object in its own colour, which distinguishes it from the others."""
    match item.solid:
        case Sphere(centre=(x, y, _), radius=radius):
            reach, middle = radius * units_per_metre(back), on_plan(x, y, back)
            turns = np.linspace(0.0, 2.0 * math.pi, 36, endpoint=False)
            outline = [polar(middle, reach, float(turn)) for turn in turns]
        case Box() as box:
            x, y = box.size[0] / 2, box.size[1] / 2
            local = ((-x, -y, 0.0), (x, -y, 0.0), (x, y, 0.0), (-x, y, 0.0))
            corners = [np.array(corner) @ box.world_to_box + box.centre for corner in local]
            outline = [on_plan(float(corner[0]), float(corner[1]), back) for corner in corners]
    return swatch_polygon(outline, encode_srgb(item.albedo).tolist())


def shutter_text(seconds: float) -> str:
    """The time as on a camera's dial: ``1/60`` to two digits, or seconds from a third upwards."""
    return f"1/{float(f'{1 / seconds:.2g}'):.0f}" if seconds < 0.3 else format_number(seconds, 1)


def metres(depth: float) -> str:
    """Metres, to a centimetre below 10 m, as the depth of field may be as small."""
    return format_number(depth, 2 if depth < 10 else 1)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """A photograph of the still life, and a plan of the scene."""
    photograph: Raster = outputs["sRGB"]
    now = after_step(settings)
    focal, aperture, focus = now.focal_length, now.aperture, now.focus
    view_rad, view = view_of(now), math.degrees(view_of(now))
    limits = thin_lens.depth_of_field(focal, aperture, focus * 1000.0, PITCH_MM)
    near, far = (limit / 1000.0 for limit in limits)
    quality = decibels((rms_codes(photograph, outputs["noiseless picture"]) / 255.0) ** 2)
    above = "".join(plan(settings, focal, view_rad, near, far))
    behind_mm, title = principal_mm(focal, focus), "What the camera records"
    shutter = shutter_text(shutter_s(focal, aperture, focus, now.exposure))
    sharp = f"{metres(near)} to {metres(far)}"
    lines = "stay straight" if now.k1 == 0 else f"bow {'outwards' if now.k1 < 0 else 'inwards'}"
    beyond = "onwards" if math.isinf(far) else f"to {metres(far)} m"
    noise = "no noise" if math.isinf(quality) else f"noise at {quality:.0f} dB PSNR"
    step = f", {now.back:.1f} m farther back," if now.back else ""
    return Frame(
        (
            Panel("photograph", title, *SIZE, photograph, lead=True),
            Panel("plan", "From above", *SIZE, overlay=above),
        ),
        (
            readout("sensor_distance", "Lens to sensor", behind_mm, "mm", digits=1, role="camera"),
            readout("field_of_view", "Field of view", view, "°", digits=1, role="camera"),
            Readout("depth_of_field", "Sharp from", sharp, "m", role="ray"),
            readout("largest_blur", "Largest blur", blur_of(now), "px", digits=1, role="ray"),
            Readout("shutter", "Shutter", shutter, "s", role="light"),
            readout("psnr", "PSNR against no noise", quality, "dB", digits=1, role="error"),
        ),
        f"At {focal:.0f} mm and f/{aperture:.1f}{step} the camera sees {view:.0f}° of a still life "
        f"of balls and boxes; it is sharp from {metres(near)} m {beyond}, straight lines {lines}, "
        f"and the picture has {noise}.",
    )


def estimate(settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """Error of the noiseless picture against rays through the whole lens.

    Each step adds a ray per pixel; the rays form a grid that no tier uses.
    """
    rays = len(aperture_grid(REFERENCE_GRID))
    for count, truth in enumerate(references(after_step(settings)), start=1):
        codes = format_number(rms_codes(outputs["noiseless picture"], truth), 2)
        label = f"RMS error against {count} of {rays} rays through the lens"
        yield Readout("error", label, codes, "codes of 255", role="error")


def middle(_settings: Settings, _outputs: Outputs) -> Point:
    return (WIDTH / 2, HEIGHT / 2)


def focus_on(settings: Settings, place: Point) -> dict[str, float]:
    """Focus on the point that the lens images at a place of the photograph, if any ray arrives
    there."""
    now = after_step(settings)
    principal = principal_mm(now.focal_length, now.focus)
    across = (place[0] / WIDTH - 0.5) * SENSOR_WIDTH_MM / principal
    down = (place[1] / HEIGHT - 0.5) * SENSOR_HEIGHT_MM / principal
    ideal, reached = undistort_clamped([(across, down)], Distortion(k1=settings.k1))
    if not reached.all():
        return {}
    return {"focus": ray_depth((*ideal[0], 1.0), settings.back) - settings.back}


SCENE = Scene(
    "camera",
    "Interactive Camera Simulator",
    Settings,
    draw,
    STAGES,
    (
        Handle(
            "aim", "photograph", "Object to focus on", ("focus",), middle, focus_on, reach="aim"
        ),
        Handle("focus", "plan", "Distance in focus", ("focus",), focus_at, role="ray"),
        Handle(
            "edge", "plan", "Edge of the field of view", ("focal_length",), edge_at, role="camera"
        ),
        Handle("lamp", "plan", "Lamp", ("light_angle",), lamp_at, role="light"),
    ),
    accuracy=Accuracy(levels=LEVELS, default="layers", estimate=estimate, unit="codes"),
    parameters=parameters,
)
