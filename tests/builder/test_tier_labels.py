"""What the menu of accuracies says."""

from simulations.engine.frame import Frame
from simulations.engine.scene import Scene
from simulations.registry import load_ladder
from site_builder.figure_view import tier_labels


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
