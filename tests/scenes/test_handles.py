"""What a pull at any handle of any scene does, whatever it moves."""

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
"""What no handle moves is computed once."""
FAR = 1e7
FINGER = 24 / 267
"""Share of a panel: the 24 CSS pixels of WCAG 2.2 (2.5.8) where a phone is 320 pixels wide."""
NOISE = 0.05
"""Units of the view box by which one step may seem nearer than another that is not."""


def named(part: object) -> str:
    return part.id if isinstance(part, Scene) else getattr(part, "name", "")


class Outputs(Mapping[str, Any]):
    """What the stages make of some settings: of them only those that a handle asks for."""

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
        return scene.run(self._settings, scene.default_tier, self._cache).outputs


@dataclass(frozen=True)
class Start:
    """A scene at some settings, and one of its handles."""

    scene: Scene[Any]
    handle: Handle[Any]
    settings: Any

    @property
    def place(self) -> Point | None:
        return self.handle.at(self.settings, Outputs(self.scene, self.settings))

    def having(self, values: Mapping[str, Value]) -> "Start":
        return replace(self, settings=self.scene.clamp({**values_of(self.settings), **values}))

    def pulled_to(self, place: Point) -> "Start":
        return self.having(self.scene.pull(self.settings, self.handle.name, place))


def starts(scene: Scene[Any], handle: Handle[Any], count: int) -> Iterator[Start]:
    """The defaults, then settings drawn from the whole of what the controls allow."""
    rng = np.random.default_rng(0)
    yield Start(scene, handle, scene.check({}))
    for _ in range(count):
        values = {control.name: drawn(control, rng) for control in scene.controls}
        yield Start(scene, handle, scene.clamp(values))


def drawn(control: Any, rng: np.random.Generator) -> Value:
    if isinstance(control, Slider):
        return control.nearest(float(rng.uniform(control.minimum, control.maximum)))
    if isinstance(control, Choice):
        return str(rng.choice(list(control.options)))
    if isinstance(control, Points):
        lists = (rng.uniform(size=(control.most, 2)) for _ in range(control.lists))
        return PointLists("", 0, tuple(tuple(map(tuple, each)) for each in lists)).text
    return control.default  # type: ignore[no-any-return]


def with_other_values(start: Start) -> Iterator[Start]:
    """The same settings but for what the handle drives."""
    rng = np.random.default_rng(1)
    controls = [c for c in start.scene.controls if c.name in start.handle.drives]
    for _ in range(6):
        yield start.having({control.name: drawn(control, rng) for control in controls})


def a_step_away(start: Start) -> Iterator[Start]:
    """All neighbours, one step of each driven slider or none, and all other options of a menu."""
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
        yield start.having(dict(values))


def test_every_scene_has_something_to_grab() -> None:
    without = [scene.id for scene in SCENES.values() if not scene.handles]
    assert without == []


@pytest.mark.parametrize("goals", [8, pytest.param(36, marks=pytest.mark.deep)])
@pytest.mark.parametrize(("scene", "handle"), PLACED, ids=named)
def test_a_handle_goes_where_it_is_pulled_as_near_as_a_step_of_its_controls_allows(
    scene: Scene[Any], handle: Handle[Any], goals: int
) -> None:
    """It stays where it is when it is pulled to its own place."""
    tried = 0
    for start in starts(scene, handle, 5):
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
            around = (other.place for other in a_step_away(pulled))
            nearest = min(math.dist(other, place) for other in around if other is not None)
            assert left <= max(nearest, 1.0) + NOISE, (start.settings, goal.settings, left)
    assert tried, "no settings at which it could be grabbed"


@pytest.mark.parametrize(("scene", "handle"), ALL, ids=named)
def test_wherever_the_pointer_goes_the_controls_stay_legal(
    scene: Scene[Any], handle: Handle[Any]
) -> None:
    for start in starts(scene, handle, 2):
        for across, down in itertools.product((-FAR, 0.0, 200.0, FAR), (-FAR, -1.0, 150.0, FAR)):
            values = scene.pull(start.settings, handle.name, (across, down))
            assert scene.check({**values}) is not None


@pytest.mark.parametrize("scene", SCENES.values(), ids=named)
def test_handles_lie_in_panels_and_a_finger_tells_the_marks_of_an_untouched_figure_apart(
    scene: Scene[Any],
) -> None:
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
