"""The stages of the second-bounce figure: the lamp's light, the light between the planes, the ball,
and the room as a camera sees it.

There are two kinds of light: red, for which wall, floor and ball have the same albedo, and blue,
for which a red wall has a tenth of it.
"""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb_table
from simulations.models.light.interreflection import bounced, lamp_light, mean_lamp_light, seen_of
from simulations.scenes.second_bounce import room
from simulations.scenes.second_bounce.room import NORMALS, PARTS, Surface, shaded

DRAFT = "coarse"  # the draft while lamp, opening or albedo is dragged
FINE, DRAFT_FINE = 1.4, 0.7  # raster pixels per unit of the view box
RED_WALL = 0.1  # share of the floor's albedo that a red wall has in green and blue
PLACES: Floats = np.linspace(0.0, 1.0, 201)  # distances from the edge at which planes are shown
ASIDE = 0.7  # distance along the edge from the ball's centre to the ends of the grid
GRID, FINER = 25, 97
"""Points along the sides of each plane at which the ball's share of the light is computed, and
those between which it is interpolated."""


@dataclass(frozen=True, slots=True)
class Planes:
    """Brightness of both planes; 1 is a perfect white that faces the lamp."""

    lamp: Floats  # (2, 201) by the lamp alone, in red light; the floor first
    all_light: Floats  # (2, 2, 201) in red light and in blue: floor and wall

    def at(self, place: float) -> tuple[float, float, float]:
        """Brightness on the floor, interpolated: by the lamp alone, then in red and in blue."""
        red, blue = self.all_light
        lamp, red, blue = (np.interp(place, PLACES, each[0]) for each in (self.lamp, red, blue))
        return float(lamp), float(red), float(blue)


@dataclass(frozen=True, slots=True)
class Brightness:
    """Tables of brightness, for the picture: see `room.PARTS`."""

    lamp: Floats  # (NOTHING + 1, 2) of the planes in red and in blue, by the lamp alone
    before: Floats  # (NOTHING + 1, 2) one bounce earlier; 0 if there is no bounce
    shown: Floats  # (NOTHING + 1, 2) with all bounces that are chosen
    ball_before: Floats  # (NORMALS, 2) of the ball, one bounce earlier
    ball_bounced: Floats  # (terms, 2) polynomial of the ball's irradiance by the planes


@dataclass(frozen=True, slots=True)
class PlanesView:
    """What the picture shows of floor and wall, and what these see of the ball."""

    fine: float  # pixels per unit of the view box
    pixels: NDArray[np.intp]  # (N,) indices of the pixels that show the planes
    cover: Floats  # (N,) share of the pixel that they cover
    shown: Surface  # (N,) the places shown
    across: Floats  # (N, 1) share of the pixel that shows the other plane, beyond the edge
    share: Floats  # (N, 1) form factor of the ball, from each of these
    cell: NDArray[np.intp]  # (N,) index of the nearest point of the finer grid
    weights: Floats  # (2 · GRID², NORMALS) of the ball's points, seen from those of the grid
    beyond: Surface  # (2 · GRID², 16) what the ball hides from these


@dataclass(frozen=True, slots=True)
class BallView:
    """The pixels of the ball, which never change."""

    pixels: NDArray[np.intp]  # (N,) their indices
    cover: Floats  # (N, 1) share of the pixel that it covers
    normals: Floats  # (N, 3)
    basis: Floats  # (N, terms) for the light that is not the lamp's


def direct(light_angle: float, opening: float) -> Floats:
    """(2, CELLS) irradiance of the strips of floor and wall."""
    light, angle = math.radians(light_angle), math.radians(opening)
    return np.stack([mean_lamp_light(light, angle), mean_lamp_light(angle - light, angle)])


def count_of(bounces: str) -> int | None:
    return None if bounces == "all" else int(bounces)


def albedos_of(albedo: float, wall: str) -> Floats:
    """(2, 2) of floor and wall, in red light and in blue."""
    blue = albedo * RED_WALL if wall == "red" else albedo
    return np.array([[albedo, albedo], [albedo, blue]])


def planes_of(
    direct: Floats, light_angle: float, opening: float, bounces: str, albedo: float, wall: str
) -> Planes:
    """The brightness at all places. The last bounce is computed for each place, so that shadows
    stay sharp."""
    light, angle = math.radians(light_angle), math.radians(opening)
    sharp = np.stack([lamp_light(PLACES, light, angle), lamp_light(PLACES, angle - light, angle)])
    view = seen_of(PLACES, angle)
    count = count_of(bounces)
    shown = []
    for albedos in albedos_of(albedo, wall):
        arriving = sharp
        if count != 0:
            before = bounced(direct, albedos, angle, None if count is None else count - 1)
            arriving = sharp + before[::-1] @ view.T
        shown.append(albedos[:, None] * arriving)
    return Planes(albedo * sharp, np.stack(shown))


def brightness(
    direct: Floats,
    planes: Planes,
    surroundings: Surface,
    light_angle: float,
    opening: float,
    bounces: str,
    albedo: float,
    wall: str,
) -> Brightness:
    """The ball sees the planes as they were one bounce earlier, and the planes the ball."""
    light, angle = math.radians(light_angle), math.radians(opening)
    shares = albedos_of(albedo, wall) / albedo if albedo else np.ones((2, 2))
    lamp, shown = table(shares[..., None] * planes.lamp), table(planes.all_light)

    def earlier(by: int) -> Floats:
        """The planes some bounces earlier."""
        count = count_of(bounces)
        if count is None:
            return shown
        if count < by:
            return np.zeros_like(shown)
        fewer = planes_of(direct, light_angle, opening, str(count - by), albedo, wall)
        return table(fewer.all_light)

    def gathered(table: Floats) -> Floats:
        """(NORMALS, 2) irradiance of the ball by the planes, less its own shadow on these."""
        if not table.any():
            return np.zeros((NORMALS, 2))
        dark = shaded(surroundings.places, light)[..., None]
        seen = table[surroundings.index] - dark * lamp[surroundings.index]
        return np.asarray(seen.mean(axis=1))

    before = earlier(1)
    by_lamp = room.lamp_on_ball(room.ball_normals(), light, angle)[:, None]
    return Brightness(
        lamp=lamp,
        before=before,
        shown=shown,
        ball_before=albedo * (by_lamp + gathered(earlier(2))),
        ball_bounced=room.polynomial_fit() @ gathered(before),
    )


def table(brightness: Floats) -> Floats:
    """(NOTHING + 1, 2) from (2, 2, 201) of colours, planes and places."""
    fine = np.linspace(0.0, 1.0, PARTS + 1)
    columns = [
        np.concatenate([*(np.interp(fine, PLACES, plane) for plane in colour), [0.0]])
        for colour in brightness
    ]
    return np.stack(columns, axis=-1).astype(np.float32)


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
    return BallView(pixels, cover[pixels, None], normals, room.polynomial_basis(normals))


def view_of(opening: float, tier: str) -> PlanesView:
    """The planes at an angle, in degrees, to each other; in a draft by a quarter of the pixels."""
    fine = DRAFT_FINE if tier == DRAFT else FINE
    angle = math.radians(opening)
    along, off = room.wall_axes(angle)
    ways = room.rays(fine)
    shown = room.struck(np.broadcast_to(room.EYE, ways.shape), ways, angle)
    floor = shown.floor
    from_edge = np.where(floor, shown.places[..., 0], shown.places @ along)
    z = shown.places[..., 2]
    cover = within(1.0 - from_edge) * within(np.minimum(room.FRONT - z, z - room.BACK))
    cover *= (ways[..., 1] < 0) | (ways @ off < 0)
    pixels = np.flatnonzero(cover)
    places, on_floor = shown.places.reshape(-1, 3)[pixels], floor.ravel()[pixels]
    up = np.array([0.0, 1.0, 0.0])
    factors = (room.ball_form_factor(places, normal) for normal in (up, off))
    row = finer_step(from_edge.ravel()[pixels])
    column = finer_step(0.5 + 0.5 * (places[:, 2] - room.CENTRE[2]) / ASIDE)
    grid = grid_points(along)
    nearer = np.rint(PARTS * np.clip(from_edge, 0.0, 1.0)).astype(np.intp)
    index = (nearer + np.where(floor, 0, PARTS + 1)).ravel()[pixels]
    starts = np.broadcast_to(grid[:, None], (len(grid), 16, 3))
    return PlanesView(
        fine=fine,
        pixels=pixels,
        cover=cover.ravel()[pixels],
        shown=Surface(index, on_floor, places),
        across=np.maximum(0.5 - pixels_from_edge(fine)[pixels, None], 0.0),
        share=np.where(on_floor, *factors)[:, None],
        cell=column + FINER * row + np.where(on_floor, 0, FINER * FINER),
        weights=room.seen_side(grid),
        beyond=room.struck(starts, room.through_ball(grid), angle),
    )


def finer_step(share: Floats) -> NDArray[np.intp]:
    """(N,) nearest step of the finer grid's sides."""
    return np.rint((FINER - 1) * np.clip(share, 0.0, 1.0)).astype(np.intp)


def finer(grid: Floats) -> Floats:
    """(2 · FINER², 2) from values (2 · GRID², 2) at the grid's points, interpolated linearly."""
    spread = finer_weights()
    values = grid.reshape(2, GRID, GRID, 2).astype(np.float32)
    rows = np.tensordot(spread, values, (1, 1))  # FINER, 2, GRID, 2
    return np.tensordot(rows, spread, (2, 1)).transpose(1, 0, 3, 2).reshape(-1, 2)


@cache
def finer_weights() -> Floats:
    """(FINER, GRID) weights of linear interpolation."""
    places = np.linspace(0.0, GRID - 1.0, FINER)[:, None]
    return np.maximum(1.0 - np.abs(places - np.arange(GRID)), 0.0).astype(np.float32)


@cache
def pixels_from_edge(fine: float) -> Floats:
    """(H · W,) distance of the pixels from the picture of the edge, in pixels."""
    high, wide = room.rays(fine).shape[:2]
    near, far = (np.array(room.project((0.0, 0.0, z))) for z in (room.FRONT, room.BACK))
    x, y = (np.arange(wide) + 0.5) / fine, (np.arange(high)[:, None] + 0.5) / fine
    along = (far - near) / np.linalg.norm(far - near)
    off = (x - near[0]) * along[1] - (y - near[1]) * along[0]
    return np.asarray(fine * np.abs(off), np.float32).ravel()


def within(inside: Floats) -> Floats:
    """Coverage (H, W) of pixels, from the distance to a border in any unit."""
    down, across = np.gradient(inside)
    return np.clip(inside / np.maximum(np.hypot(down, across), 1e-9) + 0.5, 0.0, 1.0)


def grid_points(along: Floats) -> Floats:
    """(2 · GRID², 3) points of the floor, then of the wall."""
    out, aside = np.linspace(0, 1, GRID), np.linspace(-ASIDE, ASIDE, GRID) + room.CENTRE[2]
    planes = []
    for axis in (np.array([1.0, 0.0, 0.0]), along):
        points = out[:, None, None] * axis + np.zeros((GRID, GRID, 3))
        points[..., 2] = aside
        planes.append(points.reshape(-1, 3))
    return np.concatenate(planes).astype(np.float32)


def picture(
    lit: Brightness,
    view: PlanesView,
    light_angle: float,
    opening: float,
    bounces: str,
    albedo: float,
    wall: str,
) -> Raster:
    """The room, its ball and the ball's shadow: bytes (H, W, 4)."""
    light, angle = math.radians(light_angle), math.radians(opening)
    index = view.shown.index
    dark = shaded(view.shown.places, light)[:, None]
    planes = lit.shown[index] - dark * lit.lamp[index]
    if bounces != "0":
        hidden = lit.before[view.beyond.index]
        hidden -= shaded(view.beyond.places, light)[..., None] * lit.lamp[view.beyond.index]
        more = view.weights @ lit.ball_before - hidden.mean(axis=1)
        floor, other = albedos_of(albedo, wall).T
        more[: len(more) // 2] *= floor
        more[len(more) // 2 :] *= other
        planes += view.share * finer(more)[view.cell]
    mixed = np.flatnonzero(view.across)
    other = np.where(view.shown.floor[mixed], PARTS + 1, 0)
    beyond_edge = lit.shown[other] - dark[mixed] * lit.lamp[other]
    planes[mixed] += view.across[mixed] * (beyond_edge - planes[mixed])
    of_ball = ball_view(view.fine)
    by_lamp = room.lamp_on_ball(of_ball.normals, light, angle)[:, None]
    by_planes = np.maximum(of_ball.basis @ lit.ball_bounced, 0.0)
    return paint(view, np.maximum(planes, 0.0), albedo * (by_lamp + by_planes))


def paint(view: PlanesView, planes: Floats, on_ball: Floats) -> Raster:
    """Bytes (H, W, 4) from the brightness in red and blue of the planes' pixels (N, 2) and of
    the ball's (M, 2)."""
    of_ball = ball_view(view.fine)
    picture = np.zeros((*room.rays(view.fine).shape[:2], 4), np.uint8)
    flat = picture.reshape(-1, 4)
    flat[view.pixels] = coded(planes, view.cover)
    behind = np.zeros((len(flat), 2), np.float32)
    behind[view.pixels] = planes
    under = behind[of_ball.pixels]
    mixed = under + of_ball.cover * (on_ball - under)
    cover = np.maximum(flat[of_ball.pixels, 3] / 255.0, of_ball.cover[:, 0])
    flat[of_ball.pixels] = coded(mixed, cover)
    return picture


def coded(light: Floats, cover: Floats) -> Raster:
    """(N, 4) bytes of red and blue light (N, 2); the blue is green as well."""
    return to_rgba8(encode_srgb_table(light)[None][..., [0, 1, 1]], cover[None])[0]


STAGES = (
    Stage("direct", direct),
    Stage("planes", planes_of, ("direct",)),
    Stage("surroundings", room.surroundings),
    Stage("lit", brightness, ("direct", "planes", "surroundings")),
    Stage("view", view_of),
    Stage("picture", picture, ("lit", "view")),
)
