"""Fisheye projections: OpenCV, identities that define each model, and the awkward directions."""

from collections.abc import Sequence

import cv2
import numpy as np
import pytest
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.distortion.fisheye import (
    IDEAL_MODELS,
    Fisheye,
    project_fisheye,
    project_ideal,
    unproject_fisheye,
    unproject_ideal,
)

LENS = Fisheye(0.05, -0.01, 0.003, -0.0004)


def rays(angle: ArrayLike, azimuth: float | list[list[float]] = 0.4) -> Floats:
    angle = np.asarray(angle, float)
    across = np.sin(angle)
    return np.stack((across * np.cos(azimuth), across * np.sin(azimuth), np.cos(angle)), axis=-1)


def test_kannala_brandt_agrees_with_opencv() -> None:
    scene = np.random.default_rng(2).uniform(-1.5, 1.5, (100, 2))
    expected = cv2.fisheye.distortPoints(
        scene[:, None], np.eye(3), np.array([LENS.k1, LENS.k2, LENS.k3, LENS.k4])
    )[:, 0]
    image, valid = project_fisheye(np.column_stack((scene, np.ones(100))), LENS)
    assert valid.all()
    np.testing.assert_allclose(image, expected, atol=1e-12)


def test_kannala_brandt_reaches_behind_the_camera_and_comes_back() -> None:
    directions = rays(np.radians([0.0, 45.0, 90.0, 100.0]))
    image, seen = project_fisheye(directions, LENS)
    back, valid = unproject_fisheye(image, LENS)
    assert seen.all()
    assert valid.all()
    np.testing.assert_allclose(back, directions, atol=1e-12)


@pytest.mark.parametrize("model", IDEAL_MODELS)
def test_each_ideal_model_is_undone_by_its_inverse(model: str) -> None:
    directions = rays(np.linspace(0.0, 0.97 * IDEAL_MODELS[model].largest_angle_rad, 50))
    image, _ = project_ideal(directions, model)
    back, valid = unproject_ideal(image, model)
    assert valid.all()
    np.testing.assert_allclose(back, directions, atol=1e-9)


@pytest.mark.parametrize("model", ["perspective", "orthographic"])
def test_models_of_one_half_space_refuse_what_lies_beside_the_camera(model: str) -> None:
    image, valid = project_ideal([1.0, 0.0, -0.01], model)
    assert not valid
    assert np.isnan(image).all()


@pytest.mark.parametrize(
    ("model", "edge"),
    [
        ("perspective", [1.0, 0.0, 0.0]),
        ("orthographic", [0.0, 1.0, 0.0]),
        ("stereographic", [1e-300, 0.0, -1.0]),
        ("equidistant", [0.0, -1e-300, -1.0]),
        ("equisolid", [1e-300, 0.0, -1.0]),
    ],
)
def test_a_model_does_not_see_its_largest_angle_itself(model: str, edge: list[float]) -> None:
    assert not project_ideal(edge, model)[1]
    assert project_fisheye(edge, Fisheye())[1] == (edge[2] == 0.0)


@pytest.mark.parametrize("bad", [[0, 0, 0], [0, 0, -1], [np.nan, 0, 1]])
def test_what_is_no_direction_has_no_image(bad: Sequence[float]) -> None:
    image, valid = project_fisheye(np.array(bad, float), Fisheye())
    assert not valid
    assert np.isnan(image).all()


def test_an_unknown_model_is_named() -> None:
    with pytest.raises(ValueError, match="fishy"):
        project_ideal([0, 0, 1], "fishy")


@pytest.mark.parametrize("model", ["perspective", "orthographic"])
def test_models_of_one_half_space_see_just_up_to_its_edge(model: str) -> None:
    image, valid = project_ideal(rays(np.radians([89.0, 89.999, 90.001])), model)
    assert valid.tolist() == [True, True, False]
    expected = {"perspective": np.tan, "orthographic": np.sin}[model](np.radians(89.0))
    assert np.hypot(*image[0]) == pytest.approx(expected)


@pytest.mark.parametrize("model", ["stereographic", "equidistant", "equisolid"])
def test_the_other_models_see_all_but_exactly_backwards(model: str) -> None:
    image, valid = project_ideal(rays(np.radians([179.9, 120.0])), model)
    half = np.radians([89.95, 60.0])
    expected = {"stereographic": 2 * np.tan(half), "equisolid": 2 * np.sin(half)}
    assert valid.all()
    np.testing.assert_allclose(np.hypot(*image.T), expected.get(model, 2 * half))
    assert not project_ideal([0.0, 0.0, -1.0], model)[1]


def test_the_axis_and_the_directions_around_it_keep_their_azimuth() -> None:
    directions = np.array([(0, 0, 3), (1, 0, 1), (0, 2, 2), (-1, 0, 1), (0, -1, 1)])
    image, valid = project_ideal(directions, "equidistant")
    assert valid.all()
    quarter = np.pi / 4
    expected = quarter * np.array([(0, 0), (1, 0), (0, 1), (-1, 0), (0, -1)])
    np.testing.assert_allclose(image, expected, atol=1e-15)


@pytest.mark.parametrize("size", [1e-300, 1.0, 1e300])
def test_the_length_of_a_direction_does_not_matter(size: float) -> None:
    image, valid = project_ideal(size * np.array([3.0, 4.0, 5.0]), "perspective")
    assert valid
    np.testing.assert_allclose(image, [0.6, 0.8])


@pytest.mark.parametrize("sign", [1, -1])
def test_the_longest_directions_do_not_overflow(sign: int) -> None:
    image, valid = project_ideal(sign * np.array([1.5e308, 1e308, 1e-300]), "equidistant")
    assert valid
    azimuth = np.arctan2(sign * 2, sign * 3)
    np.testing.assert_allclose(image, np.pi / 2 * np.array([np.cos(azimuth), np.sin(azimuth)]))


def test_the_shortest_direction_is_as_good_as_any() -> None:
    image, valid = project_ideal([5e-324] * 3, "perspective")
    assert valid
    np.testing.assert_allclose(image, [1, 1])


@pytest.mark.parametrize("model", IDEAL_MODELS)
def test_stacks_of_directions_and_of_points_are_those_of_each_alone(model: str) -> None:
    stack = rays([[0.1, 0.3], [0.5, 0.7], [1.1, 1.3]], [[0.0, 1.0], [2.0, 3.0], [4.0, 5.0]])
    image, back = project_ideal(stack, model)[0], project_fisheye(stack, LENS)[0]
    for index in np.ndindex(3, 2):
        np.testing.assert_array_equal(image[index], project_ideal(stack[index], model)[0])
        np.testing.assert_array_equal(back[index], project_fisheye(stack[index], LENS)[0])
    np.testing.assert_allclose(unproject_ideal(image, model)[0], stack, atol=1e-12)
    np.testing.assert_allclose(unproject_fisheye(back, LENS)[0], stack, atol=1e-12)


def test_one_bad_direction_among_good_ones_spoils_no_other() -> None:
    directions = np.array([[0, 0, 1.0], [np.inf, 0, 1], [0, 0, 0], [0, 1, 1]])
    for image, valid in (
        project_ideal(directions, "stereographic"),
        project_fisheye(directions, LENS),
    ):
        assert valid.tolist() == [True, False, False, True]
        np.testing.assert_array_equal(image[:3], [[0, 0], [np.nan] * 2, [np.nan] * 2])
        assert image[3, 1] > 0.5
    points = np.array([[0, 0.0], [np.nan, 0], [0.5, 0.0], [1e308, 1e308]])
    for direction, valid in (
        unproject_ideal(points, "orthographic"),
        unproject_fisheye(points, LENS),
    ):
        assert valid.tolist() == [True, False, True, False]
        np.testing.assert_array_equal(direction[:2], [[0, 0, 1], [np.nan] * 3])
        assert np.isnan(direction[3]).all()
        assert direction[2, 0] > 0.4
        assert np.linalg.norm(direction[2]) == pytest.approx(1)


def test_past_its_fold_a_lens_sees_nothing() -> None:
    """θ (1 − θ²/3) turns back at 1, where its image radius is 2/3."""
    lens = Fisheye(-1 / 3)
    image, valid = project_fisheye(rays([0.5, 0.999, 1.001, 3.0]), lens)
    assert valid.tolist() == [True, True, False, False]
    assert np.hypot(*image[0]) == pytest.approx(0.5 - 0.125 / 3)
    assert unproject_fisheye([[0.66, 0], [0.67, 0]], lens)[1].tolist() == [True, False]


def test_a_lens_without_a_fold_sees_up_to_half_a_turn() -> None:
    image, valid = project_fisheye(rays([3.14]), Fisheye())
    assert valid.all()
    assert np.hypot(*image[0]) == pytest.approx(3.14)
    assert unproject_fisheye([[3.14, 0], [3.15, 0]], Fisheye())[1].tolist() == [True, False]
    assert unproject_ideal([[3.14, 0], [3.15, 0]], "equidistant")[1].tolist() == [True, False]


@pytest.mark.parametrize(("model", "edge"), [("equisolid", 2.0), ("orthographic", 1.0)])
def test_a_radius_just_beyond_the_image_circle_is_told_from_one_within(
    model: str, edge: float
) -> None:
    points = [[edge * (1 - 1e-6), 0.0], [edge * (1 + 1e-7), 0.0]]
    assert unproject_ideal(points, model)[1].tolist() == [True, False]


def test_each_coefficient_is_of_its_own_power_and_must_be_finite() -> None:
    angle = np.array([0.6])
    for power, name in enumerate(("k1", "k2", "k3", "k4"), start=1):
        image, _ = project_fisheye(rays(angle, 0.0), Fisheye(**{name: 0.01}))
        assert image[0, 0] == pytest.approx(0.6 * (1 + 0.01 * 0.36**power), abs=1e-15)
        with pytest.raises(ValueError, match="finite"):
            Fisheye(**{name: np.inf})


def test_the_very_edge_of_each_image_is_outside() -> None:
    for model, radius in (("equisolid", 2.0), ("equidistant", np.pi), ("orthographic", 1.0)):
        assert not unproject_ideal([radius, 0.0], model)[1]
    assert not unproject_ideal([np.tan(np.pi / 2), 0.0], "perspective")[1]
    assert not unproject_fisheye([np.pi, 0.0], Fisheye())[1]


def test_a_direction_is_valid_if_its_radius_comes_back_to_a_billionth() -> None:
    """So close to 90° that an angle in floating point cannot tell the radii apart."""
    far = np.column_stack([np.linspace(1e8, 2e8, 100), np.zeros(100)])
    assert unproject_ideal(far / 1e3, "perspective")[1].all()
    assert not unproject_ideal(far, "perspective")[1].all()
