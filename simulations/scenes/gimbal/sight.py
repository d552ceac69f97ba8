"""What the camera on the gimbal sees: level ground with trees, and a sky with stars.

Straight up, the circles of the sky close around one point. There pan and roll both turn the
picture about its middle, so the lock can be seen.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from simulations.engine import drawing
from simulations.engine.plotting.clipping import runs_inside
from simulations.models.arrays import Floats
from simulations.models.geometry import euler
from simulations.models.geometry.transforms import clip_half_plane

WIDTH, HEIGHT = 400.0, 340.0
CENTRE = np.array([WIDTH / 2.0, HEIGHT / 2.0])
FOCAL = 260.0
"""Focal length in view box units: the picture is 75° wide."""
NEAREST = 0.05
"""Cosine of the largest angle from the line of sight at which anything is drawn."""
EDGES = ((1, 0, 0), (-1, 0, WIDTH), (0, 1, 0), (0, -1, HEIGHT))
"""The view box, as half planes a x + b y + c ≥ 0."""
BOX = np.array([(0.0, 0.0), (WIDTH, 0.0), (WIDTH, HEIGHT), (0.0, HEIGHT)])
NAMES = ("ahead", "right", "behind", "left")
_RNG = np.random.default_rng(5)
STARS = np.stack([_RNG.uniform(0.0, 360.0, 90), np.degrees(np.arcsin(_RNG.uniform(0.1, 1.0, 90)))])
"""Azimuth and elevation (2, n) of the stars, in degrees, evenly over the sky."""
TREES = np.stack(
    [np.arange(0.0, 360.0, 18.0) + _RNG.uniform(3.0, 15.0, 20), _RNG.uniform(4, 11, 20)]
)
"""Azimuth and height (2, n) of the trees, in degrees."""


def towards(azimuth_deg: Floats | float, elevation_deg: Floats | float) -> Floats:
    """Unit vectors (..., 3) in the world (right, down, ahead); the azimuth counts from ahead to the
    right."""
    azimuth, elevation = np.radians(azimuth_deg), np.radians(elevation_deg)
    azimuth, elevation = np.broadcast_arrays(azimuth, elevation)
    flat = np.cos(elevation)
    return np.stack([flat * np.sin(azimuth), -np.sin(elevation), flat * np.cos(azimuth)], axis=-1)


def place(C: Floats, directions: Floats) -> Floats:
    """View box places (..., 2) of directions of the world, for a camera whose axes are the columns
    of ``C``; NaN beside or behind the camera."""
    seen = directions @ C
    depth = seen[..., 2:]
    inside = depth > NEAREST
    return np.asarray(
        np.where(inside, CENTRE + FOCAL * seen[..., :2] / np.where(inside, depth, 1.0), np.nan)
    )


def draw(pan: float, tilt: float, roll: float) -> str:
    """SVG markup of the panel; angles in degrees."""
    C = euler.to_matrix("YXZ", np.radians([pan, tilt, roll]))
    middle = CENTRE.tolist()
    return "".join(
        (
            *_ground(C),
            _circles(C),
            _stars(C),
            *_trees(C),
            *_names(C),
            drawing.line((middle[0] - 9, middle[1]), (middle[0] + 9, middle[1]), "camera thin"),
            drawing.line((middle[0], middle[1] - 9), (middle[0], middle[1] + 9), "camera thin"),
        )
    )


def _ground(C: Floats) -> Iterator[str]:
    """The half of the picture below the horizon: where the ray points downwards."""
    a, b, c = C[1]
    half_plane = (a, b, FOCAL * c - a * CENTRE[0] - b * CENTRE[1])
    ground = clip_half_plane(BOX, half_plane)
    if len(ground):
        yield drawing.polygon(ground, "world fill")


def _circles(C: Floats) -> str:
    """Circles of equal elevation and upright half circles, every 15° and 30°."""
    turns, rises = np.linspace(0.0, 360.0, 121), np.linspace(0.0, 90.0, 31)
    curves = [towards(turns, level) for level in (15.0, 30.0, 45.0, 60.0, 75.0)]
    curves += [towards(azimuth, rises) for azimuth in np.arange(0.0, 360.0, 30.0).tolist()]
    return drawing.path([run for curve in curves for run in _runs(C, curve)], "muted thin faint")


def _runs(C: Floats, curve: Floats) -> list[list[tuple[float, float]]]:
    across, down = place(C, curve).T
    return runs_inside(across, down, (0.0, WIDTH), (0.0, HEIGHT))


def _stars(C: Floats) -> str:
    spots = [spot for spot in place(C, towards(*STARS)).tolist() if _shown(spot, 2.0)]
    return drawing.path([(spot, spot) for spot in spots], "light bold") if spots else ""


def _trees(C: Floats) -> Iterator[str]:
    for azimuth, height in TREES.T.tolist():
        foot, half = 0.0, height / 3.5
        corners = towards(
            np.array([azimuth - half, azimuth, azimuth + half]), np.array([foot, height, foot])
        )
        tree = place(C, corners)
        if not np.isfinite(tree).all():
            continue
        for edge in EDGES:
            tree = clip_half_plane(tree, edge)
        if len(tree):
            yield drawing.polygon(tree, "world solid")


def _names(C: Floats) -> Iterator[str]:
    quarters = zip(NAMES, (0.0, 90.0, 180.0, 270.0), strict=True)
    spots = [(name, towards(azimuth, -7.0)) for name, azimuth in quarters]
    for name, direction in (*spots, ("straight up", towards(0.0, 90.0))):
        spot = place(C, direction).tolist()
        if _shown(spot, 45.0):
            yield drawing.text((spot[0], spot[1] + 18.0), name, "world small ground", "middle")


def _shown(spot: Sequence[float], margin: float) -> bool:
    """Whether a place is so far inside the panel; false for NaN."""
    x, y = spot
    return margin < x < WIDTH - margin and margin < y < HEIGHT - margin
