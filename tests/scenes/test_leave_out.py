"""Effects that may be left out: listed costs match the picture, the button follows the list, and
times come from the clock alone."""

from itertools import count

import pytest
from support.frames import frame_of

from simulations.engine.stages import StageCache
from simulations.scenes.leave_out import PHOTOS, ROUNDS, SCENE
from simulations.world.omissions import EFFECTS

PICTURES = [
    pytest.param(name, marks=[] if name in ("night", "map") else pytest.mark.deep)
    for name in PHOTOS
]
"""`make test` runs the two photographs that differ most from the first."""


def readouts(**given: object) -> dict[str, float]:
    return {each.name: float(each.text) for each in frame_of(SCENE, "", **given).readouts}


@pytest.mark.parametrize("photo", PICTURES)
def test_listed_cost_of_an_effect_is_the_pictures_error_without_it(photo: str) -> None:
    listed = readouts(photo=photo)
    assert listed["rms"] == 0.0
    for name in EFFECTS:
        assert readouts(photo=photo, **{name: False})["rms"] == listed[f"cost_{name}"], name


@pytest.mark.parametrize("photo", PICTURES)
def test_button_leaves_out_effects_costing_less_than_half_a_code(photo: str) -> None:
    listed = readouts(photo=photo)
    for start in ({}, dict.fromkeys(EFFECTS, False)):
        pressed = SCENE.pull(SCENE.check({"photo": photo, **start}), "small", (0.0, 0.0))
        assert pressed == {name: listed[f"cost_{name}"] >= 0.5 for name in EFFECTS}


def test_leaving_out_an_effect_saves_the_time_of_its_stage() -> None:
    """By a clock that ticks once for each look: only stages that are left out whole take less."""
    given = SCENE.check({"blur": False, "area": False})
    ticks = count()
    listed = list(SCENE.estimates(given, "", StageCache(), clock=lambda: float(next(ticks))))
    assert len(listed) == ROUNDS * (len(EFFECTS) + 1)
    last = {each.name: each.text for each in listed}
    assert last == dict.fromkeys(EFFECTS, "none") | {
        "blur": "1000.0",
        "falloff": "1000.0",
        "saved": "1000.0",
    }
