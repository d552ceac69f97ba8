"""Every control of every scene, to its ends and beyond, alone and against every other control.

A frame at the end of a slider must be as sound as the first one: no NaN or infinity in pixels,
drawing or numbers, no warning (pytest turns those into errors), and the same panels and readouts,
so that nothing in the page jumps.
"""

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from hashlib import blake2b
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from support.label_boxes import in_figures, labels

from simulations.engine.controls import Action, Control, Slider
from simulations.engine.frame import Frame, Panel, to_json
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from simulations.registry import SCENE_MODULES, load_scene

type Setting = dict[str, object]

STEPS, MANY_STEPS = 2, 7
"""Positions of a slider between and including its ends."""
MIXED = 40

RESIZED = ("aliasing", "bayer-demosaic", "resolution")
"""Scenes that draw as many pixels as there are samples to be seen."""
UNDEFINED = {("perspective-projection", "x"), ("perspective-projection", "y"), ("phong", "n_dot_h")}
"""Readouts that somewhere have no value, and say so."""
NOT_FINITE = re.compile(r"\b(nan|inf)\b", re.IGNORECASE)


def positions(control: Control, steps: int) -> list[object]:
    """The ends, and for a slider ``steps`` on the way between them, its zero, and single steps
    from the ends."""
    if not isinstance(control, Slider):
        return list(control.extremes())
    low, high, step = control.minimum, control.maximum, control.step
    between = np.linspace(low, high, steps).tolist()
    zero = [0.0] if low < 0 < high else []
    return [*between, low + step, high - step, *zero]


def mixed_extremes(controls: tuple[Control, ...]) -> Iterator[Setting]:
    """Settings of extremes at random; any two ends of two controls nearly certainly meet."""
    rng = np.random.default_rng(0)
    for _ in range(MIXED):
        extremes = {control.name: control.extremes() for control in controls}
        yield {name: values[rng.integers(len(values))] for name, values in extremes.items()}


def overshoots(control: Slider) -> Iterator[tuple[float, float]]:
    """Values past the ends, and the end that each stands for."""
    span = control.maximum - control.minimum
    for far in (control.step, span, 1e9 * span, 1e300):
        yield control.maximum + far, control.maximum
        yield control.minimum - far, control.minimum


def shape_of(scene: Scene[Any], frame: Frame) -> object:
    """All that must not change from frame to frame, lest the page jump."""
    return (
        [(panel.name, panel.width, panel.height, pixels(scene, panel)) for panel in frame.panels],
        [(item.name, item.label) for item in frame.readouts],
    )


def pixels(scene: Scene[Any], panel: Panel) -> object:
    """The size of a panel's raster; of scenes that may change it, whether there is one."""
    if panel.raster is None or scene.id in RESIZED:
        return panel.raster is not None
    return panel.raster.shape


def assert_sound(scene: Scene[Any], frame: Frame, setting: Mapping[str, object]) -> None:
    """Everything that a frame holds can be drawn, read and sent."""
    json.loads(to_json(frame))
    for panel in frame.panels:
        fault = fault_of_drawing(panel.overlay, panel.width, panel.height)
        assert not fault, (setting, panel.name, fault)
        if panel.raster is not None:
            opaque = panel.raster[..., 3].max()
            assert opaque > 0, (setting, panel.name, "nothing to be seen")
    for item in frame.readouts:
        assert not NOT_FINITE.search(item.text), (setting, item)
        assert item.text.strip(), (setting, item)
        assert item.text != "undefined" or (scene.id, item.name) in UNDEFINED, (setting, item)
    assert not NOT_FINITE.search(frame.description), (setting, frame.description)


@lru_cache(maxsize=64)
def fault_of_drawing(overlay: str, width: float, height: float) -> str:
    """What in it is no number, or which label lies outside; most controls leave some panel as it
    was."""
    for element in ElementTree.fromstring(f"<svg>{overlay}</svg>").iter():
        for name, value in element.attrib.items():
            if name != "class" and NOT_FINITE.search(value):
                return str(element.attrib)
    for label in labels(overlay, in_figures):
        box = label.box
        if min(box.left, box.top) < 0 or box.right > width or box.bottom > height:
            return str(label)
    return ""


def shown(frame: Frame) -> bytes:
    """A digest of all that the reader sees, but for the words."""
    seen = blake2b(repr((frame.readouts, [panel.overlay for panel in frame.panels])).encode())
    for panel in frame.panels:
        if panel.raster is not None:
            seen.update(repr(panel.raster.shape).encode())
            seen.update(np.ascontiguousarray(panel.raster))
    return seen.digest()


@dataclass(frozen=True, slots=True)
class Seen:
    """What is left of a sound frame once it was looked at."""

    shape: object
    shown: bytes


@dataclass(frozen=True, slots=True)
class Swept:
    """A scene whose frames are drawn and looked at once, however many of the tests meet them."""

    scene: Scene[Any]
    seen: dict[tuple[str, object], Seen] = field(default_factory=dict)
    caches: dict[str, StageCache] = field(default_factory=dict)

    def see(self, setting: Setting, tier: str = "") -> Seen:
        """The frame of a setting, which is sound; as a draft, where the scene has its own."""
        scene, given = self.scene, self.scene.clamp(setting)
        tier = tier or scene.default_tier or next(iter(scene.own_drafts), "")
        if (tier, given) not in self.seen:
            frame = scene.render(given, tier, self.caches.setdefault(tier, StageCache()))
            assert_sound(scene, frame, {"tier": tier, **setting})
            self.seen[tier, given] = Seen(shape_of(scene, frame), shown(frame))
        return self.seen[tier, given]


@pytest.fixture(params=sorted(SCENE_MODULES), scope="module")
def swept(request: pytest.FixtureRequest) -> Swept:
    return Swept(load_scene(request.param))


@pytest.mark.parametrize("steps", [STEPS, pytest.param(MANY_STEPS, marks=pytest.mark.deep)])
def test_each_control_is_sound_over_its_whole_range(swept: Swept, steps: int) -> None:
    expected = swept.see({}).shape
    for control in swept.scene.controls:
        for value in positions(control, steps):
            setting = {control.name: value}
            assert swept.see(setting).shape == expected, setting


def test_each_control_changes_the_frame(swept: Swept) -> None:
    """From the defaults, or once the controls before it were moved: one may turn another on.

    Buttons that move other controls change nothing by themselves.
    """
    moved = dict[str, object]()
    for control in swept.scene.controls:
        if isinstance(control, Action) and control.effect:
            continue
        found = next(changes(swept, control, ({}, moved)), None)
        assert found, control.name
        moved |= found


def changes(swept: Swept, control: Control, starts: Iterable[Setting]) -> Iterator[Setting]:
    """Extremes of a control that show something else than one of the settings ``starts`` does."""
    for start in starts:
        before = swept.see(start).shown
        for value in control.extremes():
            if swept.see({**start, control.name: value}).shown != before:
                yield {control.name: value}


@pytest.mark.deep
def test_mixed_extremes_are_sound(swept: Swept) -> None:
    expected = swept.see({}).shape
    for setting in mixed_extremes(swept.scene.controls):
        assert swept.see(setting).shape == expected, setting


def test_every_tier_is_sound_at_the_extremes(swept: Swept) -> None:
    controls = swept.scene.controls
    corners: list[Setting] = [
        {control.name: control.extremes()[end] for control in controls} for end in (0, -1)
    ]
    expected = swept.see({}).shape
    for tier in swept.scene.tiers:
        for setting in corners:
            assert swept.see(setting, tier).shape == expected, (tier, setting)


def test_values_past_the_ends_are_brought_to_the_ends(swept: Swept) -> None:
    for control in swept.scene.controls:
        if isinstance(control, Slider):
            for beyond, end in overshoots(control):
                assert getattr(swept.scene.clamp({control.name: beyond}), control.name) == end
