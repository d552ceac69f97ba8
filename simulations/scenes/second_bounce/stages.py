"""The stages of the second-bounce figure: the lamp's light, the light between the planes, the ball.

There are two kinds of light: red, for which wall, floor and ball have the same albedo, and blue,
for which a red wall has a tenth of it.
"""

import math
from dataclasses import dataclass

import numpy as np

from simulations.engine.frame import Raster
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.light.interreflection import (
    bounced,
    lamp_light,
    mean_lamp_light,
    seen_of,
)
from simulations.scenes.second_bounce import ball, room
from simulations.scenes.second_bounce.picture import View, ball_view, finer, paint, view_of
from simulations.scenes.second_bounce.room import Surface, shaded

RED_WALL = 0.1
"""Share of the floor's albedo that a red wall has in green and blue."""
PLACES: Floats = np.linspace(0.0, 1.0, 201)
"""Distances from the edge at which both planes are shown."""


@dataclass(frozen=True, slots=True)
class Planes:
    """Brightness of both planes; 1 is a perfect white that faces the lamp."""

    lamp: Floats
    """(2, 201) by the lamp alone, in red light; the floor first."""
    all_light: Floats
    """(2, 2, 201) in red light and in blue: floor and wall."""


@dataclass(frozen=True, slots=True)
class Lit:
    """Tables of brightness, for the picture: see `room.PARTS`."""

    lamp: Floats
    """(NOTHING + 1, 2) of the planes in red and in blue, by the lamp alone."""
    before: Floats
    """(NOTHING + 1, 2) one bounce earlier; 0 if there is no bounce."""
    shown: Floats
    """(NOTHING + 1, 2) with all bounces that are chosen."""
    ball_before: Floats
    """(NORMALS, 2) of the ball, one bounce earlier."""
    ball_bounced: Floats
    """(terms, 2) polynomial of the ball's irradiance by the planes."""


def _direct(light_angle: float, opening: float) -> Floats:
    """(2, CELLS) irradiance of the strips of floor and wall."""
    light, angle = math.radians(light_angle), math.radians(opening)
    return np.stack([mean_lamp_light(light, angle), mean_lamp_light(angle - light, angle)])


def _count(bounces: str) -> int | None:
    return None if bounces == "all" else int(bounces)


def _albedos(albedo: float, wall: str) -> Floats:
    """(2, 2) of floor and wall, in red light and in blue."""
    blue = albedo * RED_WALL if wall == "red" else albedo
    return np.array([[albedo, albedo], [albedo, blue]])


def _planes(
    direct: Floats, light_angle: float, opening: float, bounces: str, albedo: float, wall: str
) -> Planes:
    """The brightness at all places. The last bounce is computed for each place, so that shadows
    stay sharp."""
    light, angle = math.radians(light_angle), math.radians(opening)
    sharp = np.stack([lamp_light(PLACES, light, angle), lamp_light(PLACES, angle - light, angle)])
    view = seen_of(PLACES, angle)
    count = _count(bounces)
    shown = []
    for albedos in _albedos(albedo, wall):
        arriving = sharp
        if count != 0:
            before = bounced(direct, albedos, angle, None if count is None else count - 1)
            arriving = sharp + before[::-1] @ view.T
        shown.append(albedos[:, None] * arriving)
    return Planes(albedo * sharp, np.stack(shown))


def _surroundings(opening: float) -> Surface:
    return ball.surroundings(math.radians(opening))


def _lit(
    direct: Floats,
    planes: Planes,
    surroundings: Surface,
    light_angle: float,
    opening: float,
    bounces: str,
    albedo: float,
    wall: str,
) -> Lit:
    """The ball sees the planes as they were one bounce earlier, and the planes the ball."""
    light, angle = math.radians(light_angle), math.radians(opening)

    def earlier(by: int) -> Floats:
        """The planes some bounces earlier."""
        count = _count(bounces)
        if count is None:
            return shown
        if count < by:
            return np.zeros_like(shown)
        return _table(
            _planes(direct, light_angle, opening, str(count - by), albedo, wall).all_light
        )

    def gathered(table: Floats) -> Floats:
        """(NORMALS, 2) irradiance of the ball by the planes, less its own shadow on these."""
        if not table.any():
            return np.zeros((ball.NORMALS, 2))
        dark = shaded(surroundings.places, light)[..., None]
        seen = table[surroundings.index] - dark * lamp[surroundings.index]
        return np.asarray(seen.mean(axis=1))

    shares = _albedos(albedo, wall) / albedo if albedo else np.ones((2, 2))
    lamp = _table(shares[..., None] * planes.lamp)
    shown = _table(planes.all_light)
    before = earlier(1)
    by_lamp = ball.lamp_on(ball.normals(), light, angle)[:, None]
    return Lit(
        lamp=lamp,
        before=before,
        shown=shown,
        ball_before=albedo * (by_lamp + gathered(earlier(2))),
        ball_bounced=ball.fit() @ gathered(before),
    )


def _table(brightness: Floats) -> Floats:
    """(NOTHING + 1, 2) from (2, 2, 201) of colours, planes and places."""
    fine = np.linspace(0.0, 1.0, room.PARTS + 1)
    columns = [
        np.concatenate([*(np.interp(fine, PLACES, plane) for plane in colour), [0.0]])
        for colour in brightness
    ]
    return np.stack(columns, axis=-1).astype(np.float32)


def _picture(
    lit: Lit,
    view: View,
    light_angle: float,
    opening: float,
    bounces: str,
    albedo: float,
    wall: str,
) -> Raster:
    """The room, its ball and the ball's shadow."""
    light, angle = math.radians(light_angle), math.radians(opening)
    index = view.shown.index
    dark = shaded(view.shown.places, light)[:, None]
    planes = lit.shown[index] - dark * lit.lamp[index]
    if bounces != "0":
        hidden = lit.before[view.beyond.index]
        hidden -= shaded(view.beyond.places, light)[..., None] * lit.lamp[view.beyond.index]
        more = view.weights @ lit.ball_before - hidden.mean(axis=1)
        floor, other = _albedos(albedo, wall).T
        more[: len(more) // 2] *= floor
        more[len(more) // 2 :] *= other
        planes += view.share * finer(more)[view.cell]
    mixed = np.flatnonzero(view.across)
    other = np.where(view.shown.floor[mixed], room.PARTS + 1, 0)
    beyond_edge = lit.shown[other] - dark[mixed] * lit.lamp[other]
    planes[mixed] += view.across[mixed] * (beyond_edge - planes[mixed])
    of_ball = ball_view(view.fine)
    by_lamp = ball.lamp_on(of_ball.normals, light, angle)[:, None]
    by_planes = np.maximum(of_ball.basis @ lit.ball_bounced, 0.0)
    return paint(view, np.maximum(planes, 0.0), albedo * (by_lamp + by_planes))


STAGES = (
    Stage("direct", _direct),
    Stage("planes", _planes, ("direct",)),
    Stage("surroundings", _surroundings),
    Stage("lit", _lit, ("direct", "planes", "surroundings")),
    Stage("view", view_of),
    Stage("picture", _picture, ("lit", "view")),
)
