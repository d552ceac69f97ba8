"""Which values of a control stand side by side on paper, and are drawn before Python starts."""

from simulations.engine.controls import Choice, Slider, Toggle
from site_builder.editions.multiples import shown_values
from site_builder.figures import prerendered_frames

SLIDER = Slider(name="k1", label="k₁", default=0, minimum=-0.5, maximum=0.5, step=0.01)
MENU = Choice(name="m", label="M", default="a", options={name: name for name in "abcdef"})


def test_a_slider_is_shown_to_both_sides_of_where_it_stands() -> None:
    low, now, high = shown_values(SLIDER, 0.1)
    assert (low, now, high) == (-0.2, 0.1, 0.3)


def test_a_slider_at_its_end_is_shown_on_its_way_to_the_other() -> None:
    values = shown_values(SLIDER, -0.5)
    assert values[0] == -0.5
    assert len(values) == 3
    assert values == sorted(values)


def test_every_value_shown_is_one_that_the_control_can_take() -> None:
    for now in (-0.5, -0.33, 0.0, 0.47, 0.5):
        assert all(SLIDER.reaches(float(value)) for value in shown_values(SLIDER, now))


def test_of_a_long_menu_those_around_the_chosen_are_shown() -> None:
    for now in MENU.options:
        values = shown_values(MENU, now)
        assert now in values
        assert len(values) == 4


def test_a_slider_is_prerendered_from_end_to_end_and_where_it_starts() -> None:
    values = prerendered_frames.shown_values(SLIDER, 0.33)
    assert (values[0], values[-1], len(values)) == (-0.5, 0.5, prerendered_frames.FRAMES + 1)
    assert 0.33 in values
    assert all(SLIDER.reaches(float(value)) for value in values)


def test_what_has_few_values_is_prerendered_at_each_once() -> None:
    coarse = Slider(name="s", label="S", default=1, minimum=0, maximum=3, step=1)
    assert prerendered_frames.shown_values(coarse, 1) == (0, 1, 2, 3)
    assert prerendered_frames.shown_values(MENU, "b") == tuple("abcdef")
    box = Toggle(name="t", label="T", default=True)
    assert prerendered_frames.shown_values(box, True) == (True,)
