"""Perspective projection: one point, one camera, with or without division by depth."""

from simulations.engine.frame import Frame, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.projection.pinhole import project
from simulations.scenes.perspective_projection.handles import HANDLES, view_of
from simulations.scenes.perspective_projection.picture import image_panel
from simulations.scenes.perspective_projection.settings import Settings
from simulations.scenes.perspective_projection.top_view import top_view_panel
from simulations.scenes.perspective_projection.view import View


def draw(settings: Settings, _outputs: Outputs) -> Frame:
    """The picture, and the camera from above."""
    view = view_of(settings)
    return Frame(
        panels=(image_panel(view), top_view_panel(view)),
        readouts=(
            _image_readout("x", "x, right", view, view.x),
            _image_readout("y", "y, down", view, view.y),
            _off_readout(view),
        ),
        description=describe(view),
    )


def _image_readout(name: str, label: str, view: View, value: float) -> Readout:
    if view.visible:
        return readout(name, label, value, "px", digits=1, role="image")
    between = view.camera.centre_m == view.Z
    return Readout(name, label, "undefined" if between else "behind", "", "image")


def _off_readout(view: View) -> Readout:
    """How far the image is from the one in perspective."""
    label = "Off from perspective"
    if view.Z <= 0.0:
        return Readout("off", label, "no image in perspective", "", "error")
    return readout("off", label, view.off_px, "px", digits=1, role="error")


def describe(view: View) -> str:
    """What one would see, then the numbers."""
    if not view.visible:
        return _without_image(view)
    outside = "" if view.in_picture else ", outside the picture"
    at = f"x = {format_number(view.x, 1)} px, y = {format_number(view.y, 1)} px{outside}"
    depth = f"{format_number(view.Z, 1)} m"
    if view.full:
        return (
            "A small house whose side walls converge towards the middle of the picture. Its front "
            f"lower left corner is {depth} in front of the camera and projects to {at}."
        )
    seen = (
        "A small house of which only the front is seen, at any distance equally large"
        if view.camera.parallel
        else f"A small house with {100.0 * view.camera.perspective:.0f}\u00a0% of the convergence "
        "of perspective"
    )
    sentence = f"{seen}. Its front lower left corner, at a depth of {depth}, projects to {at}"
    if view.Z <= 0.0:
        return f"{sentence}; in perspective it has no image."
    return f"{sentence}, {format_number(view.off_px, 1)} px from its place in perspective."


def _without_image(view: View) -> str:
    behind = view.camera.centre_m - view.Z
    if behind == 0.0:
        return (
            "The corner of the house is in the plane of the camera centre, Z = 0, where f X / Z is "
            "undefined: it has no image."
        )
    return (
        f"The corner of the house is {format_number(behind, 1)} m behind the camera: light from it "
        "never meets the image plane, so it has no image."
    )


SCENE = Scene(
    id="perspective-projection",
    title="Perspective Projection",
    settings=Settings,
    draw=draw,
    formula=project,
    handles=HANDLES,
)
