"""2D transformations: how each moves points, and where the division by w fails."""

import math

import numpy as np
import pytest
from numpy.typing import ArrayLike

from simulations.models.geometry import transforms
from simulations.models.geometry.transforms import apply_homography

TILTED = transforms.projective([1, 0, 0, 0, 1, 0, 1, 0, 1])
"""w = 1 + x: the line x = −1 goes to infinity."""


def test_each_rung_moves_a_point_as_its_equation_says() -> None:
    quarter = math.pi / 2
    for H, expected in (
        (transforms.translation(3, -1), (5, 0)),
        (transforms.rigid(quarter, 3, -1), (2, 1)),
        (transforms.similarity(2, quarter, 3, -1), (1, 3)),
        (transforms.affine([[2, 1], [0, 3]], (3, -1)), (8, 2)),
        (TILTED, (2 / 3, 1 / 3)),
    ):
        image, valid = apply_homography(H, (2.0, 1.0))
        assert valid
        assert image == pytest.approx(expected)


def test_nothing_on_the_line_sent_to_infinity_has_an_image() -> None:
    images, valid = apply_homography(TILTED, [(-1 + 1e-9, 0), (-1, 0), (-1 - 1e-16, 0), (-2, 3)])
    assert valid.tolist() == [True, False, False, True]
    assert np.isnan(images[1:3]).all()
    assert images[3] == pytest.approx((2, -3))


def test_the_sign_of_w_tells_the_two_sides_of_that_line() -> None:
    points = [(0, 0), (-2, 0), (-1, 5), (-1 + 1e-13, 0), (math.inf, 0), (math.nan, 0)]
    assert transforms.sign_of_w(TILTED, points).tolist() == [1, -1, 0, 0, 0, 0]
    assert transforms.sign_of_w(-1e200 * TILTED, points).tolist() == [-1, 1, 0, 0, 0, 0]


def test_the_smallest_w_that_counts_is_relative_to_its_terms() -> None:
    """At x = −1 + ε the terms are of size 1, and w = ε."""
    for far in (1.0, 1e6):
        H = np.array([[1.0, 0, 0], [0, 1, 0], [1 / far, 0, 1]])
        _, valid = apply_homography(H, [(-far * (1 - 3e-12), 0), (-far * (1 - 1e-12), 0)])
        assert valid.tolist() == [True, False]


PLAIN = np.array([[1.0, 2, 3], [0, 1, 4], [1, 0, 2]])
TO_INFINITY = np.array([[1.0, 0, 0], [0, 0, 1], [0, -2, 0]])
"""Sends the origin there."""


@pytest.mark.parametrize(
    ("matrix", "scaled"),
    [
        (2.0 * TILTED, TILTED),
        (-TILTED, TILTED),
        (1e-200 * PLAIN, PLAIN / 2),
        (-1e200 * PLAIN, PLAIN / 2),
        (PLAIN.ravel(), PLAIN / 2),  # nine entries do as well as three rows
        (TO_INFINITY, -TO_INFINITY / math.sqrt(6)),
        ([[1.0, 0, 0], [0, 1, 0], [1, 0, 1e-11]], [[1e11, 0, 0], [0, 1e11, 0], [1e11, 0, 1]]),
        (
            [[1.0, 0, 0], [0, 1, 0], [-1, 0, 1e-13]],
            np.array([[-1, 0, 0], [0, -1, 0], [1, 0, 0]]) / 3**0.5,
        ),
        (np.diag([1, 1, 0]), np.diag([1, 1, 0]) / math.sqrt(2)),
    ],
)
def test_a_homography_is_scaled_to_its_last_entry_or_else_to_unit_norm(
    matrix: ArrayLike, scaled: ArrayLike
) -> None:
    np.testing.assert_allclose(transforms.projective(matrix), np.array(scaled), atol=1e-12)
