"""What ``bench.scene_profile`` moves, measures, keeps and compares."""

from pathlib import Path

import pytest
from bench.scene_profile import COLD, Cost, comparison, one_step, profile, read, write

from simulations.engine.controls import Action, Choice, Control, Slider, Toggle
from simulations.registry import load_scene


@pytest.mark.parametrize(
    ("control", "moved"),
    [
        (Slider(name="a", label="", default=1, minimum=0, maximum=2, step=0.5), 1.5),
        (Slider(name="a", label="", default=2, minimum=0, maximum=2, step=0.5), 1.5),
        (Choice(name="b", label="", default="x", options={"x": "X", "y": "Y"}), "y"),
        (Choice(name="b", label="", default="y", options={"x": "X", "y": "Y"}), "x"),
        (Toggle(name="c", label="", default=True), False),
        (Action(name="d", labels=("again", "again")), 1),
    ],
)
def test_one_step_is_the_next_legal_value(control: Control, moved: object) -> None:
    assert one_step(control) == moved == control.check(moved)


def test_every_control_of_a_scene_has_its_row_in_each_of_its_two_tiers() -> None:
    scene = load_scene("lens-distortion")
    costs = list(profile(scene))
    tiers = dict.fromkeys((scene.default_tier, scene.draft_tier))
    names = [COLD, *(control.name for control in scene.controls)]
    assert [cost.key for cost in costs] == [
        (scene.id, tier, name) for tier in tiers for name in names
    ]
    assert costs[0].computed
    assert all(cost.ms >= 0 for cost in costs)


def test_what_is_kept_is_read_again(tmp_path: Path) -> None:
    costs = [
        Cost("camera", "layers", COLD, 41.5, ("light", "grain")),
        Cost("ball", "", "k", 0.0, ()),
    ]
    write(costs, tmp_path / "kept.json")
    assert read(tmp_path / "kept.json") == costs


def test_rows_stand_side_by_side_and_none_is_lost() -> None:
    before = [Cost("s", "t", "a", 4.0, ("x", "y")), Cost("s", "t", "gone", 1.0, ())]
    now = [Cost("s", "t", "a", 1.0, ("x",)), Cost("s", "t", "new", 2.0, ())]
    _, same, new, gone = comparison(now, before)
    assert same.split() == ["s", "t", "a", "4.00", "1.00", "0.25", "2", "→", "1"]
    assert new.split()[2:6] == ["new", "–", "2.00", "new"]
    assert gone.split()[2:] == ["gone", "1.00", "–", "gone"]
