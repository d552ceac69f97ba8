"""What holds for every chapter, scene and ladder, however many there are."""

import math
from typing import Any

import pytest
from bench.record import close, finite

from simulations.engine.controls import Slider
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from simulations.registry import LADDER_MODULES, SCENE_MODULES, load_ladder, load_scene
from site_builder.book_root import ROOT
from site_builder.build import Options, check_site
from site_builder.diagnostics import Diagnostic, Diagnostics
from site_builder.measured.ladder_choice import off_the_front
from site_builder.measured.measurements import read_measurements


def ends(scene: Scene[Any]) -> list[dict[str, object]]:
    """The defaults, and each slider at both its ends."""
    sliders = [control for control in scene.controls if isinstance(control, Slider)]
    return [{}, *({one.name: end} for one in sliders for end in (one.minimum, one.maximum))]


def measured_ladders() -> list[str]:
    kept = read_measurements(ROOT, Diagnostics()).ladders
    return [name for name in LADDER_MODULES if name in kept]


def test_the_sources_have_no_mistakes() -> None:
    warnings: list[Diagnostic] = []
    check_site(Options(ROOT, warn=warnings.append))
    assert warnings == []


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_a_scene_draws_at_the_ends_of_its_controls(scene_id: str) -> None:
    scene = load_scene(scene_id)
    for tier in scene.tiers or ("",):
        for values in ends(scene):
            frame = scene.render(scene.check(values), tier, StageCache())
            assert frame.description, values


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_what_a_scene_keeps_changes_nothing(scene_id: str) -> None:
    scene = load_scene(scene_id)
    kept = StageCache()
    for values in [*ends(scene), {}]:
        settings = scene.check(values)
        warm, cold = (scene.render(settings, "", cache) for cache in (kept, StageCache()))
        assert (warm.panels, warm.readouts) == (cold.panels, cold.readouts)


@pytest.mark.parametrize("ladder_id", measured_ladders())
def test_the_recorded_errors_are_those_of_the_code(ladder_id: str) -> None:
    ladder = load_ladder(ladder_id)
    workload = ladder.prepare()
    reference = ladder.reference(workload)
    for item in read_measurements(ROOT, Diagnostics()).find(ladder_id).tiers:
        result = item.tier.run(workload)
        for metric in ladder.metrics:
            now = metric.measure(result, reference, workload)
            assert not math.isnan(now)
            assert close(finite(now), item.errors[metric.id]), f"{item.tier.id}: {now}"


@pytest.mark.parametrize("ladder_id", measured_ladders())
def test_a_default_is_not_beaten_by_another_tier(ladder_id: str) -> None:
    assert off_the_front(read_measurements(ROOT, Diagnostics()).find(ladder_id)) == ""
