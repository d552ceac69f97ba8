"""Settings: a dataclass whose fields declare the controls of a scene; authors' values are checked,
readers' values clamped, and lists of points written as text."""

from dataclasses import dataclass

import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.engine.controls import Action, Choice, ControlError, PointLists, Slider, Toggle
from simulations.engine.settings import (
    action,
    check_settings,
    choice,
    clamp_settings,
    controls_of,
    points,
    slider,
    toggle,
    values_of,
)

KINDS = {"rigid": "Rigid", "affine": "A"}


@dataclass(frozen=True, slots=True)
class Settings:
    depth: float = slider("Depth", 5.0, 0.5, 20, 0.25, unit="m")
    column: int = slider("Column", 3, 1, 30, 1)
    kind: str = choice("Kind", KINDS, "affine")
    show: bool = toggle("Show", True)
    play: int = action("Play", "Pause", drives="depth", effect="play")
    lines: str = points("Lines", 3, 4, buttons={}, default=";0.5,0.5")


DEPTH, COLUMN, KIND, SHOW, PLAY, LINES = controls_of(Settings)


def stepped(low: float, high: float, step: float, default: float = 0.0) -> Slider:
    return Slider(name="x", label="x", default=default, minimum=low, maximum=high, step=step)


def test_each_field_declares_a_control_of_its_name() -> None:
    assert (
        Slider(
            name="depth", label="Depth", default=5.0, minimum=0.5, maximum=20, step=0.25, unit="m"
        ),
        Slider(name="column", label="Column", default=3, minimum=1, maximum=30, step=1),
        Choice(name="kind", label="Kind", default="affine", options=KINDS),
        Toggle(name="show", label="Show", default=True),
        Action(name="play", labels=("Play", "Pause"), drives="depth", effect="play"),
    ) == (DEPTH, COLUMN, KIND, SHOW, PLAY)
    first: str = choice("Kind", KINDS).default  # type: ignore[attr-defined]
    assert first == "rigid"


@pytest.mark.parametrize(
    ("number", "nearest"),
    [
        (0.3, 0.25), (0.05, 0.0), (-4, 0.0), (4, 0.75), (float("inf"), 0.75),
        (float("-inf"), 0.0), (0.25, 0.25), (0.75, 0.75),
    ],
)  # fmt: skip
def test_slider_reaches_whole_steps_from_its_minimum(number: float, nearest: float) -> None:
    uneven = stepped(0, 0.9, 0.25)
    assert uneven.nearest(number) == nearest
    assert uneven.reaches(nearest)
    assert not uneven.reaches(0.3)


@pytest.mark.parametrize(("step", "decimals"), [(1, 0), (0.5, 1), (0.25, 2), (0.01, 2), (10, 0)])
def test_decimals_follow_from_the_step(step: float, decimals: int) -> None:
    assert stepped(0, 100, step).decimals == decimals
    assert str(stepped(-1, 1, 0.5).clamp(-0.0)) == str(stepped(-1, 1, 0.5).check("-0")) == "0.0"


@pytest.mark.parametrize(
    ("low", "high", "default", "reason"),
    [
        (20, 1, 5, "x: the range 20 to 1; legal: the smaller number first"),
        (1, 20, 0, "x: default 0 outside 1 to 20"),
    ],
)
def test_slider_of_an_impossible_range_is_refused(
    low: float, high: float, default: float, reason: str
) -> None:
    with pytest.raises(ControlError, match=reason):
        stepped(low, high, 1, default)


def test_missing_values_take_defaults_and_texts_are_parsed_by_type() -> None:
    assert check_settings(Settings, {}) == Settings()
    assert values_of(Settings())["play"] == 0
    texts = {"depth": "2.5", "column": "7", "kind": "affine", "show": "false", "play": "1"}
    read = check_settings(Settings, texts)
    assert read == Settings(2.5, 7, "affine", False, 1)
    assert type(read.column) is int


@pytest.mark.parametrize(
    ("name", "raw", "reason"),
    [
        ("depth", 0.25, "0.25 is out of range; legal: 0.5 to 20"),
        ("depth", "far", "'far' is not a number"),
        ("depth", "nan", "'nan' is not finite"),
        ("depth", True, "True is not a number"),
        ("depth", 10**400, "is not a number"),
        ("column", "2.5", "steps of 1"),
        ("kind", "rigit", "did you mean 'rigid'?"),
        ("show", "perhaps", "'perhaps' is not a switch position"),
        ("play", 2, "2 is not a state; legal: 0 to 1"),
        ("play", "inf", "'inf' is not a state"),
        ("dept", 1, "unknown parameter 'dept'; legal: depth, column"),
        *(
            ("lines", wrong, "legal: 3 lists")
            for wrong in (
                ";0.5", ";a,b", ";0.1,1.2", ";nan,0.2", "b-d;0.1,0.2", "x_-1;0.1,0.2", ";;;;",
                ";0,0_0,0_0,0_0,0_0,0", 7, None,
            )
        ),
    ],
)  # fmt: skip
def test_authors_illegal_value_is_refused_with_the_legal_ones(
    name: str, raw: object, reason: str
) -> None:
    with pytest.raises(ControlError) as raised:
        check_settings(Settings, {name: raw})
    assert reason in str(raised.value)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_readers_value_is_clamped(number: float) -> None:
    depth = clamp_settings(Settings, {"depth": number}).depth
    assert 0.5 <= depth <= 20
    if 0.5 <= number <= 20:
        assert depth == number
    assert clamp_settings(Settings, {"column": 2.6}).column == 3
    for nonsense in ({"depth": float("nan")}, {"kind": "projective"}):
        with pytest.raises(ControlError):
            clamp_settings(Settings, nonsense)


def test_points_round_trip_through_text_and_are_clamped() -> None:
    text = "corner_3;0.1,0.2_0.5,1;;0,0.33333"
    found = PointLists.from_text(text)
    assert found == PointLists("corner", 3, (((0.1, 0.2), (0.5, 1.0)), (), ((0.0, 0.33333),)))
    assert found.text == text
    assert PointLists.from_text("") == PointLists()
    assert PointLists.from_text("").text == ""
    outside = PointLists("", 0, (((-0.2, 1.7), (1e-9, 0.123456)),))
    assert outside.text == ";0,1_0,0.12346"


@dataclass(frozen=True)
class Bare:
    depth: float = 5.0


@dataclass(frozen=True)
class Crossed:
    depth: str = slider("Depth", 5, 0, 20, 1)  # type: ignore[assignment]


@dataclass
class Loose:
    depth: float = slider("Depth", 0.5, 0, 1, 0.1)


@dataclass(frozen=True)
class Beyond:
    depth: float = slider("Depth", 3.0, 0, 1, 0.1)


@dataclass(frozen=True)
class Pointless:
    lines: str = points("Lines", 1, 4, buttons={}, default="0.1;0.2")


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: stepped(0, 1, 0.1, default=3), "default 3"),
        (lambda: stepped(0, 1, 0), "step"),
        (lambda: stepped(0, 3, 1, default=0.5), "no step of 1 leads"),
        (lambda: Choice(name="x", label="x", default="c", options=KINDS), "not an option"),
        (lambda: Action(name="x", labels=("X",), drives="depth"), "effect"),
        (lambda: Action(name="x", labels=("X",), effect="play"), "effect"),
        (lambda: controls_of(Bare), "setting 'depth' has no control"),
        (lambda: controls_of(Crossed), "a slider is float or int"),
        (lambda: controls_of(Loose), r"can be changed; legal: @dataclass\(frozen=True"),
        (lambda: controls_of(int), "can be changed"),
        (lambda: controls_of(Beyond), "default 3"),
        (lambda: controls_of(Pointless), "legal: 1 lists"),
    ],
)
def test_control_that_contradicts_itself_is_refused(make: object, message: str) -> None:
    with pytest.raises((ControlError, TypeError), match=message):
        make()  # type: ignore[operator]
