"""The contract of a scene, the table of scenes, and what the browser's worker calls."""

import json

import pytest

from simulations import browser
from simulations.engine.controls import Action, Slider
from simulations.engine.frame import Frame, Panel
from simulations.engine.scene import Scene
from simulations.registry import SCENE_MODULES, UnknownSceneError, load_scene

SIZE = Slider(name="size", label="Size", default=1, minimum=0, maximum=2, step=1)


def frame_of(values, tier, _cache):  # type: ignore[no-untyped-def]
    panel = Panel("a", "A", 400, 300)
    return Frame((panel,), (), f"Size {values.number('size'):g}, tier {tier!r}.")


def test_two_controls_of_one_name_are_refused() -> None:
    with pytest.raises(ValueError, match="duplicate control"):
        Scene("s", "S", (SIZE, SIZE), frame_of)


def test_a_button_must_drive_a_slider_of_its_scene() -> None:
    play = Action(name="play", labels=("Play",), drives="sise", effect="play")
    with pytest.raises(ValueError, match="drives no slider 'sise'"):
        Scene("s", "S", (SIZE, play), frame_of)


def test_tiers_need_a_default_and_a_draft_among_them() -> None:
    with pytest.raises(ValueError, match="tier"):
        Scene("s", "S", (SIZE,), frame_of, tiers=("fast", "exact"))
    with pytest.raises(ValueError, match="tier 'slow'"):
        Scene("s", "S", (SIZE,), frame_of, ("fast",), "fast", "slow")
    with pytest.raises(ValueError, match="tier 'fast'"):
        Scene("s", "S", (SIZE,), frame_of, default_tier="fast")


def test_an_unknown_scene_is_named_with_the_nearest_legal_one() -> None:
    with pytest.raises(UnknownSceneError) as raised:
        load_scene("lens-distorsion")
    assert str(raised.value) == (
        "unknown simulation 'lens-distorsion'; did you mean 'lens-distortion'?"
    )


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_every_scene_of_the_table_loads_under_its_own_id(scene_id: str) -> None:
    assert load_scene(scene_id).id == scene_id


def test_the_worker_gets_a_clamped_frame_and_its_pixels(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = Scene("s", "S", (SIZE,), frame_of, ("fast", "exact"), "exact", "fast")
    monkeypatch.setattr(browser, "load_scene", lambda _id: scene)
    reply = browser.render("figure-1", "s", '{"size": 99}', "no such tier")
    assert json.loads(reply.meta)["description"] == "Size 2, tier 'exact'."
    assert reply.rasters == ()


def test_a_figure_that_is_forgotten_loses_only_its_cache(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = Scene("s", "S", (SIZE,), frame_of)
    monkeypatch.setattr(browser, "load_scene", lambda _id: scene)
    first = browser.render("figure-2", "s", "{}", "")
    browser.forget("figure-2")
    browser.forget("figure-2")
    assert browser.render("figure-2", "s", "{}", "") == first
