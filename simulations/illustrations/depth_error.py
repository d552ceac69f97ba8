"""Two cameras and their pixels: the farther a point, the larger the uncertainty of its depth."""

from simulations.engine.drafting import label
from simulations.engine.drawing import dot, line, path, polygon
from simulations.engine.illustration import Illustration, Panel
from simulations.models.arrays import Floats
from simulations.models.geometry.lines_and_planes import intersection, line_through

BASELINE, FOCAL_PX, HALF_PX = 0.8, 45.0, 0.5
"""Metres, pixels, and the largest error of a match."""
EYES = (BASELINE / 2, -BASELINE / 2)
AXIS, LEFT, UNITS_PER_M, SIDEWAYS = 112.0, 20.0, 46.0, 3.0
DEPTHS = (2.4, 3.7, 5.6)


def at(x: float, z: float) -> tuple[float, float]:
    """From above, depth to the right, left upwards."""
    return LEFT + UNITS_PER_M * z, AXIS - SIDEWAYS * UNITS_PER_M * x


def edges(centre: float, depth: float) -> tuple[Floats, Floats]:
    """The two rays from a camera past a point straight ahead, half a pixel to either side."""
    middle = -centre * FOCAL_PX / depth

    def ray(x_px: float) -> Floats:
        return line_through((centre, 0.0), (centre + x_px / FOCAL_PX, 1.0))[0]

    return ray(middle - HALF_PX), ray(middle + HALF_PX)


def diamond(depth: float) -> list[Floats]:
    """The corners (x, z) of the region that is consistent with both pixels."""
    left, right = edges(-BASELINE / 2, depth), edges(BASELINE / 2, depth)
    return [intersection(left[i], right[j])[0] for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]


def stretch(depth: float) -> tuple[float, float]:
    """Nearest and farthest depth of the diamond."""
    depths = [float(corner[1]) for corner in diamond(depth)]
    return min(depths), max(depths)


def draw() -> Illustration:
    marks = []
    for depth in DEPTHS:
        corners = [at(float(x), float(z)) for x, z in diamond(depth)]
        rays = [[at(centre, 0), corner] for centre in EYES for corner in corners]
        near, far = stretch(depth)
        middle, foot = at(0, (near + far) / 2)[0], AXIS + 84
        marks += [
            path(rays, "ray thin faint"),
            polygon(corners, "error fill"),
            dot(at(0, depth), "world", 3.5),
            line((at(0, near)[0], foot), (at(0, far)[0], foot), "error bold"),
            label((middle, foot + 19), f"{far - near:.1f} m", "error", "middle"),
            label((at(0, depth)[0], AXIS - 76), f"{depth:g} m", "world", "middle"),
        ]
    for centre, name in zip(EYES, ("left camera", "right camera"), strict=True):
        place = at(centre, 0)
        marks.append(dot(place, "camera", 5))
        marks.append(label((place[0] - 8, place[1] + (-14 if centre > 0 else 24)), name, "camera"))
    reach = ", ".join(
        f"{stretch(depth)[1] - stretch(depth)[0]:.1f} m at {depth:g} m" for depth in DEPTHS
    )
    words = (
        "From above, sideways drawn three times too wide: two cameras, and three points straight "
        "ahead. The rays half a pixel to either side of each point enclose a diamond in which it "
        f"may lie. It gets longer with the square of the distance: {reach}."
    )
    return Illustration((Panel("plan", "", 400.0, 222.0, overlay="".join(marks)),), words)
