"""Stages are recomputed only where they must be: every scene with stages, control by control."""

from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any

import numpy as np
import pytest

from simulations.engine.controls import Action, Choice, Control, Points, Slider
from simulations.engine.frame import Frame
from simulations.engine.scene import Scene
from simulations.engine.settings import values_of
from simulations.engine.stages import Parameter, Stage, StageCache
from simulations.models.lens.aperture import fibonacci_disc
from simulations.registry import SCENE_MODULES, load_scene
from simulations.scenes.depth_of_field import stages as depth_stages

SCENES = {scene_id: load_scene(scene_id) for scene_id in SCENE_MODULES}

START: dict[str, dict[str, object]] = {
    "camera": {"aperture": 2.0, "k1": -0.1},
    "lens-distortion": {"k1": -0.1, "correct": True},
}
"""Settings at which no stage is neutral."""


def other_values(control: Control) -> list[object]:
    """Legal values that differ from `START` and most defaults, with those that make stages
    neutral."""
    match control:
        case Slider(minimum=low, maximum=high):
            return [high, low, *([0.0] if low < 0 < high else [])]
        case Choice(options=options, default=default):
            return [option for option in options if option != default]
        case Action(labels=labels):
            return [1 % len(labels)]
        case Points():
            return [value for value in control.extremes() if value != control.default]
        case _:
            return [not control.default]


def frame_at(
    scene: Scene[Any], given: Mapping[str, object], cache: StageCache, tier: str = ""
) -> Frame:
    return scene.render(scene.check(given), tier, cache)


def parameters(scene: Scene[Any], given: Mapping[str, object]) -> dict[str, Parameter]:
    """All that stages may read, without photographs."""
    settings, level = scene.check(given), scene.accuracy.level("")
    worked_out = scene.parameters(settings, level.name) if scene.parameters else {}
    own: dict[str, Parameter] = {"photograph": None, "readings": ()}
    return {**values_of(settings), **level.parameters, **own, **(worked_out or {})}


def affected_stages(
    stages: tuple[Stage, ...], before: Mapping[str, Parameter], after: Mapping[str, Parameter]
) -> set[str]:
    """Stages that read a changed parameter or change whether they are neutral, and dependents."""
    changed = {name for name, value in after.items() if before.get(name) != value}
    reached: set[str] = set()
    for stage in stages:
        turned = bool(stage.reason(before)) != bool(stage.reason(after))
        if turned or changed.intersection(stage.reads) or reached & {*stage.after, stage.source}:
            reached.add(stage.name)
    return reached


@pytest.mark.parametrize("scene_id", [name for name, scene in SCENES.items() if scene.stages])
def test_control_recomputes_only_stages_that_depend_on_it(scene_id: str) -> None:
    scene, start, cache = SCENES[scene_id], START.get(scene_id, {}), StageCache()
    for control in scene.controls:
        moved = {**start, control.name: other_values(control)[0]}
        before, after = frame_at(scene, start, cache), frame_at(scene, moved, cache)
        computed = {stage.name for stage in after.stages if stage.status == "computed"}
        made_before = {stage.name for stage in before.stages if stage.status != "skipped"}
        assert computed & made_before <= affected_stages(
            scene.stages, parameters(scene, start), parameters(scene, moved)
        ), control.name


def walk(scene_id: str, *, every_value: bool) -> Iterator[dict[str, object]]:
    """From the start through the controls and back: each moved to one other value, cumulatively; or
    each alone to ``every_value``, then all at once."""
    start, controls = START.get(scene_id, {}), SCENES[scene_id].controls
    yield start
    if every_value:
        for control in controls:
            yield from ({**start, control.name: value} for value in other_values(control))
        for end in (0, -1):
            yield {control.name: other_values(control)[end] for control in controls}
    else:
        names = [control.name for control in controls]
        ends = [other_values(control)[0] for control in controls]
        for moved in range(1, len(controls) + 1):
            yield {**start, **dict(zip(names[:moved], ends, strict=False))}
    yield start


@pytest.fixture
def few_rays(monkeypatch: pytest.MonkeyPatch) -> None:
    """Fewer rays through the lens: their number changes a picture's cost, not its dependencies."""
    through_lens = SCENES["camera"].accuracy.level("aperture-rays")
    monkeypatch.setitem(through_lens.stage_values, "lens_rays", 2)
    monkeypatch.setitem(depth_stages.SPIRALS, "fibonacci-16", fibonacci_disc(2))


@cache
def cold_start(scene_id: str, tier: str) -> Frame:
    """The first frame, with few rays, to which several walks return."""
    return frame_at(SCENES[scene_id], START.get(scene_id, {}), StageCache(), tier)


WALKS = [
    pytest.param(name, tier, every, marks=pytest.mark.deep if every or tier else [])
    for name, scene in SCENES.items()
    for tier in ("", *scene.accuracy.names)
    for every in ((False,) if tier else (False, True))
]


@pytest.mark.usefixtures("few_rays")
@pytest.mark.parametrize(("scene_id", "tier", "every_value"), WALKS)
def test_warm_frame_is_bit_equal_to_a_cold_one(scene_id: str, tier: str, every_value: bool) -> None:
    scene, cache = SCENES[scene_id], StageCache()
    for given in walk(scene_id, every_value=every_value):
        warm = frame_at(scene, given, cache, tier)
        at_start = given == START.get(scene_id, {})
        cold = (
            cold_start(scene_id, tier) if at_start else frame_at(scene, given, StageCache(), tier)
        )
        assert_same(warm, cold, (given, tier))


@pytest.mark.usefixtures("few_rays")
@pytest.mark.parametrize(
    "scene_id", [name for name, scene in SCENES.items() if scene.accuracy.levels]
)
def test_frame_does_not_depend_on_the_levels_before_it(scene_id: str) -> None:
    """There and back through all levels with a cache that holds them all."""
    scene, given = SCENES[scene_id], START.get(scene_id, {})
    for way in (scene.accuracy.names, scene.accuracy.names[::-1]):
        cache = StageCache(depth=len(way))
        for tier in way:
            assert_same(
                frame_at(scene, given, cache, tier), cold_start(scene_id, tier), (tier, way)
            )


def assert_same(ours: Frame, theirs: Frame, where: object) -> None:
    """All that the reader sees is equal to the last bit."""
    assert ours.readouts == theirs.readouts, where
    assert ours.description == theirs.description, where
    for one, other in zip(ours.panels, theirs.panels, strict=True):
        assert one.overlay == other.overlay, where
        assert (one.raster is None) == (other.raster is None), where
        if one.raster is not None and other.raster is not None:
            assert np.array_equal(one.raster, other.raster), where
