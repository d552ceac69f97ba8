"""Handles of the second-bounce figure: lamp, wall, and the point on the floor."""

from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.second_bounce import profile, room, section
from simulations.scenes.second_bounce.settings import Settings
from simulations.scenes.second_bounce.shown import shown_at


def _lamp(settings: Settings, _outputs: Outputs) -> Point:
    return section.towards(settings.light_angle, section.LAMP)


def _lamp_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"light_angle": section.angle_at(place)}


def _lamp_in_room(settings: Settings, _outputs: Outputs) -> Point:
    return room.lamp_at(settings.light_angle)


def _lamp_in_room_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"light_angle": room.nearest_angle(place)}


def _point_in_room(settings: Settings, _outputs: Outputs) -> Point:
    return room.on_floor(settings.place)


def _point_in_room_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"place": room.nearest_place(place)}


def _wall(settings: Settings, _outputs: Outputs) -> Point:
    return section.towards(settings.opening, section.LENGTH)


def _wall_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"opening": section.angle_at(place)}


def _point(settings: Settings, _outputs: Outputs) -> Point:
    return section.towards(0, section.LENGTH * settings.place)


def _point_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"place": section.distance_at(place)}


def _plotted(settings: Settings, outputs: Outputs) -> Point:
    return profile.at(settings.place, shown_at(outputs["planes"], settings.place).red)


def _plotted_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"place": profile.place_at(place)}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle(
        "lamp-in-room",
        "picture",
        "Lamp",
        ("light_angle",),
        _lamp_in_room,
        _lamp_in_room_pulled,
        role="light",
        reversed=("light_angle",),
    ),
    Handle(
        "point-in-room",
        "picture",
        "Point on the floor",
        ("place",),
        _point_in_room,
        _point_in_room_pulled,
        role="image",
    ),
    Handle(
        "lamp",
        "section",
        "Lamp",
        ("light_angle",),
        _lamp,
        _lamp_pulled,
        role="light",
        reversed=("light_angle",),
    ),
    Handle(
        "wall",
        "section",
        "Top of the wall",
        ("opening",),
        _wall,
        _wall_pulled,
        role="world",
        reversed=("opening",),
    ),
    Handle(
        "point", "section", "Point on the floor", ("place",), _point, _point_pulled, role="image"
    ),
    Handle(
        "plotted",
        "profile",
        "Point on the floor",
        ("place",),
        _plotted,
        _plotted_pulled,
        role="ray",
    ),
)
