"""The contract of a scene, the table of scenes, and what the browser's worker calls."""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import pytest

from simulations import browser
from simulations.engine.frame import Frame, Panel, Readout
from simulations.engine.scene import Scene
from simulations.engine.settings import action, slider
from simulations.engine.stages import Outputs, Stage, StageCache
from simulations.registry import SCENE_MODULES, UnknownIdError, load_ladder, load_scene

TIERS = {"tiers": ("coarse", "fine"), "default_tier": "fine", "draft_tier": "coarse"}


@dataclass(frozen=True, slots=True)
class Settings:
    size: float = slider("Size", 1, 0, 2, 1)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    panel = Panel("a", "A", 400, 300)
    told = outputs.get("told", "nothing")
    return Frame((panel,), (), f"Size {settings.size:g}, {told}.")


STAGES = (Stage("told", lambda size, tier: f"{tier} of {size:g}"),)


def scene_of(**changed: Any) -> Scene[Settings]:
    return Scene("s", "S", Settings, draw, **changed)


@pytest.mark.parametrize("value", [None, 3])
def test_a_module_without_a_scene_is_refused(
    monkeypatch: pytest.MonkeyPatch, value: object
) -> None:
    known = next(iter(SCENE_MODULES))
    monkeypatch.setattr(import_module(SCENE_MODULES[known]), "SCENE", value)
    with pytest.raises(UnknownIdError, match=r"has (no|int as) SCENE; legal: a Scene"):
        load_scene(known)


def test_a_scene_with_the_id_of_another_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("simulations.scenes.camera.scene.SCENE", load_scene("aliasing"))
    with pytest.raises(UnknownIdError, match=r"has the id 'aliasing'; legal: 'camera'"):
        load_scene("camera")


def test_a_button_must_drive_a_slider_of_its_scene() -> None:
    @dataclass(frozen=True)
    class Driving:
        size: float = slider("Size", 1, 0, 2, 1)
        play: int = action("Play", drives="sise", effect="play")

    with pytest.raises(ValueError, match="'play' drives no slider 'sise'; legal: size"):
        Scene("s", "S", Driving, lambda _settings, _outputs: Frame((), (), ""))


SHADED = {**TIERS, "ladder": "shading"}


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"stages": (*STAGES, *STAGES)}, "two stages named 'told'; legal: a name for each"),
        ({"tiers": ("fast", "exact")}, "tier"),
        ({"tiers": ("fast",), "default_tier": "fast", "draft_tier": "slow"}, "tier 'slow'"),
        ({"default_tier": "fast"}, "tier 'fast'"),
        (TIERS, "no ladder to label them"),
        ({**SHADED, "tier_labels": {"slow": "Slow"}}, r"labels .'slow'.*legal: .'coarse', 'fine'"),
        ({"drafted": ("sise",)}, "drafted 'sise'"),
        ({**SHADED, "drafted_in": {"fine": ("sise",)}}, "drafted 'sise'"),
        ({**SHADED, "drafted_in": {"finer": ("size",)}}, r"drafted_in .*'finer'.*legal: \('coarse"),
        ({**SHADED, "own_drafts": {"coarse": ("size",)}}, "'coarse' is a tier; legal: another"),
        ({"own_drafts": {"rough": ("sise",)}}, "drafted 'sise'"),
    ],
)
def test_a_scene_that_contradicts_itself_is_refused(changed: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        scene_of(**changed)


def test_a_drag_is_answered_by_the_default_where_no_draft_is_named() -> None:
    assert scene_of(tiers=("fast",), default_tier="fast", ladder="shading").draft_tier == "fast"


def test_a_draft_of_its_own_stands_in_for_the_default_and_what_is_dearer() -> None:
    tiers = {"tiers": ("coarse", "fine", "finest"), "default_tier": "fine"}
    words = {tier: tier for tier in tiers["tiers"]}
    scene = scene_of(**tiers, tier_labels=words, stages=STAGES, own_drafts={"rough": ("size",)})
    assert [scene.drafts_of(tier) for tier in tiers["tiers"]] == [
        {},
        {"size": "rough"},
        {"size": "rough"},
    ]
    assert "rough of 1" in scene.render(Settings(), "rough", StageCache()).description


def test_stages_read_settings_the_tier_and_what_is_worked_out_from_both() -> None:
    double = Stage("told", lambda size, tier, double: f"{tier}: {size:g}, twice {double:g}")
    scene = scene_of(
        **SHADED,
        stages=(double,),
        parameters=lambda settings, tier: {"double": 2 * settings.size + (tier == "coarse")},
    )
    frame = scene.render(Settings(2), "coarse", StageCache())
    assert frame.description == "Size 2, coarse: 2, twice 5."
    assert [report.name for report in frame.stages] == ["told"]


def test_what_is_worked_out_may_stand_for_a_setting() -> None:
    scene = scene_of(**SHADED, stages=STAGES, parameters=lambda _settings, _tier: {"size": 7})
    assert scene.render(Settings(2), "", StageCache()).description == "Size 2, fine of 7."


def test_where_there_is_nothing_to_compute_no_stage_runs_and_none_is_reported() -> None:
    scene = scene_of(**SHADED, stages=STAGES, parameters=lambda _settings, _tier: None)
    frame = scene.render(Settings(2), "fine", StageCache())
    assert frame.description == "Size 2, nothing."
    assert frame.stages == ()


def test_a_tier_that_the_scene_lacks_is_its_default() -> None:
    scene = scene_of(**SHADED, stages=STAGES)
    for tier in ("", "fine", "no such tier"):
        frame = scene.render(Settings(), tier, StageCache())
        assert frame.description == "Size 1, fine of 1."


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_every_tier_of_a_scene_is_a_rung_of_its_ladder(scene_id: str) -> None:
    scene = load_scene(scene_id)
    if scene.ladder:
        rungs = [tier.id for tier in load_ladder(scene.ladder).tiers]
        assert [rung for rung in rungs if rung in scene.tiers] == list(scene.tiers)


def estimate(settings: Settings, _outputs: Outputs, tier: str) -> Iterator[Readout]:
    for rays in (1, 2):
        yield Readout("error", f"{tier}, {rays} rays", f"{settings.size:g}", "px")


def test_estimates_of_the_error_come_one_at_a_time_and_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    scene = scene_of(estimate=estimate)
    monkeypatch.setattr(browser, "load_scene", lambda _id: scene)
    ask = [json.loads(browser.error("figure-3", "s", '{"size": 2}', "")) for _ in range(4)]
    assert [answer and answer["label"] for answer in ask] == [", 1 rays", ", 2 rays", None, None]
    assert ask[0]["text"] == "2"


def test_another_setting_is_judged_from_the_beginning(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = scene_of(estimate=estimate)
    monkeypatch.setattr(browser, "load_scene", lambda _id: scene)
    browser.error("figure-4", "s", '{"size": 2}', "")
    assert json.loads(browser.error("figure-4", "s", '{"size": 1}', ""))["label"] == ", 1 rays"
    assert json.loads(browser.error("figure-4", "s", '{"size": 2}', ""))["label"] == ", 1 rays"


def test_a_scene_without_a_reference_has_no_error(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = scene_of()
    monkeypatch.setattr(browser, "load_scene", lambda _id: scene)
    assert browser.error("figure-5", "s", "{}", "") == "null"


def test_an_unknown_scene_is_named_with_the_nearest_legal_one() -> None:
    known = next(iter(SCENE_MODULES))
    with pytest.raises(UnknownIdError) as raised:
        load_scene(f"{known}x")
    assert str(raised.value) == f"unknown simulation '{known}x'; did you mean {known!r}?"


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_every_scene_of_the_table_loads_under_its_own_id(scene_id: str) -> None:
    assert load_scene(scene_id).id == scene_id


def test_the_worker_gets_a_clamped_frame_and_its_pixels(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = scene_of(**SHADED, stages=STAGES)
    monkeypatch.setattr(browser, "load_scene", lambda _id: scene)
    reply = browser.render("figure-1", "s", '{"size": 99}', "no such tier")
    assert json.loads(reply.meta)["description"] == "Size 2, fine of 2."
    assert reply.rasters == ()


def test_a_figure_that_is_forgotten_loses_only_its_cache(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = scene_of()
    monkeypatch.setattr(browser, "load_scene", lambda _id: scene)
    first = browser.render("figure-2", "s", "{}", "")
    browser.forget("figure-2")
    browser.forget("figure-2")
    assert browser.render("figure-2", "s", "{}", "") == first
