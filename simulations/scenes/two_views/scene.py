"""Two views of a lamp: its disparity, the epipolar line, and the error of the depth."""

import math

from simulations.engine.frame import Frame, Readout, format_number, matrix_readout, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.projection.two_views import (
    depth_error,
    depth_from_disparity,
    essential_matrix,
)
from simulations.scenes.two_views.handles import HANDLES
from simulations.scenes.two_views.pictures import left_panel, right_panel
from simulations.scenes.two_views.plan import plan_panel
from simulations.scenes.two_views.settings import Settings
from simulations.scenes.two_views.stages import COARSE, STAGES, parameters
from simulations.scenes.two_views.view import View, in_picture, view_of


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The lamp from above, and as both cameras see it."""
    view = view_of(settings)
    return Frame(
        panels=(
            plan_panel(view),
            right_panel(view, outputs["right"], settings.line),
            left_panel(view, outputs["left"]),
        ),
        readouts=_readouts(settings, view),
        description=_description(settings, view),
    )


def _readouts(settings: Settings, view: View) -> tuple[Readout, ...]:
    pair = view.pair
    first_order = depth_error(view.depth, pair.focal_px, pair.baseline, settings.matching_error)
    return (
        readout("d", "d, disparity", view.disparity, "px", digits=1, role="image"),
        _parallel_depth(view),
        Readout("interval", "Z, with the error", _interval(view), "m", "error"),
        readout("first_order", "±Z²Δd / f b", float(first_order), "m", role="error"),
        readout(
            "off_row",
            "y right − y left",
            view.right[1] - view.left[1],
            "px",
            digits=1,
            role="ray",
        ),
        matrix_readout("E", "E = [t]ₓ R", essential_matrix(pair.R, pair.t).tolist(), role="camera"),
    )


def _parallel_depth(view: View) -> Readout:
    """The depth by the formula for parallel cameras, if it is defined."""
    depth, valid = depth_from_disparity(view.disparity, view.pair.focal_px, view.pair.baseline)
    if not valid:
        return Readout("parallel", "f b / d", "none: d < 0", "", "image")
    return readout("parallel", "f b / d", float(depth), "m", digits=1, role="image")


def _interval(view: View) -> str:
    near, far = (format_number(depth, 2) for depth in (view.nearest, view.farthest))
    return near if near == far else f"{near} to {far}"


def _description(settings: Settings, view: View) -> str:
    turned = settings.toe_in
    position = f"{format_number(settings.baseline)} m apart, " + (
        f"the right one turned in by {turned:.0f}°" if turned else "looking the same way"
    )
    seen = "" if in_picture(view.right) else ", outside the right picture"
    off = float(view.right[1] - view.left[1])
    row = (
        "in the same row of both pictures"
        if abs(off) < 0.05
        else f"{format_number(abs(off), 1)} px {'lower' if off > 0 else 'higher'} in the right one"
    )
    doubt = (
        f"leaves its depth open from {format_number(view.nearest)} m on"
        if math.isinf(view.farthest)
        else f"leaves its depth between {format_number(view.nearest)} and "
        f"{format_number(view.farthest)} m"
    )
    error = settings.matching_error
    return (
        f"Two cameras {position}, before coloured blocks on a tiled square. A lamp "
        f"{format_number(view.depth, 1)} m away has a disparity of "
        f"{format_number(view.disparity, 1)} px and is {row}{seen}"
        + (f"; a match good to {format_number(error, 1)} px {doubt}." if error else ".")
    )


SCENE = Scene(
    id="two-views",
    title="Two Views",
    settings=Settings,
    draw=draw,
    formula=depth_from_disparity,
    stages=STAGES,
    handles=HANDLES,
    parameters=parameters,
    own_drafts={COARSE: ("focal_length",)},
)
