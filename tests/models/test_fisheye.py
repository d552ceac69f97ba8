"""Fisheye projections: OpenCV, identities that define each model, and the awkward directions."""

import cv2
import numpy as np
import pytest

from simulations.models.fisheye import (
    IDEAL_MODELS,
    Fisheye,
    project_fisheye,
    project_ideal,
    unproject_fisheye,
    unproject_ideal,
)

LENS = Fisheye(0.05, -0.01, 0.003, -0.0004)


def rays(angle, azimuth=0.4):
    angle = np.asarray(angle, float)
    across = np.sin(angle)
    return np.stack((across * np.cos(azimuth), across * np.sin(azimuth), np.cos(angle)), axis=-1)


def test_kannala_brandt_agrees_with_opencv():
    scene = np.random.default_rng(2).uniform(-1.5, 1.5, (100, 2))
    expected = cv2.fisheye.distortPoints(
        scene[:, None], np.eye(3), np.array([LENS.k1, LENS.k2, LENS.k3, LENS.k4])
    )[:, 0]
    image, valid = project_fisheye(np.column_stack((scene, np.ones(100))), LENS)
    assert valid.all()
    np.testing.assert_allclose(image, expected, atol=1e-12)


def test_kannala_brandt_reaches_behind_the_camera_and_comes_back():
    directions = rays(np.radians([0.0, 45.0, 90.0, 100.0]))
    image, seen = project_fisheye(directions, LENS)
    back, valid = unproject_fisheye(image, LENS)
    assert seen.all()
    assert valid.all()
    np.testing.assert_allclose(back, directions, atol=1e-12)


@pytest.mark.parametrize("model", IDEAL_MODELS)
def test_each_ideal_model_is_undone_by_its_inverse(model):
    directions = rays(np.linspace(0.0, 0.97 * IDEAL_MODELS[model].largest_angle_rad, 50))
    image, _ = project_ideal(directions, model)
    back, valid = unproject_ideal(image, model)
    assert valid.all()
    np.testing.assert_allclose(back, directions, atol=1e-9)


@pytest.mark.parametrize(
    ("model", "radius"),
    [
        ("stereographic", 2.0),
        ("equidistant", np.pi / 2),
        ("equisolid", np.sqrt(2.0)),
    ],
)
def test_where_ninety_degrees_lands(model, radius):
    image, valid = project_ideal([1.0, 0.0, 0.0], model)
    assert valid
    np.testing.assert_allclose(image, [radius, 0.0], atol=1e-12)


@pytest.mark.parametrize("model", ["perspective", "orthographic"])
def test_models_of_one_half_space_refuse_what_lies_beside_the_camera(model):
    image, valid = project_ideal([1.0, 0.0, -0.01], model)
    assert not valid
    np.testing.assert_array_equal(image, [0.0, 0.0])


@pytest.mark.parametrize("bad", [[0, 0, 0], [0, 0, -1], [np.nan, 0, 1]])
def test_what_is_no_direction_has_no_image(bad):
    image, valid = project_fisheye(np.array(bad, float), Fisheye())
    assert not valid
    assert np.isfinite(image).all()


@pytest.mark.parametrize(("model", "radius"), [("equisolid", 2.01), ("orthographic", 1.01)])
def test_radii_outside_the_image_circle_have_no_direction(model, radius):
    direction, valid = unproject_ideal([radius, 0.0], model)
    assert not valid
    np.testing.assert_array_equal(direction, [0.0, 0.0, 1.0])


def test_an_unknown_model_is_named():
    with pytest.raises(ValueError, match="fishy"):
        project_ideal([0, 0, 1], "fishy")
