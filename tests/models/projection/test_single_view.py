"""A camera and lengths from lines along the axes of a room."""

import math

import numpy as np
import pytest
from support.drawn_lines import CENTRE, FOCAL, HEIGHT, SIZE, above, image_of, lines_along_axes

from simulations.models.arrays import Floats
from simulations.models.projection.level_ground import pose_above_ground
from simulations.models.projection.pinhole import intrinsics
from simulations.models.projection.single_view import fit_view, focal_from_pair
from simulations.models.projection.single_view_lengths import Stretch, measured
from simulations.models.projection.vanishing_lines import fit_vanishing_point, pixel_of

POSE = pose_above_ground(1.5, 0.6, 0.3, 0.05)

EXACT = 1e-3
"""Error of ends drawn without noise, so small that priors have no weight."""


@pytest.mark.parametrize("counts", [(4, 4, 4), (2, 2, 0), (2, 0, 2), (0, 3, 2), (2, 2, 1)])
def test_lines_without_noise_give_the_true_camera(counts: tuple[int, int, int]) -> None:
    view = fit_view(*lines_along_axes(POSE, np.random.default_rng(1), counts), SIZE, EXACT)
    assert view.focal_px == pytest.approx(FOCAL, rel=1e-6)
    np.testing.assert_allclose(view.R, POSE[:3, :3], atol=1e-6)
    assert (view.pitch, view.roll) == pytest.approx((0.3, 0.05), abs=1e-6)
    assert view.misfit < 1e-6


def test_three_directions_give_the_true_camera_between_walls_off_square() -> None:
    rng = np.random.default_rng(1)
    ends, axes = lines_along_axes(POSE, rng, off_square=math.radians(3.0))
    view = fit_view(ends, axes, SIZE, EXACT, off_square=math.radians(1.5))
    assert view.focal_px == pytest.approx(FOCAL, rel=1e-4)
    assert math.degrees(view.lean) == pytest.approx(3.0, abs=0.01)
    np.testing.assert_allclose(view.normal(2), POSE[:3, 2], atol=1e-5)


def test_three_directions_also_give_the_principal_point() -> None:
    shifted = intrinsics(FOCAL, (450.0, 260.0))
    ends, axes = lines_along_axes(POSE, np.random.default_rng(1), K=shifted)
    view = fit_view(ends, axes, SIZE, EXACT, find_centre=True)
    assert view.centre == pytest.approx((450.0, 260.0), abs=1e-4)
    assert view.focal_px == pytest.approx(FOCAL, rel=1e-6)


def test_focal_length_from_two_directions_agrees_with_the_formula() -> None:
    rng = np.random.default_rng(4)
    ends, axes = lines_along_axes(POSE, rng, (4, 4, 0))
    ends = ends + rng.normal(0, 0.1, ends.shape)
    first, second = (fit_vanishing_point(ends[axes == axis])[0] for axis in (0, 1))
    view = fit_view(ends, axes, SIZE, 0.1)
    assert view.focal_px == pytest.approx(focal_from_pair(first, second, CENTRE), rel=1e-4)
    for fitted, alone in zip(view.vanishing, (first, second), strict=False):
        np.testing.assert_allclose(fitted / fitted[2], alone / alone[2], atol=0.05)
    for axis in (0, 1):
        _, spread, _ = pixel_of(view.vanishing[axis], view.vanishing_covariances[axis])
        _, alone, _ = pixel_of(*fit_vanishing_point(ends[axes == axis], 0.1))
        np.testing.assert_allclose(spread, alone, rtol=1e-3)


@pytest.mark.parametrize("seed", range(4))
def test_one_vanishing_point_leaves_the_focal_length_undetermined(seed: int) -> None:
    rng = np.random.default_rng(seed)
    ends, axes = lines_along_axes(pose_above_ground(1.5, 0.0, 0.0), rng)
    view = fit_view(ends + rng.normal(0, 1, ends.shape), axes, SIZE)
    assert view.spread(lambda view: math.log(view.focal_px)) > 0.5
    away = view.vanishing[1]
    np.testing.assert_allclose(away[:2] / away[2], CENTRE, atol=12.0)


def test_two_directions_with_one_vanishing_point_are_refused() -> None:
    ends, _ = lines_along_axes(POSE, np.random.default_rng(1), (2, 0, 0))
    with pytest.raises(ValueError, match="apart"):
        fit_view([*ends, *ends], [0, 0, 1, 1], SIZE)


OTHER_POSE = pose_above_ground(HEIGHT, 0.6, 0.3, 0.05)
VIEW = fit_view(*lines_along_axes(OTHER_POSE, np.random.default_rng(1)), SIZE, 1e-3)


def stretch(start: Floats, end: Floats, pose: Floats = OTHER_POSE) -> Stretch:
    kind = "above" if end[2] - start[2] > 1e-9 else "within"
    return Stretch(image_of(np.array([start, end]), pose), kind)


A, B, C = np.array([[1.0, 3.0, 0.0], [3.0, 4.0, 0.0], [2.0, 6.0, 0.0]])


def test_known_length_on_the_floor_gives_all_other_lengths() -> None:
    known, others = stretch(A, B), (stretch(A, C), stretch(C, above(C, 1.8)))
    found = measured(VIEW, known, math.sqrt(5.0), others)
    np.testing.assert_allclose(found.metres, (math.sqrt(10.0), 1.8), rtol=1e-5)
    assert found.distance == pytest.approx(HEIGHT, rel=1e-5)


@pytest.mark.parametrize(("normal", "across"), [(0, (0.0, 1.0, 1.0)), (1, (1.0, 0.0, 1.0))])
def test_known_length_on_a_wall_gives_all_other_lengths(
    normal: int, across: tuple[float, ...]
) -> None:
    corner = np.array([2.5, 5.0, 0.3])
    diagonal, out = np.array(across), np.eye(3)[normal]
    ends = [(corner, corner + diagonal), (corner, corner + 0.5 * diagonal), (corner, corner - out)]
    known, other, shelf = (image_of(np.array(pair), OTHER_POSE) for pair in ends)
    found = measured(
        VIEW,
        Stretch(known),
        math.sqrt(2.0),
        (Stretch(other), Stretch(shelf, "above")),
        normal=normal,
    )
    np.testing.assert_allclose(found.metres, (math.sqrt(0.5), 1.0), rtol=1e-5)
    assert found.distance == pytest.approx(corner[normal], rel=1e-5)


def test_segment_beyond_the_horizon_has_no_length() -> None:
    sky = Stretch(np.array([[400.0, 20.0], [500.0, 20.0]]))
    found = measured(VIEW, stretch(A, B), math.sqrt(5.0), (sky, stretch(A, C)))
    assert np.isnan(found.metres[0])
    assert found.metres[1] == pytest.approx(math.sqrt(10.0), rel=1e-5)
    across = Stretch(np.array([[400.0, 500.0], [500.0, 20.0]]))
    with pytest.raises(ValueError, match="horizon"):
        measured(VIEW, across, 1.0, ())
