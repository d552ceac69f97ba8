"""A figure as its template gets it: controls, and the menu of accuracies."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import pytest
from support.toy_ladder import toy_ladder

from simulations.engine.frame import Frame, readout
from simulations.engine.scene import Scene
from simulations.engine.settings import action, choice, slider
from simulations.engine.stages import Outputs
from simulations.registry import tier_labels
from site_builder.document.blocks import Simulation
from site_builder.document.passage import Passage
from site_builder.figures.initial_frames import InitialFrame
from site_builder.pages.views.control import ControlView, control_cells, readouts_in_sight

MEASURED = tuple(readout(name, name.upper(), 1.0) for name in "vwxyz")


def draw(_settings: Any, _outputs: Outputs) -> Frame:
    return Frame((), MEASURED, "Nothing.")


def still(settings: type, in_sight: tuple[str, ...] = ()) -> InitialFrame:
    scene = Scene("s", "S", settings, draw)
    values = {control.name: control.default for control in scene.controls}
    figure = Simulation(scene, "figure-s", {}, "", Passage(), "", 1, in_sight=in_sight)
    return InitialFrame(figure, values, draw(None, {}), {})


@dataclass(frozen=True, slots=True)
class Five:
    a: float = slider("A", 5, 0, 9, 1)
    b: str = choice("B", {"one": "One", "two": "Two"})
    play: int = action("Play")
    again: int = action("Again")
    c: float = slider("C", 5, 0, 9, 1)


def names(cells: Iterable[tuple[ControlView, ...]]) -> list[str]:
    return ["+".join(item.control.name for item in cell) for cell in cells]


def test_a_slider_keeps_the_room_of_its_longest_value() -> None:
    @dataclass(frozen=True, slots=True)
    class Settings:
        yaw: float = slider("Yaw", 5, -170, 90, 5, unit="\N{DEGREE SIGN}")

    ((cell,), _) = control_cells(still(Settings), tiers=False)
    assert [item.longest for item in cell] == ["\N{MINUS SIGN}170\N{DEGREE SIGN}"]


def test_the_first_three_are_in_sight_and_the_others_folded_with_the_accuracy() -> None:
    shown, folded = control_cells(still(Five), tiers=True)
    assert names(shown) == ["a", "b", "play+again"]
    assert names(folded) == ["c", ""]


def test_an_author_says_what_is_in_sight() -> None:
    shown, folded = control_cells(still(Five, ("tier", "c")), tiers=True)
    assert names(shown) == ["", "c"]
    assert names(folded) == ["a", "b", "play+again"]


@pytest.mark.parametrize(
    ("named", "shown"),
    [((), "vwx"), (("a", "z"), "z"), (("a",), "")],
    ids=["none", "one", "others"],
)
def test_readouts_in_sight_are_those_named_or_the_first(named: tuple[str, ...], shown: str) -> None:
    in_sight, folded = readouts_in_sight(still(Five, named))
    assert "".join(each.name for each in in_sight) == shown
    assert sorted(each.name for each in (*in_sight, *folded)) == list("vwxyz")


@dataclass(frozen=True, slots=True)
class Empty:
    """No controls."""


def tiered(**fields: Any) -> Scene[Empty]:
    tiers = ("rough", "fine")
    return Scene("s", "S", Empty, draw, tiers=tiers, default_tier="fine", **fields)


@pytest.fixture(autouse=True)
def _of_the_book(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("simulations.registry.load_ladder", toy_ladder)


@pytest.mark.parametrize(
    ("fields", "rough", "fine"),
    [
        ({"ladder": "toy"}, "Rough", "Fine"),
        ({"ladder": "toy", "tier_labels": {"fine": "In every pixel"}}, "Rough", "In every pixel"),
        ({"tier_labels": {"fine": "Smooth", "rough": "Coarse"}}, "Coarse", "Smooth"),
    ],
)
def test_tiers_are_named_by_their_scene_or_else_by_their_ladder(
    fields: dict[str, Any], rough: str, fine: str
) -> None:
    assert tier_labels(tiered(**fields)) == (("rough", rough), ("fine", fine))
