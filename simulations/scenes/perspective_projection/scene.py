"""Perspective projection: one point of the room, one camera, with or without division by depth."""

from dataclasses import dataclass

import numpy as np

from simulations.engine import drawing
from simulations.engine.accuracy import Accuracy
from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.scene import Scene
from simulations.engine.settings import slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import clip_to_rectangle
from simulations.models.projection.pinhole import project
from simulations.scenes.perspective_projection import top_view
from simulations.scenes.perspective_projection.view import (
    HALF_HEIGHT_PX,
    HALF_WIDTH_PX,
    METRES_PER_PX,
    Camera,
    Projection,
    in_picture,
    outline,
    projection_of,
    room_axes,
)
from simulations.world.room import LEVELS, photograph

WIDTH, HEIGHT = 400.0, 300.0  # of the picture's view box
IMAGE_SCALE = 2.0  # view box units per pixel
ALMOST_PARALLEL = 1e-4  # perspective of the picture at 0 %: to a hundredth of a pixel the same
CENTRE = np.array([200.0, 150.0])  # the principal point in the picture's view box
LETTER_LEAST = 14.0  # side of a rectangle, in view box units, from which it is named
PIXELS = (-50, 50)  # columns and rows with a mark
SAME_PX = 0.05  # distances below this are printed as 0.0 px


@dataclass(frozen=True, slots=True)
class Settings:
    depth: float = slider("Depth (Z)", 5.0, -2, 20, 0.1, unit="m")
    focal_length: float = slider("Focal length", 80, 20, 200, 1, unit="px")
    point_x: float = slider("Right (X)", 1.0, -3, 3, 0.05, unit="m")
    point_y: float = slider("Down (Y)", 0.5, -1, 2, 0.05, unit="m")
    perspective: float = slider("Perspective", 100, 0, 100, 1, unit="%")


def view_of(settings: Settings) -> Projection:
    camera = Camera(settings.focal_length, settings.perspective / 100.0)
    return projection_of(settings.point_x, settings.point_y, settings.depth, camera)


def picture(
    depth: float,
    focal_length: float,
    point_x: float,
    point_y: float,
    perspective: float,
    columns: int,
) -> Raster:
    """The room through the camera."""
    camera = Camera(focal_length, max(perspective / 100.0, ALMOST_PARALLEL))
    view = projection_of(point_x, point_y, depth, camera)
    pose = room_axes(view)
    pose[2, 3] -= camera.centre_m
    rays_per_px = columns / (2.0 * HALF_WIDTH_PX)
    return photograph(rays_per_px * focal_length / camera.perspective, pose, columns)


def place(x: float, y: float) -> Floats:
    """Pixel to the picture's view box."""
    return CENTRE + IMAGE_SCALE * np.array([x, y])


def image_panel(view: Projection, raster: Raster) -> Panel:
    overlay = "".join(
        (
            "" if view.full else in_perspective(view),
            axes(),
            image_point(view) if view.visible else no_image(view),
        )
    )
    return Panel("image", "The picture", WIDTH, HEIGHT, raster, overlay, lead=True)


def axes() -> str:
    """The axes through the principal point, and their pixels and names along the edges of the
    picture."""
    right, bottom, row = WIDTH - 8.0, HEIGHT - 8.0, HEIGHT - 11.0
    columns, rows = [place(x, 0)[0] for x in PIXELS], [place(0, y)[1] for y in PIXELS]
    ticks = [[(x, HEIGHT), (x, HEIGHT - 6.0)] for x in columns]
    ticks += [[(0.0, y), (6.0, y)] for y in rows]
    words = [format_number(pixel, 0) for pixel in PIXELS]
    return "".join(
        (
            drawing.arrow((8.0, CENTRE[1]), (right, CENTRE[1]), "muted thin"),
            drawing.arrow((CENTRE[0], 8.0), (CENTRE[0], bottom), "muted thin"),
            drawing.path(ticks, "muted thin"),
            *(
                drawing.text((x, row), word, "muted small ground", "middle")
                for x, word in zip(columns, words, strict=True)
            ),
            *(
                drawing.text((10.0, y + 4.0), word, "muted small ground")
                for y, word in zip(rows, words, strict=True)
            ),
            drawing.text((right, row), "x, px", "muted small ground", "end"),
            drawing.text((10.0, row), "y, px", "muted small ground"),
        )
    )


def image_point(view: Projection) -> str:
    """The image of the point, or an arrow towards it if it is outside the picture."""
    if view.in_picture:
        spot = place(view.x, view.y)
        corners = [CENTRE, place(view.x, 0), spot, place(0, view.y)]
        return (
            drawing.polygon(corners, "image fill")
            + (letters(view) if view.full else "")
            + drawing.line(CENTRE, spot, "ray")
            + drawing.dot(spot, "image", 5.0)
        )
    reach = min(
        limit / abs(value)
        for limit, value in ((HALF_WIDTH_PX, view.x), (HALF_HEIGHT_PX, view.y))
        if value != 0.0
    )
    tip, tail = (place(view.x * reach * s, view.y * reach * s) for s in (0.97, 0.82))
    numbers = f"({format_number(view.x, 1)}, {format_number(view.y, 1)}) px"
    return drawing.arrow(tail, tip, "image bold", head=12.0) + message(
        f"outside the picture: {numbers}", "image"
    )


def letters(view: Projection) -> str:
    """The names of the rectangle's sides: x below it, y beside it."""
    parts = []
    if IMAGE_SCALE * abs(view.x) >= LETTER_LEAST:
        middle = place(view.x / 3.0, max(view.y, 0.0)) + np.array([0.0, 19.0])
        parts.append(drawing.text(middle, "x", "image italic ground", "middle"))
    if IMAGE_SCALE * abs(view.y) >= LETTER_LEAST:
        aside, anchor = (-6.0, "end") if view.x >= 0.0 else (6.0, "start")
        middle = place(0, view.y / 2.0) + np.array([aside, 4.0])
        parts.append(drawing.text(middle, "y", "image italic ground", anchor))
    return "".join(parts)


def in_perspective(view: Projection) -> str:
    """The room and the point as full perspective shows them."""
    parts = []
    if view.Z > 0.0:
        lines = outline(view, Camera(view.camera.focal_px, 1.0))
        drawn = [
            clip_to_rectangle(CENTRE + IMAGE_SCALE * line, (0, 0), (WIDTH, HEIGHT), False)
            for line in lines
        ]
        parts.append(drawing.path([line for line in drawn if len(line) > 1], "error thin dashed"))
    if view.Z > 0.0 and view.off_px >= SAME_PX and in_picture(*view.formula_only):
        parts.append(drawing.dot(place(*view.formula_only), "error", 3.0))
    words = "dashed: in perspective" if view.Z > 0.0 else "in perspective: no image of the point"
    parts.append(drawing.text((WIDTH - 8.0, HEIGHT - 34.0), words, "error small ground", "end"))
    return "".join(parts)


def no_image(view: Projection) -> str:
    """The reason why the point has no image, and the result of the bare formula."""
    if view.camera.centre_m == view.Z:
        return message("Z = 0: the ray never meets the image plane", "error")
    ghost, claim = "", ""
    if view.full:
        x, y = view.formula_only
        words = f"the formula alone would say ({format_number(x, 1)}, {format_number(y, 1)})"
        claim = drawing.text((WIDTH / 2.0, 44.0), words, "error small ground", "middle")
        if in_picture(x, y):
            spot = place(x, y)
            ghost = drawing.line(CENTRE, spot, "error dashed") + drawing.circle(spot, 5.0, "error")
    return ghost + message("behind the camera: no image", "error") + claim


def message(words: str, role: str) -> str:
    return drawing.text((WIDTH / 2.0, 26.0), words, f"{role} strong ground", "middle")


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The picture, and the camera from above."""
    view = view_of(settings)
    missing = "undefined" if view.camera.centre_m == view.Z else "behind"
    coordinates = (("x", "x, right", view.x), ("y", "y, down", view.y))
    off = "Off from perspective"
    return Frame(
        (image_panel(view, outputs["picture"]), top_view.panel(view)),
        (
            *(
                readout(name, label, value, "px", digits=1, role="image")
                if view.visible
                else Readout(name, label, missing, "", role="image")
                for name, label, value in coordinates
            ),
            readout("off", off, view.off_px, "px", digits=1, role="error")
            if view.Z > 0.0
            else Readout("off", off, "no image in perspective", "", role="error"),
        ),
        describe(view) if view.visible else describe_missing(view),
    )


def describe(view: Projection) -> str:
    """The picture, then the numbers."""
    outside = "" if view.in_picture else ", outside the picture"
    at = f"x = {format_number(view.x, 1)} px, y = {format_number(view.y, 1)} px{outside}"
    depth = f"{format_number(view.Z, 1)} m"
    if view.full:
        return (
            "A room with balls and boxes, whose side walls converge towards the middle of the "
            f"picture. The top of the white ball is {depth} in front of the camera and "
            f"projects to {at}."
        )
    view_words = (
        "A room of which only the far wall is seen, at any distance equally large"
        if view.camera.parallel
        else f"A room with {100.0 * view.camera.perspective:.0f}\u00a0% of the convergence "
        "of perspective"
    )
    sentence = f"{view_words}. The top of the white ball, at a depth of {depth}, projects to {at}"
    if view.Z <= 0.0:
        return f"{sentence}; in perspective it has no image."
    return f"{sentence}, {format_number(view.off_px, 1)} px from its place in perspective."


def describe_missing(view: Projection) -> str:
    behind = view.camera.centre_m - view.Z
    if behind == 0.0:
        return (
            "The top of the ball is in the plane of the camera centre, Z = 0, where f X / Z is "
            "undefined: it has no image."
        )
    return (
        f"The top of the ball is {format_number(behind, 1)} m behind the camera: light from it "
        "never meets the image plane, so it has no image."
    )


def point_at(settings: Settings, _outputs: Outputs) -> Point:
    view = view_of(settings)
    return tuple(top_view.above(view, view.Z, view.X).tolist())


def point_pulled(_settings: Settings, spot: Point) -> dict[str, float]:
    depth = top_view.depth_at(spot[0])
    return {"depth": depth, "point_x": (spot[1] - top_view.AXIS[1]) / top_view.scale_of(depth)}


def plane_at(settings: Settings, _outputs: Outputs) -> Point | None:
    """The lower end of the image plane, if it is in the panel."""
    view = view_of(settings)
    depth = view.camera.plane_m
    end = top_view.above(view, depth, HALF_WIDTH_PX * METRES_PER_PX)
    return None if depth < top_view.left_m(view) else tuple(end.tolist())


def image_at(settings: Settings, _outputs: Outputs) -> Point | None:
    view = view_of(settings)
    return tuple(place(view.x, view.y).tolist()) if view.visible else None


def image_pulled(settings: Settings, spot: Point) -> dict[str, float]:
    """The point of the same depth that has its image there."""
    view = view_of(settings)
    x, y = (np.asarray(spot, float) - CENTRE) / IMAGE_SCALE / view.camera.size_at(view.Z)
    return {"point_x": x, "point_y": y}


SCENE = Scene(
    "perspective-projection",
    "Perspective Projection",
    Settings,
    draw,
    (Stage("picture", picture),),
    (
        Handle(
            "point",
            "top",
            "Point",
            drives=("depth", "point_x"),
            at=point_at,
            pull=point_pulled,
            role="world",
            reversed=("point_x",),
        ),
        Handle("plane", "top", "Image plane", ("focal_length",), plane_at, role="image"),
        Handle(
            "image",
            "image",
            "Image of the point",
            drives=("point_x", "point_y"),
            at=image_at,
            pull=image_pulled,
            role="image",
            reversed=("point_y",),
        ),
    ),
    accuracy=Accuracy(levels=LEVELS),
    formula=project,
)
