"""The two views from above: centres, baseline, rays, and the uncertainty of the depth."""

import math

import numpy as np

from simulations.engine import drawing
from simulations.engine.drafting import swatch_polygon
from simulations.engine.frame import Panel
from simulations.engine.plotting.labels import Label, Rectangle, place_labels
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.geometry.transforms import clip_half_plane
from simulations.scenes.two_views.stages import BLOCKS
from simulations.scenes.two_views.view import HALF_WIDTH_PX, View

WIDTH, HEIGHT = 400.0, 300.0
TITLE = "From above, widths stretched"
CENTRE = np.array([30.0, 144.0])
"""The left camera, seen from above: depth to the right, X downwards."""
DEPTH_SCALE, SIDE_SCALE = 17.5, 28.5
"""View box units per metre."""
AXIS_ROW = HEIGHT - 24.0
"""Height of the axis of depths, whose ticks are named below it."""
LIMIT_ROW = AXIS_ROW - 12.0
LIMITS = ((1, 0, 0), (-1, 0, WIDTH), (0, 1, 0), (0, -1, LIMIT_ROW))
"""The drawing area, as half planes a x + b y + c ≥ 0."""
FAR_M = 60.0
"""Length of drawn rays, beyond the panel."""
INSIDE = Rectangle(4.0, 4.0, WIDTH - 4.0, AXIS_ROW - 4.0)
"""Room for labels."""
AXIS_M = 4.0
"""Distance of the handle on the right camera's axis."""


def above(Z: float, X: float) -> Floats:
    """Metres to view box."""
    return CENTRE + np.array([DEPTH_SCALE * Z, SIDE_SCALE * X])


def metres_at(place: drawing.Point) -> Floats:
    """View box to metres: Z and X."""
    return (np.asarray(place, float) - CENTRE) / [DEPTH_SCALE, SIDE_SCALE]


def axis_end(view: View) -> Floats:
    """The handle on the right camera's axis, in the view box."""
    angle = view.pair.toe_in_rad
    return above(AXIS_M * math.cos(angle), view.pair.baseline - AXIS_M * math.sin(angle))


def plan_panel(view: View) -> Panel:
    parts = (
        _blocks(),
        _depth_axis(),
        _cameras(view),
        _doubt(view),
        _rays(view),
        _point(view),
        _names(view),
    )
    return Panel("plan", TITLE, WIDTH, HEIGHT, overlay="".join(parts), lead=True)


def _blocks() -> str:
    """What stands on the square, in its colours."""
    shapes = []
    for block in BLOCKS:
        (x0, x1), (y0, y1), _ = block.spans
        corners = np.array([above(y, x) for y, x in ((y0, x0), (y1, x0), (y1, x1), (y0, x1))])
        for limit in LIMITS:
            corners = clip_half_plane(corners, limit)
        if len(corners) > 2:
            points = [(float(x), float(y)) for x, y in corners]
            shapes.append(swatch_polygon(points, encode_srgb(block.paint).tolist()))
    return "".join(shapes)


def _segment(start: Floats, end: Floats, style: str) -> str:
    """A segment clipped to the panel."""
    points = np.array([start, end])
    for limit in LIMITS:
        points = clip_half_plane(points, limit, closed=False)
    return drawing.line(points[0], points[1], style) if len(points) > 1 else ""


def _depth_axis() -> str:
    ticks = "".join(
        drawing.line((above(Z, 0.0)[0], AXIS_ROW - 3), (above(Z, 0.0)[0], AXIS_ROW + 3), "muted")
        + drawing.text((above(Z, 0.0)[0], AXIS_ROW + 18.0), f"{Z}", "muted small", "middle")
        for Z in (5, 10, 15, 20)
    )
    start, end = (CENTRE[0], AXIS_ROW), (WIDTH - 4.0, AXIS_ROW)
    name = drawing.text((CENTRE[0], AXIS_ROW + 18.0), "Z, m", "muted small")
    return drawing.arrow(start, end, "muted thin") + name + ticks


def _cameras(view: View) -> str:
    """Both centres, the baseline, and the fields of view."""
    pair = view.pair
    slope = HALF_WIDTH_PX / pair.focal_px
    left, right = above(0.0, 0.0), above(0.0, pair.baseline)
    parts = []
    for X, turn in ((0.0, 0.0), (pair.baseline, pair.toe_in_rad)):
        for side in (-slope, slope):
            angle = math.atan(side) - turn
            end = above(FAR_M * math.cos(angle), X + FAR_M * math.sin(angle))
            parts.append(_segment(above(0.0, X), end, "camera thin faint dashed"))
    parts.append(_segment(right, axis_end(view), "camera thin"))
    parts.append(drawing.line(left, right, "camera bold"))
    parts += [drawing.dot(left, "camera", 4.5), drawing.dot(right, "camera", 4.5)]
    parts.append(drawing.text((4.0, left[1] - 12.0), "left", "camera small ground"))
    low = min(right[1] + 24.0, HEIGHT - 40.0)
    parts.append(drawing.text((4.0, low), "right", "camera small ground"))
    return "".join(parts)


def _rays(view: View) -> str:
    """The left ray to its end, and the right one, which meets it in the lamp."""
    point = view.point
    far = view.at(FAR_M)
    ray = _segment(above(0.0, 0.0), above(far[2], far[0]), "ray")
    return ray + _segment(above(0.0, view.pair.baseline), above(point[2], point[0]), "ray")


def _doubt(view: View) -> str:
    """The part of the left ray that is consistent with the match and its error, with the
    directions of the right camera that lead to it, and its depths on the axis."""
    if view.nearest == view.farthest:
        return ""
    near, far = view.at(view.nearest), view.at(min(view.farthest, FAR_M))
    ends = np.array([above(near[2], near[0]), above(far[2], far[0])])
    wedge = np.array([above(0.0, view.pair.baseline), *ends])
    for limit in LIMITS:
        wedge = clip_half_plane(wedge, limit)
    parts = [drawing.polygon(wedge, "error thin fill")] if len(wedge) > 2 else []
    parts.append(_segment(ends[0], ends[1], "error bold"))
    inside = ends[:, 0] <= WIDTH
    for x, y in ends[inside]:
        start = min(max(y, 0.0), LIMIT_ROW)
        parts.append(drawing.line((x, start), (x, AXIS_ROW), "error thin dashed"))
    left, right = np.minimum(ends[:, 0], WIDTH)
    if left < right:
        parts.append(drawing.line((left, AXIS_ROW), (right, AXIS_ROW), "error bold"))
    return "".join(parts)


def _point(view: View) -> str:
    """The lamp, with its name on the side away from its rays."""
    spot = above(view.depth, float(view.point[0]))
    if not (0.0 <= spot[0] <= WIDTH and 0.0 <= spot[1] <= HEIGHT):
        return ""
    up = view.point[0] >= 0.0
    at = (min(max(spot[0] + 10.0, 16.0), WIDTH - 20.0), spot[1] + (-14.0 if up else 24.0))
    name = drawing.text(at, "lamp", "world small ground", "middle")
    return drawing.dot(spot, "world", 5.0) + name


def _names(view: View) -> str:
    """The names of the handle on the right camera's axis and of the range of depths, clear of the
    rays and the lamp."""
    right, axis = above(0.0, view.pair.baseline), axis_end(view)
    spot = above(view.depth, float(view.point[0]))
    labels = [Label(axis, "turn", "camera small ground", "below", 14.0)]
    if view.nearest < view.farthest:
        near, far = (
            min(float(above(depth, 0.0)[0]), WIDTH) for depth in (view.nearest, view.farthest)
        )
        bar = (far, AXIS_ROW - 10.0)
        others = [(near, AXIS_ROW - 10.0)]
        labels.append(Label(bar, "depths that fit", "error small ground", "right", others=others))
    below = spot + np.array([0.0, 30.0])
    rays = [(above(0.0, 0.0), spot), (right, spot), (right, axis), (spot, below)]
    curves: list[list[drawing.Point]] = [list(ends) for ends in rays]
    return place_labels(labels, INSIDE, curves)
