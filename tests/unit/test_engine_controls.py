"""Controls: one statement of each parameter's range, held to by authors and readers alike."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.engine.controls import (
    Action,
    Choice,
    Control,
    ControlError,
    Slider,
    Toggle,
    check_values,
    clamp_values,
    describe,
)

DEPTH = Slider(
    name="depth", label="Depth", default=5.0, minimum=0.5, maximum=20.0, step=0.25, unit="m"
)
KIND = Choice(name="kind", label="Kind", default="rigid", options={"rigid": "Rigid", "affine": "A"})
SHOW = Toggle(name="show", label="Show", default=True)
PLAY = Action(name="play", labels=("Play", "Pause"), drives="depth", effect="play")
CONTROLS: tuple[Control, ...] = (DEPTH, KIND, SHOW, PLAY)


def test_what_is_not_given_takes_its_default() -> None:
    assert dict(check_values(CONTROLS, {})) == {
        "depth": 5.0, "kind": "rigid", "show": True, "play": 0,
    }  # fmt: skip


def test_texts_of_a_page_are_read_as_values() -> None:
    given_texts = {"depth": "2.5", "kind": "affine", "show": "false", "play": "1"}
    values = check_values(CONTROLS, given_texts)
    assert values.number("depth") == 2.5
    assert values.choice("kind") == "affine"
    assert values.toggle("show") is False
    assert values.state("play") == 1


@pytest.mark.parametrize(
    ("name", "raw", "reason"),
    [
        ("depth", 0.25, "0.25 is out of range; legal: 0.5 to 20"),
        ("depth", "far", "'far' is not a number; legal: 0.5 to 20"),
        ("depth", "nan", "'nan' is not finite; legal: 0.5 to 20"),
        ("depth", True, "True is not a number"),
        ("depth", 10**400, "is not a number; legal: 0.5 to 20"),
        ("kind", "rigit", "legal: rigid, affine; did you mean 'rigid'?"),
        ("show", "perhaps", "'perhaps' is not a switch position; legal: true, false"),
        ("play", 2, "2 is not a state; legal: 0 to 1"),
        ("play", "inf", "'inf' is not a state"),
        ("dept", 1, "unknown parameter 'dept'; legal: depth, kind, show, play; did you mean"),
    ],
)
def test_an_author_is_told_what_was_given_and_what_is_legal(
    name: str, raw: object, reason: str
) -> None:
    with pytest.raises(ControlError) as raised:
        check_values(CONTROLS, {name: raw})
    assert reason in str(raised.value)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_reader_s_gesture_is_brought_into_range(number: float) -> None:
    depth = clamp_values(CONTROLS, {"depth": number}).number("depth")
    assert DEPTH.minimum <= depth <= DEPTH.maximum
    if DEPTH.minimum <= number <= DEPTH.maximum:
        assert depth == number


def test_a_reader_s_nonsense_is_refused_even_when_clamping() -> None:
    with pytest.raises(ControlError):
        clamp_values(CONTROLS, {"depth": float("nan")})
    with pytest.raises(ControlError):
        clamp_values(CONTROLS, {"kind": "projective"})


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
