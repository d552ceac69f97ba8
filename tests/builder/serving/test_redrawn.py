"""What a page shows of a scene is drawn anew once its code has changed, before it is asked for."""

import sys

import pytest

from simulations.registry import load_scene, scene_module
from site_builder.drawing.frames import frame_at, print_at
from site_builder.editor.sources import scene_sources
from site_builder.kept.keeper import Keeper, keeping, kept_as
from site_builder.serving.redrawn import redrawn

SCENE_ID = "transform-2d"
MODULE = scene_module(SCENE_ID)


def draw() -> None:
    scene = load_scene(SCENE_ID)
    frame_at(scene, scene.check({"amount": 40}), scene.default_tier)
    print_at(scene, scene.check({}), scene.default_tier)
    scene_sources(scene)


@pytest.fixture(scope="module")
def asked() -> list[str]:
    """What a build notes of that."""
    with keeping(keeper := Keeper()):
        draw()
    return [*keeper.asked]


def test_all_that_was_asked_of_a_changed_scene_is_there_when_it_is_asked_again(
    asked: list[str],
) -> None:
    keeper = Keeper()
    with keeping(keeper):
        for ask in redrawn([MODULE], asked):
            ask()
        keeper.made.clear()
        draw()
        assert keeper.made == []


def test_of_a_scene_that_has_not_changed_nothing_is_asked(asked: list[str]) -> None:
    assert redrawn(["simulations.scenes.camera.scene"], asked) == []


def test_what_is_wrong_with_a_changed_scene_is_left_to_who_asks_next(
    asked: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delattr(sys.modules[MODULE], "SCENE")
    for ask in redrawn([MODULE], asked):
        ask()


def test_settings_that_a_changed_scene_has_no_more_are_not_drawn(
    asked: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys.modules[MODULE], "SCENE", load_scene("camera"))
    keeper = Keeper()
    with keeping(keeper):
        for ask in redrawn([MODULE], asked):
            ask()
    assert not [name for name in keeper.made if name.endswith("frame_at")]


def test_what_a_page_asks_for_is_known_though_the_page_is_only_found() -> None:
    keeper = Keeper()
    for _ in range(2):
        keeper.asked.clear()
        with keeping(keeper):
            kept_as("page", SCENE_ID, draw)
        assert len(redrawn([MODULE], keeper.asked)) == 3
