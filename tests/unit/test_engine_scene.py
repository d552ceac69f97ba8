"""Scenes: consistency, tiers and drafts, the registry, and calls of the browser's worker."""

import json
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib import import_module
from typing import Any, cast

import numpy as np
import pytest
from numpy.typing import NDArray

from simulations import browser
from simulations.engine.accuracy import Accuracy, Level, tiers
from simulations.engine.figure import figure
from simulations.engine.frame import Frame, Panel, Readout
from simulations.engine.scene import Scene
from simulations.engine.settings import action, slider
from simulations.engine.stages import Outputs, Stage, StageCache
from simulations.registry import (
    LADDER_MODULES,
    SCENE_MODULES,
    UnknownIdError,
    load_ladder,
    load_scene,
)

LEVELS = (
    *tiers("coarse", "fine", labels={"coarse": "Coarse", "fine": "Fine"}),
    Level("4", "4 columns", {"tier": "fine", "columns": 4}),
)
SHADED: dict[str, Any] = {"accuracy": Accuracy(levels=LEVELS, default="fine")}


@dataclass(frozen=True, slots=True)
class Settings:
    size: float = slider("Size", 1, 0, 2, 1)


@dataclass(frozen=True)
class Setting:
    least: int = action("Least", effect="set")


@dataclass(frozen=True)
class Driving:
    size: float = slider("Size", 1, 0, 2, 1)
    play: int = action("Play", drives="sise", effect="play")


def draw(settings: Settings, outputs: Outputs) -> Frame:
    summary = outputs.get("summary", "nothing")
    return Frame((Panel("a", "A", 400, 300),), (), f"Size {settings.size:g}, {summary}.")


def estimate(settings: Settings, _outputs: Outputs, tier: str) -> Iterator[Readout]:
    for rays in (1, 2):
        yield Readout("error", f"{tier}, {rays} rays", f"{settings.size:g}", "px")


WIDE = (Stage("summary", lambda tier, columns: f"{tier}, {columns} columns"),)
STAGES = (Stage("summary", lambda size, tier: f"{tier} of {size:g}"),)
DOUBLE = (Stage("summary", lambda size, tier, double: f"{tier}: {size:g}, twice {double:g}"),)


def scene_of(**changed: Any) -> Scene[Any]:
    return Scene("s", "S", **{"settings": Settings, "draw": draw, **changed})


@pytest.fixture
def use(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Scene[Any]]:
    """Let the worker load a scene with these parts."""

    def chosen(**parts: Any) -> Scene[Any]:
        scene = scene_of(**parts)
        monkeypatch.setattr(browser, "load_scene", lambda _id: scene)
        return scene

    return chosen


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"stages": (*STAGES, *STAGES)}, "two stages named 'summary'; legal: a name for each"),
        ({"accuracy": Accuracy(levels=LEVELS + LEVELS[:1])}, "'coarse'.*legal: a name for each"),
        (
            {"accuracy": Accuracy(levels=LEVELS, default="finer")},
            r"'finer'; legal: \('coarse', 'fine",
        ),
        ({"accuracy": Accuracy(default="fast")}, "default level 'fast'"),
        ({"accuracy": Accuracy(levels=tiers("fast"))}, "'fast' has no label, and no ladder"),
        ({"settings": Driving}, "'play' drives no slider 'sise'; legal: size"),
        ({"settings": Setting}, "'least' sets nothing; legal: a button in `sets`"),
    ],
)
def test_scene_that_contradicts_itself_is_refused(changed: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        scene_of(**changed)


@pytest.mark.parametrize(
    ("stages", "parameters", "tier", "description"),
    [
        (STAGES, None, "coarse", "Size 2, coarse of 2."),
        (STAGES, None, "", "Size 2, fine of 2."),
        (STAGES, None, "no such tier", "Size 2, fine of 2."),
        (WIDE, None, "4", "Size 2, fine, 4 columns."),
        (DOUBLE, lambda s, _tier: {"double": 3 * s.size}, "fine", "Size 2, fine: 2, twice 6."),
        (STAGES, lambda _settings, _tier: {"size": 7}, "fine", "Size 2, fine of 7."),
        (STAGES, lambda _settings, _tier: None, "fine", "Size 2, nothing."),
    ],
)
def test_stages_read_settings_tier_and_parameters(
    stages: Any, parameters: Any, tier: str, description: str
) -> None:
    """Without parameters no stage runs and none is reported."""
    given = {"parameters": parameters} if parameters else {}
    frame = scene_of(**SHADED, stages=stages, **given).render(Settings(2), tier, StageCache())
    assert frame.description == description
    assert [report.name for report in frame.stages] == (
        [] if "nothing" in description else ["summary"]
    )


def test_error_estimates_restart_with_other_settings(use: Callable[..., Scene[Any]]) -> None:
    use(accuracy=Accuracy(estimate=estimate))

    def ask(size: int) -> Any:
        answer = json.loads(browser.error("figure-3", "s", f'{{"size": {size}}}', ""))
        return answer and (answer["label"], answer["text"])

    one, two = (", 1 rays", "2"), (", 2 rays", "2")
    assert [ask(2) for _ in range(4)] == [one, two, None, None]
    assert [ask(1), ask(2)] == [(", 1 rays", "1"), one]
    use()
    assert browser.error("figure-5", "s", "{}", "") == "null"


def test_forgotten_figure_loses_only_its_cache(use: Callable[..., Scene[Any]]) -> None:
    use(**SHADED, stages=STAGES)
    request = ("figure-1", "s", '{"size": 99}', "no such tier")
    reply = browser.render(*request)
    assert json.loads(reply.meta)["description"] == "Size 2, fine of 2."
    assert reply.rasters == ()
    browser.forget("figure-1")
    browser.forget("figure-1")
    assert browser.render(*request) == reply


@pytest.mark.parametrize(
    ("load", "modules", "known"),
    [(load_scene, SCENE_MODULES, "camera"), (load_ladder, LADDER_MODULES, "shading")],
)
def test_scenes_and_ladders_load_under_their_ids(
    load: Callable[[str], Any], modules: dict[str, str], known: str
) -> None:
    assert [load(name).id for name in modules] == list(modules)
    with pytest.raises(UnknownIdError, match=f"unknown [a-z]+ '{known}x'; did you mean '{known}'"):
        load(f"{known}x")


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (None, "has no SCENE; legal: a Scene"),
        (3, "has int as SCENE"),
        (scene_of(), "has the id 's'; legal: 'camera'"),
    ],
)
def test_module_without_a_scene_of_its_name_is_refused(
    monkeypatch: pytest.MonkeyPatch, value: object, message: str
) -> None:
    monkeypatch.setattr(import_module(SCENE_MODULES["camera"]), "SCENE", value)
    with pytest.raises(UnknownIdError, match=message):
        load_scene("camera")


@pytest.mark.parametrize("codes", [np.full((2, 2), 255.0), np.full((2, 2, 3), 3)])
def test_picture_of_a_figure_with_values_beyond_white_is_refused(
    codes: NDArray[Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys.modules[__name__], "SCENE", None, raising=False)
    figure("A Picture")(lambda: codes)
    scene = cast(Any, sys.modules[__name__]).SCENE
    with pytest.raises(ValueError, match=r"legal: 0 \(black\) to 1 \(white\), or uint8"):
        scene.draw(scene.settings(), {})


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_levels_without_labels_are_rungs_of_the_ladder_in_its_order(scene_id: str) -> None:
    accuracy = load_scene(scene_id).accuracy
    if accuracy.ladder:
        rungs = [tier.id for tier in load_ladder(accuracy.ladder).tiers]
        named = [level.name for level in accuracy.levels if level.name in rungs or not level.label]
        assert [rung for rung in rungs if rung in accuracy.names] == named
