"""Controls: one statement of each parameter's range, held to by authors and readers alike."""

import json

import pytest

from simulations.engine.controls import (
    Action,
    Choice,
    Control,
    ControlError,
    Slider,
    Toggle,
    describe,
)

DEPTH = Slider(
    name="depth", label="Depth", default=5.0, minimum=0.5, maximum=20.0, step=0.25, unit="m"
)
KIND = Choice(name="kind", label="Kind", default="rigid", options={"rigid": "Rigid", "affine": "A"})
SHOW = Toggle(name="show", label="Show", default=True)
PLAY = Action(name="play", labels=("Play", "Pause"), drives="depth", effect="play")
CONTROLS: tuple[Control, ...] = (DEPTH, KIND, SHOW, PLAY)


@pytest.mark.parametrize(
    ("number", "reached"), [(0.5, True), (0.75, True), (20.0, True), (0.6, False), (0.5001, False)]
)
def test_a_slider_reaches_whole_steps_from_its_minimum(number: float, reached: bool) -> None:
    assert DEPTH.reaches(number) is reached


@pytest.mark.parametrize(("step", "decimals"), [(1, 0), (0.5, 1), (0.25, 2), (0.01, 2), (10, 0)])
def test_decimals_are_those_that_the_step_can_change(step: float, decimals: int) -> None:
    slider = Slider(name="x", label="x", default=0, minimum=0, maximum=100, step=step)
    assert slider.decimals == decimals


def test_a_control_that_contradicts_itself_cannot_be_made() -> None:
    with pytest.raises(ControlError, match="default 3"):
        Slider(name="x", label="x", default=3, minimum=0, maximum=1, step=0.1)
    with pytest.raises(ControlError, match="step"):
        Slider(name="x", label="x", default=0, minimum=0, maximum=1, step=0)
    with pytest.raises(ControlError, match="no step of 1 leads"):
        Slider(name="x", label="x", default=0.5, minimum=0, maximum=3, step=1)
    with pytest.raises(ControlError, match="not an option"):
        Choice(name="x", label="x", default="c", options={"a": "A"})
    with pytest.raises(ControlError, match="effect"):
        Action(name="x", labels=("X",), drives="depth")
    with pytest.raises(ControlError, match="effect"):
        Action(name="x", labels=("X",), effect="play")


@pytest.mark.parametrize("control", CONTROLS, ids=lambda control: control.kind)
def test_a_description_is_plain_data_with_the_contract_s_keys(control: Control) -> None:
    entry = describe(control)
    assert json.loads(json.dumps(entry)) == entry
    assert {"name", "kind", "label", "default"} <= entry.keys()
    if control is DEPTH:
        assert (entry["min"], entry["max"], entry["step"]) == (0.5, 20.0, 0.25)
    if control is KIND:
        assert entry["options"] == ["rigid", "affine"]


def test_minus_zero_is_zero() -> None:
    tilt = Slider(name="tilt", label="Tilt", default=0, minimum=-1, maximum=1, step=0.5)
    assert str(tilt.clamp(-0.0)) == str(tilt.check("-0")) == "0.0"
