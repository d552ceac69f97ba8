"""Lambert, Phong, Blinn-Phong and lamps against numbers worked by hand."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.models.reflectance import (
    DirectionalLight,
    PointLight,
    attenuation,
    blinn_phong,
    irradiance,
    lambert,
    normalise,
    phong,
)

FRONT = np.array([0.0, 0.0, 1.0])


@given(st.floats(-math.pi, math.pi))
def test_lambert_is_the_cosine_until_the_horizon_then_dark(theta):
    light = [math.sin(theta), 0, math.cos(theta)]
    assert lambert(FRONT, light, 0.8) == pytest.approx(0.8 * max(0, math.cos(theta)))


def test_a_surface_without_normal_is_dark():
    assert lambert([0, 0, 0], FRONT) == 0


def test_float32_never_exceeds_one():
    normals = normalise(np.random.default_rng(0).normal(size=(2000, 3)).astype(np.float32))
    assert max(float(lambert(n, n)) for n in normals) <= 1


@pytest.mark.parametrize("scale", [1e-200, 1.0, 1e200])
def test_normalise_neither_overflows_nor_vanishes(scale):
    np.testing.assert_allclose(normalise(scale * np.array([3.0, 0, 4])), [0.6, 0, 0.8])


def test_phong_highlight_is_half_as_high_at_the_half_width():
    phi = math.acos(2 ** (-1 / 100))
    view = [math.sin(phi), 0, math.cos(phi)]
    shade = phong(FRONT, FRONT, view, 0.0, specular=1.0, shininess=100)
    assert shade == pytest.approx(0.5)


def test_blinn_with_fourfold_shininess_looks_like_phong_near_the_peak():
    angles = np.radians(np.arange(0, 9))
    view = np.stack([np.sin(angles), 0 * angles, np.cos(angles)], axis=-1)
    ours = phong(FRONT, FRONT, view, shininess=50)
    np.testing.assert_allclose(blinn_phong(FRONT, FRONT, view, shininess=200), ours, atol=0.01)


@pytest.mark.parametrize("model", [phong, blinn_phong])
@pytest.mark.parametrize("shininess", [0, 1, 1e6])
def test_no_highlight_where_the_light_is_below_the_horizon(model, shininess):
    assert model(FRONT, -FRONT, FRONT, shininess=shininess) == 0


def test_light_opposite_to_the_eye_gives_no_highlight():
    assert blinn_phong([1.0, 0, 0], FRONT, -FRONT) == 0


def test_twice_the_distance_a_quarter_of_the_light():
    np.testing.assert_allclose(attenuation([1, 2, np.inf]), [1, 0.25, 0])
    assert attenuation(0, radius=0.1) == pytest.approx(100)


def test_lights_add_up():
    lamps = [DirectionalLight((0, 0, 1), (1, 0, 0)), PointLight((0, 0, 2), (0, 8, 0))]
    np.testing.assert_allclose(irradiance([0, 0, 0], FRONT, lamps), [1, 2, 0])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: lambert(FRONT, [0, 0, 2]), "light"),
        (lambda: lambert(FRONT, FRONT, 1.2), "albedo"),
        (lambda: phong(FRONT, FRONT, FRONT, shininess=-1), "shininess"),
        (lambda: attenuation(-1), "distance"),
        (lambda: attenuation(1, radius=0), "radius"),
    ],
)
def test_meaningless_parameters_are_refused_by_name(call, message):
    with pytest.raises(ValueError, match=message):
        call()
