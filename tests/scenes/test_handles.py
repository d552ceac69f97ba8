"""Pulls at every handle of every scene."""

import itertools
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest

from simulations.engine.controls import Choice, PointLists, Points, Slider, Value
from simulations.engine.handles import Handle, Point, places
from simulations.engine.scene import Scene
from simulations.engine.settings import values_of
from simulations.engine.stages import StageCache
from simulations.registry import SCENE_MODULES, load_scene

SCENES = {id_: load_scene(id_) for id_ in SCENE_MODULES}
ALL = [(scene, handle) for scene in SCENES.values() for handle in scene.handles]
PLACED = [(scene, handle) for scene, handle in ALL if handle.reach != "aim"]
"""Handles that have a place of their own."""
CACHES = {id_: StageCache() for id_ in SCENES}
"""Stages that no handle changes are computed once."""
FAR = 1e7
FINGER = 24 / 267
"""Share of a panel: the 24 CSS pixels of WCAG 2.2 (2.5.8) where a phone is 320 pixels wide."""
NOISE = 0.05
"""Units of the view box by which rounding can make one step seem nearer than another."""


def name_of(part: object) -> str:
    return part.id if isinstance(part, Scene) else getattr(part, "name", "")


class Outputs(Mapping[str, Any]):
    """The stages' outputs at some settings; only the stages that a requested output needs run."""

    def __init__(self, scene: Scene[Any], settings: object) -> None:
        self._scene, self._settings = scene, settings
        self._cache = CACHES[scene.id]

    def __getitem__(self, name: str) -> Any:
        wanted = {name}
        for stage in reversed(self._scene.stages):
            if stage.name in wanted:
                wanted.update((*stage.after, stage.source))
        stages = tuple(stage for stage in self._scene.stages if stage.name in wanted)
        return self._run(replace(self._scene, stages=stages))[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._run(self._scene))

    def __len__(self) -> int:
        return len(self._run(self._scene))

    def _run(self, scene: Scene[Any]) -> Mapping[str, Any]:
        return scene.run(self._settings, scene.accuracy.default, self._cache).outputs


@dataclass(frozen=True)
class Start:
    """A scene at some settings, and one of its handles."""

    scene: Scene[Any]
    handle: Handle[Any]
    settings: Any

    @property
    def place(self) -> Point | None:
        return self.handle.at(self.settings, Outputs(self.scene, self.settings))

    def with_values(self, values: Mapping[str, Value]) -> "Start":
        return replace(self, settings=self.scene.clamp({**values_of(self.settings), **values}))

    def pulled_to(self, place: Point) -> "Start":
        return self.with_values(self.scene.pull(self.settings, self.handle.name, place))


def starts(scene: Scene[Any], handle: Handle[Any], count: int) -> Iterator[Start]:
    """The defaults, then random legal settings."""
    rng = np.random.default_rng(0)
    yield Start(scene, handle, scene.check({}))
    for _ in range(count):
        values = {control.name: random_value(control, rng) for control in scene.controls}
        yield Start(scene, handle, scene.clamp(values))


def random_value(control: Any, rng: np.random.Generator) -> Value:
    if isinstance(control, Slider):
        return control.nearest(float(rng.uniform(control.minimum, control.maximum)))
    if isinstance(control, Choice):
        return str(rng.choice(list(control.options)))
    if isinstance(control, Points):
        lists = (rng.uniform(size=(control.most, 2)) for _ in range(control.lists))
        return PointLists("", 0, tuple(tuple(map(tuple, each)) for each in lists)).text
    return control.default  # type: ignore[no-any-return]


def with_other_values(start: Start) -> Iterator[Start]:
    """The same settings except random values of the controls that the handle drives."""
    rng = np.random.default_rng(1)
    controls = [c for c in start.scene.controls if c.name in start.handle.drives]
    for _ in range(6):
        yield start.with_values({control.name: random_value(control, rng) for control in controls})


def neighbours(start: Start) -> Iterator[Start]:
    """All neighbours: driven sliders moved by one step or none, driven menus at any option."""
    options = []
    for control in start.scene.controls:
        if control.name not in start.handle.drives:
            continue
        here = getattr(start.settings, control.name)
        if isinstance(control, Slider):
            steps = {control.nearest(here + step * control.step) for step in (-1, 0, 1)}
            options.append([(control.name, type(here)(value)) for value in steps])
        elif isinstance(control, Choice):
            options.append([(control.name, value) for value in control.options])
    for values in itertools.product(*options):
        yield start.with_values(dict(values))


def test_every_scene_has_a_handle() -> None:
    without = [scene.id for scene in SCENES.values() if not scene.handles]
    assert without == []


@pytest.mark.parametrize("goals", [8, pytest.param(36, marks=pytest.mark.deep)])
@pytest.mark.parametrize(("scene", "handle"), PLACED, ids=name_of)
def test_pulled_handle_gets_as_near_as_one_step_of_its_controls_allows(
    scene: Scene[Any], handle: Handle[Any], goals: int
) -> None:
    """Pulled to its own place, it stays."""
    tried = 0
    for start in starts(scene, handle, goals // 4 + 1):
        here = start.place
        if here is None:
            continue
        stayed = start.pulled_to(here).place
        assert stayed is not None
        assert math.dist(stayed, here) <= 1.0 + NOISE, start.settings
        for goal in with_other_values(start) if tried < goals else ():
            place = goal.place
            if place is None:
                continue
            tried += 1
            pulled = start.pulled_to(place)
            assert pulled.place is not None, (start.settings, goal.settings)
            left = math.dist(pulled.place, place)
            around = (other.place for other in neighbours(pulled))
            nearest = min(math.dist(other, place) for other in around if other is not None)
            assert left <= max(nearest, 1.0) + NOISE, (start.settings, goal.settings, left)
    assert tried, "no settings at which it could be grabbed"


@pytest.mark.parametrize(("scene", "handle"), ALL, ids=name_of)
def test_controls_stay_legal_wherever_the_pointer_goes(
    scene: Scene[Any], handle: Handle[Any]
) -> None:
    for start in starts(scene, handle, 2):
        for across, down in itertools.product((-FAR, 0.0, 200.0, FAR), (-FAR, -1.0, 150.0, FAR)):
            values = scene.pull(start.settings, handle.name, (across, down))
            assert scene.check({**values}) is not None


@pytest.mark.parametrize("scene", SCENES.values(), ids=name_of)
def test_handles_belong_to_panels_and_lie_a_fingers_width_apart(scene: Scene[Any]) -> None:
    settings = scene.check({})
    outputs = Outputs(scene, settings)
    panels = scene.draw(settings, outputs).panels
    assert {handle.panel for handle in scene.handles} <= {panel.name for panel in panels}
    marked = tuple(handle for handle in scene.handles if handle.reach in ("mark", "press"))
    at = {place.name: (place.x, place.y) for place in places(marked, settings, outputs, panels)}
    shown = [handle for handle in marked if handle.name in at]
    for panel in panels:
        near = FINGER * panel.width
        names = [handle.name for handle in shown if handle.panel == panel.name]
        for one, other in itertools.combinations(names, 2):
            assert math.dist(at[one], at[other]) >= near, (one, other)
