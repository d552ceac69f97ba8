"""Reflection against values computed by hand, explicit vectors, and SciPy’s integrals."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import dblquad

from simulations.models.arrays import Floats
from simulations.models.light.brdf import MODELS, Material, parts, reflected, sent_back
from simulations.models.light.interreflection import CELLS, SHAPE, bounced, edge_factor, exchange
from simulations.models.light.reflectance import PointLight, blinn_phong, irradiance, phong

FRONT = np.array([0.0, 0.0, 1.0])


NONE, ALONG = np.zeros(3), np.array([1.0, 0, 0])
ABOVE_ONE = np.array([1 + np.finfo(np.float32).eps, 0, 0], np.float32)
SIDE, SLANTED = np.array([0, 1.0, 0]), np.array([math.sin(1), 0, math.cos(1)])


@pytest.mark.parametrize("model", [phong, blinn_phong])
@pytest.mark.parametrize(
    ("normal", "light", "view", "shininess", "shade"),
    [
        *((FRONT, -FRONT, FRONT, shininess, 0) for shininess in (0, 1, 1e6)),  # from below
        *((NONE, FRONT, FRONT, shininess, 0) for shininess in (0, 1, 64)),
        (ABOVE_ONE, ALONG, ALONG, 1e7, 0.25),  # one ulp above one does not overflow
        (FRONT, SLANTED, SIDE, 0, 0.25),  # everywhere on the lit side
    ],
)
def test_highlights_are_correct_at_extreme_arguments(
    model: Callable[..., Floats],
    normal: Floats,
    light: Floats,
    view: Floats,
    shininess: float,
    shade: float,
) -> None:
    found = model(normal, light, view, 0.0, specular=0.25, shininess=shininess)
    assert found == pytest.approx(shade, abs=1e-15)


def test_irradiance_of_a_lamp_follows_cosine_and_inverse_square() -> None:
    """At (3, 0, 0) below a lamp at (0, 0, 4): distance 5, cosine 4/5."""
    lamp = PointLight((0, 0, 4), (1.0, 2.0, 3.0))
    points = np.array([[3.0, 0, 0], [0, 0, 0], [0, 0, 8.0]])
    found = irradiance(points, np.broadcast_to(FRONT, (3, 3)), [lamp])
    expected = np.outer([0.8 / 25, 1 / 16, 0], [1, 2, 3])
    np.testing.assert_allclose(found, expected, atol=1e-15)


def test_default_highlights_have_strength_half_and_exponents_32_and_128() -> None:
    view = [math.sin(0.2), 0, math.cos(0.2)]
    assert phong(FRONT, FRONT, view) == pytest.approx(1 + 0.5 * math.cos(0.2) ** 32)
    assert blinn_phong(FRONT, FRONT, view) == pytest.approx(1 + 0.5 * math.cos(0.1) ** 128)


SATIN = Material(0.5, 0.3, 0.4)
RNG = np.random.default_rng(2)


def directions(count: int) -> NDArray[np.float64]:
    """(count, 3) unit vectors above the surface z = 0."""
    vectors = RNG.normal(size=(count, 3))
    vectors[:, 2] = np.abs(vectors[:, 2]) + 0.05
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1, keepdims=True))


LIGHTS, EYES = directions(200), directions(200)
N_L, N_V, L_V = LIGHTS[:, 2], EYES[:, 2], np.sum(LIGHTS * EYES, axis=1)


def test_phong_brdf_is_its_radiance_divided_by_the_irradiance() -> None:
    normals = np.broadcast_to([0.0, 0.0, 1.0], (200, 3))
    radiance = phong(normals, LIGHTS, EYES, 0.5, specular=0.3, shininess=SATIN.shininess)
    found = reflected("phong", SATIN, N_L, N_V, L_V)
    np.testing.assert_allclose(found * np.pi * N_L, radiance, rtol=1e-9)


def test_microfacets_agree_with_walter_and_heitz() -> None:
    """Written out with vectors, with Smith's two Λ for the masking."""
    found = parts("microfacets", SATIN, N_L, N_V, L_V)
    for i in range(200):
        light, eye, m = LIGHTS[i], EYES[i], SATIN.roughness
        half = (light + eye) / np.linalg.norm(light + eye)
        tangent = np.tan(np.arccos(half[2]))
        density = m**2 / (np.pi * half[2] ** 4 * (m**2 + tangent**2) ** 2)
        slopes = [m * np.tan(np.arccos(way[2])) for way in (light, eye)]
        hidden = sum((np.sqrt(1 + slope**2) - 1) / 2 for slope in slopes)
        mirrored, into, out = (
            0.3 + 0.7 * (1 - cosine) ** 5 for cosine in (half @ light, light[2], eye[2])
        )
        mirrored = mirrored * density / (1 + hidden) / (4 * light[2] * eye[2])
        assert found[1][i] == pytest.approx(mirrored, rel=1e-9)
        assert found[0][i] == pytest.approx((1 - into) * (1 - out) / np.pi)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("roughness", [0.15, 0.5])
@pytest.mark.parametrize("angle", [0.0, 50.0, 85.0])
def test_reflected_share_is_scipys_integral_over_the_hemisphere(
    model: str, roughness: float, angle: float
) -> None:
    material = Material(0.4, 0.2, roughness)
    light, sine = np.cos(np.radians(angle)), np.sin(np.radians(angle))

    def sent(around: float, polar: float) -> float:
        eye = np.cos(polar)
        between = light * eye + sine * np.sin(polar) * np.cos(around)
        # Above the surface: at its rim the cosine is 6e-17.
        return float(reflected(model, material, light, eye, between)) * eye * np.sin(polar)

    whole = 2 * dblquad(sent, 0, np.pi / 2, 0, np.pi, epsabs=2e-4, epsrel=2e-4)[0]
    assert sent_back(model, material, light) == pytest.approx(whole, abs=1e-3)


def test_form_factors_agree_with_their_integrals() -> None:
    """Between patches of facing walls and of adjacent walls."""
    whole, middles = exchange().reshape(6, CELLS**2, 6, CELLS**2), (np.arange(40) + 0.5) / 40
    u, v, s, t = np.meshgrid(*[middles / CELLS] * 4, indexing="ij", sparse=True)
    far = 1.0 + (u - s) ** 2 + (v - t - 2 / CELLS) ** 2
    facing = np.mean(1.0 / (np.pi * far**2)) / CELLS**2
    assert whole[0, 0, 1, 2] == pytest.approx(facing, rel=1e-4)
    apart = 5 / CELLS  # from the edge
    square = (u + apart) ** 2 + (s + apart) ** 2 + (v - t) ** 2
    aside = np.mean((u + apart) * (s + apart) / (np.pi * square**2)) / CELLS**2
    # x = 0 at (y, z) and y = 0 at (x, z), both as far from their edge.
    assert whole[0, 5 * CELLS + 1, 2, 5 * CELLS + 1] == pytest.approx(aside, rel=1e-4)
    np.testing.assert_allclose(exchange().sum(axis=1), 1.0)
    np.testing.assert_allclose(exchange(), exchange().T, atol=1e-14)


@pytest.mark.parametrize("albedo", [0.0, 0.5, 0.95])
def test_mean_light_in_a_closed_room_follows_the_closed_form(albedo: float) -> None:
    lamp = np.random.default_rng(3).random(SHAPE)
    lit = bounced(lamp, np.full(6, albedo), None)
    assert lit.mean() == pytest.approx(albedo * lamp.mean() * edge_factor(albedo, 0.0))


def test_bounces_converge_to_the_solution_of_the_linear_system() -> None:
    lamp, albedos = np.random.default_rng(3).random(SHAPE), np.array([0.95, 0.9, 0.6, 0.1, 1, 0.8])
    share = np.repeat(albedos, CELLS**2)
    system = np.eye(6 * CELLS**2) - share[:, None] * exchange()
    solved = np.linalg.solve(system, share * lamp.ravel()).reshape(SHAPE)
    endless = bounced(lamp, albedos, None)
    np.testing.assert_allclose(endless, solved, rtol=1e-9)
    before, after = (bounced(lamp, albedos, count) for count in (3, 4))
    assert (before < after).all()
    assert (after < endless).all()
    np.testing.assert_allclose(bounced(lamp, albedos, 0).ravel(), share * lamp.ravel())
