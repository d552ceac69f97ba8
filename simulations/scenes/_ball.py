"""The ball of the scenes on reflection: its pixels, its normals, and the marks drawn over it.

It is seen from far away, so that a point of the picture, in radii from the centre, is the x and y
part of the normal there. Directions in the horizontal plane are given by their angle from the
camera's, positive to the right.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.engine.drawing import Point, circle, dot, line, polyline, text
from simulations.engine.frame import Panel, Raster, Readout, format_magnitude
from simulations.engine.handles import Handle
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats, Mask
from simulations.models.color.srgb import encode_srgb, encode_srgb_table
from simulations.models.error_measures import root_mean_square
from simulations.models.light.cell_blending import blend_cells, blend_normals

type Picture = NDArray[np.float32]

WIDTH, HEIGHT = 400, 340
CENTRE, RADIUS = (200.0, 170.0), 122.0  # the ball, in view box units
PIXELS_PER_UNIT = 1.75  # raster pixels per unit of the view box
RADIUS_PX = RADIUS * PIXELS_PER_UNIT
LONGEST_NAME = 116.0  # room for the name of a point, in view box units


@dataclass(frozen=True, slots=True)
class Ball:
    """The parts of the picture that depend on no control. The square is that around the ball."""

    x: Picture  # (w,) pixels to the right of the centre, of the columns of the square
    y: Picture  # (h,) pixels above the centre, of its rows
    normals: Picture  # (h, w, 3) unit normals in the square; z towards the camera
    inner: Mask  # (h, w) pixels that the ball covers completely
    rim: Mask  # (h, w) pixels that it covers partly
    rim_coverage: Picture  # (rim pixels, 1) share of the pixel that it covers
    behind_rim: Picture  # (rim pixels, 3) linear light of the wall there
    backdrop: NDArray[np.uint8]  # (H, W, 4) the wall alone
    square: tuple[slice, slice]  # place of the square in the picture


def build_ball() -> Ball:
    scale = PIXELS_PER_UNIT
    height, width = round(HEIGHT * scale), round(WIDTH * scale)
    across = np.arange(width, dtype=np.float32) + 0.5 - CENTRE[0] * scale
    up = CENTRE[1] * scale - np.arange(height, dtype=np.float32) - 0.5
    rows, columns = (np.flatnonzero(np.abs(axis) < RADIUS_PX + 1) for axis in (up, across))
    square = (slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1))
    y, x = up[square[0]], across[square[1]]
    coverage = np.clip(RADIUS_PX - np.hypot(x, y[:, None]) + 0.5, 0, 1).astype(np.float32)
    rim = (coverage > 0) & (coverage < 1)
    wall = slate_wall(across, up)
    return Ball(
        x=x,
        y=y,
        normals=unit_normals(x, y),
        inner=coverage == 1,
        rim=rim,
        rim_coverage=coverage[rim][:, None],
        behind_rim=wall[square][rim],
        backdrop=to_rgba8(encode_srgb(wall)),
        square=square,
    )


def unit_normals(x: Floats, y: Floats) -> Picture:
    """Normals (h, w, 3) at columns ``x`` and rows ``y``; outside the ball, those of its rim."""
    across, up = np.meshgrid(x, y)
    distance = np.hypot(across, up)
    outer = np.maximum(distance, RADIUS_PX)
    depth = np.sqrt(np.maximum(RADIUS_PX**2 - distance**2, 0))
    return np.stack([across / outer, up / outer, depth / outer], axis=-1).astype(np.float32)


def slate_wall(x: Picture, y: Picture) -> Picture:
    """Linear light (H, W, 3), a little lighter behind the ball."""
    distance = np.hypot(x, y[:, None]) / (WIDTH * PIXELS_PER_UNIT)
    level = 0.105 - 0.085 * np.minimum(distance, 0.8)
    return (level[..., None] * np.array([0.92, 1.0, 1.12])).astype(np.float32)


def light_direction(angle_deg: float) -> NDArray[np.float64]:
    """Unit vector in the horizontal plane: 0° from the camera, 90° from the right.

    At ±90° and ±180° its zeros are exact. With sin 180° = 1.2e-16 a light from behind would
    light the rim on one side.
    """
    off_axis = angle_deg if abs(angle_deg) <= 90 else math.copysign(180, angle_deg) - angle_deg
    across, along = math.sin(math.radians(off_axis)), math.sin(math.radians(90 - abs(angle_deg)))
    return np.array([across, 0.0, along])


def corner_normals(ball: Ball, cells: int) -> Picture:
    """Normals (cells + 1, cells + 1, 3) at the corners of a grid over the square."""
    x, y = (np.linspace(axis[0], axis[-1], cells + 1) for axis in (ball.x, ball.y))
    return unit_normals(x, y)


# The normals that a tier computes light for: of all pixels, or of its grid's corners. The tiers are
# rungs of the ladder `shading`, but for the blended normals. They save work in a mesh, which has no
# others, and not in a picture that has normals in every pixel.
LIT: Mapping[str, Callable[[Ball], Floats]] = {
    **{f"gouraud-{cells}": partial(corner_normals, cells=cells) for cells in (8, 16, 32, 64)},
    "phong": lambda ball: ball.normals,
    "blended-normals-16": lambda ball: blend_normals(corner_normals(ball, 16), *ball.inner.shape),
}
DEFAULT_TIER = "phong"
TIER_LABELS = {
    "phong": "Light in every pixel",
    "blended-normals-16": "Normals at 16 × 16 cells",
}


def lit_normals(ball: Ball, tier: str) -> Floats:
    """Unit normals (..., 3) of the tier's entry in `LIT`."""
    return LIT[tier](ball)


def light_of_pixels(light: Floats, ball: Ball) -> Floats:
    """Light (h, w, ...), interpolated across the cells if only their corners were lit."""
    return light if light.shape[:2] == ball.inner.shape else blend_cells(light, *ball.inner.shape)


def paint(ball: Ball, linear: Floats) -> NDArray[np.uint8]:
    """The bytes (H, W, 4) of (h, w) or (h, w, 3) light. Only the rim mixes ball and wall."""
    picture = ball.backdrop.copy()
    square = picture[ball.square]
    shown = to_rgba8(encode_srgb_table(linear))
    # Pixels are copied as one number of four bytes, which is faster than with a mask.
    whole, shown_whole = (rgba.view(np.uint32)[..., 0] for rgba in (square, shown))
    np.copyto(whole, shown_whole, where=ball.inner)
    on_rim = linear[ball.rim].reshape(len(ball.behind_rim), -1)
    mixed = ball.behind_rim + ball.rim_coverage * (on_rim - ball.behind_rim)
    square[ball.rim] = to_rgba8(encode_srgb_table(mixed)[None])[0]
    return picture


def camera_panel(picture: Raster, overlay: str) -> Panel:
    return Panel("camera", "What the camera sees", WIDTH, HEIGHT, picture, overlay, lead=True)


def true_cosine(ball: Ball, angle_deg: float) -> NDArray[np.float64]:
    """n · d (h, w) for the direction at an angle, from the equation of the sphere, float64."""
    return true_normals(ball) @ light_direction(angle_deg)


def true_normals(ball: Ball) -> NDArray[np.float64]:
    """Normals (h, w, 3) from the equation of the sphere, float64; z is 0 outside the ball."""
    x, y = np.meshgrid(*(axis.astype(np.float64) / RADIUS_PX for axis in (ball.x, ball.y)))
    return np.stack([x, y, np.sqrt(np.maximum(1.0 - x * x - y * y, 0.0))], axis=-1)


def rms_error(ball: Ball, light: ArrayLike, truth: Floats) -> Readout:
    """RMS difference of (h, w) linear light from the truth, over the pixels of the ball alone."""
    wrong = (np.asarray(light, np.float64) - truth)[ball.inner]
    label = "RMS error of the light against its formula in float64"
    error = format_magnitude(root_mean_square(wrong), 1e-9)
    return Readout("error", label, error, "of white", "error")


def on_equator(angle_rad: float) -> tuple[float, float]:
    """Place in the picture of the equator's point whose normal has an angle."""
    return CENTRE[0] + RADIUS * math.sin(angle_rad), CENTRE[1]


def probe_on_ball(role: str) -> Handle[Any]:
    """The handle of the probed point in the camera's picture; its setting is ``probe``."""
    return Handle(
        "probe",
        "camera",
        "Probed point",
        ("probe",),
        lambda settings, _: on_equator(math.radians(settings.probe)),
        role=role,
    )


def outlined_dot(place: Point, role: str, radius: float = 5.5, outline: float = 5.5) -> str:
    return circle(place, outline, "casing") + dot(place, role, radius)


def named(place: Point, words: str, role: str, *, above: bool = False) -> str:
    """The name of a point of the ball, far enough from it for the ring of its handle."""
    across = min(max(place[0], LONGEST_NAME / 2), WIDTH - LONGEST_NAME / 2)
    spot = (across, place[1] + (-20 if above else 30))
    return text(spot, words, f"{role} small ground", "middle")


def lamp(place: Point) -> str:
    """A disc with rays around it."""
    parts = [outlined_dot(place, "light", 6, 7)]
    for eighth in range(8):
        across, down = math.cos(math.pi * eighth / 4), math.sin(math.pi * eighth / 4)
        near, far = ((place[0] + reach * across, place[1] + reach * down) for reach in (9, 14))
        parts.append(line(near, far, "light"))
    return "".join(parts)


def shadow_edge(light_rad: float) -> str:
    """The terminator with an outline, visible on light and dark: the visible half of the circle
    where the light grazes the sphere. If the light is in front or behind, it is the whole rim."""
    reach, turns = RADIUS, [math.pi * step / 48 for step in range(97)]
    if abs(math.sin(light_rad)) >= 1e-9:
        side = 1 if math.cos(light_rad) * math.sin(light_rad) <= 0 else -1
        reach = abs(math.cos(light_rad)) * side * RADIUS
        turns = [math.pi * (step / 48 - 0.5) for step in range(49)]
    edge = [
        (CENTRE[0] + reach * math.cos(turn), CENTRE[1] + RADIUS * math.sin(turn)) for turn in turns
    ]
    return polyline(edge, "casing") + polyline(edge, "light dashed")
