"""A figure of the book in a notebook: ``figure("lens-distortion", k1=-0.2)``.

This module and `simulations.notebook.controls` alone need ipywidgets.
"""

import io
import wave
from collections.abc import Callable, Sequence
from html import escape
from pathlib import Path
from typing import Any

import ipywidgets as widgets

from simulations.engine.controls import Action, Slider, Value
from simulations.engine.frame import Frame, Readout, Sound
from simulations.engine.scene import Scene
from simulations.engine.settings import values_of
from simulations.engine.stages import StageCache
from simulations.notebook.controls import Widget, label_options, mover, widget_of
from simulations.notebook.picture import frame_svg
from simulations.registry import level_labels, load_scene

STYLE = Path(__file__).with_name("style.css")
"""Written beside this module by ``python -m site_builder notebooks``, from the site's own."""
PANELS = {"grid_template_columns": "repeat(auto-fit, minmax(min(340px, 100%), 1fr))"}
"""Beside each other while there is room for legible labels."""
TILES = {"grid_template_columns": "repeat(auto-fill, minmax(26em, 1fr))", "grid_gap": "0 1.5em"}


def figure(
    scene_id: str, /, *, tier: str = "", panels: Sequence[str] = (), **values: object
) -> "Figure":
    """The scene at these values, with defaults for the others, at the level ``tier`` or the
    default; with the panels of these names, or all.

    Raises `UnknownIdError`, and `ControlError` for values that its controls do not have.
    """
    scene = load_scene(scene_id)
    return Figure(scene, scene.check(values), tier or scene.accuracy.default, panels)


class Figure:
    """A scene, its widgets and its present frame. A notebook shows it as the value of a cell."""

    def __init__(
        self, scene: Scene[Any], settings: object, tier: str, panels: Sequence[str] = ()
    ) -> None:
        self.scene = scene
        self.panels = panels
        """Names of those that are shown; none where all are."""
        self.values = values_of(settings)
        self.tier = tier
        self.widgets = self._make_widgets()
        """Widgets by control name, and ``tier``; setting the value of one moves the figure."""
        self._cache = StageCache()
        self._style = STYLE.read_text(encoding="utf-8")
        self._pictures = widgets.GridBox(layout={**PANELS, "align_items": "flex-start"})
        self._numbers = widgets.HTML()
        tiles = widgets.GridBox([*self.widgets.values()], layout=TILES)
        self.player = widgets.Audio(format="wav", autoplay=False, loop=False)
        self._show()
        sound = [self.player] if self.frame.sound else []
        self._box = widgets.VBox([self._pictures, tiles, *sound, self._numbers])

    def _repr_mimebundle_(self, **formats: object) -> object:
        return self._box._repr_mimebundle_(**formats)

    @property
    def pictures(self) -> list[str]:
        """The panels as SVG, as they are named, else the one that leads first."""
        panels = {p.name: p for p in sorted(self.frame.panels, key=lambda panel: not panel.lead)}
        shown = [panels[name] for name in self.panels or panels]
        return [frame_svg([panel], self._style) for panel in shown]

    def _make_widgets(self) -> dict[str, Widget]:
        made: dict[str, Widget] = {}
        controls = {control.name: control for control in self.scene.controls}
        for name, control in controls.items():
            widget = widget_of(control, self.values[name], self._setter(name))
            if widget is not None:
                made[name] = widget
        for name, control in controls.items():
            if isinstance(control, Action) and control.drives:
                driven = controls[control.drives]
                assert isinstance(driven, Slider)  # which a scene checks
                made[name] = mover(control, driven, made[control.drives])
        if self.scene.accuracy.names:
            made["tier"] = self._menu_of_tiers()
        return made

    def _menu_of_tiers(self) -> Widget:
        options = [(label, tier) for tier, label in level_labels(self.scene)]
        menu = widgets.Dropdown(value=self.tier, options=options, **label_options("tier"))
        menu.observe(self._set_tier, "value")
        return menu

    def _setter(self, name: str) -> Callable[[Value], None]:
        def changed(value: Value) -> None:
            self.values[name] = value
            if name in self.scene.sets:
                now = self.scene.clamp(self.values)
                for other, given in self.scene.pull(now, name, (0.0, 0.0), self.tier).items():
                    self.widgets[other].value = given
            self._show()

        return changed

    def _set_tier(self, change: dict[str, str]) -> None:
        self.tier = change["new"]
        self._show()

    def _show(self) -> None:
        settings = self.scene.clamp(self.values)
        self.frame: Frame = self.scene.render(settings, self.tier, self._cache)
        pictures = self.pictures
        if len(self._pictures.children) != len(pictures):
            layout = {"width": "100%", "max_width": "640px"}
            self._pictures.children = [
                widgets.Image(format="svg+xml", layout=layout) for _ in pictures
            ]
        for image, svg in zip(self._pictures.children, pictures, strict=True):
            image.value = svg.encode()
        if self.frame.sound:
            self.player.value = _wav(self.frame.sound)
        numbers = "&ensp; ".join(map(_number, self.frame.readouts))
        self._numbers.value = f"<p>{numbers}</p><p>{escape(self.frame.description)}</p>"


def _number(item: Readout) -> str:
    value = "<br>".join(map(escape, item.text.split("\n")))
    unit = item.unit if item.unit == "°" else f" {item.unit}"
    return f"{escape(item.label)} <b>{value}</b>{escape(unit)}".rstrip()


def _wav(sound: Sound) -> bytes:
    """A file of 16-bit samples."""
    file = io.BytesIO()
    with wave.open(file, "wb") as written:
        written.setparams((1, 2, sound.rate, len(sound.samples), "NONE", ""))
        written.writeframes((sound.samples * 32767).astype("<i2").tobytes())
    return file.getvalue()
