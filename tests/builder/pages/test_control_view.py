"""The controls of a figure as its template gets them."""

from dataclasses import dataclass
from typing import Any

from simulations.engine.frame import Frame
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider
from simulations.engine.stages import Outputs
from site_builder.figures.initial_frames import InitialFrame
from site_builder.page_model.blocks import Simulation
from site_builder.page_model.passage import Passage
from site_builder.pages.views.control import control_cells


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
