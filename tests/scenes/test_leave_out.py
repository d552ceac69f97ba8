"""What may be left out: the list of costs says what the picture shows, the button what the list
says, and times come from the clock alone."""

from itertools import count

import pytest
from support.frames import frame_of

from simulations.engine.stages import StageCache
from simulations.scenes.leave_out import EFFECTS, PHOTOS, ROUNDS, SCENE

PICTURES = [
    pytest.param(name, marks=[] if name in ("night", "map") else pytest.mark.deep)
    for name in PHOTOS
]
"""`make test` has those that depart the most from the first."""


def readouts(**given: object) -> dict[str, float]:
    return {each.name: float(each.text) for each in frame_of(SCENE, "", **given).readouts}


@pytest.mark.parametrize("photo", PICTURES)
def test_the_picture_without_one_effect_is_off_by_what_the_list_says(photo: str) -> None:
    told = readouts(photo=photo)
    assert told["rms"] == 0.0
    for name in EFFECTS:
        assert readouts(photo=photo, **{name: False})["rms"] == told[f"cost_{name}"], name


@pytest.mark.parametrize("photo", PICTURES)
def test_the_button_leaves_out_what_costs_less_than_half_a_code(photo: str) -> None:
    told = readouts(photo=photo)
    for start in ({}, dict.fromkeys(EFFECTS, False)):
        pressed = SCENE.pull(SCENE.check({"photo": photo, **start}), "small", (0.0, 0.0))
        assert pressed == {name: told[f"cost_{name}"] >= 0.5 for name in EFFECTS}


def test_an_effect_saves_the_time_of_its_stage() -> None:
    """By a clock that ticks once for each look: only stages that are left out whole take less."""
    given = SCENE.check({"blur": False, "area": False})
    ticks = count()
    told = list(SCENE.estimates(given, "", StageCache(), clock=lambda: float(next(ticks))))
    assert len(told) == ROUNDS * (len(EFFECTS) + 1)
    last = {each.name: each.text for each in told}
    assert last == dict.fromkeys(EFFECTS, "0.0") | {
        "blur": "1000.0",
        "falloff": "1000.0",
        "saved": "1000.0",
    }
