"""Pictures of every scene: by tier, as drafts, before Python runs, and with the reader's own
photograph."""

import itertools
import json
from typing import Any

import numpy as np
import pytest
from PIL import Image
from support.frames import frame_of, texts_of

from simulations.engine.controls import Control, Slider
from simulations.engine.frame import Frame, Raster, to_json
from simulations.engine.photograph import Photograph
from simulations.engine.scene import Scene
from simulations.engine.settings import values_of
from simulations.engine.stages import StageCache
from simulations.registry import SCENE_MODULES, load_ladder, load_scene
from site_builder.document.blocks import Simulation
from site_builder.document.places import Passage
from site_builder.figures import initial_frames

SCENES = {name: load_scene(name) for name in SCENE_MODULES}
TIERED = [name for name, scene in SCENES.items() if scene.accuracy.levels]
WITH_ESTIMATE = [name for name, scene in SCENES.items() if scene.accuracy.estimate is not None]
WITH_PHOTOGRAPH = [
    name for name, scene in SCENES.items() if isinstance(scene.instrument.photograph, tuple)
]
COARSER = [
    (name, level.name)
    for name, scene in SCENES.items()
    for rest in [scene.accuracy.level("")]
    for level in scene.accuracy.levels
    if level.stage_values and level != rest
    if not scene.accuracy.ladder or level.parameters["tier"] == rest.parameters["tier"]
    if name != "photon-transfer"  # it draws other cells, of the same noise
]
"""Levels that compute what the default does, for fewer pixels."""
FAR_CODES = {"stability": 15.0, "depth-of-field": 2.0}
"""Mean difference of a coarser picture; 1.5 codes elsewhere. Near trouble both are noise; where all
is sharp, a ray for four pixels aliases."""


@pytest.mark.parametrize("name", [name for name in TIERED if SCENES[name].accuracy.ladder])
def test_default_level_is_the_ladders_and_has_an_error_estimate(name: str) -> None:
    accuracy = SCENES[name].accuracy
    assert accuracy.default == load_ladder(accuracy.ladder).default_tier
    assert accuracy.estimate


@pytest.mark.parametrize("name", WITH_ESTIMATE)
def test_every_level_states_its_error_with_a_number_and_a_unit(name: str) -> None:
    """Before the first number there may be steps that only prepare the reference."""
    scene = SCENES[name]
    given = scene.check({})
    for tier in scene.accuracy.names or ("",):
        first = next(each for each in scene.estimates(given, tier, StageCache()) if each.unit)
        assert first.label
        assert any(sign.isdigit() for sign in first.text), (tier, first.text)


@pytest.mark.parametrize("name", TIERED)
def test_change_of_level_recomputes_a_stage(name: str) -> None:
    """A choice between levels that no stage reads would change nothing."""
    scene, cache = SCENES[name], StageCache()
    given = scene.check({})
    for one, other in itertools.pairwise(scene.accuracy.names):
        scene.render(given, one, cache)
        after = scene.render(given, other, cache)
        statuses = {stage.status for stage in after.stages}
        assert not after.stages or statuses != {"reused"}, (one, other)


@pytest.mark.parametrize(("name", "level"), COARSER)
def test_coarser_level_looks_like_the_level_at_rest(name: str, level: str) -> None:
    """At the start, and at the ends of two sliders."""
    scene, most = SCENES[name], FAR_CODES.get(name, 1.5)
    sliders = (each for each in scene.controls if isinstance(each, Slider))
    for given in ({}, *itertools.chain(*map(ends, itertools.islice(sliders, 2)))):
        rest, moving = (frame_of(scene, tier, **given) for tier in (scene.accuracy.default, level))
        for one, other in zip(pictures(rest), pictures(moving), strict=True):
            assert np.abs(reduced(one) - reduced(other)).mean() <= most, given


def ends(control: Control) -> list[dict[str, object]]:
    assert isinstance(control, Slider)
    return [{control.name: value} for value in (control.minimum, control.maximum)]


def pictures(frame: Frame) -> list[Raster]:
    return [panel.raster for panel in frame.panels if panel.raster is not None]


def reduced(raster: Raster) -> Any:
    """The means of 16 × 12 parts of a picture."""
    whole = Image.fromarray(raster)
    return np.asarray(whole.resize((16, 12), Image.Resampling.BOX), float)


@pytest.mark.parametrize("scene", SCENE_MODULES)
def test_initial_frame_equals_the_scenes_frame(scene: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Only the frames at the ends are prepared, to save time."""
    monkeypatch.setattr(initial_frames, "FRAMES", 2)
    of: Scene[Any] = SCENES[scene]
    start = values_of(of.check({}))
    figure = Simulation(
        scene=of,
        id=f"figure-{scene}",
        values={},
        tier=of.accuracy.default,
        caption=Passage(),
        path="",
        line=1,
    )
    strip = initial_frames.prerender("page", figure)
    if strip is None:
        return
    cache = StageCache()
    prerendered = json.loads(strip.data)
    for frame in (prerendered["frames"][0], prerendered["frames"][-1]):
        settings = of.check({**start, prerendered["control"]: frame["value"]})
        truth = json.loads(to_json(of.render(settings, of.accuracy.default, cache)))
        assert frame["readouts"] == truth["readouts"]
        assert frame["description"] == truth["description"]
        drawn = [panel["overlay"] for panel in truth["panels"]]
        assert [panel["overlay"] for panel in frame["panels"]] == drawn


@pytest.mark.parametrize("name", WITH_PHOTOGRAPH)
def test_scene_shows_the_readers_picture_and_then_the_books_again(name: str) -> None:
    scene = SCENES[name]
    assert isinstance(scene.instrument.photograph, tuple)
    width, height = scene.instrument.photograph
    codes = np.random.default_rng(0).integers(0, 256, (height, width, 3), np.uint8)
    settings, cache = scene.check({}), StageCache()
    book_s, reader_s, again = (
        scene.render(settings, scene.accuracy.default, cache, own)
        for own in (None, Photograph(1, codes), None)
    )
    both = zip(pictures(book_s), pictures(reader_s), strict=True)
    assert not all(np.array_equal(a, b) for a, b in both)
    assert all((a == b).all() for a, b in zip(pictures(book_s), pictures(again), strict=True))
    assert book_s.description == again.description
    assert texts_of(book_s) == texts_of(again)
