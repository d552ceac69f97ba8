"""Settings: a dataclass whose fields state the controls of a scene, once."""

from dataclasses import dataclass

import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.engine.controls import Action, Choice, ControlError, Slider, Toggle
from simulations.engine.settings import (
    action,
    check_settings,
    choice,
    clamp_settings,
    controls_of,
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


def test_each_field_states_a_control_of_its_name() -> None:
    assert controls_of(Settings) == (
        Slider(
            name="depth", label="Depth", default=5.0, minimum=0.5, maximum=20, step=0.25, unit="m"
        ),
        Slider(name="column", label="Column", default=3, minimum=1, maximum=30, step=1),
        Choice(name="kind", label="Kind", default="affine", options=KINDS),
        Toggle(name="show", label="Show", default=True),
        Action(name="play", labels=("Play", "Pause"), drives="depth", effect="play"),
    )


def test_what_is_not_given_takes_its_default() -> None:
    assert check_settings(Settings, {}) == Settings()
    assert values_of(Settings()) == {
        "depth": 5.0, "column": 3, "kind": "affine", "show": True, "play": 0,
    }  # fmt: skip


def test_the_first_option_is_the_default_where_none_is_named() -> None:
    @dataclass(frozen=True, slots=True)
    class Plain:
        kind: str = choice("Kind", KINDS)

    assert Plain().kind == "rigid"


def test_a_fraction_of_a_whole_setting_is_refused_of_an_author_and_rounded_of_a_reader() -> None:
    with pytest.raises(ControlError, match=r"column.*2\.5.*steps of 1"):
        check_settings(Settings, {"column": "2.5"})
    assert clamp_settings(Settings, {"column": 2.6}).column == 3


def test_texts_of_a_page_are_read_as_values_of_the_fields_types() -> None:
    texts = {"depth": "2.5", "column": "7", "kind": "affine", "show": "false", "play": "1"}
    read = check_settings(Settings, texts)
    assert read == Settings(2.5, 7, "affine", False, 1)
    assert type(read.column) is int


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
        ("dept", 1, "unknown parameter 'dept'; legal: depth, column, kind, show, play; did you"),
    ],
)
def test_an_author_is_told_what_was_given_and_what_is_legal(
    name: str, raw: object, reason: str
) -> None:
    with pytest.raises(ControlError) as raised:
        check_settings(Settings, {name: raw})
    assert reason in str(raised.value)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_reader_s_gesture_is_brought_into_range(number: float) -> None:
    depth = clamp_settings(Settings, {"depth": number}).depth
    assert 0.5 <= depth <= 20
    if 0.5 <= number <= 20:
        assert depth == number


def test_a_reader_s_nonsense_is_refused_even_when_clamping() -> None:
    with pytest.raises(ControlError):
        clamp_settings(Settings, {"depth": float("nan")})
    with pytest.raises(ControlError):
        clamp_settings(Settings, {"kind": "projective"})


def test_a_field_without_a_control_or_of_another_type_is_refused() -> None:
    @dataclass(frozen=True)
    class Bare:
        depth: float = 5.0

    @dataclass(frozen=True)
    class Crossed:
        depth: str = slider("Depth", 5, 0, 20, 1)  # type: ignore[assignment]

    with pytest.raises(TypeError, match="setting 'depth' has no control"):
        controls_of(Bare)
    with pytest.raises(TypeError, match="setting 'depth': a slider is float or int, not"):
        controls_of(Crossed)


def test_settings_that_can_be_changed_are_refused() -> None:
    @dataclass
    class Loose:
        depth: float = slider("Depth", 0.5, 0, 1, 0.1)

    for settings in (Loose, int):
        with pytest.raises(TypeError, match=r"can be changed; legal: @dataclass\(frozen=True"):
            controls_of(settings)


def test_a_field_whose_control_contradicts_itself_is_refused() -> None:
    @dataclass(frozen=True)
    class Wrong:
        depth: float = slider("Depth", 3.0, 0, 1, 0.1)

    with pytest.raises(ControlError, match="default 3"):
        controls_of(Wrong)
