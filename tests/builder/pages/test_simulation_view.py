"""A figure as its template gets it: the menu of accuracies, the columns of its numbers."""

import pytest

from simulations.engine.controls import Values
from simulations.engine.frame import Frame, StageReport
from simulations.engine.scene import Scene
from simulations.registry import load_ladder
from site_builder.book import Simulation
from site_builder.pages.simulation_view import tier_labels, view_simulation
from site_builder.pages.stills import Still


def tiered(**fields: object) -> Scene:
    return Scene(
        "s",
        "S",
        (),
        lambda *_: Frame((), (), "Nothing."),
        tiers=("gouraud-8", "phong"),
        default_tier="phong",
        draft_tier="gouraud-8",
        **fields,  # type: ignore[arg-type]
    )


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


@pytest.mark.parametrize(
    ("path", "stages", "open_"),
    [("content/08.md", 9, False), ("content/08.md", 10, True), ("content/book.toml", 10, False)],
)
def test_a_long_chain_of_stages_is_shown_at_once_but_not_on_the_cover(
    path: str, stages: int, open_: bool
) -> None:
    scene = Scene("s", "S", (), lambda *_: Frame((), (), "Nothing."))
    frame = Frame(
        (), (), "Nothing.", tuple(StageReport("a", "computed", "") for _ in range(stages))
    )
    figure = Simulation(scene, "figure-s", {}, "", "", path, 1)
    assert view_simulation(Still(figure, Values({}), frame, {}), "").stages_open is open_
