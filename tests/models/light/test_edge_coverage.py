"""Coverage of a pixel from the distance of an edge, against exact areas."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import clip_half_plane
from simulations.models.light.edge_coverage import (
    chord_length,
    curved_edge_coverage,
    ramp_coverage,
    straight_edge_coverage,
)

ANGLES = st.floats(0, 2 * np.pi)
PIXEL = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])


def normal_at(angle: float) -> Floats:
    return np.array([np.cos(angle), np.sin(angle)])


def area(polygon: Floats) -> float:
    x, y = polygon.T
    return abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2 if len(x) else 0.0


@given(ANGLES, st.floats(-1, 1))
def test_a_straight_edge_covers_the_area_of_the_clipped_pixel(
    angle: float, distance: float
) -> None:
    n = normal_at(angle)
    inside = clip_half_plane(PIXEL, [n[0], n[1], distance])
    assert straight_edge_coverage(distance, n) == pytest.approx(area(inside), abs=1e-12)


@given(ANGLES, st.floats(-0.7, 0.7))
def test_the_chord_is_the_slope_of_the_coverage(angle: float, distance: float) -> None:
    n, step = normal_at(angle), 1e-6
    rise = straight_edge_coverage(distance + step, n) - straight_edge_coverage(distance - step, n)
    corners = (abs(n[0]) + abs(n[1])) / 2, abs(abs(n[0]) - abs(n[1])) / 2
    if min(abs(abs(distance) - corner) for corner in corners) > 1e-4:
        assert chord_length(distance, n) == pytest.approx(rise / (2 * step), abs=1e-4)


def test_chords_through_the_centre_are_one_along_the_grid_and_root_two_across() -> None:
    diagonal = np.array([1.0, -1.0]) / np.sqrt(2)
    assert chord_length(0.0, [0.0, 1.0]) == pytest.approx(1)
    assert chord_length(0.0, [-1.0, 0.0]) == pytest.approx(1)
    assert chord_length(0.0, diagonal) == pytest.approx(np.sqrt(2))
    assert chord_length([-0.6, 0.6, 3.0], [1.0, 0.0]).tolist() == [0, 0, 0]
    assert chord_length(0.2, [np.inf, 0.0]) == 1.0


@pytest.mark.parametrize("distance", [-0.6, -0.5, -0.2, 0.0, 0.3, 0.5, 2.0])
def test_on_an_edge_along_the_grid_the_ramp_is_exact(distance: float) -> None:
    expected = min(max(0.5 + distance, 0.0), 1.0)
    assert ramp_coverage(distance) == pytest.approx(expected, abs=1e-15)
    for normal in ([1.0, 0.0], [0.0, -1.0], [3.0, 0.0], [np.inf, 0.0]):
        assert straight_edge_coverage(distance, normal) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(
    ("angle", "offset"),
    [(np.pi / 2, 0.3), (np.pi / 2, 0.0), (1.2, 0.0), (2.2, 0.0), (np.pi / 4, -0.2)],
)
def test_a_disc_covers_the_area_that_its_columns_add_up_to(angle: float, offset: float) -> None:
    """Where the foot of the normal halves the chord, what is left out goes with κ³."""
    radius, n = 200.0, normal_at(angle)
    x_centre, y_centre = -n * (radius - offset)
    x = (np.arange(20_000) + 0.5) / 20_000 - 0.5
    top = y_centre + np.sqrt(radius**2 - (x - x_centre) ** 2)
    exact = np.mean(np.clip(top, -0.5, 0.5) + 0.5)
    bulge = float(chord_length(offset, n)) ** 3 / 24 / radius
    curved = curved_edge_coverage(offset, n, 1 / radius)
    assert curved == pytest.approx(exact, abs=0.02 * bulge)
    assert curved == curved_edge_coverage(offset, n[::-1], 1 / radius)


def test_a_hollow_edge_covers_more_and_never_more_than_all() -> None:
    straight = straight_edge_coverage(0.1, [1.0, 0.0])
    assert curved_edge_coverage(0.1, [1.0, 0.0], -0.24) == pytest.approx(straight + 0.01)
    assert curved_edge_coverage([0.49, -0.49], [1.0, 0.0], [-5.0, 5.0]).tolist() == [1, 0]
    assert curved_edge_coverage(0.1, [0.6, 0.8], [-1e308, 1e308]).tolist() == [1, 0]


def test_an_edge_far_away_covers_all_or_nothing_even_at_infinity() -> None:
    far = [np.inf, 1e300, 3.0, -3.0, -np.inf]
    for coverage in (
        ramp_coverage(far),
        straight_edge_coverage(far, [0.6, 0.8]),
        curved_edge_coverage(far, [0.6, 0.8], 0.1),
    ):
        assert coverage.tolist() == [1, 1, 1, 0, 0]
