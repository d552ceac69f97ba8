"""Handles: their places, the settings that a pull changes, and the search for the nearest value."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest

from simulations.engine.controls import ControlError, PointLists, Value
from simulations.engine.frame import Frame, Panel, Place, to_json
from simulations.engine.handles import Handle, Point
from simulations.engine.photograph import Photograph
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, points, slider, toggle
from simulations.engine.stages import Outputs, StageCache
from site_builder.pages.views.question import _simulation


@dataclass(frozen=True, slots=True)
class Settings:
    across: float = slider("Across", 1, 0, 2, 0.25)
    along: int = slider("Along", 3, 0, 9, 3)
    kind: str = choice("Kind", {"left": "Left", "right": "Right"})
    grid: bool = toggle("Grid")
    lines: str = points("Lines", 3, 4, buttons={"add": "Add a line"}, default=";0.5,0.5")


def draw(_settings: Settings, _outputs: Outputs) -> Frame:
    return Frame((Panel("plane", "Plane", 400, 300),), (), "A plane.")


def at(settings: Settings, _outputs: Outputs) -> Point | None:
    return (100 * settings.across, 100.0 * settings.along)


def pull(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"across": place[0] / 100, "along": place[1] / 100}


POINT: Handle[Settings] = Handle("point", "plane", "Point", ("across", "along"), at, pull)
GROUND = replace(POINT, reach="drag")
NAN, RIGHT = float("nan"), {"kind": "right"}


def scene_of(*handles: Handle[Settings]) -> Scene[Settings]:
    return Scene("s", "S", Settings, draw, handles=handles)


def frame_of(handle: Handle[Settings], **given: Value) -> Frame:
    scene = scene_of(handle)
    return scene.render(scene.check(given), "", StageCache())


@pytest.mark.parametrize(
    ("handle", "along", "place"),
    [
        (POINT, 3, (Place("point", 125, 300),)),
        (POINT, 9, (Place("point", 125, 300),)),  # kept inside its panel
        (GROUND, 9, (Place("point", 125, 900),)),
        (replace(POINT, at=lambda *_: None), 3, ()),
        (replace(POINT, at=lambda *_: (NAN, 1.0)), 3, ()),
        (replace(POINT, at=lambda *_: (float("inf"), 1.0)), 3, ()),
        (replace(POINT, step=lambda *_: 0.5), 3, (Place("point", 125, 300, 0.5),)),
    ],
)
def test_frame_lists_the_places_of_its_handles(
    handle: Handle[Settings], along: int, place: tuple[Place, ...]
) -> None:
    frame = frame_of(handle, across=1.25, along=along)
    assert frame.handles == place
    listed = [
        {"name": p.name, "x": p.x, "y": p.y} | ({"step": 0.5} if p.step else {}) for p in place
    ]
    assert json.loads(to_json(frame)).get("handles", []) == listed


def scale(settings: Settings, _outputs: Outputs) -> Point | None:
    return None if settings.across == 2 else (100 * settings.across**2, 50)


def option(settings: Settings, _outputs: Outputs) -> Point:
    return ({"left": 10, "right": 90}[settings.kind], 0)


def searched(drives: str, where: Any) -> Handle[Settings]:
    return Handle("point", "plane", "Point", (drives,), where)


@pytest.mark.parametrize(
    ("handle", "place", "changes"),
    [
        (POINT, (112, 340), {"across": 1, "along": 3}),
        (POINT, (-50, 1e9), {"across": 0, "along": 9}),
        (replace(POINT, pull=lambda *_: {"across": NAN, "along": 6}), (0, 0), {"along": 6}),
        (replace(POINT, drives=("kind",), pull=lambda *_: RIGHT), (0, 0), RIGHT),
        (searched("across", scale), (100 * 0.75**2, 0), {"across": 0.75}),
        (searched("across", scale), (-500, 0), {"across": 0.0}),
        (searched("across", scale), (1e9, 1e9), {"across": 1.75}),  # at 2 it has no place
        (searched("along", lambda settings, _: (0, 7 * settings.along)), (0, 40), {"along": 6}),
        (searched("along", lambda *_: (0, 0)), (0, 40), {"along": 3}),  # it does not move
        (searched("along", lambda *_: None), (0, 40), {"along": 3}),
        (searched("kind", option), (60, 5), {"kind": "right"}),
    ],
)
def test_pull_rounds_settings_to_their_steps_and_clamps_them(
    handle: Handle[Settings], place: Point, changes: dict[str, Value]
) -> None:
    scene = scene_of(handle)
    assert scene.pull(scene.check({}), "point", place) == changes


@pytest.mark.parametrize(
    ("changed", "name", "place", "message"),
    [
        ({"drives": ("kind",), "pull": lambda *_: {"kind": "rihgt"}}, "point", (0, 0), "'right'"),
        ({"drives": ("along",)}, "point", (0, 0), "changes 'across'; legal: along"),
        ({}, "point", (NAN, 0), "legal: finite"),
        ({}, "piont", (0, 0), "'piont'; legal: point"),
    ],
)
def test_invalid_pull_is_refused(changed: Any, name: str, place: Point, message: str) -> None:
    with pytest.raises((ControlError, ValueError, KeyError), match=message):
        scene_of(replace(POINT, **changed)).pull(Settings(), name, place)


@pytest.mark.parametrize(
    ("handles", "message"),
    [
        ((replace(POINT, drives=("grid",)),), "drives 'grid'; legal: across, along, kind"),
        ((replace(POINT, drives=()),), "legal: one or two settings"),
        ((replace(POINT, reversed=("kind",)),), "reverses 'kind'; legal: across, along"),
        ((replace(POINT, role="the lamp"),), "role 'the lamp'; legal:"),
        ((replace(POINT, pull=None),), "'point' has no pull"),
        ((POINT, POINT), "two handles named 'point'"),
        ((GROUND, replace(GROUND, name="other")), "whole of panel 'plane'"),
    ],
)
def test_handles_that_contradict_their_scene_are_refused(handles: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        scene_of(*handles)


def test_handle_in_an_unknown_panel_is_refused() -> None:
    with pytest.raises(ValueError, match="panel 'plan'; legal: plane"):
        frame_of(replace(POINT, panel="plan"))


def test_pull_of_points_receives_the_readers_photograph() -> None:
    def moved(_: Settings, place: Point, photograph: Photograph | None) -> Mapping[str, Value]:
        shares = (((place[0] / 400, place[1] / 300),),)
        return {"lines": PointLists("own" if photograph else "book", 0, shares).text}

    scene = scene_of(replace(POINT, drives=("lines",), pull=moved))
    photograph = Photograph(1, np.zeros((1, 1, 3), np.uint8))
    for given, name in ((None, "book"), (photograph, "own")):
        pulled = scene.pull(Settings(), "point", (40, 30), "", given)
        assert pulled == {"lines": f"{name};0.1,0.1"}
    controls: Any = _simulation(scene)["controls"]
    listed = {control["name"] for control in controls}
    assert listed == {"across", "along", "kind", "grid"}, "points have no control"
