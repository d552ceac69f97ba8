"""Figures in notebooks: widgets that change a scene, and pictures of its frame."""

import io
import wave
from base64 import b64decode
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from simulations.engine.drawing import line
from simulations.engine.frame import Frame, Panel, Sound, readout
from simulations.engine.scene import Scene
from simulations.engine.settings import action, choice, points, slider, toggle
from simulations.engine.stages import Outputs
from simulations.notebook import live
from simulations.notebook.live import Figure, figure
from site_builder.figures.frames import pixels

SVG = "{http://www.w3.org/2000/svg}"


@dataclass(frozen=True, slots=True)
class Settings:
    size: int = slider("Size", 2, 1, 4, 1, unit="px")
    kind: str = choice("Kind", {"a": "First", "b": "Second"})
    on: bool = toggle("On")
    again: int = action("Once", "Twice", "Thrice")
    step: int = action("Next", drives="size", effect="step")
    play: int = action("Play", drives="size", effect="play", seconds=3)
    least: int = action("Least", effect="set")
    marks: str = points("Marks", lists=1, most=2, buttons={})


def draw(settings: Settings, _outputs: Outputs) -> Frame:
    raster = np.arange(settings.size * 12, dtype=np.uint8).reshape(settings.size, 3, 4)
    panels = (
        Panel("plan", "A < B", 400, 300, overlay=line((0, 0), (9, 9), "ray")),
        Panel("picture", "", 400, 200, raster=raster, pixelated=True, lead=True),
    )
    description = f"{settings.size} {settings.kind} {settings.on} {settings.again}"
    numbers = (readout("size", "Size", settings.size, "px"),)
    sound = Sound(np.full(settings.size, -0.5, np.float32), 8000)
    return Frame(panels, numbers, description, sound=sound)


SCENE = Scene(
    "demo",
    "Demo",
    Settings,
    draw,
    sets={"least": lambda given, _outputs: {"size": 1.0, "on": given.on}},
)


@pytest.fixture
def demo(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Callable[..., Figure]:
    style = tmp_path / "style.css"
    style.write_text(".sheet { fill: white; }", encoding="utf-8")
    monkeypatch.setattr(live, "STYLE", style)
    monkeypatch.setattr(live, "load_scene", lambda _id: SCENE)
    return lambda **values: figure("demo", **values)


def test_widgets_change_the_figure(demo: Callable[..., Figure]) -> None:
    shown = demo(size=3)
    widgets = shown.widgets
    assert [*widgets] == ["size", "kind", "on", "again", "least", "step", "play"]
    assert shown.frame.description == "3 a False 0"
    widgets["size"].value = 1.0
    widgets["kind"].value = "b"
    widgets["on"].value = True
    widgets["again"].click()
    widgets["again"].click()
    assert shown.frame.description == "1 b True 2"
    assert widgets["again"].description == "Thrice"
    widgets["size"].value = 4.0
    widgets["least"].click()
    assert shown.frame.description == "1 b True 2"


def test_pictures_have_the_pixels_and_drawings_of_the_frame(demo: Callable[..., Figure]) -> None:
    shown = demo(size=4)
    lead, plan = map(ElementTree.fromstring, shown.pictures)
    (image,) = lead.iter(f"{SVG}image")
    (raster,) = (p.raster for p in shown.frame.panels if p.raster is not None)
    assert np.array_equal(pixels(b64decode(image.get("href", "").partition(",")[2])), raster)
    assert [text.text for text in plan.iter(f"{SVG}text")] == ["A < B"]
    assert len([*plan.iter(f"{SVG}line")]) == 1


def test_sound_of_a_frame_can_be_played(demo: Callable[..., Figure]) -> None:
    shown = demo()
    shown.widgets["size"].value = 3
    with wave.open(io.BytesIO(shown.player.value)) as heard:
        assert (heard.getframerate(), heard.getnchannels()) == (8000, 1)
        assert np.frombuffer(heard.readframes(9), "<i2").tolist() == [-16383] * 3


def test_buttons_step_and_sweep_a_slider(demo: Callable[..., Figure]) -> None:
    widgets = demo().widgets
    seen = []
    for _ in range(4):
        widgets["step"].click()
        seen.append(widgets["size"].value)
    assert seen == [3, 4, 1, 2]
    play = widgets["play"].children[1]
    play.value = play.max
    assert widgets["size"].value == 4
