"""Chapter 1: transformations of the plane."""

import numpy as np
from support.worked_numbers import Says

from simulations.models.geometry.lines_and_planes import (
    intersection,
    line_through,
    signed_distance,
)
from simulations.models.geometry.transforms import (
    affine,
    apply_homography,
    rigid,
    sign_of_w,
    translation,
)
from simulations.scenes.transform_2d.family import transformation

CHAPTER = "01-2d-transformations"


def a_square_becomes_a_road() -> Says:
    H = np.array([[1, 0, 0], [0, 1, 0], [0.5, 0, 1]])
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.5], [0.5, 0]])
    (stays, right, top, also_stays, centre, middle), _ = apply_homography(H, corners)
    assert [*stays, *also_stays] == [0, 0, 0, 1]
    yield f"have $w = {0.5 * 1 + 1:g}$, so $(1, 0)$ goes to $({right[0]:.3f}, {right[1]:.0f})$"
    yield f"$(1, 1)$ goes to $({top[0]:.3f}, {top[1]:.3f})$"
    yield f"has $w = {0.5 * 0.5 + 1:g}$ and goes to $({centre[0]:g}, {centre[1]:g})$"
    yield f"$y = 1 - {(1 - top[1] / 2) / top[0] + 0.5:.1f}x$. At $x = {centre[0]:g}$"
    assert np.isclose(1 - 1.5 * centre[0], centre[1]), "the diagonals cross there"
    assert np.isclose(1 - 1.5 * right[0], right[1]), "the falling diagonal ends in the corner"
    yield f"also goes to $x = {middle[0]:g}$"
    yield f"the middle of the new side is ${right[0] / 2:.3f}$"
    fall = (1 - top[1]) / top[0]
    yield f"falls by {fall:g} for each unit to the right"
    yield f"meets the lower side at $({1 / fall:g}, 0)$"


def the_figure_s_scale_and_shift() -> Says:
    yield f"corner $P$ goes from $(40, 40)$ to $({40 + 30}, {40 + 30 // 2})$"
    yield f"$1.5^2 = {1.5**2:g}$"


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


def where_the_corner_runs_off() -> Says:
    per_amount = 40 / 10000 + 40 / 3000
    yield rf"$w = 1 - {per_amount:.5f}\,m$, which is zero at $m = {1 / per_amount:.1f}$"
    H = transformation("projective", 30.0)
    x, y = 7.0, -11.0  # anywhere
    w = (H[2] @ [x, y, 1.0]) / H[2, 2]
    assert np.isclose(w, 1 - 30 * x / 10000 + 30 * y / 3000)
    yield r"$w = 1 - mx/10\,000 + my/3000$"


def turn_and_shift() -> Says:
    turn, shift = rigid(np.pi / 2, 0, 0), translation(3, 0)
    first, _ = apply_homography(shift @ turn, [1, 0])
    yield "to $({:.0f}, {:.0f})$. Shift first".format(*first)
    second, _ = apply_homography(turn @ shift, [1, 0])
    yield "then to $({:.0f}, {:.0f})$.".format(*second)


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


def dividing_by_a_negative_w() -> Says:
    u, v, w = 6, -4, -2
    yield f"The point $({u / w:g}, {v / w:g})$"


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


def a_line_a_point_and_no_point() -> Says:
    first = np.cross([1, 2, 1], [4, 6, 1])
    yield "$(1, 2, 1) \\times (4, 6, 1) = ({}, {}, {})$".format(*first)
    ours, _ = line_through([1.0, 2], [4.0, 6])
    assert np.allclose(ours, first / np.hypot(*first[:2]))
    yield f"$2/5 = {abs(float(signed_distance([0.0, 0], first))):g}$ away from it"
    yield "$(-4, 3, -2) \\times (0, 1, -2) = ({}, {}, {})$".format(*np.cross(first, [0, 1, -2]))
    meet, valid = intersection(first, [0, 1, -2])
    assert valid
    yield "after division that is $({:g}, {:g})$".format(*meet)
    yield "(-4, 3, 8) = ({}, {}, {})$".format(*np.cross(first, [-4, 3, 8]))
    assert not intersection(first, [-4, 3, 8])[1]


ROAD = np.array([[1, 0, 0], [0, 1, 0], [0.5, 0, 1]])


def where_the_line_at_infinity_goes() -> Says:
    horizon = np.linalg.inv(ROAD).T @ [0, 0, 1]
    yield "becomes $({:g}, {:g}, {:g})$: the upright line".format(*horizon)
    yield f"$x = {-horizon[2] / horizon[0]:g}$, on which the two parallels met"


WORKED = (
    a_line_a_point_and_no_point,
    where_the_line_at_infinity_goes,
    a_square_becomes_a_road,
    the_figure_s_scale_and_shift,
    the_area_under_an_affine_map,
    the_sign_of_a_determinant,
    a_homography_that_does_little,
    shift_first_and_then_double,
    where_the_corner_runs_off,
    the_same_map_with_the_opposite_sign,
    the_numbers_of_the_direct_linear_transform,
    dividing_by_a_negative_w,
    which_segment_is_torn,
    turn_and_shift,
)
