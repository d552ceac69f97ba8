"""A closed room with red walls: light that bounces from wall to wall, and deepens.

There are two kinds of light: red, for which all surfaces have the same albedo, and blue, for which
what is red has a tenth of it. Floor, ceiling and ball are white, unless everything is red.
"""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np

from simulations.engine.accuracy import Accuracy, columns
from simulations.engine.drawing import cased, circle, line, text
from simulations.engine.frame import Frame, Panel, Raster, format_number, readout
from simulations.engine.handles import Handle
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.engine.plotting.labels import name_curves
from simulations.engine.raster import of_planes
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb_codes
from simulations.models.light.interreflection import CELLS, bounced, exchange
from simulations.scenes._ball import lamp, named, outlined_dot
from simulations.scenes.second_bounce import room

WALLS = {"red": "Red", "white": "White, as the floor", "all": "Red, with floor and ceiling"}
BOUNCES = {
    "0": "None: the lamp alone",
    "1": "The first",
    "2": "First and second",
    "4": "The first four",
    "all": "All",
}
RED = 0.1  # share of the white's albedo that red paint has in green and blue
COLUMNS = 510  # pixels across and down, at rest
PLACES: Floats = np.linspace(0.0, 1.0, room.FINER + 1)  # distances from the edge on the line

PLOT = Plot(Axis(-1.0, 1.0, 42.0, 386.0), Axis(0.0, 1.2, 262.0, 22.0))
"""Places along the wall from −1 to 0, along the floor from 0 to 1."""
FROM_EDGE = Scale(ticks=[(place, f"{abs(place):g}") for place in (-1, 0, 1)])
ALONG = np.concatenate([PLACES - 1.0, PLACES])


@dataclass(frozen=True, slots=True)
class Settings:
    bounces: str = choice("Bounces", BOUNCES, "all")
    light_angle: float = slider("Lamp above the floor", 55, 10, 170, 1, unit="°")
    albedo: float = slider("Albedo ρ", 0.8, 0, 0.95, 0.01)
    wall: str = choice("Walls", WALLS)
    place: float = slider("Point on the floor", 0.15, 0.01, 0.99, 0.01)


@dataclass(frozen=True, slots=True)
class Light:
    """What the walls send to each other, in red light and in blue."""

    arriving: Floats  # (6 · (FINER + 1)², 2) irradiance by the other walls, at the finer places
    on_ball: Floats  # (9, 2) polynomial of the ball's irradiance by them
    mean: tuple[float, float]  # brightness of the walls in red: by the lamp alone, and with bounces


@dataclass(frozen=True, slots=True)
class Profile:
    """Brightness down the wall and along the floor; 1 is a perfect white that faces the lamp."""

    lamp: Floats  # (2 · (FINER + 1),) by the lamp alone, in red light
    all_light: Floats  # (2 · (FINER + 1), 2) in red light and in blue

    def at(self, place: float) -> tuple[float, float, float]:
        """On the floor, interpolated: by the lamp alone, then in red and in blue."""
        curves = (self.lamp, *self.all_light.T)
        lamp, red, blue = (float(np.interp(place, PLACES, each[-len(PLACES) :])) for each in curves)
        return lamp, red, blue


def direct(light_angle: float) -> Floats:
    """(6, CELLS, CELLS) irradiance of the patches by the lamp: means of `room.SAMPLES`² points."""
    found = room.sampled().by_lamp(light_angle)
    return found.reshape(6, CELLS, room.SAMPLES, CELLS, room.SAMPLES).mean(axis=(2, 4))


def albedos_of(albedo: float, wall: str) -> Floats:
    """(7, 2) of the walls and the ball, in red light and in blue."""
    reds = {"red": [0, 1, 4, 5], "white": [], "all": range(6)}[wall]
    found = np.full((7, 2), albedo)
    found[list(reds), 1] *= RED
    return found


def light_of(direct: Floats, bounces: str, albedo: float, wall: str) -> Light:
    """Light arriving from the walls, which they reflected one bounce earlier."""
    colours, count = albedos_of(albedo, wall)[:6].T, None if bounces == "all" else int(bounces)
    before = [np.zeros_like(direct)] * 2
    if count != 0:
        fewer = None if count is None else count - 1
        before = [bounced(direct, albedos, fewer) for albedos in colours]
    sent = np.stack([each.ravel() for each in before], axis=-1)
    arriving = (exchange() @ sent).reshape(6, CELLS, CELLS, 2)
    spread = room.finer_weights()
    finer = np.einsum("ai,fijc,bj->fabc", spread, arriving, spread, optimize=True)
    of_lamp = float(albedo * direct.mean())
    return Light(
        np.maximum(finer, 0.0).reshape(-1, 2).astype(np.float32),
        (room.light_on_ball() @ sent).astype(np.float32),
        (of_lamp, of_lamp + float(albedo * arriving[..., 0].mean())),
    )


def first_of(direct: Floats, albedo: float, wall: str) -> Light:
    return light_of(direct, "1", albedo, wall)


def profile_of(light: Light, light_angle: float, albedo: float, wall: str) -> Profile:
    places, index = room.line(len(PLACES))
    lit = places.by_lamp(light_angle)
    shares = np.repeat(albedos_of(albedo, wall)[[0, 2]], len(PLACES), axis=0)
    return Profile(albedo * lit, shares * (lit[:, None] + light.arriving[index]))


def by_lamp(light_angle: float, columns: int) -> Floats:
    """(N,) irradiance by the lamp, in each pixel."""
    return room.view(columns).places.by_lamp(light_angle)


def picture(light: Light, by_lamp: Floats, albedo: float, wall: str, columns: int) -> Raster:
    """The room: bytes (H, W, 4)."""
    view, codes = room.view(columns), []
    for colour, albedos in enumerate(albedos_of(albedo, wall).astype(np.float32).T):
        arriving = light.arriving[:, colour].take(view.index)
        on_ball = np.maximum(view.basis @ light.on_ball[:, colour], 0.0)
        of_ball = albedos[6] * (on_ball.mean() + by_lamp[view.ball].mean())
        arriving += view.hidden * (of_ball - arriving)
        arriving[view.ball] = on_ball
        radiance = albedos.take(view.wall) * (by_lamp + arriving)
        radiance[view.borders] = radiance.take(view.around).mean(axis=0)
        codes.append(encode_srgb_codes(radiance).reshape(columns, columns))
    return of_planes((codes[0], codes[1], codes[1]))


def first_picture(first: Light, by_lamp: Floats, albedo: float, wall: str, columns: int) -> Raster:
    return picture(first, by_lamp, albedo, wall, columns)


STAGES = (
    Stage("direct", direct),
    Stage("light", light_of, ("direct",)),
    Stage("first", first_of, ("direct",)),
    Stage("profile", profile_of, ("light",)),
    Stage("by_lamp", by_lamp),
    Stage("picture", picture, ("light", "by_lamp")),
    Stage("first picture", first_picture, ("first", "by_lamp")),
)


def lamp_in_room(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    """Where the lamp's axis meets floor or wall."""
    turn = math.radians(settings.light_angle)
    across, down = -math.cos(turn), -math.sin(turn)
    reach = min(-room.LAMP[1] / down, 0.5 / max(abs(across), 1e-9))
    x, y, z = room.LAMP + reach * np.array([across, down, 0.0])
    return room.project((float(x), float(y), float(z)))


def point_in_room(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return room.project((settings.place, 0.0, room.LINE))


def marks(settings: Settings) -> str:
    """The lamp with its axis, and the chosen point."""
    source = room.project((0.5, float(room.LAMP[1]), float(room.LAMP[2])))
    spot, here = lamp_in_room(settings, {}), point_in_room(settings, {})
    return "".join(
        (
            cased(line, source, spot, style="light dashed"),
            lamp(source),
            cased(circle, spot, 6, style="light"),
            outlined_dot(here, "image", 5),
            named(here, "point", "image", above=True),
        )
    )


def curves(profile: Profile, place: float) -> str:
    red, blue = profile.all_light.T
    _, red_here, blue_here = profile.at(place)
    drawn = (
        ("lamp alone", "light dashed", profile.lamp),
        ("blue light", "image", blue),
        ("red light", "ray bold", red),
    )
    return "".join(
        (
            axes(),
            *(PLOT.curve(ALONG, np.minimum(each, PLOT.y.high), style) for _, style, each in drawn),
            name_curves(PLOT, ALONG, drawn),
            PLOT.drop(place, red_here, "muted thin"),
            PLOT.mark(place, blue_here, "image", radius=4.0),
            PLOT.mark(place, red_here, "ray"),
        )
    )


@cache
def axes() -> str:
    (wall, foot), (edge, _), (floor, _) = (PLOT.at(place, 0) for place in (-0.5, 0, 0.5))
    return "".join(
        (
            PLOT.frame(FROM_EDGE, Scale(ticks=(0, 1))),
            PLOT.upright(0.0, "world thin dashed"),
            text((wall, foot + 38), "← up the left wall", "world small", "middle"),
            text((floor, foot + 38), "along the floor →", "world small", "middle"),
            text((edge, foot + 38), "edge", "world small", "middle"),
        )
    )


def draw(settings: Settings, outputs: Outputs) -> Frame:
    profile: Profile = outputs["profile"]
    by_lamp, red, blue = profile.at(settings.place)
    alone, together = outputs["light"].mean
    size = (room.SIZE, room.SIZE)
    title = f"Bounces: {BOUNCES[settings.bounces].lower()}"
    return Frame(
        (
            Panel("picture", title, *size, outputs["picture"], marks(settings), lead=True),
            Panel("first", "The first bounce only", *size, outputs["first picture"]),
            Panel(
                "profile",
                "Brightness along a line",
                400,
                320,
                overlay=curves(profile, settings.place),
            ),
        ),
        (
            readout("lamp", "Point, lamp alone", by_lamp, digits=3, role="light"),
            readout("red", "Point, red light", red, digits=3, role="ray"),
            readout("blue", "Point, blue light", blue, digits=3, role="image"),
            readout("bounced", "Point, red light from the walls", red - by_lamp, digits=3),
            readout(
                "factor",
                "Room, red light: times the lamp’s",
                together / alone if alone else 1.0,
                digits=2,
            ),
        ),
        describe(settings, red, blue),
    )


def describe(settings: Settings, red: float, blue: float) -> str:
    paint = {"red": "red walls", "white": "white walls", "all": "red walls, floor and ceiling"}
    return (
        f"A white ball in a closed room with {paint[settings.wall]}, under a lamp that shines from "
        f"{settings.light_angle:.0f}° above the floor. Bounces of its light: "
        f"{BOUNCES[settings.bounces].lower()}. A point {100 * settings.place:.0f}\u00a0% of the "
        f"way along the floor has the brightness {format_number(red)} in red light and "
        f"{format_number(blue)} in blue."
    )


def plotted_at(settings: Settings, outputs: Outputs) -> tuple[float, float]:
    return PLOT.clamped(settings.place, outputs["profile"].at(settings.place)[1])


LIGHT, PLACE = ("light_angle",), ("place",)
HANDLES: tuple[Handle[Settings], ...] = (
    Handle("lamp-in-room", "picture", "Lamp", LIGHT, lamp_in_room, role="light"),
    Handle("point-in-room", "picture", "Point on the floor", PLACE, point_in_room, role="image"),
    Handle("plotted", "profile", "Point on the floor", PLACE, plotted_at, role="ray"),
)
SCENE = Scene(
    "second-bounce",
    "A Shadow and a Second Bounce",
    Settings,
    draw,
    STAGES,
    HANDLES,
    accuracy=Accuracy(levels=columns(170, 255, COLUMNS)),
    formula=bounced,
)
