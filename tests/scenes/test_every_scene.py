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
TIERED = [name for name, scene in SCENES.items() if scene.tiers]
WITH_ESTIMATE = [name for name, scene in SCENES.items() if scene.estimate is not None]
WITH_PHOTOGRAPH = [name for name, scene in SCENES.items() if isinstance(scene.photograph, tuple)]
DRAFTS = [
    (name, draft, [control for control, tier in drafts.items() if tier == draft])
    for name, scene in SCENES.items()
    for drafts in [scene.drafts_of(scene.default_tier)]
    for draft in dict.fromkeys(drafts.values())
    if name != "photon-transfer"  # it draws other cells, of the same noise
]
FAR_CODES = {"stability": 15.0}
"""Mean difference of a draft from its picture; 1.5 codes elsewhere. Near trouble both are noise."""


@pytest.mark.parametrize("name", TIERED)
def test_default_tier_is_the_ladders_and_has_an_error_estimate(name: str) -> None:
    scene = SCENES[name]
    assert not scene.ladder or scene.default_tier == load_ladder(scene.ladder).default_tier
    assert name in WITH_ESTIMATE


@pytest.mark.parametrize("name", WITH_ESTIMATE)
def test_every_tier_states_its_error_with_a_number_and_a_unit(name: str) -> None:
    """Before the first number there may be steps that only prepare the reference."""
    scene = SCENES[name]
    given = scene.check({})
    for tier in scene.tiers or ("",):
        first = next(each for each in scene.estimates(given, tier, StageCache()) if each.unit)
        assert first.label
        assert any(sign.isdigit() for sign in first.text), (tier, first.text)


@pytest.mark.parametrize("name", TIERED)
def test_change_of_tier_recomputes_a_stage(name: str) -> None:
    """A choice between tiers that no stage reads would change nothing."""
    scene, cache = SCENES[name], StageCache()
    given = scene.check({})
    for one, other in itertools.pairwise(scene.tiers):
        scene.render(given, one, cache)
        after = scene.render(given, other, cache)
        statuses = {stage.status for stage in after.stages}
        assert not after.stages or statuses != {"reused"}, (one, other)


@pytest.mark.parametrize(("name", "draft", "controls"), DRAFTS)
def test_draft_is_near_the_settled_picture(name: str, draft: str, controls: list[str]) -> None:
    """At the start, and at the ends of the controls during whose drag it is shown."""
    scene, most = SCENES[name], FAR_CODES.get(name, 1.5)
    sliders = (each for each in scene.controls if each.name in controls)
    for given in ({}, *itertools.chain(*map(ends, itertools.islice(sliders, 2)))):
        rest, moving = (frame_of(scene, tier, **given) for tier in (scene.default_tier, draft))
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
    figure = Simulation(of, f"figure-{scene}", {}, of.default_tier, Passage(), "", 1)
    strip = initial_frames.prerender("page", figure)
    if strip is None:
        return
    cache = StageCache()
    prerendered = json.loads(strip.data)
    for frame in (prerendered["frames"][0], prerendered["frames"][-1]):
        settings = of.check({**start, prerendered["control"]: frame["value"]})
        truth = json.loads(to_json(of.render(settings, of.default_tier, cache)))
        assert frame["readouts"] == truth["readouts"]
        assert frame["description"] == truth["description"]
        drawn = [panel["overlay"] for panel in truth["panels"]]
        assert [panel["overlay"] for panel in frame["panels"]] == drawn


@pytest.mark.parametrize("name", WITH_PHOTOGRAPH)
def test_scene_shows_the_readers_picture_and_then_the_books_again(name: str) -> None:
    scene = SCENES[name]
    assert isinstance(scene.photograph, tuple)
    width, height = scene.photograph
    codes = np.random.default_rng(0).integers(0, 256, (height, width, 3), np.uint8)
    settings, cache = scene.check({}), StageCache()
    book_s, reader_s, again = (
        scene.render(settings, scene.default_tier, cache, own)
        for own in (None, Photograph(1, codes), None)
    )
    both = zip(pictures(book_s), pictures(reader_s), strict=True)
    assert not all(np.array_equal(a, b) for a, b in both)
    assert all((a == b).all() for a, b in zip(pictures(book_s), pictures(again), strict=True))
    assert book_s.description == again.description
    assert texts_of(book_s) == texts_of(again)
