"""A figure as its template gets it: controls, and the menu of accuracies."""

from dataclasses import dataclass
from typing import Any

import pytest
from support.toy_ladder import toy_ladder

from simulations.engine.frame import Frame
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider
from simulations.engine.stages import Outputs
from site_builder.figures.initial_frames import InitialFrame
from site_builder.page_model.blocks import Simulation
from site_builder.page_model.passage import Passage
from site_builder.pages.views.control import control_cells
from site_builder.pages.views.simulation import tier_labels


def draw(_settings: Any, _outputs: Outputs) -> Frame:
    return Frame((), (), "Nothing.")


def still(settings: type) -> InitialFrame:
    scene = Scene("s", "S", settings, draw)
    values = {control.name: control.default for control in scene.controls}
    return InitialFrame(
        Simulation(scene, "figure-s", {}, "", Passage(), "", 1), values, draw(None, {}), {}
    )


def test_a_slider_keeps_the_room_of_its_longest_value() -> None:
    @dataclass(frozen=True, slots=True)
    class Settings:
        yaw: float = slider("Yaw", 5, -170, 90, 5, unit="\N{DEGREE SIGN}")

    ((cell,), _) = control_cells(still(Settings), ())
    assert [item.longest for item in cell.controls] == ["\N{MINUS SIGN}170\N{DEGREE SIGN}"]


def test_a_menu_of_long_words_has_a_row_of_a_phone_to_itself() -> None:
    @dataclass(frozen=True, slots=True)
    class Settings:
        picture: str = choice("Picture", {"a": "Room", "b": "Chart"})
        camera: str = choice("Camera", {"a": "Scaled orthographic", "b": "Perspective"})
        depth: float = slider("Depth", 5, 0, 9, 1)
        width: float = slider("Width", 5, 0, 9, 1)

    cells, _ = control_cells(still(Settings), ())
    narrow = [cell.spans.partition(";")[0] for cell in cells]
    assert narrow == ["--narrow: 12", "--narrow: 12", "--narrow: 6", "--narrow: 6"]


@dataclass(frozen=True, slots=True)
class Empty:
    """No controls."""


def tiered(**fields: Any) -> Scene[Empty]:
    tiers = ("rough", "fine")
    return Scene("s", "S", Empty, draw, tiers=tiers, default_tier="fine", **fields)


@pytest.fixture(autouse=True)
def _of_the_book(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("site_builder.pages.views.simulation.load_ladder", toy_ladder)


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
