"""Where a figure's main control is shown before Python has started."""

from simulations.engine.controls import Choice, Slider, Toggle
from site_builder.figures.prerendered_frames import FRAMES, shown_values


def test_a_slider_is_shown_from_end_to_end_and_where_it_starts() -> None:
    slider = Slider(name="s", label="S", default=0.3, minimum=-1, maximum=1, step=0.1)
    values = shown_values(slider, 0.3)
    assert values[0] == -1
    assert values[-1] == 1
    assert 0.3 in values
    assert len(values) == FRAMES + 1
    assert all(slider.reaches(float(value)) for value in values)


def test_a_coarse_slider_is_shown_at_each_of_its_steps_once() -> None:
    slider = Slider(name="s", label="S", default=1, minimum=0, maximum=3, step=1)
    assert shown_values(slider, 1) == (0, 1, 2, 3)


def test_a_menu_is_shown_at_all_its_options() -> None:
    menu = Choice(name="m", label="M", default="b", options={"a": "A", "b": "B"})
    assert shown_values(menu, "b") == ("a", "b")


def test_a_check_box_alone_has_no_strip() -> None:
    assert shown_values(Toggle(name="t", label="T", default=True), True) == (True,)
