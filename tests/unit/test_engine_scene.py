"""The contract of a scene, the table of scenes, and what the browser's worker calls."""

import json
from collections.abc import Iterator

import pytest

from simulations import browser
from simulations.engine.controls import Action, Slider, Values
from simulations.engine.frame import Frame, Panel, Readout
from simulations.engine.pipeline import StageCache
from simulations.engine.scene import Scene
from simulations.registry import SCENE_MODULES, UnknownIdError, load_ladder, load_scene

SIZE = Slider(name="size", label="Size", default=1, minimum=0, maximum=2, step=1)
TIERS = (("coarse", "fine"), "fine", "coarse")
"""All of them, the default, the draft."""


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


def test_tiers_need_labels_or_a_ladder_that_has_them() -> None:
    with pytest.raises(ValueError, match="no ladder to label them"):
        Scene("s", "S", (SIZE,), frame_of, ("fast",), "fast", "fast")
    Scene("s", "S", (SIZE,), frame_of, ("fast",), "fast", "fast", ladder="srgb")


def test_words_for_a_tier_that_the_scene_lacks_are_refused() -> None:
    with pytest.raises(ValueError, match=r"labels .'slow'.*legal: .'fast'"):
        Scene(
            "s",
            "S",
            (SIZE,),
            frame_of,
            ("fast",),
            "fast",
            "fast",
            ladder="srgb",
            tier_labels={"slow": "Slow"},
        )


def test_only_controls_of_the_scene_can_be_drafted() -> None:
    with pytest.raises(ValueError, match="drafted 'sise'"):
        Scene("s", "S", (SIZE,), frame_of, drafted=("sise",))
    with pytest.raises(ValueError, match="drafted 'sise'"):
        Scene("s", "S", (SIZE,), frame_of, *TIERS, ladder="srgb", drafted_in={"fine": ("sise",)})


def test_only_tiers_of_the_scene_can_have_drags_of_their_own() -> None:
    with pytest.raises(ValueError, match=r"drafted_in .*'finer'.*legal: \('coarse', 'fine'\)"):
        Scene("s", "S", (SIZE,), frame_of, *TIERS, ladder="srgb", drafted_in={"finer": ("size",)})


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_every_tier_of_a_scene_is_a_rung_of_its_ladder(scene_id: str) -> None:
    scene = load_scene(scene_id)
    if scene.ladder:
        rungs = [tier.id for tier in load_ladder(scene.ladder).tiers]
        assert [rung for rung in rungs if rung in scene.tiers] == list(scene.tiers)


def judged(values: Values, tier: str, _cache: StageCache) -> Iterator[Readout]:
    for rays in (1, 2):
        yield Readout("error", f"{tier}, {rays} rays", f"{values.number('size'):g}", "px")


def test_estimates_of_the_error_come_one_at_a_time_and_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    scene = Scene("s", "S", (SIZE,), frame_of, error=judged)
    monkeypatch.setattr(browser, "load_scene", lambda _id: scene)
    ask = [json.loads(browser.error("figure-3", "s", '{"size": 2}', "")) for _ in range(4)]
    assert [answer and answer["label"] for answer in ask] == [", 1 rays", ", 2 rays", None, None]
    assert ask[0]["text"] == "2"


def test_another_setting_is_judged_from_the_beginning(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = Scene("s", "S", (SIZE,), frame_of, error=judged)
    monkeypatch.setattr(browser, "load_scene", lambda _id: scene)
    browser.error("figure-4", "s", '{"size": 2}', "")
    assert json.loads(browser.error("figure-4", "s", '{"size": 1}', ""))["label"] == ", 1 rays"
    assert json.loads(browser.error("figure-4", "s", '{"size": 2}', ""))["label"] == ", 1 rays"


def test_a_scene_without_a_reference_has_no_error(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = Scene("s", "S", (SIZE,), frame_of)
    monkeypatch.setattr(browser, "load_scene", lambda _id: scene)
    assert browser.error("figure-5", "s", "{}", "") == "null"


def test_an_unknown_scene_is_named_with_the_nearest_legal_one() -> None:
    with pytest.raises(UnknownIdError) as raised:
        load_scene("lens-distorsion")
    assert str(raised.value) == (
        "unknown simulation 'lens-distorsion'; did you mean 'lens-distortion'?"
    )


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_every_scene_of_the_table_loads_under_its_own_id(scene_id: str) -> None:
    assert load_scene(scene_id).id == scene_id


def test_the_worker_gets_a_clamped_frame_and_its_pixels(monkeypatch: pytest.MonkeyPatch) -> None:
    labels = {"fast": "Fast", "exact": "Exact"}
    scene = Scene(
        "s", "S", (SIZE,), frame_of, ("fast", "exact"), "exact", "fast", tier_labels=labels
    )
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
