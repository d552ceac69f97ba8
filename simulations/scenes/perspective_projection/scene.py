"""Perspective projection: one point, one camera, with or without division by depth."""

import math

from simulations.engine.frame import Frame, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.projection.pinhole import field_of_view_rad
from simulations.scenes.perspective_projection import parallel, picture, top_view
from simulations.scenes.perspective_projection.handles import HANDLES, view_of
from simulations.scenes.perspective_projection.settings import Settings
from simulations.scenes.perspective_projection.view import (
    HALF_WIDTH_PX,
    PERSPECTIVE,
    View,
    metres,
)

HOUSE = "A small house has the point for its front lower left corner."


def draw(settings: Settings, _outputs: Outputs) -> Frame:
    """The camera from above, and the picture it takes."""
    view = view_of(settings)
    through_centre = view.camera == PERSPECTIVE
    if through_centre:
        top, image = top_view.top_view_panel(view), picture.image_panel(view)
    else:
        top, image = parallel.top_view_panel(view), parallel.image_panel(view)
    return Frame(
        panels=(top, image),
        readouts=(
            Readout("X", "X, right", metres(view.X), "m", "world"),
            Readout("Y", "Y, down", metres(view.Y), "m", "world"),
            readout("Z", "Z, depth", view.Z, "m", digits=1, role="world"),
            readout("f", "f, focal length", view.focal_px, "px", digits=0, role="camera"),
            image_readout("x", "x, right", view, view.x),
            image_readout("y", "y, down", view, view.y),
            extent_readout(view),
        ),
        description=f"{describe(view) if through_centre else parallel.describe(view)} {HOUSE}",
    )


def extent_readout(view: View) -> Readout:
    """The width of the picture as an angle or, for parallel rays, as a length in the world."""
    width_px = 2.0 * HALF_WIDTH_PX
    if view.camera == PERSPECTIVE:
        seen, unit = math.degrees(field_of_view_rad(view.focal_px, width_px)), "°"
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
    settings=Settings,
    draw=draw,
    handles=HANDLES,
)
