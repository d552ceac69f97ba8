"""Where points do not determine a transformation, or nine numbers do not hold it."""

import math

import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.geometry import homography_estimation as estimation
from simulations.models.geometry.transforms import apply_homography

RNG = np.random.default_rng(7)
CORNERS = np.array([(0.0, 0.0), (640.0, 0.0), (640.0, 480.0), (0.0, 480.0)])
SEEN = np.array([(32.0, 15.0), (610.0, 60.0), (580.0, 500.0), (-12.0, 430.0)])


FIVE = np.array([(-3.0, 0.0), (-2.0, 1.0), (1.0, 0.0), (2.0, 1.0), (3.0, -1.0)])
THREE_ON_A_LINE = np.array([(0.0, 0), (1, 0), (2, 0), (0, 1)])


@pytest.mark.parametrize(
    ("source", "target"),
    [
        pytest.param(CORNERS[:3], SEEN[:3], id="too few"),
        pytest.param(np.outer(np.arange(4.0), [1, 2]), SEEN, id="on one line"),
        pytest.param(np.ones((4, 2)), SEEN, id="coincident"),
        pytest.param(THREE_ON_A_LINE, SEEN, id="three on one line"),
        pytest.param(THREE_ON_A_LINE, THREE_ON_A_LINE, id="many maps keep a line and a point"),
        pytest.param(
            np.array([(0.0, 0), (1, 0), (2, 1), (0, 1), (3, 5)]),
            np.array([(0.0, 0), (1, 0), (2, 0), (0, 0), (3, 0)]),
            id="the only map squashes the plane",
        ),
        pytest.param(FIVE, FIVE / (1 + FIVE[:, :1]), id="seen from both sides of infinity"),
    ],
)
def test_points_that_do_not_determine_a_homography_are_reported(
    source: Floats, target: Floats
) -> None:
    H, valid = estimation.estimate_homography(source, target)
    assert valid is False
    assert H.shape == (3, 3)
    assert np.isnan(H).all()


def test_mirrored_points_with_no_best_rotation_are_reported() -> None:
    cross = np.array([(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])
    assert not estimation.estimate_rigid(cross, cross * [1, -1])[1]


@pytest.mark.parametrize(("apart", "usable"), [(1e-10, True), (1e-13, False)])
def test_points_coincide_where_only_rounding_parts_them(apart: float, usable: bool) -> None:
    points = np.array([(1.0, 1.0), (1.0 + apart, 1.0)])
    assert (estimation.normalisation(points) is not None) is usable
    far = np.array([(1e6, 1.0), (1e6 + 1e-7, 1.0)])
    assert estimation.normalisation(far) is None
    assert estimation.normalisation(-far) is None
    assert estimation.normalisation(np.array([(0.0, 0), (1e-110, 0)])) is None
    assert estimation.normalisation(np.array([(0.0, 0), (1e-98, 0)])) is not None


@pytest.mark.parametrize("far", [1e5, 1e6, 3e6])
def test_far_from_both_origins_four_points_meet_as_nearly_as_is_promised(far: float) -> None:
    for _ in range(20):
        target = SEEN + RNG.uniform(-20, 20, (4, 2))
        H, valid = estimation.estimate_homography(CORNERS + far, target + far)
        assert valid
        T, U = (estimation.normalisation(points + far) for points in (CORNERS, target))
        assert T is not None
        assert U is not None
        share = 2.2e-16 * (1 + np.hypot(*T[:2, 2])) * (1 + np.hypot(*U[:2, 2]))
        off = np.abs(apply_homography(H, CORNERS + far)[0] - (target + far)).max()
        assert off < share * math.sqrt(2) / U[0, 0]


@pytest.mark.parametrize(("thin", "usable"), [(1e-7, True), (1e-11, False)])
def test_points_nearly_on_one_line_determine_a_plane_as_long_as_digits_last(
    thin: float, usable: bool
) -> None:
    points = np.array([(0.0, 0), (1, 0), (2, thin), (3, 0), (1.5, -thin)])
    assert estimation.estimate_affine(points, points)[1] is usable


KEYSTONE_NEAR = np.array([[1.1, 0.1, 0.0], [-0.2, 0.9, 0.0], [0.1, -0.05, 1.0]])


@pytest.mark.parametrize("far", [1e3, 1e4, 2e4])
def test_far_from_both_origins_a_homography_is_as_right_as_its_entries_can_be(far: float) -> None:
    points = np.random.default_rng(2).uniform(-1, 1, (20, 2))
    images = apply_homography(KEYSTONE_NEAR, points)[0]
    H, valid = estimation.estimate_homography(points + far, images - far)
    assert valid
    assert apply_homography(H, points + far)[0] + far == pytest.approx(images, abs=4e-16 * far**2)


@pytest.mark.parametrize("far", [1e6, 1e9])
def test_what_nine_numbers_cannot_hold_is_not_called_valid(far: float) -> None:
    points = np.random.default_rng(2).uniform(-1, 1, (20, 2))
    images = apply_homography(KEYSTONE_NEAR, points)[0]
    H, valid = estimation.estimate_homography(points + far, images - far)
    assert not valid
    assert np.isnan(H).all()
    assert estimation.estimate_homography(points + far, images)[1], "near one of the origins"
    assert estimation.estimate_affine(points + far, points - far)[1], "six numbers can"


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("far_picture", [0, 1])
def test_a_homography_is_held_until_rounding_moves_images_by_a_millionth_of_their_spread(
    far_picture: int, axis: int
) -> None:
    """The spread of this square is 1: its corners are √2 from its middle, on the mean."""
    square = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    for share, held in ((0.97, True), (1.03, False)):
        pictures = [square, square.copy()]
        pictures[far_picture][:, axis] += share * 1e-6 / np.finfo(float).eps
        assert estimation.estimate_homography(*pictures)[1] is held
