"""The chequered room and the resolution chart: geometry one can check."""

from collections.abc import Callable

import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.pictures.checker_room import HIGH, LOW, TRIM_M, checker_room
from simulations.pictures.resolution_chart import INK, PAPER, resolution_chart


def test_the_back_wall_ends_where_projection_puts_its_corners() -> None:
    room = checker_room(561, 421, 200.0)
    # 1.2 m below the eye the wall is teal, with little red, between its pale mouldings.
    row = room[210 + round(200.0 * 1.2 / HIGH[2]), :, 0]
    pale = np.flatnonzero(row > 0.2)
    left, right = pale[pale < 280].max() + 1, pale[pale > 280].min()
    for column, wall_x in ((left, LOW[0] + TRIM_M), (right, HIGH[0] - TRIM_M)):
        assert column == pytest.approx(280 + 200.0 * wall_x / HIGH[2], abs=1.0)


@pytest.mark.parametrize("draw", [checker_room, resolution_chart])
def test_pictures_are_finite_linear_light_for_any_size(
    draw: Callable[[int, int, float], Floats],
) -> None:
    for width, height in ((64, 48), (1, 1), (7, 3)) if draw is checker_room else ((64, 48),):
        picture = draw(width, height, 40.0)
        assert picture.shape == (height, width, 3)
        assert picture.dtype == np.float32
        assert np.isfinite(picture).all()
        assert picture.min() >= 0.0
        assert picture.max() <= 1.5


@pytest.mark.parametrize("draw", [checker_room, resolution_chart])
def test_a_meaningless_focal_length_is_refused(draw: Callable[[int, int, float], Floats]) -> None:
    with pytest.raises(ValueError, match="focal_px"):
        draw(8, 8, 0.0)


def test_the_edge_of_the_chart_is_slanted_by_five_degrees() -> None:
    chart = resolution_chart(561, 421, 200.0)[..., 0]
    # Dark square |x + y tan 5°| < 0.12: its right edge moves left by tan 5° px for each row.
    rows = np.r_[190:200, 221:231]  # clear of the cross at the centre
    darkness = (PAPER[0] - chart[rows, 280:316]) / (PAPER[0] - INK[0])
    edge_px = darkness.sum(axis=1) - 0.5
    slope, middle = np.polyfit(rows - 210, edge_px, 1)
    assert slope == pytest.approx(-np.tan(np.radians(5.0)), abs=1e-3)
    assert middle == pytest.approx(0.12 * 200.0, abs=0.05)
