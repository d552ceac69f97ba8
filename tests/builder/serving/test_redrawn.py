"""What a page shows of a scene is drawn anew once its code has changed, before it is asked for."""

import sys

import pytest

from simulations.registry import load_scene, scene_module
from site_builder.drawing import frames
from site_builder.drawing.frames import frame_at, print_at
from site_builder.editor.sources import scene_sources
from site_builder.kept.keeper import Keeper, keeping
from site_builder.serving.redrawn import redrawn

SCENE_ID = "transform-2d"
MODULE = scene_module(SCENE_ID)


@pytest.fixture(autouse=True)
def _nothing_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(frames, "_drawn", {})


def draw() -> None:
    scene = load_scene(SCENE_ID)
    frame_at(scene, scene.check({"amount": 40}), scene.default_tier)
    print_at(scene, scene.check({}), scene.default_tier)
    scene_sources(scene)


def test_all_that_was_asked_of_a_changed_scene_is_there_when_it_is_asked_again() -> None:
    draw()
    keeper = Keeper()
    with keeping(keeper):
        for ask in redrawn([MODULE]):
            ask()
        keeper.made.clear()
        draw()
        assert keeper.made == []


def test_of_a_scene_that_has_not_changed_nothing_is_asked() -> None:
    draw()
    assert redrawn(["simulations.scenes.camera.scene"]) == []


def test_what_is_wrong_with_a_changed_scene_is_left_to_who_asks_next(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    draw()
    monkeypatch.delattr(sys.modules[MODULE], "SCENE")
    for ask in redrawn([MODULE]):
        ask()


def test_settings_that_a_changed_scene_has_no_more_are_not_drawn(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    draw()
    monkeypatch.setattr(sys.modules[MODULE], "SCENE", load_scene("camera"))
    keeper = Keeper()
    with keeping(keeper):
        for ask in redrawn([MODULE]):
            ask()
    assert not [name for name in keeper.made if name.endswith("frame_at")]
