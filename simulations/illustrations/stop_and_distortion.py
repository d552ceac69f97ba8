"""A simple lens with its stop in front or behind, and two about it: their rays and squares."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import dot, line, path, polygon, polyline
from simulations.engine.illustration import Illustration, Panel
from simulations.models.arrays import Floats
from simulations.models.lens.singlet import Singlet, sag_mm
from simulations.models.lens.stop_position import ChiefRays, chief_rays, chief_rays_of_pair

WIDTH, HEIGHT, UNITS_PER_MM = 190.0, 226.0, 1.85
LENS_X, AXIS_Y, SQUARE_Y = 68.0, 46.0, 156.0
APART_MM, CORNER = 10.0, 0.36
"""Distance from stop to lens, and the tangent of the angle to the axis of the ray and of the
corners."""
ENLARGED = 3.0  # exaggeration of the squares' distortion
ALONE, OF_TWO = Singlet(1 / 50, -1 / 50, 6.0, 1.5), Singlet(1 / 100, -1 / 100, 6.0, 1.5)
HALF_MM = 14.0
SLOPES = np.linspace(0.001, 0.5, 500)
BEFORE, BEHIND = (chief_rays(ALONE, stop, SLOPES) for stop in (-APART_MM, APART_MM))
BETWEEN = chief_rays_of_pair(OF_TWO, APART_MM, SLOPES)
CASES: tuple[tuple[str, str, ChiefRays, Singlet, tuple[float, ...], float], ...] = (
    ("front", "Aperture stop in front", BEFORE, ALONE, (0.0,), -APART_MM),
    ("behind", "Behind the lens", BEHIND, ALONE, (0.0,), APART_MM),
    ("between", "Between two lenses", BETWEEN, OF_TWO, (-APART_MM, APART_MM), 0.0),
)
"""Name, title, rays, the glass, and the places of its pieces and of the stop."""


def factor(rays: ChiefRays, radius: Floats) -> Floats:
    """r_d / r at radii up to the corner, by interpolation between traced rays."""
    bent = np.interp(radius, rays.tan_field, rays.image / rays.tan_field)
    return np.asarray(bent, float)


def _at(places: Floats) -> Floats:
    return np.array([LENS_X, AXIS_Y]) + places * np.array([UNITS_PER_MM, -UNITS_PER_MM])


def _section(rays: ChiefRays, glass: Singlet, stands: tuple[float, ...], stop: float) -> list[str]:
    """The ray of a corner through glass and stop, and its path through a thin lens."""
    nearest = int(np.nanargmin(np.abs(rays.tan_field - CORNER)))
    ways, tangent = rays.places[nearest], float(rays.tan_field[nearest])
    start = ways[0] - 22.0 * np.array([1.0, tangent])
    wrong = np.array([rays.image_mm, rays.focal_mm * rays.image[nearest]])
    right = np.array([rays.image_mm, rays.focal_mm * tangent])
    sensor = rays.image_mm
    return [
        line((4, AXIS_Y), (WIDTH - 4, AXIS_Y), "muted thin dashed"),
        *(polygon(_at(_outline(glass, place)), "camera fill") for place in stands),
        *(polyline(_at(np.array([[stop, 2.2 * up], [stop, 15.0 * up]])), "bold") for up in (1, -1)),
        polyline(_at(np.array([[sensor, -21.0], [sensor, 21.0]])), "image"),
        polyline(_at(np.stack([ways[-1], right])), "world thin dashed"),
        polyline(_at(np.stack([start, *ways, wrong])), "ray"),
        dot(tuple(_at(right)), "world", 3),
        dot(tuple(_at(wrong)), "image", 3),
    ]


def _outline(glass: Singlet, place: float) -> Floats:
    heights = np.linspace(-HALF_MM, HALF_MM, 25)
    half = glass.thickness_mm / 2
    front = place - half + sag_mm(glass.front_per_mm, heights)
    back = place + half + sag_mm(glass.back_per_mm, heights)
    faces = [np.stack([front, heights], -1), np.stack([back, heights], -1)[::-1]]
    return np.concatenate(faces)


def _square(rays: ChiefRays) -> str:
    """A grid whose corners lie at the tangent `CORNER`."""
    side = CORNER / np.sqrt(2.0)
    along, lines = np.linspace(-side, side, 41), np.linspace(-side, side, 5)
    rows = [np.stack([along, np.full_like(along, c)], -1) for c in lines]
    images = []
    for row in (*rows, *(row[:, ::-1] for row in rows)):
        bent = factor(rays, np.hypot(row[:, 0], row[:, 1]))
        moved = row * (1.0 + ENLARGED * (bent - 1.0))[:, None]
        images.append(np.array([WIDTH / 2, SQUARE_Y]) + 43.0 / side * moved)
    return path(images, "image")


def draw() -> Illustration:
    panels = []
    for name, title, rays, glass, stands, stop in CASES:
        share = 100.0 * float(factor(rays, np.array(CORNER)) - 1.0)
        corner = f"corners {share:+.1f} %".replace("-", "−")
        marks = [
            *_section(rays, glass, stands, stop),
            _square(rays),
            label((WIDTH / 2, HEIGHT - 4), corner, "muted small", "middle"),
        ]
        panels.append(Panel(name, title, WIDTH, HEIGHT, overlay="".join(marks)))
    words = (
        "A ray through a simple lens, and a square grid as the lens makes it: a barrel with the "
        "stop in front, a pincushion with the stop behind, and nearly straight with the stop "
        "between two equal lenses."
    )
    return Illustration(tuple(panels), words)
