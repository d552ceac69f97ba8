"""Only what a scene requires is computed: for every scene with stages, control by control."""

import itertools
from importlib import import_module

import numpy as np
import pytest

from simulations.engine.controls import Action, Choice, Control, Slider, check_values
from simulations.engine.frame import Frame
from simulations.engine.scene import Scene
from simulations.engine.stages import Stage, StageCache
from simulations.registry import SCENE_MODULES, load_scene
from simulations.scenes.camera import scene as camera
from simulations.scenes.camera import stages as camera_stages


def chain_of(scene_id: str) -> tuple[Stage, ...]:
    """The ``STAGES`` of the scene's module; nothing where it computes in one go."""
    stages: tuple[Stage, ...] = getattr(import_module(SCENE_MODULES[scene_id]), "STAGES", ())
    return stages


CHAINS = {
    scene_id: (load_scene(scene_id), chain_of(scene_id))
    for scene_id in SCENE_MODULES
    if chain_of(scene_id)
}

START: dict[str, dict[str, object]] = {
    "camera": {"aperture": 2.0, "k1": -0.1},
    "lens-distortion": {"k1": -0.1, "correct": True},
    "bayer-demosaic": {"demosaic": 1},
}
"""Settings at which no stage is neutral."""


def moved(control: Control) -> object:
    """Another legal value than the default, and than those of `START`."""
    match control:
        case Slider():
            return control.maximum
        case Choice():
            return next(option for option in control.options if option != control.default)
        case Action():
            return 1 % len(control.labels)
        case _:
            return not control.default


MOVES = [(name, control) for name, (scene, _) in CHAINS.items() for control in scene.controls]


def named(move: object) -> str | None:
    return move.name if isinstance(move, Slider | Choice | Action) else None


def show(scene: Scene, given: dict[str, object], cache: StageCache) -> Frame:
    return scene.render(check_values(scene.controls, given), scene.default_tier, cache)


TIER_PARAMETERS = {"tier", "reduction", "bent_rays", "lens_rays"}
"""Set by the tier alone."""


def readers(scene: Scene, stages: tuple[Stage, ...], control: str) -> set[str]:
    """Stages that read the control, and all that follow them.

    A parameter that is no control is worked out from them, from any of them.
    """
    others = TIER_PARAMETERS | {item.name for item in scene.controls if item.name != control}
    reached: set[str] = set()
    for stage in stages:
        if set(stage.reads) - others or reached.intersection(stage.inputs):
            reached.add(stage.name)
    return reached


def test_every_scene_that_reports_stages_is_held_to_them_here() -> None:
    frames = {name: show(load_scene(name), {}, StageCache()) for name in SCENE_MODULES}
    reporting = {name for name, frame in frames.items() if frame.stages}
    assert reporting <= set(CHAINS)
    assert {"lens-distortion", "lambertian-shading", "bayer-demosaic", "camera"} <= reporting


@pytest.mark.parametrize(("scene_id", "control"), MOVES, ids=named)
def test_a_control_recomputes_only_what_reads_it_or_follows(
    scene_id: str, control: Control
) -> None:
    scene, stages = CHAINS[scene_id]
    start, cache = START.get(scene_id, {}), StageCache()
    show(scene, start, cache)
    after = show(scene, {**start, control.name: moved(control)}, cache)
    computed = {stage.name for stage in after.stages if stage.status == "computed"}
    assert computed <= readers(scene, stages, control.name)


@pytest.mark.parametrize(("scene_id", "control"), MOVES, ids=named)
def test_a_warm_frame_is_bit_equal_to_a_cold_one(scene_id: str, control: Control) -> None:
    scene, _ = CHAINS[scene_id]
    start, cache = START.get(scene_id, {}), StageCache()
    given = {**start, control.name: moved(control)}
    show(scene, start, cache)
    warm, cold = show(scene, given, cache), show(scene, given, StageCache())
    for ours, theirs in zip(warm.panels, cold.panels, strict=True):
        assert ours.overlay == theirs.overlay
        assert (ours.raster is None) == (theirs.raster is None)
        if ours.raster is not None and theirs.raster is not None:
            np.testing.assert_array_equal(ours.raster, theirs.raster)
    assert warm.readouts == cold.readouts


TIERS = list(itertools.permutations(camera_stages.TIERS, 2))


@pytest.mark.parametrize(("first", "second"), TIERS)
def test_a_settled_photograph_does_not_remember_the_draft(first: str, second: str) -> None:
    scene, cache = camera.SCENE, StageCache()
    given = scene.check(START["camera"])
    scene.render(given, first, cache)
    warm = scene.render(given, second, cache).panels[0].raster
    cold = scene.render(given, second, StageCache()).panels[0].raster
    assert warm is not None
    assert cold is not None
    np.testing.assert_array_equal(warm, cold)


def test_dearer_tiers_of_the_camera_are_nearer_to_rays_through_the_whole_lens() -> None:
    scene = camera.SCENE
    given = scene.check({"aperture": 1.4})
    errors = {}
    for tier in scene.tiers:
        *_, last = scene.estimates(given, tier, StageCache())
        errors[tier] = float(last.text)
    assert errors["draft"] > 3 * errors["layers"]
    assert errors["layers"] > 1.4 * errors["aperture-rays"]


def test_a_lens_that_is_a_pinhole_needs_no_rays() -> None:
    scene = camera.SCENE
    given = scene.check({"aperture": 22})
    layers = scene.render(given, "layers", StageCache()).panels[0].raster
    rays = scene.render(given, "aperture-rays", StageCache())
    assert "aperture rays" in {item.name for item in rays.stages if item.status == "skipped"}
    ours, theirs = np.asarray(layers, int), np.asarray(rays.panels[0].raster, int)
    inner = (slice(2, -2), slice(2, -2))
    np.testing.assert_array_equal(ours[inner], theirs[inner])
    # Only the picture with a margin knows how patterns go on beyond the edge.
    np.testing.assert_allclose(ours, theirs, atol=1)
