"""Lists of points: how they are written, what is refused, and how a handle of theirs is pulled."""

import json
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pytest

from simulations.engine.controls import ControlError, PointLists, Value
from simulations.engine.frame import Frame, Panel, Place, to_json
from simulations.engine.handles import Handle, Point
from simulations.engine.photograph import Photograph
from simulations.engine.scene import Scene
from simulations.engine.settings import points
from simulations.engine.stages import Outputs, StageCache
from site_builder.pages.catalogue import _simulation

TEXT = "corner_3;0.1,0.2_0.5,1;;0,0.33333"


@dataclass(frozen=True, slots=True)
class Settings:
    lines: str = points("Lines", 3, 4, buttons={"add": "Add a line"}, default=";0.5,0.5")


def draw(_settings: Settings, _outputs: Outputs) -> Frame:
    return Frame((Panel("plane", "Plane", 400, 300),), (), "A plane.")


def at(settings: Settings, _outputs: Outputs) -> Point:
    x, y = PointLists.from_text(settings.lines).lists[0][0]
    return 400 * x, 300 * y


def pull(_settings: Settings, place: Point, photograph: Photograph | None) -> Mapping[str, Value]:
    name = "own" if photograph else "book"
    return {"lines": PointLists(name, 0, (((place[0] / 400, place[1] / 300),),)).text}


HANDLE: Handle[Settings] = Handle("end", "plane", "End", ("lines",), at, pull, step=lambda *_: 0.5)
SCENE = Scene("s", "S", Settings, draw, handles=(HANDLE,))


def test_points_are_read_as_they_are_written() -> None:
    found = PointLists.from_text(TEXT)
    assert found == PointLists("corner", 3, (((0.1, 0.2), (0.5, 1.0)), (), ((0.0, 0.33333),)))
    assert found.text == TEXT
    assert PointLists.from_text("") == PointLists()
    assert PointLists.from_text("").text == ""


def test_points_are_written_inside_the_picture() -> None:
    assert PointLists("", 0, (((-0.2, 1.7), (1e-9, 0.123456)),)).text == ";0,1_0,0.12346"


@pytest.mark.parametrize(
    "wrong",
    [
        ";0.5",
        ";a,b",
        ";0.1,1.2",
        ";nan,0.2",
        "b-d;0.1,0.2",
        "x_-1;0.1,0.2",
        ";;;;",
        ";0,0_0,0_0,0_0,0_0,0",
        7,
        None,
    ],
)
def test_what_is_no_list_of_points_is_refused(wrong: object) -> None:
    with pytest.raises(ControlError, match=r"lines: .*; legal: 3 lists"):
        SCENE.check({"lines": wrong})


def test_a_default_must_be_one() -> None:
    @dataclass(frozen=True, slots=True)
    class Wrong:
        lines: str = points("Lines", 1, 4, buttons={}, default="0.1;0.2")

    with pytest.raises(ControlError, match="legal: 1 lists"):
        Scene("s", "S", Wrong, draw)  # type: ignore[arg-type]


def test_a_handle_of_points_says_how_far_a_key_moves_it() -> None:
    frame = SCENE.render(SCENE.check({}), "", StageCache())
    assert frame.handles == (Place("end", 200, 150, 0.5),)
    assert json.loads(to_json(frame))["handles"] == [
        {"name": "end", "x": 200.0, "y": 150.0, "step": 0.5}
    ]


def test_a_pull_may_ask_for_the_readers_photograph() -> None:
    photograph = Photograph(1, np.zeros((1, 1, 3), np.uint8))
    settings = SCENE.check({})
    assert SCENE.pull(settings, "end", (40, 30)) == {"lines": "book;0.1,0.1"}
    assert SCENE.pull(settings, "end", (40, 30), "", photograph) == {"lines": "own;0.1,0.1"}


def test_the_catalogue_lists_only_controls_that_a_hand_moves() -> None:
    assert _simulation(SCENE)["controls"] == []
