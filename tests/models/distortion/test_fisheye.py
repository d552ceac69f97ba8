"""Fisheye projections against OpenCV and their defining formulas, up to the largest angle."""

from collections.abc import Callable
from typing import Any

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
    unproject_ideal,
)

LENS = Fisheye(0.05, -0.01, 0.003, -0.0004)


def rays(angle: ArrayLike, azimuth: float | list[list[float]] = 0.4) -> Floats:
    angle = np.asarray(angle, float)
    across = np.sin(angle)
    return np.stack((across * np.cos(azimuth), across * np.sin(azimuth), np.cos(angle)), axis=-1)


def test_kannala_brandt_agrees_with_opencv() -> None:
    scene = np.random.default_rng(2).uniform(-1.5, 1.5, (100, 2))
    coefficients = np.array([LENS.k1, LENS.k2, LENS.k3, LENS.k4])
    expected = cv2.fisheye.distortPoints(scene[:, None], np.eye(3), coefficients)[:, 0]
    image, valid = project_fisheye(np.column_stack((scene, np.ones(100))), LENS)
    assert valid.all()
    np.testing.assert_allclose(image, expected, atol=1e-12)


@pytest.mark.parametrize(
    ("model", "radius"),
    [
        ("perspective", np.tan),
        ("orthographic", np.sin),
        ("stereographic", lambda angle: 2 * np.tan(angle / 2)),
        ("equidistant", lambda angle: angle),
        ("equisolid", lambda angle: 2 * np.sin(angle / 2)),
    ],
)
def test_each_ideal_model_follows_its_formula_and_round_trips(
    model: str, radius: Callable[[Floats], Floats]
) -> None:
    angles = np.linspace(0.0, 0.97 * IDEAL_MODELS[model].largest_angle_rad, 50)
    directions = rays(angles)
    image, seen = project_ideal(directions, model)
    np.testing.assert_allclose(np.hypot(*image.T), radius(angles), rtol=1e-12)
    back, valid = unproject_ideal(image, model)
    assert (seen & valid).all()
    np.testing.assert_allclose(back, directions, atol=1e-9)


@pytest.mark.parametrize(
    ("see", "largest"),
    [
        (lambda rays: project_fisheye(rays, Fisheye(-1 / 3)), 1.0),  # θ (1 − θ²/3) turns back at 1
        (lambda rays: project_fisheye(rays, Fisheye()), np.pi),
        (lambda rays: project_ideal(rays, "equidistant"), np.pi),
        (lambda rays: project_ideal(rays, "orthographic"), np.pi / 2),
    ],
)
def test_lens_sees_up_to_its_largest_angle(see: Any, largest: float) -> None:
    seen = see(rays([0.5 * largest, largest * (1 - 1e-3), largest * (1 + 1e-3)]))[1]
    assert seen.tolist() == [True, True, largest == np.pi]  # beyond half a turn is the other side


@pytest.mark.parametrize(
    ("model", "furthest"), [("equidistant", np.pi), ("equisolid", 2.0), ("orthographic", 1.0)]
)
def test_places_beyond_the_image_are_invalid(model: str, furthest: float) -> None:
    radii = furthest * np.array([0.5, 1 - 1e-6, 1.0, 1 + 1e-7, np.nan, np.inf])
    valid = unproject_ideal(np.column_stack([radii, np.zeros(6)]), model)[1]
    assert valid.tolist() == [True, True, *[False] * 4]
