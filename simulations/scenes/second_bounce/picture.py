"""The first panel of the second-bounce figure: the room as a camera sees it."""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from simulations.engine.drawing import circle, dot
from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb_table
from simulations.scenes._ball.marks import lamp, named
from simulations.scenes.second_bounce import ball, room
from simulations.scenes.second_bounce.room import Surface
from simulations.scenes.second_bounce.settings import Settings

ASIDE = 0.7
"""Distance along the edge from the ball's centre to the ends of the grid."""
GRID, FINER = 25, 97
"""Points along the sides of each plane at which the ball's share of the light is computed, and
those between which it is interpolated."""


@dataclass(frozen=True, slots=True)
class View:
    """What the picture shows of floor and wall, and what these see of the ball."""

    fine: float
    """Pixels per unit of the view box."""
    pixels: NDArray[np.intp]
    """(N,) indices of the pixels that show the planes."""
    cover: Floats
    """(N,) share of the pixel that they cover."""
    shown: Surface
    """(N,) the places shown."""
    across: Floats
    """(N, 1) share of the pixel that shows the other plane, beyond the edge."""
    share: Floats
    """(N, 1) form factor of the ball, from each of these."""
    cell: NDArray[np.intp]
    """(N,) index of the nearest point of the finer grid."""
    weights: Floats
    """(2 · GRID², NORMALS) of the ball's points, seen from those of the grid."""
    beyond: Surface
    """(2 · GRID², 16) what the ball hides from these."""


@dataclass(frozen=True, slots=True)
class BallView:
    """The pixels of the ball, which never change."""

    pixels: NDArray[np.intp]
    """(N,) their indices."""
    cover: Floats
    """(N, 1) share of the pixel that it covers."""
    normals: Floats
    """(N, 3)."""
    basis: Floats
    """(N, terms) for the light that is not the lamp's."""


@cache
def ball_view(fine: float) -> BallView:
    """Found once for each count of pixels per unit."""
    ways = room.rays(fine).reshape(-1, 3)
    middle = room.CENTRE - room.EYE
    along = ways @ middle
    off = np.sqrt(np.maximum(middle @ middle - along * along, 0.0))
    cover = np.clip((room.RADIUS - off) * room.FOCAL * fine / along + 0.5, 0.0, 1.0)
    pixels = np.flatnonzero(cover)
    inside = np.sqrt(np.maximum(room.RADIUS**2 - off[pixels] ** 2, 0.0))
    normals = ways[pixels] * (along[pixels] - inside)[:, None] - middle
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    return BallView(pixels, cover[pixels, None], normals, ball.basis(normals))


def view_of(opening: float, tier: str) -> View:
    """The planes at an angle, in degrees, to each other; in a draft by a quarter of the pixels."""
    fine = room.DRAFT_FINE if tier == room.DRAFT else room.FINE
    angle = math.radians(opening)
    along, off = room.wall_axes(angle)
    ways = room.rays(fine)
    shown = room.struck(np.broadcast_to(room.EYE, ways.shape), ways, angle)
    floor = shown.floor
    from_edge = np.where(floor, shown.places[..., 0], shown.places @ along)
    z = shown.places[..., 2]
    cover = _within(1.0 - from_edge) * _within(np.minimum(room.FRONT - z, z - room.BACK))
    cover *= (ways[..., 1] < 0) | (ways @ off < 0)
    pixels = np.flatnonzero(cover)
    places, on_floor = shown.places.reshape(-1, 3)[pixels], floor.ravel()[pixels]
    share = np.where(
        on_floor,
        ball.form_factor(places, np.array([0.0, 1.0, 0.0])),
        ball.form_factor(places, off),
    )
    row = _step(from_edge.ravel()[pixels])
    column = _step(0.5 + 0.5 * (places[:, 2] - room.CENTRE[2]) / ASIDE)
    cell = column + FINER * row + np.where(on_floor, 0, FINER * FINER)
    grid = _grid(along)
    nearer = np.rint(room.PARTS * np.clip(from_edge, 0.0, 1.0)).astype(np.intp)
    index = (nearer + np.where(floor, 0, room.PARTS + 1)).ravel()[pixels]
    starts = np.broadcast_to(grid[:, None], (len(grid), 16, 3))
    return View(
        fine=fine,
        pixels=pixels,
        cover=cover.ravel()[pixels],
        shown=Surface(index, on_floor, places),
        across=np.maximum(0.5 - _from_edge(fine)[pixels, None], 0.0),
        share=share[:, None],
        cell=cell,
        weights=ball.seen_side(grid),
        beyond=room.struck(starts, ball.through(grid), angle),
    )


def _step(share: Floats) -> NDArray[np.intp]:
    """(N,) nearest step of the finer grid's sides."""
    return np.rint((FINER - 1) * np.clip(share, 0.0, 1.0)).astype(np.intp)


def finer(grid: Floats) -> Floats:
    """(2 · FINER², 2) from values (2 · GRID², 2) at the grid's points, interpolated linearly."""
    spread = _spread()
    values = grid.reshape(2, GRID, GRID, 2).astype(np.float32)
    rows = np.tensordot(spread, values, (1, 1))  # FINER, 2, GRID, 2
    return np.tensordot(rows, spread, (2, 1)).transpose(1, 0, 3, 2).reshape(-1, 2)


@cache
def _spread() -> Floats:
    """(FINER, GRID) weights of linear interpolation."""
    places = np.linspace(0.0, GRID - 1.0, FINER)[:, None]
    return np.maximum(1.0 - np.abs(places - np.arange(GRID)), 0.0).astype(np.float32)


@cache
def _from_edge(fine: float) -> Floats:
    """(H · W,) distance of the pixels from the picture of the edge, in pixels."""
    high, wide = room.rays(fine).shape[:2]
    near, far = (np.array(room.project((0.0, 0.0, z))) for z in (room.FRONT, room.BACK))
    x, y = (np.arange(wide) + 0.5) / fine, (np.arange(high)[:, None] + 0.5) / fine
    along = (far - near) / np.linalg.norm(far - near)
    off = (x - near[0]) * along[1] - (y - near[1]) * along[0]
    return np.asarray(fine * np.abs(off), np.float32).ravel()


def _within(inside: Floats) -> Floats:
    """Coverage (H, W) of pixels, from the distance to a border in any unit."""
    down, across = np.gradient(inside)
    return np.clip(inside / np.maximum(np.hypot(down, across), 1e-9) + 0.5, 0.0, 1.0)


def _grid(along: Floats) -> Floats:
    """(2 · GRID², 3) points of the floor, then of the wall."""
    out, aside = np.linspace(0, 1, GRID), np.linspace(-ASIDE, ASIDE, GRID) + room.CENTRE[2]
    planes = []
    for axis in (np.array([1.0, 0.0, 0.0]), along):
        points = out[:, None, None] * axis + np.zeros((GRID, GRID, 3))
        points[..., 2] = aside
        planes.append(points.reshape(-1, 3))
    return np.concatenate(planes).astype(np.float32)


def paint(view: View, planes: Floats, on_ball: Floats) -> Raster:
    """Bytes (H, W, 4) from the brightness in red and blue of the planes' pixels (N, 2) and of
    the ball's (M, 2)."""
    of_ball = ball_view(view.fine)
    picture = np.zeros((*room.rays(view.fine).shape[:2], 4), np.uint8)
    flat = picture.reshape(-1, 4)
    flat[view.pixels] = _coded(planes, view.cover)
    behind = np.zeros((len(flat), 2), np.float32)
    behind[view.pixels] = planes
    under = behind[of_ball.pixels]
    mixed = under + of_ball.cover * (on_ball - under)
    flat[of_ball.pixels] = _coded(
        mixed, np.maximum(flat[of_ball.pixels, 3] / 255.0, of_ball.cover[:, 0])
    )
    return picture


def _coded(light: Floats, cover: Floats) -> Raster:
    """(N, 4) bytes of red and blue light (N, 2); the blue is green as well."""
    return to_rgba8(encode_srgb_table(light)[None][..., [0, 1, 1]], cover[None])[0]


def marks(settings: Settings) -> str:
    """The lamp, dashed behind the wall, and the chosen point."""
    here, source = room.on_floor(settings.place), room.lamp_at(settings.light_angle)
    hidden = settings.light_angle > settings.opening
    return "".join(
        (
            *((circle(source, 9, "light dashed"),) if hidden else lamp(source)),
            *(circle(here, 5.5, "casing"), dot(here, "image", 5)),
            named(here, "point", "image"),
        )
    )
