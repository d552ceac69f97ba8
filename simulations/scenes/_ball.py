"""The ball and the vase of the scenes on reflection: pixels, normals, and the marks over them.

Both are turned about a vertical axis, widest at the height of their centre, and seen from far away.
So a point of the equator, the widest circle, at an angle to the camera has a normal at that angle.
Directions in the horizontal plane are given by their angle from the camera's, positive to the
right.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import KW_ONLY, dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import ArrayLike, NDArray

from simulations.engine.accuracy import tiers
from simulations.engine.drawing import Point, cased, circle, dot, line, polyline, text
from simulations.engine.frame import Panel, Raster, Readout, format_magnitude
from simulations.engine.handles import Handle
from simulations.engine.raster import of_planes, to_rgba8
from simulations.models.arrays import Floats, Mask
from simulations.models.color.srgb import encode_srgb, encode_srgb_codes
from simulations.models.error_measures import root_mean_square
from simulations.models.light.cell_blending import blend_cells, blend_normals

type Picture = NDArray[np.float32]

WIDTH, HEIGHT = 400, 340
CENTRE, RADIUS = (200.0, 170.0), 122.0  # the widest circle, in view box units
PIXELS_PER_UNIT = 1.75  # raster pixels per unit of the view box
RADIUS_PX = RADIUS * PIXELS_PER_UNIT
LONGEST_NAME = 116.0  # room for the name of a point, in view box units
SHELF = np.array([0.20, 0.11, 0.05], np.float32)  # linear RGB of the board under the body
LEAST_FOOT = 0.12  # half the width of the darkest shadow there, in radii


@dataclass(frozen=True, slots=True)
class Shape:
    """What a lathe turns. Its unit is the largest radius."""

    squared: Polynomial  # square of the radius, by the height above the widest circle
    low: float
    high: float
    """Heights of its ends."""

    def radius(self, height: Floats) -> Floats:
        return np.sqrt(np.maximum(self.squared(height), 0.0))


SPHERE = Shape(Polynomial((1, 0, -1)), -1.0, 1.0)
VASE = Shape(Polynomial((1, 0, -0.687, -0.970, -0.045, 1.468, 0.223, -0.572)) ** 2, -1.2, 1.2)


@dataclass(frozen=True, slots=True)
class Body:
    """The parts of the picture that depend on no control. The square is that around the body."""

    shape: Shape
    x: Picture  # (w,) pixels to the right of the centre, of the columns of the square
    _: KW_ONLY
    y: Picture  # (h,) pixels above the centre, of its rows
    normals: Picture  # (h, w, 3) unit normals in the square; z towards the camera
    inner: Mask  # (h, w) pixels that the body covers completely
    rim: Mask  # (h, w) pixels that it covers partly
    rim_coverage: Picture  # (rim pixels, 1) share of the pixel that it covers
    behind_rim: Picture  # (rim pixels, 3) linear light of the wall there
    backdrop: NDArray[np.uint8]  # (H, W, 4) wall and shelf alone
    square: tuple[slice, slice]  # place of the square in the picture


def build_ball() -> Body:
    return build_body(SPHERE)


def build_vase() -> Body:
    return build_body(VASE)


def build_body(shape: Shape) -> Body:
    scale = PIXELS_PER_UNIT
    height, width = round(HEIGHT * scale), round(WIDTH * scale)
    across = np.arange(width, dtype=np.float32) + 0.5 - CENTRE[0] * scale
    up = CENTRE[1] * scale - np.arange(height, dtype=np.float32) - 0.5
    low, high = shape.low * RADIUS_PX, shape.high * RADIUS_PX
    rows = np.flatnonzero((up > low - 1) & (up < high + 1))
    columns = np.flatnonzero(np.abs(across) < RADIUS_PX + 1)
    square = (slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1))
    y, x = up[square[0]], across[square[1]]
    ends = np.clip(np.minimum(y - low, high - y) + 0.5, 0, 1)[:, None]
    within = np.clip(RADIUS_PX * inside(shape, x, y) + 0.5, 0, 1)
    coverage = np.minimum(within, ends).astype(np.float32)
    rim = (coverage > 0) & (coverage < 1)
    wall = slate_wall(across, up)
    foot = RADIUS_PX * max(math.sqrt(shape.squared(shape.low)), LEAST_FOOT)
    wall[up < low] = shelf(across, low - up[up < low], foot)
    return Body(
        shape=shape,
        x=x,
        y=y,
        normals=unit_normals(shape, x, y).astype(np.float32),
        inner=coverage == 1,
        rim=rim,
        rim_coverage=coverage[rim][:, None],
        behind_rim=wall[square][rim],
        backdrop=to_rgba8(encode_srgb(wall)),
        square=square,
    )


def inside(shape: Shape, x: Floats, y: Floats) -> Floats:
    """Distance (h, w) of pixels to the outline, positive inside; exact to first order there."""
    across, up = np.meshgrid(x / RADIUS_PX, np.clip(y / RADIUS_PX, shape.low, shape.high))
    steep = np.hypot(2 * across, shape.squared.deriv()(up))
    return (shape.squared(up) - across**2) / np.maximum(steep, 1e-3)


def unit_normals(shape: Shape, x: Floats, y: Floats) -> NDArray[np.float64]:
    """Normals (h, w, 3) at columns ``x`` and rows ``y``; outside the body, the normals of its rim.

    A radius R(y) has the normal (x, -R dR/dy, z), and R dR/dy is half the slope of its square.
    """
    heights = np.clip(np.asarray(y, float) / RADIUS_PX, shape.low, shape.high)
    rising, squared = -0.5 * shape.squared.deriv()(heights), shape.squared(heights)
    across, up = np.meshgrid(np.asarray(x, float) / RADIUS_PX, rising)
    depth = np.sqrt(np.maximum(squared[:, None] - across**2, 0.0))
    normals = np.stack([across, up, depth], axis=-1)
    return normals / np.sqrt(np.einsum("...i,...i", normals, normals))[..., None]


def slate_wall(x: Picture, y: Picture) -> Picture:
    """Linear light (H, W, 3), a little lighter behind the body."""
    distance = np.hypot(x, y[:, None]) / (WIDTH * PIXELS_PER_UNIT)
    level = 0.105 - 0.085 * np.minimum(distance, 0.8)
    return (level[..., None] * np.array([0.92, 1.0, 1.12])).astype(np.float32)


def shelf(x: Picture, below: Floats, foot: float) -> Picture:
    """Linear light (h, W, 3) of the edge of a wooden shelf, at distances below its top: a lighter
    ridge, the grain, and the shadow below a body that stands on it, ``foot`` pixels wide."""
    down = below[:, None] / PIXELS_PER_UNIT
    across = x / PIXELS_PER_UNIT
    grain = 1.0 + 0.10 * np.sin(1.9 * down + 4.0 * np.sin(0.011 * across + 0.05 * down))
    ridge = 0.8 + 0.9 * np.exp(-down) - 0.012 * down
    beside = np.maximum(np.abs(x) - foot, 0.0) / PIXELS_PER_UNIT
    shadow = 1.0 - 0.75 * np.exp(-((beside / 5.0) ** 2) - down / 5.0)
    return np.asarray((grain * ridge * shadow)[..., None] * np.array(SHELF), np.float32)


def light_direction(angle_deg: float) -> NDArray[np.float64]:
    """Unit vector in the horizontal plane: 0° from the camera, 90° from the right.

    At ±90° and ±180° its zeros are exact. With sin 180° = 1.2e-16 a light from behind would
    light the rim on one side.
    """
    off_axis = angle_deg if abs(angle_deg) <= 90 else math.copysign(180, angle_deg) - angle_deg
    across, along = math.sin(math.radians(off_axis)), math.sin(math.radians(90 - abs(angle_deg)))
    return np.array([across, 0.0, along])


def corner_normals(body: Body, cells: int) -> Picture:
    """Normals (cells + 1, cells + 1, 3) at the corners of a grid over the square."""
    x, y = (np.linspace(axis[0], axis[-1], cells + 1) for axis in (body.x, body.y))
    return unit_normals(body.shape, x, y).astype(np.float32)


# The normals that a tier computes light for: of all pixels, or of its grid's corners. The tiers are
# rungs of the ladder `shading`, but for the blended normals. They save work in a mesh, which has no
# others, and not in a picture that has normals in every pixel.
LIT: Mapping[str, Callable[[Body], Floats]] = {
    **{f"gouraud-{cells}": partial(corner_normals, cells=cells) for cells in (8, 16, 32, 64)},
    "phong": lambda body: body.normals,
    "blended-normals-16": lambda body: blend_normals(corner_normals(body, 16), *body.inner.shape),
}
DEFAULT_TIER = "phong"
LEVELS = tiers(
    *LIT, labels={"phong": "Light in every pixel", "blended-normals-16": "Normals at 16 × 16 cells"}
)


def lit_normals(body: Body, tier: str) -> Floats:
    """Unit normals (..., 3) of the tier's entry in `LIT`."""
    return LIT[tier](body)


def light_of_pixels(light: Floats, body: Body) -> Floats:
    """Light (h, w, ...), interpolated across the cells if only their corners were lit."""
    return light if light.shape[:2] == body.inner.shape else blend_cells(light, *body.inner.shape)


def paint(body: Body, linear: Floats) -> NDArray[np.uint8]:
    """The bytes (H, W, 4) of light, (h, w) or three planes of it. Only the rim mixes body and
    wall."""
    picture = body.backdrop.copy()
    square = picture[body.square]
    shown = np.broadcast_to(encode_srgb_codes(linear), (3, *body.inner.shape))
    # Pixels are copied as one number of four bytes, which is faster than with a mask.
    whole, shown_whole = (rgba.view(np.uint32)[..., 0] for rgba in (square, of_planes(shown)))
    np.copyto(whole, shown_whole, where=body.inner)
    on_rim = linear[..., body.rim].reshape(-1, len(body.behind_rim)).T
    mixed = body.behind_rim + body.rim_coverage * (on_rim - body.behind_rim)
    square[body.rim, :3] = encode_srgb_codes(mixed)
    return picture


def camera_panel(picture: Raster, overlay: str) -> Panel:
    return Panel("camera", "What the camera sees", WIDTH, HEIGHT, picture, overlay, lead=True)


def true_cosine(body: Body, angle_deg: float) -> NDArray[np.float64]:
    """n · d (h, w) for the direction at an angle, from the equation of the sphere, float64."""
    return true_normals(body) @ light_direction(angle_deg)


def true_normals(body: Body) -> NDArray[np.float64]:
    """Normals (h, w, 3) from the equation of the shape, float64."""
    return unit_normals(body.shape, body.x, body.y)


def rms_error(body: Body, light: ArrayLike, truth: Floats) -> Readout:
    """RMS difference of (h, w) linear light from the truth, over the pixels of the body alone."""
    wrong = (np.asarray(light, np.float64) - truth)[body.inner]
    label = "RMS error of the light against its formula in float64"
    error = format_magnitude(root_mean_square(wrong), 1e-9)
    return Readout("error", label, error, "of white", role="error")


def on_equator(angle_rad: float) -> tuple[float, float]:
    """Place in the picture of the equator's point whose normal has an angle."""
    return CENTRE[0] + RADIUS * math.sin(angle_rad), CENTRE[1]


def probe_on_ball(role: str) -> Handle[Any]:
    """The handle of the probed point in the camera's picture; its setting is ``probe``."""
    return Handle(
        "probe",
        "camera",
        "Probed point",
        drives=("probe",),
        at=lambda settings, _: on_equator(math.radians(settings.probe)),
        role=role,
    )


def outlined_dot(place: Point, role: str, radius: float = 5.5, outline: float = 5.5) -> str:
    return circle(place, outline, "casing") + dot(place, role, radius)


def named(place: Point, words: str, role: str, *, above: bool = False) -> str:
    """The name of a point of the body, far enough from it for the ring of its handle."""
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


def shadow_edge(light_rad: float, shape: Shape = SPHERE) -> str:
    """The terminator with an outline, visible on light and dark: the visible half of the curve
    where the light grazes the body. If the light is in front or behind, it is the whole rim."""
    # Heights by a cosine, so that they are dense at the poles of a ball.
    share = 0.5 - 0.5 * np.cos(np.linspace(0.0, math.pi, 49))
    heights = shape.low + share * (shape.high - shape.low)
    radii = shape.radius(heights)
    if abs(math.sin(light_rad)) < 1e-9:
        heights, radii = np.append(heights, heights[::-1]), np.append(radii, -radii[::-1])
    else:
        radii = -math.copysign(1.0, math.sin(light_rad)) * math.cos(light_rad) * radii
    edge = list(zip(CENTRE[0] + RADIUS * radii, CENTRE[1] - RADIUS * heights, strict=True))
    return cased(polyline, edge, style="light dashed")
