"""What the engine promises about handles: where they are, and what a pull may change."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import pytest

from simulations.engine.controls import ControlError, Slider, Value
from simulations.engine.frame import Frame, Panel, Place, to_json
from simulations.engine.handles import Handle, Point
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider, toggle
from simulations.engine.stages import Outputs, StageCache


@dataclass(frozen=True, slots=True)
class Settings:
    across: float = slider("Across", 1, 0, 2, 0.25)
    along: int = slider("Along", 3, 0, 9, 3)
    kind: str = choice("Kind", {"left": "Left", "right": "Right"})
    grid: bool = toggle("Grid")


def draw(_settings: Settings, _outputs: Outputs) -> Frame:
    return Frame((Panel("plane", "Plane", 400, 300),), (), "A plane.")


def at(settings: Settings, _outputs: Outputs) -> Point | None:
    return (100 * settings.across, 100.0 * settings.along)


def pull(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"across": place[0] / 100, "along": place[1] / 100}


POINT: Handle[Settings] = Handle("point", "plane", "Point", ("across", "along"), at, pull)


def scene_of(*handles: Handle[Settings]) -> Scene[Settings]:
    return Scene("s", "S", Settings, draw, handles=handles)


def frame_of(handle: Handle[Settings], **given: Value) -> Frame:
    scene = scene_of(handle)
    return scene.render(scene.check(given), "", StageCache())


def test_a_frame_says_where_its_handles_are() -> None:
    frame = frame_of(POINT, across=1.25, along=3)
    assert frame.handles == (Place("point", 125, 300),)
    assert json.loads(to_json(frame))["handles"] == [{"name": "point", "x": 125, "y": 300}]


def test_a_mark_stays_inside_its_panel() -> None:
    assert frame_of(POINT, along=9).handles == (Place("point", 100, 300),)


def test_what_is_dragged_from_anywhere_may_lie_outside() -> None:
    ground = replace(POINT, reach="drag")
    assert frame_of(ground, along=9).handles == (Place("point", 100, 900),)


@pytest.mark.parametrize("nowhere", [None, (float("nan"), 1.0), (float("inf"), 1.0)])
def test_a_handle_without_a_place_is_not_offered(nowhere: Point | None) -> None:
    assert frame_of(replace(POINT, at=lambda _settings, _outputs: nowhere)).handles == ()


def test_a_pull_brings_its_settings_onto_their_steps_and_into_their_range() -> None:
    scene = scene_of(POINT)
    start = scene.check({})
    assert scene.pull(start, "point", (112, 340)) == {"across": 1, "along": 3}
    assert scene.pull(start, "point", (-50, 1e9)) == {"across": 0, "along": 9}


def test_what_no_number_leads_to_stays_as_it_is() -> None:
    lost = replace(POINT, pull=lambda _settings, _place: {"across": float("nan"), "along": 6})
    assert scene_of(lost).pull(Settings(), "point", (0, 0)) == {"along": 6}


def test_a_menu_takes_only_its_options() -> None:
    kinds = replace(POINT, drives=("kind",), pull=lambda _settings, _place: {"kind": "right"})
    assert scene_of(kinds).pull(Settings(), "point", (0, 0)) == {"kind": "right"}
    wrong = replace(kinds, pull=lambda _settings, _place: {"kind": "rihgt"})
    with pytest.raises(ControlError, match="did you mean 'right'"):
        scene_of(wrong).pull(Settings(), "point", (0, 0))


def test_a_pull_may_change_nothing_else() -> None:
    greedy = replace(POINT, drives=("along",))
    with pytest.raises(ValueError, match="'point': a pull changes 'across'; legal: along"):
        scene_of(greedy).pull(Settings(), "point", (0, 0))


def test_a_place_must_be_one() -> None:
    with pytest.raises(ValueError, match="legal: finite"):
        scene_of(POINT).pull(Settings(), "point", (float("nan"), 0))
    with pytest.raises(KeyError, match="'piont'; legal: point"):
        scene_of(POINT).pull(Settings(), "piont", (0, 0))


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"drives": ("grid",)}, "drives 'grid'; legal: across, along, kind"),
        ({"drives": ()}, "legal: one or two settings"),
        ({"reversed": ("kind",)}, "reverses 'kind'; legal: across, along"),
        ({"role": "the lamp"}, "role 'the lamp'; legal:"),
    ],
)
def test_a_scene_refuses_a_handle_that_contradicts_it(wrong: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        scene_of(replace(POINT, **wrong))


def test_handles_have_names_of_their_own_and_share_no_ground() -> None:
    with pytest.raises(ValueError, match="two handles named 'point'"):
        scene_of(POINT, POINT)
    ground = replace(POINT, reach="drag")
    with pytest.raises(ValueError, match="whole of panel 'plane'"):
        scene_of(ground, replace(ground, name="other"))


def test_a_handle_lies_in_a_panel_that_there_is() -> None:
    with pytest.raises(ValueError, match="panel 'plan'; legal: plane"):
        frame_of(replace(POINT, panel="plan"))


@pytest.mark.parametrize(
    ("number", "nearest"),
    [(0.3, 0.25), (0.05, 0.0), (-4, 0.0), (4, 0.75), (float("inf"), 0.75), (float("-inf"), 0.0)],
)
def test_the_nearest_value_is_one_that_whole_steps_lead_to(number: float, nearest: float) -> None:
    uneven = Slider(name="s", label="S", default=0, minimum=0, maximum=0.9, step=0.25)
    assert uneven.nearest(number) == nearest


def scale(settings: Settings, _outputs: Outputs) -> Point | None:
    return None if settings.across == 2 else (100 * settings.across**2, 50)


def option(settings: Settings, _outputs: Outputs) -> Point:
    return ({"left": 10, "right": 90}[settings.kind], 0)


@pytest.mark.parametrize(
    ("drives", "where", "place", "value"),
    [
        ("across", scale, (100 * 0.75**2, 0), 0.75),
        ("across", scale, (-500, 0), 0.0),
        ("across", scale, (1e9, 1e9), 1.75),  # at 2 there is nothing to grab
        ("along", lambda settings, _: (0, 7 * settings.along), (0, 40), 6),
        ("along", lambda *_: (0, 0), (0, 40), 3),  # it does not move: stays
        ("along", lambda *_: None, (0, 40), 3),
        ("kind", option, (60, 5), "right"),
    ],
)
def test_a_search_finds_the_value_nearest_to_the_pointer(
    drives: str, where: Any, place: Point, value: Value
) -> None:
    scene = scene_of(Handle("point", "plane", "Point", (drives,), where))
    assert scene.pull(scene.check({}), "point", place) == {drives: value}


def test_two_settings_need_a_pull() -> None:
    with pytest.raises(ValueError, match="'point' has no pull"):
        scene_of(replace(POINT, pull=None))
