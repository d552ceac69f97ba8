"""Camera on a Gimbal: pan, tilt and roll on three rings, and the lock at a tilt of ±90°.

The camera's axes are the columns of C = Ry(pan) Rx(tilt) Rz(roll), in a world whose axes are
right, down and ahead. Each ring is perpendicular to its angle's axis. The pan ring is fixed in the
world, the tilt ring turns with the pan, the roll ring with both; at a tilt of ±90° the roll ring
lies in the plane of the pan ring, just inside it.

Beside it is what the camera sees: a round terrace, hills with trees, and a sky with stars.
Straight up and straight down, circles close around one point. There pan and roll both turn the
picture about its middle, so the lock can be seen.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import KW_ONLY, dataclass
from functools import cache, lru_cache, partial

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine import drawing
from simulations.engine.accuracy import Accuracy, columns
from simulations.engine.frame import (
    Frame,
    Panel,
    Raster,
    Readout,
    format_number,
    matrix_readout,
    readout,
)
from simulations.engine.handles import Handle, Point
from simulations.engine.plotting.clipping import runs_inside
from simulations.engine.raster import of_planes
from simulations.engine.scene import Scene
from simulations.engine.settings import slider
from simulations.engine.space.orbit import turning
from simulations.engine.space.view import View, runs
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats, Planes
from simulations.models.color.srgb import encode_srgb_codes
from simulations.models.geometry import euler
from simulations.models.geometry.rotation_paths import rate_axes
from simulations.scenes._turned_camera import draw_body, nearest, view_from

CENTRE = (200.0, 208.0)  # of the rings in their panel of 400 × 400
STEPS = 72
NEARLY = math.cos(math.radians(10.0))
"""The roll and the pan ring are drawn bold when the cosine between their axes exceeds this."""
LOCKED = 1.0 - 1e-9  # cosine between the two axes above which they count as one
LOST = 1e-6  # singular value below which a direction of rotation counts as lost

SIGHT = WIDTH, HEIGHT = 400.0, 340.0  # of the picture
MIDDLE = np.array([WIDTH / 2.0, HEIGHT / 2.0])
FOCAL = 260.0  # in view box units: the picture is 75° wide
FREEDOM_AT, FREEDOM, FREEDOM_FROM = (200.0, 154.0), 98.0, (72.0, 12.0)
"""Middle of the ellipsoid of the turns, view box units for a degree per degree, and azimuth and
elevation of the eye for a pan of 0."""
RINGS, ROLES = ("pan", "tilt", "roll"), ("world", "light", "ray")
NEAREST = 0.05
"""Cosine of the largest angle from the line of sight at which anything is drawn."""
NAMES = ("ahead", "right", "behind", "left")
_RNG = np.random.default_rng(5)
STARS = np.stack(
    [_RNG.uniform(0.0, 360.0, 700), np.degrees(np.arcsin(_RNG.uniform(0.02, 1.0, 700)))]
)
"""Azimuth and elevation (2, n) of the stars, in degrees, evenly over the sky."""
STAR_LIGHT = (0.09 * _RNG.pareto(1.5, 700) + 0.08).astype(np.float32)
"""(n,) of white, where a star is sharpest: few are bright."""
TREES = np.stack([np.arange(0.0, 360.0, 9.0) + _RNG.uniform(1.0, 8.0, 40), _RNG.uniform(3, 11, 40)])
"""Azimuth and height (2, n) of the trees, in degrees."""
SKYLINE_AT = np.arange(0.0, 360.5, 0.5)
SKYLINE_SINE = np.sin(
    np.radians(
        np.maximum(
            1.2 + np.sin(np.radians(3 * SKYLINE_AT)),  # hills
            (TREES[1] - 4.5 * np.abs((SKYLINE_AT[:, None] - TREES[0] + 180) % 360 - 180)).max(
                axis=1
            ),
        )
    )
)
"""Sine of the elevation of the top of hills and trees at `SKYLINE_AT`."""
ZENITH, GLOW, GROUND = np.array(
    [(0.006, 0.010, 0.030), (0.11, 0.085, 0.10), (0.004, 0.006, 0.008)], np.float32
)
"""Linear RGB straight up, added at the horizon, and of hills and trees."""
PAVING = np.array([0.040, 0.052, 0.082], np.float32)
"""Linear RGB of the terrace below, whose slabs lie in rings half an eye height wide."""
GALAXY = np.array([0.48, -0.36, 0.80])
"""Pole of the Milky Way."""


@dataclass(frozen=True, slots=True)
class Settings:
    pan: float = slider("Pan ψ", 60, -180, 180, 1, unit="°")
    tilt: float = slider("Tilt τ", 30, -90, 90, 1, unit="°")
    roll: float = slider("Roll γ", -20, -180, 180, 1, unit="°")
    azimuth: float = slider("View azimuth", 51, -180, 180, 1, unit="°")
    elevation: float = slider("View elevation", 28, -90, 90, 1, unit="°")


@dataclass(frozen=True, slots=True)
class Ring:
    """The circle of one Euler angle."""

    name: str
    role: str
    radius: float
    _: KW_ONLY
    axis: Floats
    """(3,) unit vector in the world about which the angle turns."""
    zero: Floats
    """(3,) unit vector across the axis: the zero of the angle."""
    angle_rad: float

    def at(self, angle_rad: ArrayLike) -> Floats:
        """Points (..., 3) of the ring at angles (...) from its zero."""
        angle = np.asarray(angle_rad, float)[..., None]
        aside = np.cross(self.axis, self.zero)
        return self.radius * (np.cos(angle) * self.zero + np.sin(angle) * aside)


@lru_cache(maxsize=4)  # called for each bead
def rings_of(pan: float, tilt: float, roll: float) -> tuple[Ring, Ring, Ring]:
    """The rings from outer to inner, for angles in degrees. The angle's end on one ring is the next
    one's zero or axis."""
    angles = pan_rad, tilt_rad, roll_rad = math.radians(pan), math.radians(tilt), math.radians(roll)
    pan_axis, tilt_axis, roll_axis = rate_axes("YXZ", angles).T
    panned = euler.to_matrix("YXZ", (pan_rad, 0.0, 0.0))
    return (
        Ring(
            "pan", "world", 178.0, axis=pan_axis, zero=np.array([0.0, 0.0, 1.0]), angle_rad=pan_rad
        ),
        Ring("tilt", "light", 144.0, axis=tilt_axis, zero=panned[:, 2], angle_rad=tilt_rad),
        Ring("roll", "ray", 166.0, axis=roll_axis, zero=tilt_axis, angle_rad=roll_rad),
    )


def view_of(azimuth: float, elevation: float) -> View:
    return View(view_from(azimuth, elevation), CENTRE)


def draw_rings(view: View, pan: float, tilt: float, roll: float) -> str:
    """The camera in its rings, seen from a side: `view_from`; angles in degrees."""
    three = rings_of(pan, tilt, roll)
    C = euler.to_matrix("YXZ", [ring.angle_rad for ring in three])
    circles = [view.place(ring.at(np.linspace(0.0, 2 * math.pi, STEPS + 1))) for ring in three]
    together = abs(float(three[0].axis @ three[2].axis))
    widths = ["bold" if together > NEARLY and ring.name != "tilt" else "thin" for ring in three]
    parts = []
    if together > LOCKED:  # the band between the two rings glows
        outer, share = circles[0][:, :2], three[2].radius / three[0].radius
        inner = np.asarray(CENTRE) + share * (outer[::-1] - CENTRE)
        parts = [drawing.polygon(np.concatenate([outer, inner]), "error solid faint")]
    for front, faint in ((False, " faint"), (True, "")):
        halves = [
            drawing.path(runs(circle, front=front), f"{ring.role} {width}{faint}")
            for ring, circle, width in zip(three, circles, widths, strict=True)
        ]
        ends = [_axis(ring, view, front=front) for ring in three]
        parts += (
            [*ends, *halves] if front else [*halves, *ends, draw_body(C, view.axes, CENTRE, 100.0)]
        )
    parts += [mark for ring in three for mark in _angle(ring, view)]
    for row, ring in enumerate(three):
        y, degrees = 22.0 + 21.0 * row, format_number(math.degrees(ring.angle_rad), 0)
        parts.append(drawing.line((14.0, y - 4.5), (32.0, y - 4.5), f"{ring.role} bold"))
        parts.append(drawing.text((40.0, y), f"{ring.name} {degrees}°", f"{ring.role} ground"))
    if together > LOCKED:
        parts.append(drawing.text((386.0, 22.0), "pan and roll: one axis", "error strong", "end"))
    return "".join(parts)


def draw_freedom(tilt: float) -> str:
    """The turns that angles changing by a degree in all make together: an ellipsoid, with the turn
    of each angle alone, and its shortest axis. It turns with the pan, and is seen nearly along the
    tilt axis, from where it flattens to a line."""
    J = rate_axes("YXZ", (0.0, math.radians(tilt), 0.0))
    look = View(view_from(*FREEDOM_FROM), FREEDOM_AT, FREEDOM)
    turns = np.linspace(0.0, 2 * math.pi, STEPS + 1)
    flat = np.stack([np.cos(turns), np.sin(turns), 0 * turns])
    circles = [look.place((J @ np.roll(flat, shift, axis=0)).T) for shift in range(3)]
    across, lengths, _ = np.linalg.svd(look.axes[:2] @ J)
    outline = FREEDOM_AT + FREEDOM * (across * lengths @ flat[:2]).T
    directions, stretches, _ = np.linalg.svd(J)
    worst = stretches[2] * directions[:, 2]
    parts = [drawing.polygon(outline, "camera fill")]
    for front, style in ((False, "camera thin faint"), (True, "camera thin")):
        parts.append(drawing.path([p for c in circles for p in runs(c, front=front)], style))
    for name, role, axis, anchor in zip(RINGS, ROLES, J.T, ("end", "middle", "start"), strict=True):
        x, y = look.at(*axis)
        aside = {"end": -8.0, "middle": 0.0, "start": 8.0}[anchor]
        parts.append(drawing.arrow(look.at(0.0, 0.0, 0.0), (x, y), f"{role} bold"))
        below = 18.0 if y > FREEDOM_AT[1] else -8.0
        parts.append(drawing.text((x + aside, y + below), name, f"{role} ground", anchor))
    words = f"{format_number(float(stretches[2]), 2)}° per degree, at worst"
    return "".join(
        (
            *parts,
            drawing.line(look.at(*-worst), look.at(*worst), "error bold"),
            drawing.text((WIDTH / 2.0, HEIGHT - 10.0), words, "error", "middle"),
        )
    )


def _axis(ring: Ring, view: View, *, front: bool) -> str:
    """One end of the axis, from near the camera to just outside the ring."""
    depth = view.place(ring.axis)[2]
    end = 1.0 if (depth < 0) == front else -1.0
    lengths = (112.0, ring.radius + 8.0)
    inner, outer = (view.place(end * length * ring.axis) for length in lengths)
    if end > 0:
        return drawing.arrow(inner, outer, ring.role, head=8)
    return drawing.line(inner, outer, f"{ring.role} thin dashed")


def _angle(ring: Ring, view: View) -> Iterator[str]:
    """The arc from zero to the angle, with a bead at its end."""
    count = max(2, round(abs(ring.angle_rad) * 12))
    arc = view.all(ring.at(np.linspace(0.0, ring.angle_rad, count + 1))).tolist()
    yield drawing.polyline(arc, f"{ring.role} bold")
    inner, outer = view.place(np.stack([ring.at(0.0) * 0.965, ring.at(0.0) * 1.035]))
    yield drawing.line(inner, outer, ring.role)
    yield drawing.dot(arc[-1], ring.role, 5.0)


def towards(azimuth_deg: Floats | float, elevation_deg: Floats | float) -> Floats:
    """Unit vectors (..., 3) in the world (right, down, ahead); the azimuth counts from ahead to the
    right."""
    azimuth, elevation = np.radians(azimuth_deg), np.radians(elevation_deg)
    azimuth, elevation = np.broadcast_arrays(azimuth, elevation)
    flat = np.cos(elevation)
    return np.stack([flat * np.sin(azimuth), -np.sin(elevation), flat * np.cos(azimuth)], axis=-1)


def view_box_places(C: Floats, directions: Floats) -> Floats:
    """View box places (..., 2) of directions of the world, for a camera whose axes are the columns
    of ``C``; NaN beside or behind the camera."""
    in_camera = directions @ C
    depth = in_camera[..., 2:]
    inside = depth > NEAREST
    return np.asarray(
        np.where(inside, MIDDLE + FOCAL * in_camera[..., :2] / np.where(inside, depth, 1.0), np.nan)
    )


def draw_sky(pan: float, tilt: float, roll: float, columns: int) -> Raster:
    """The night that the camera sees, ``columns`` pixels wide; angles in degrees."""
    C = euler.to_matrix("YXZ", np.radians([pan, tilt, roll]))
    fine = columns / WIDTH  # pixels per view box unit
    rows = round(fine * HEIGHT)
    right, down, ahead = np.tensordot(C.astype("f4"), _rays(rows, columns), 1)
    light = np.multiply.outer(GLOW, np.exp(-7.0 * np.maximum(-down, 0.0)))
    light += ZENITH[:, None, None]
    band = GALAXY[0] * right + GALAXY[1] * down + GALAXY[2] * ahead
    light += 0.016 * np.exp(-25.0 * band * band) + _stars(C, rows, columns)
    low = -down < SKYLINE_SINE.max()
    azimuth = np.degrees(np.arctan2(right[low], ahead[low])) % 360.0
    low[low] = -down[low] < np.interp(azimuth, SKYLINE_AT, SKYLINE_SINE)
    light[:, low] = GROUND[:, None]
    paved = down > 0.04
    slabs = _slabs(right[paved], down[paved], ahead[paved])
    light[:, paved] += np.multiply.outer(PAVING, slabs)
    return of_planes(encode_srgb_codes(light))


@cache
def _rays(rows: int, columns: int) -> Planes:
    """(3, rows, columns) unit vectors through the pixels, right, down and ahead of the camera."""
    pixels = (np.mgrid[:rows, :columns][::-1] + 0.5) * (WIDTH / columns)
    x, y = ((pixels - MIDDLE[:, None, None]) / FOCAL).astype("f4")
    return np.asarray(np.stack([x, y, np.ones_like(x)]) / np.sqrt(x * x + y * y + 1))


def _stars(C: Floats, rows: int, columns: int) -> Floats:
    """(rows, columns) their light, each spread over 5 × 5 pixels."""
    fine = columns / WIDTH
    places = fine * view_box_places(C, star_directions())
    visible = np.isfinite(places).all(axis=-1)
    spots, shine = places[visible].T[:, None], STAR_LIGHT[visible]
    u, v = np.floor(spots) + (np.mgrid[:5, :5].reshape(2, -1, 1) - 2)
    off = np.hypot(u + 0.5 - spots[0], v + 0.5 - spots[1])
    inside = (u >= 0) & (v >= 0) & (u < columns) & (v < rows)
    spread = shine * np.exp(-1.2 * (off / fine) ** 2)
    at = (v * columns + u)[inside].astype(int)
    return np.bincount(at, spread[inside], rows * columns).reshape(rows, columns).astype("f4")


@cache
def star_directions() -> Floats:
    return towards(*STARS)


def _slabs(right: Floats, down: Floats, ahead: Floats) -> Floats:
    """The light (n,) of the round terrace below the camera, from 0 to 1; it fades far away."""
    away = np.hypot(right, ahead) / down  # in eye heights
    sharp = 40.0 / (0.6 + away * away)
    sectors = np.clip(sharp * away * np.sin(6.0 * np.arctan2(right, ahead)), -1.0, 1.0)
    rings = np.clip(sharp * np.sin(2.0 * np.pi * away), -1.0, 1.0)
    return np.exp(-0.22 * away) * (0.6 + 0.4 * sectors * rings)


def draw_sight(pan: float, tilt: float, roll: float) -> str:
    """What is drawn over the picture of the camera; angles in degrees."""
    C = euler.to_matrix("YXZ", np.radians([pan, tilt, roll]))
    x, y = MIDDLE.tolist()
    parts = (
        _circles(C),
        *_names(C),
        drawing.line((x - 9, y), (x + 9, y), "camera"),
        drawing.line((x, y - 9), (x, y + 9), "camera"),
    )
    return "".join(parts)


def _circles(C: Floats) -> str:
    """Circles of equal elevation and upright half circles, every 15° and 30°."""
    across, down = view_box_places(C, _circle_points()).T  # NaN between two circles
    runs_in_view = runs_inside(across, down, (0.0, WIDTH), (0.0, HEIGHT))
    return drawing.path(runs_in_view, "light thin faint")


@cache
def _circle_points() -> Floats:
    turns, rises = np.linspace(0.0, 360.0, 121), np.linspace(0.0, 90.0, 31)
    curves = [towards(turns, level) for level in (15.0, 30.0, 45.0, 60.0, 75.0)]
    curves += [towards(azimuth, rises) for azimuth in np.arange(0.0, 360.0, 30.0).tolist()]
    gap = np.full((1, 3), np.nan)
    return np.concatenate([part for curve in curves for part in (curve, gap)])


def _names(C: Floats) -> Iterator[str]:
    quarters = zip(NAMES, (0.0, 90.0, 180.0, 270.0), strict=True)
    spots = [(name, towards(azimuth, -7.0)) for name, azimuth in quarters]
    ends = (("straight up", towards(0.0, 90.0)), ("straight down", towards(0.0, -90.0)))
    for name, direction in (*spots, *ends):
        spot = view_box_places(C, direction).tolist()
        if _is_inside(spot, 45.0):
            yield drawing.text((spot[0], spot[1] + 18.0), name, "world small ground", "middle")


def _is_inside(spot: Sequence[float], margin: float) -> bool:
    """Whether a place is so far inside the panel; false for NaN."""
    x, y = spot
    return margin < x < WIDTH - margin and margin < y < HEIGHT - margin


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The camera in its rings, and how well the three angles can turn it."""
    angles = (settings.pan, settings.tilt, settings.roll)
    angles_rad = np.radians(angles).tolist()
    smallest = float(np.linalg.svd(rate_axes("YXZ", angles_rad))[1][2])  # of the singular values
    pan, tilt, roll = (format_number(angle, 0) for angle in angles)
    locked = (
        f"All three angles still steer (smallest singular value {format_number(smallest, 2)})"
        if smallest > LOST
        else "The pan and roll rings lie in one plane: both angles turn the camera about the same "
        "line, and one degree of freedom is lost"
    )
    title, rings = "Pan, tilt and roll, each on its ring", outputs["rings"]
    C = euler.to_matrix("YXZ", angles_rad).tolist()
    return Frame(
        (
            Panel("gimbal", title, 400.0, 400.0, overlay=rings, lead=True),
            Panel("sight", "What the camera sees", *SIGHT, outputs["sky"], outputs["sight"]),
            Panel("freedom", "How far a degree turns it", *SIGHT, overlay=outputs["freedom"]),
        ),
        (
            matrix_readout("axes", "C, the camera’s axes as columns", C, role="camera"),
            Readout("rank", "Independent axes", f"{3 if smallest > LOST else 2} of 3"),
            readout("smallest", "Turn per degree, at worst", smallest, digits=3),
        ),
        f"Three rings around a camera at pan {pan}°, tilt {tilt}°, roll {roll}°. {locked}.",
    )


def bead(index: int, settings: Settings, _outputs: Outputs) -> Point:
    ring = rings_of(settings.pan, settings.tilt, settings.roll)[index]
    view = view_of(settings.azimuth, settings.elevation)
    return tuple(view.all(ring.at(ring.angle_rad)).tolist())


def bead_pulled(index: int, settings: Settings, place: Point) -> dict[str, float]:
    ring = rings_of(settings.pan, settings.tilt, settings.roll)[index]
    limit = 90 if ring.name == "tilt" else 180
    degrees = np.arange(-limit, limit + 1)
    view = view_of(settings.azimuth, settings.elevation)
    present = round(math.degrees(ring.angle_rad))
    distances = np.abs(np.remainder(degrees - present + 180, 360) - 180)
    track = view.place(ring.at(np.radians(degrees)))
    return {ring.name: float(degrees[nearest(track, place, distances)])}


def ring_handle(index: int, name: str, role: str) -> Handle[Settings]:
    at, pull = partial(bead, index), partial(bead_pulled, index)
    return Handle(name, "gimbal", f"{name.capitalize()} ring", (name,), at, pull, role=role)


SCENE = Scene(
    "gimbal",
    "Camera on a Gimbal",
    Settings,
    draw,
    (
        Stage("view", view_of),
        Stage("rings", draw_rings, ("view",)),
        Stage("freedom", draw_freedom),
        Stage("sky", draw_sky),
        Stage("sight", draw_sight),
    ),
    handles=(
        ring_handle(1, "tilt", "light"),
        ring_handle(0, "pan", "world"),
        ring_handle(2, "roll", "ray"),
        turning("gimbal"),
    ),
    accuracy=Accuracy(levels=columns(100, 200, 400)),
    formula=euler.to_matrix,
)
