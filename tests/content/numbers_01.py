"""Chapter 1: transformations of the plane."""

import numpy as np
from support.worked_numbers import Says

from simulations.models.geometry.transforms import (
    affine,
    apply_homography,
    sign_of_w,
    translation,
)

CHAPTER = "01-2d-transformations"


def the_area_under_an_affine_map() -> Says:
    """Of a triangle anywhere, also under a map that mirrors."""
    (a, b), (c, d) = A = np.array([[0.6, 1.1], [0.9, -0.4]])
    (p, q, r), _ = apply_homography(affine(A, (3, -2)), [[1, 2], [5, 3], [2, 7]])
    before, after = (
        abs(np.linalg.det([one, two])) for one, two in (([4, 1], [1, 5]), (q - p, r - p))
    )
    assert np.isclose(after / before, abs(a * d - b * c))
    yield r"\det A = a_{11}a_{22} - a_{12}a_{21}"


def the_sign_of_a_determinant() -> Says:
    """Corners that run counter-clockwise do so after a map, unless its determinant is negative."""
    for A in ([[0.6, 1.1], [0.9, -0.4]], [[0.6, 1.1], [-0.9, 0.4]]):
        (p, q, r), _ = apply_homography(affine(A, (3, -2)), [[1, 2], [5, 3], [2, 7]])
        assert np.sign(np.linalg.det([q - p, r - p])) == np.sign(np.linalg.det(A))
    yield "With a negative one they are numbered clockwise"


def the_same_map_with_the_opposite_sign() -> Says:
    H, point = np.array([[1, 0, 0], [0, 1, 0], [0.5, 0, 1]]), [3.0, 4.0]
    assert np.array_equal(apply_homography(-H, point)[0], apply_homography(H, point)[0])
    assert apply_homography(-H, point)[1]
    yield "$H$ and $-H$ are the same map"


def the_numbers_of_the_direct_linear_transform() -> Says:
    x, y = 4000.0, 3000.0  # the far corner of a picture of 12 Mpx, in both pictures
    assert max(x * x, x * y) > 1e7
    yield "range from 1 to more than ten million"


def a_homography_that_does_little() -> Says:
    """Planar flow leaves out products of small numbers: its error goes with their square."""
    change = np.array([[0.3, -0.2, 0.1], [0.25, 0.4, -0.2], [0.2, -0.3, 0.0]])
    points = np.random.default_rng(4).uniform(-1, 1, (50, 2))
    x, y = points.T
    errors = []
    for small in (1e-3, 5e-4):
        H = np.eye(3) + small * change
        (h11, h12, h13), (h21, h22, h23), (h31, h32, _) = H
        flow = (
            h13 + h11 * x + h12 * y - h31 * x * x - h32 * x * y,
            h23 + h21 * x + h22 * y - h31 * x * y - h32 * y * y,
        )
        errors.append(np.abs(apply_homography(H, points)[0] - np.stack(flow, axis=1)).max())
    assert np.isclose(errors[0] / errors[1], 4, rtol=0.01)
    yield "Half the motion leaves a quarter of the error."


def shift_first_and_then_double() -> Says:
    S, T = np.diag([2, 2, 1]), translation(3, 0)
    first, other = (apply_homography(H, [1, 1])[0] for H in (S @ T, T @ S))
    yield "sends the point $(1, 1)$ to $({:g}, {:g})$?\n- [x] Only $ST$".format(*first)
    yield "The shift then leads to $({:g}, {:g})$".format(*other)


def which_segment_is_torn() -> Says:
    H = np.array([[1, 0, 0], [0, 1, 0], [0.5, 0, 1]])
    for answer, (start, end), torn in (
        ("- [ ] From $(0, 0)$ to $(9, 0)$", ((0, 0), (9, 0)), False),
        ("- [ ] From $(-5, 0)$ to $(-3, 2)$", ((-5, 0), (-3, 2)), False),
        ("- [ ] From $(-1, -9)$ to $(-1, 9)$", ((-1, -9), (-1, 9)), False),
        ("- [x] From $(-3, 1)$ to $(1, 1)$", ((-3, 1), (1, 1)), True),
    ):
        signs = sign_of_w(H, [start, end])
        assert (signs[0] * signs[1] < 0) == torn
        yield answer
    yield f"$w$ is ${0.5 * -5 + 1:g}$ at one end and ${0.5 * -3 + 1:g}$ at the other"
    yield f"$w$ goes from ${0.5 * -3 + 1:g}$ to ${0.5 * 1 + 1:g}$ and is zero at $x = -2$"
    yield f"$w$ grows from 1 to {0.5 * 9 + 1:g}"


ROAD = np.array([[1, 0, 0], [0, 1, 0], [0.5, 0, 1]])


def where_the_line_at_infinity_goes() -> Says:
    horizon = np.linalg.inv(ROAD).T @ [0, 0, 1]
    yield "becomes $({:g}, {:g}, {:g})$: the upright line".format(*horizon)
    yield f"$x = {-horizon[2] / horizon[0]:g}$, on which the two parallels met"


WORKED = (
    where_the_line_at_infinity_goes,
    the_area_under_an_affine_map,
    the_sign_of_a_determinant,
    a_homography_that_does_little,
    shift_first_and_then_double,
    the_same_map_with_the_opposite_sign,
    the_numbers_of_the_direct_linear_transform,
    which_segment_is_torn,
)
