"""A figure as its template gets it: the menu of accuracies, the columns of its numbers."""

from dataclasses import dataclass
from typing import Any

import pytest
from support.toy_ladder import toy_ladder

from simulations.engine.frame import Frame
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from site_builder.pages.views.simulation import tier_labels


@dataclass(frozen=True, slots=True)
class Settings:
    """None."""


def draw(_settings: Settings, _outputs: Outputs) -> Frame:
    return Frame((), (), "Nothing.")


def tiered(**fields: Any) -> Scene[Settings]:
    tiers = ("rough", "fine")
    return Scene("s", "S", Settings, draw, tiers=tiers, default_tier="fine", **fields)


@pytest.fixture(autouse=True)
def _of_the_book(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("site_builder.pages.views.simulation.load_ladder", toy_ladder)


def test_tiers_are_named_as_in_their_ladder() -> None:
    assert tier_labels(tiered(ladder="toy")) == (("rough", "Rough"), ("fine", "Fine"))


def test_a_scenes_own_words_go_before_the_ladders() -> None:
    scene = tiered(ladder="toy", tier_labels={"fine": "In every pixel"})
    assert tier_labels(scene) == (("rough", "Rough"), ("fine", "In every pixel"))


def test_a_scene_without_a_ladder_names_all_of_its_tiers() -> None:
    scene = tiered(tier_labels={"fine": "Smooth", "rough": "Coarse"})
    assert tier_labels(scene) == (("rough", "Coarse"), ("fine", "Smooth"))
