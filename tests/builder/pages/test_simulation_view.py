"""A figure as its template gets it: the menu of accuracies, the columns of its numbers."""

from dataclasses import dataclass
from typing import Any

from simulations.engine.frame import Frame
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.registry import load_ladder
from site_builder.pages.views.simulation import tier_labels


@dataclass(frozen=True, slots=True)
class Settings:
    """None."""


def draw(_settings: Settings, _outputs: Outputs) -> Frame:
    return Frame((), (), "Nothing.")


def tiered(**fields: Any) -> Scene[Settings]:
    tiers = ("gouraud-8", "phong")
    return Scene("s", "S", Settings, draw, tiers=tiers, default_tier="phong", **fields)


def test_tiers_are_named_as_in_their_ladder() -> None:
    words = dict(tier_labels(tiered(ladder="shading")))
    assert words == {name: load_ladder("shading").tier(name).label for name in words}


def test_a_scenes_own_words_go_before_the_ladders() -> None:
    scene = tiered(ladder="shading", tier_labels={"phong": "In every pixel"})
    assert tier_labels(scene) == (
        ("gouraud-8", load_ladder("shading").tier("gouraud-8").label),
        ("phong", "In every pixel"),
    )


def test_a_scene_without_a_ladder_names_all_of_its_tiers() -> None:
    scene = tiered(tier_labels={"phong": "Fine", "gouraud-8": "Coarse"})
    assert tier_labels(scene) == (("gouraud-8", "Coarse"), ("phong", "Fine"))
