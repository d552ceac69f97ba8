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
    """The ends; for a slider ``steps`` even positions, one step from each end, and its zero."""
    if not isinstance(control, Slider):
        return list(control.extremes())
    low, high, step = control.minimum, control.maximum, control.step
    between = np.linspace(low, high, steps).tolist()
    zero = [0.0] if low < 0 < high else []
    return [*between, low + step, high - step, *zero]


def mixed_extremes(controls: tuple[Control, ...]) -> Iterator[Setting]:
    """Random settings of extremes; nearly every pair of ends of two controls occurs together."""
    rng = np.random.default_rng(0)
    for _ in range(MIXED):
        extremes = {control.name: control.extremes() for control in controls}
        yield {name: values[rng.integers(len(values))] for name, values in extremes.items()}


def overshoots(control: Slider) -> Iterator[tuple[float, float]]:
    """Values beyond the ends, and the end to which each is clamped."""
    span = control.maximum - control.minimum
    for far in (control.step, span, 1e9 * span, 1e300):
        yield control.maximum + far, control.maximum
        yield control.minimum - far, control.minimum


def shape_of(scene: Scene[Any], frame: Frame) -> object:
    """What must not change from frame to frame, as the page would jump."""
    return (
        [(panel.name, panel.width, panel.height, pixels(scene, panel)) for panel in frame.panels],
        [(item.name, item.label) for item in frame.readouts],
    )


def pixels(scene: Scene[Any], panel: Panel) -> object:
    """The size of a panel's raster; for scenes that may change it, whether there is one."""
    if panel.raster is None or scene.id in RESIZED:
        return panel.raster is not None
    return panel.raster.shape


def assert_sound(scene: Scene[Any], frame: Frame, setting: Mapping[str, object]) -> None:
    """Assert that everything in a frame can be drawn, read and sent."""
    json.loads(to_json(frame))
    for panel in frame.panels:
        fault = drawing_error(panel.overlay, panel.width, panel.height)
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
def drawing_error(overlay: str, width: float, height: float) -> str:
    """The element with NaN or infinity or the label outside the panel; empty for a sound drawing.

    Cached, as most controls leave some panels unchanged.
    """
    for element in ElementTree.fromstring(f"<svg>{overlay}</svg>").iter():
        for name, value in element.attrib.items():
            if name != "class" and NOT_FINITE.search(value):
                return str(element.attrib)
    for label in labels(overlay, in_figures):
        box = label.box
        if min(box.left, box.top) < 0 or box.right > width or box.bottom > height:
            return str(label)
    return ""


def digest_of(frame: Frame) -> bytes:
    """A digest of what the reader sees, except the description."""
    seen = blake2b(repr((frame.readouts, [panel.overlay for panel in frame.panels])).encode())
    for panel in frame.panels:
        if panel.raster is not None:
            seen.update(repr(panel.raster.shape).encode())
            seen.update(np.ascontiguousarray(panel.raster))
    return seen.digest()


@dataclass(frozen=True, slots=True)
class Record:
    """The shape and the digest of a sound frame."""

    shape: object
    digest: bytes


@dataclass(frozen=True, slots=True)
class Sweep:
    """A scene whose frames are drawn and checked once, however many tests use them."""

    scene: Scene[Any]
    records: dict[tuple[str, object], Record] = field(default_factory=dict)
    caches: dict[str, StageCache] = field(default_factory=dict)

    def frame_at(self, setting: Setting, tier: str = "") -> Record:
        """The sound frame at a setting; of few pixels where that is all that levels change."""
        scene, given = self.scene, self.scene.clamp(setting)
        judged = scene.accuracy.estimate is not None
        tier = tier or (scene.accuracy.default if judged else scene.accuracy.cheapest)
        if (tier, given) not in self.records:
            frame = scene.render(given, tier, self.caches.setdefault(tier, StageCache()))
            assert_sound(scene, frame, {"tier": tier, **setting})
            self.records[tier, given] = Record(shape_of(scene, frame), digest_of(frame))
        return self.records[tier, given]


@pytest.fixture(params=sorted(SCENE_MODULES), scope="module")
def sweep(request: pytest.FixtureRequest) -> Sweep:
    return Sweep(load_scene(request.param))


@pytest.mark.parametrize("steps", [STEPS, pytest.param(MANY_STEPS, marks=pytest.mark.deep)])
def test_frame_is_sound_over_the_whole_range_of_each_control(sweep: Sweep, steps: int) -> None:
    expected = sweep.frame_at({}).shape
    for control in sweep.scene.controls:
        for value in positions(control, steps):
            setting = {control.name: value}
            assert sweep.frame_at(setting).shape == expected, setting


def test_each_control_changes_the_frame(sweep: Sweep) -> None:
    """From the defaults, or once the controls before it were moved: one may turn another on.

    Buttons that move other controls change nothing by themselves.
    """
    moved = dict[str, object]()
    for control in sweep.scene.controls:
        if isinstance(control, Action) and control.effect:
            continue
        found = next(changes(sweep, control, ({}, moved)), None)
        assert found, control.name
        moved |= found


def changes(sweep: Sweep, control: Control, starts: Iterable[Setting]) -> Iterator[Setting]:
    """Extremes of a control at which the frame differs from the frame at one of ``starts``."""
    for start in starts:
        before = sweep.frame_at(start).digest
        for value in control.extremes():
            if sweep.frame_at({**start, control.name: value}).digest != before:
                yield {control.name: value}


@pytest.mark.deep
def test_mixed_extremes_are_sound(sweep: Sweep) -> None:
    expected = sweep.frame_at({}).shape
    for setting in mixed_extremes(sweep.scene.controls):
        assert sweep.frame_at(setting).shape == expected, setting


def test_every_tier_is_sound_at_the_extremes(sweep: Sweep) -> None:
    controls = sweep.scene.controls
    corners: list[Setting] = [
        {control.name: control.extremes()[end] for control in controls} for end in (0, -1)
    ]
    for tier in sweep.scene.accuracy.names:
        expected = sweep.frame_at({}, tier).shape
        for setting in corners:
            assert sweep.frame_at(setting, tier).shape == expected, (tier, setting)


def test_values_beyond_the_ends_are_clamped(sweep: Sweep) -> None:
    for control in sweep.scene.controls:
        if isinstance(control, Slider):
            for beyond, end in overshoots(control):
                assert getattr(sweep.scene.clamp({control.name: beyond}), control.name) == end
