"""Perspective projection: one point, one camera, and the division by depth, or none."""

import math

from simulations.engine.controls import Choice, Slider, Values
from simulations.engine.frame import Frame, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from simulations.models.projection.pinhole import field_of_view
from simulations.scenes.perspective_projection import parallel, picture, top_view
from simulations.scenes.perspective_projection.view import (
    HALF_WIDTH_PX,
    PARALLEL,
    PERSPECTIVE,
    SCALED,
    View,
    look,
)


def render(values: Values, _tier: str, _cache: StageCache) -> Frame:
    """The camera from above, and the picture it takes."""
    view = look(
        X=values.number("point_x"),
        Y=values.number("point_y"),
        Z=values.number("depth"),
        focal_px=values.number("focal_length"),
        camera=values.choice("camera"),
    )
    through_centre = view.camera == PERSPECTIVE
    if through_centre:
        top, image = top_view.top_view_panel(view), picture.image_panel(view)
    else:
        top, image = parallel.top_view_panel(view), parallel.image_panel(view)
    return Frame(
        panels=(top, image),
        readouts=(
            readout("X", "X, right", view.X, "m", digits=1, role="world"),
            readout("Y", "Y, down", view.Y, "m", digits=1, role="world"),
            readout("Z", "Z, depth", view.Z, "m", digits=1, role="world"),
            readout("f", "f, focal length", view.focal_px, "px", digits=0, role="camera"),
            image_readout("x", "x, right", view, view.x),
            image_readout("y", "y, down", view, view.y),
            extent_readout(view),
        ),
        description=describe(view) if through_centre else parallel.describe(view),
    )


def extent_readout(view: View) -> Readout:
    """What the picture is wide enough for: an angle, or for parallel rays a strip of the world."""
    width_px = 2.0 * HALF_WIDTH_PX
    if view.camera == PERSPECTIVE:
        seen, unit = math.degrees(field_of_view(view.focal_px, width_px)), "°"
    else:
        seen, unit = width_px / view.scale, "m wide"
    return readout("view", "Field of view", seen, unit, digits=1, role="camera")


def image_readout(name: str, label: str, view: View, value: float) -> Readout:
    if view.visible:
        return readout(name, label, value, "px", digits=1, role="image")
    return Readout(name, label, "undefined" if view.Z == 0.0 else "behind", "", "image")


def describe(view: View) -> str:
    """One sentence for a reader who cannot see the picture."""
    if view.Z == 0.0:
        return (
            "The point is in the plane of the camera centre, Z = 0, where f X / Z is undefined: "
            "it has no image."
        )
    if not view.visible:
        return (
            f"The point is {format_number(-view.Z, 1)} m behind the camera: "
            "light from it never meets the image plane, so it has no image."
        )
    outside = "" if view.in_picture else ", outside the picture"
    return (
        f"The point is {format_number(view.Z, 1)} m in front of the camera and projects to "
        f"x = {format_number(view.x, 1)} px, y = {format_number(view.y, 1)} px{outside}."
    )


SCENE = Scene(
    id="perspective-projection",
    title="Perspective Projection",
    controls=(
        Slider(
            name="depth", label="Depth (Z)", default=5.0, minimum=-2, maximum=20, step=0.1, unit="m"
        ),
        Slider(
            name="focal_length",
            label="Focal length",
            default=80,
            minimum=20,
            maximum=200,
            step=1,
            unit="px",
        ),
        Slider(
            name="point_x",
            label="Right (X)",
            default=1.0,
            minimum=-3,
            maximum=3,
            step=0.1,
            unit="m",
        ),
        Slider(
            name="point_y", label="Down (Y)", default=0.5, minimum=-2, maximum=2, step=0.1, unit="m"
        ),
        Choice(
            name="camera",
            label="Camera",
            default=PERSPECTIVE,
            options={
                PERSPECTIVE: "Perspective",
                SCALED: "Scaled orthography",
                PARALLEL: "Orthography",
            },
        ),
    ),
    render=render,
)
