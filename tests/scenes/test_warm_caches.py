"""Stages computed ahead: the first figure of a scene finds them, and shows what it would show."""

import json
from typing import Any

import pytest

from simulations import browser
from simulations.registry import SCENE_MODULES, load_scene

SCENE, AT_REST = "camera", "layers"


@pytest.fixture(autouse=True)
def fresh(monkeypatch: pytest.MonkeyPatch) -> None:
    """Caches of this test's own."""
    monkeypatch.setattr(browser, "_caches", {})
    monkeypatch.setattr(browser, "_ahead", {})


def shown(figure: str, tier: str = AT_REST, **values: Any) -> tuple[set[str], list[bytes]]:
    """Names of the stages that were computed, and the pixels."""
    reply = browser.render(figure, SCENE, json.dumps(values), tier)
    stages = json.loads(reply.meta)["stages"]
    computed = {stage["name"] for stage in stages if stage["status"] == "computed"}
    return computed, [raster.tobytes() for raster in reply.rasters]


def test_what_is_warmed_for_a_chapter_is_found_by_the_first_figure_of_the_scene() -> None:
    browser.warm("", SCENE, "{}", AT_REST)
    computed, _ = shown("first", exposure=1)
    assert computed
    assert not {"surfaces", "light", "defocus"} & computed
    assert "surfaces" in shown("second", exposure=1)[0]


def test_a_figure_s_drafts_are_warmed_beside_its_frame_at_rest() -> None:
    scene = load_scene(SCENE)
    shown("figure")
    for tier in ("draft", *scene.own_drafts):
        browser.warm("figure", SCENE, "{}", tier)
    for tier, moved in (("scaled", {"focus": 4}), ("bowed", {"k1": -0.1}), (AT_REST, {})):
        assert "surfaces" not in shown("figure", tier, **moved)[0]


def test_a_warmed_figure_shows_what_a_cold_one_shows() -> None:
    cold = shown("cold", exposure=1)[1]
    browser.warm("", SCENE, "{}", AT_REST)
    assert shown("warm", exposure=1)[1] == cold


def test_no_more_is_kept_ahead_than_a_chapter_shows() -> None:
    for scene_id in list(SCENE_MODULES)[: browser.MOST_AHEAD + 2]:
        browser.warm("", scene_id, "{}", "")
    assert list(browser._ahead) == list(SCENE_MODULES)[2 : browser.MOST_AHEAD + 2]


def test_values_that_are_none_are_told_as_when_a_frame_is_asked_for() -> None:
    with pytest.raises(ValueError, match="k1"):
        browser.warm("", SCENE, '{"k1": "far"}', AT_REST)
