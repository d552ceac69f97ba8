"""The balloon is drawn once, by parts or whole, and cannot be spoilt by who looks at it."""

import numpy as np
import pytest

from simulations.pictures.balloon import HEIGHT, WIDTH, Window, balloon


def test_it_is_drawn_once_for_all_figures_and_cannot_be_written_to() -> None:
    assert balloon() is balloon()
    with pytest.raises(ValueError, match="read-only"):
        balloon()[0, 0, 0] = 1


@pytest.mark.parametrize(
    "window",
    [
        Window(0, 0, 1, 1),
        Window(HEIGHT - 1, WIDTH - 1, 1, 1),
        Window(13, 100, 3, 100),
        Window(100, 0, 60, WIDTH),
        Window(56, 130, 16, 20),
    ],
)
def test_a_part_is_what_the_whole_has_there(window: Window) -> None:
    rows = slice(window.top, window.top + window.height)
    part = balloon()[rows, window.left : window.left + window.width]
    np.testing.assert_allclose(balloon(window), part, rtol=1e-6)


@pytest.mark.parametrize(
    "window", [Window(-1, 0, 2, 2), Window(0, 0, 0, 2), Window(0, 239, 2, 2), Window(191, 0, 2, 2)]
)
def test_a_part_that_reaches_out_is_refused(window: Window) -> None:
    with pytest.raises(ValueError, match="legal: not empty, within 192 x 240"):
        balloon(window)


def test_it_is_light_that_a_display_can_show() -> None:
    assert balloon().shape == (HEIGHT, WIDTH, 3)
    assert balloon().min() >= 0
    assert balloon().max() <= 1
