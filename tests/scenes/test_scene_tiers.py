"""Checks of every scene with accuracy choices against its ladder and the page."""

import itertools

import pytest

from simulations.engine.stages import StageCache
from simulations.registry import SCENE_MODULES, load_ladder, load_scene

SCENES = {name: load_scene(name) for name in SCENE_MODULES}
TIERED = [name for name, scene in SCENES.items() if scene.tiers]
RUNGS = [name for name in TIERED if SCENES[name].ladder]
JUDGED = [name for name, scene in SCENES.items() if scene.estimate is not None]


@pytest.mark.parametrize("name", RUNGS)
def test_a_scene_settles_where_its_ladder_does(name: str) -> None:
    assert SCENES[name].default_tier == load_ladder(SCENES[name].ladder).default_tier


@pytest.mark.parametrize("name", TIERED)
def test_a_scene_with_tiers_can_be_judged(name: str) -> None:
    assert name in JUDGED


@pytest.mark.parametrize("name", JUDGED)
def test_every_tier_tells_its_error_with_a_number_and_a_unit(name: str) -> None:
    """Before the first number there may be steps that only prepare the reference."""
    scene = SCENES[name]
    given = scene.check({})
    for tier in scene.tiers or ("",):
        first = next(told for told in scene.estimates(given, tier, StageCache()) if told.unit)
        assert first.label
        assert any(sign.isdigit() for sign in first.text), (tier, first.text)


@pytest.mark.parametrize("name", TIERED)
def test_no_two_tiers_paint_the_same_pixels_by_being_the_same_computation(name: str) -> None:
    """Their stages read the tier: a choice that changes nothing would be no choice."""
    scene, cache = SCENES[name], StageCache()
    given = scene.check({})
    for one, other in itertools.pairwise(scene.tiers):
        scene.render(given, one, cache)
        after = scene.render(given, other, cache)
        statuses = {stage.status for stage in after.stages}
        assert not after.stages or statuses != {"reused"}, (one, other)
