"""Reflectance distributions: written out with vectors, integrated by SciPy, and by their laws."""

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import dblquad

from simulations.models.light import brdf
from simulations.models.light.brdf import (
    MODELS,
    Material,
    parts,
    reflected,
    sent_back,
)
from simulations.models.light.reflectance import phong

SATIN = Material(0.5, 0.3, 0.4)
RNG = np.random.default_rng(2)


def directions(count: int) -> NDArray[np.float64]:
    """(count, 3) unit vectors above the surface z = 0."""
    vectors = RNG.normal(size=(count, 3))
    vectors[:, 2] = np.abs(vectors[:, 2]) + 0.05
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1, keepdims=True))


LIGHTS, EYES = directions(200), directions(200)
N_L, N_V, L_V = LIGHTS[:, 2], EYES[:, 2], np.sum(LIGHTS * EYES, axis=1)


def test_phong_as_of_1975_is_the_radiance_of_the_older_model_over_the_irradiance() -> None:
    normals = np.broadcast_to([0.0, 0.0, 1.0], (200, 3))
    radiance = phong(normals, LIGHTS, EYES, 0.5, specular=0.3, shininess=SATIN.shininess)
    found = reflected("phong", SATIN, N_L, N_V, L_V)
    np.testing.assert_allclose(found * np.pi * N_L, radiance, rtol=1e-9)


def test_microfacets_are_those_of_walter_and_heitz() -> None:
    """Written out with vectors; the masking by the two Λ of Smith."""
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
def test_nothing_comes_from_below_and_nothing_goes_there(model: str) -> None:
    cosines = np.array([-0.5, 0.0, 0.5])
    found = reflected(model, SATIN, cosines[:, None], cosines, 0.3)
    assert (found > 0).tolist() == [[False] * 3, [False] * 3, [False, False, True]]


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("roughness", [0.15, 0.5])
@pytest.mark.parametrize("angle", [0.0, 50.0, 85.0])
def test_what_is_sent_back_is_scipys_integral(model: str, roughness: float, angle: float) -> None:
    material = Material(0.4, 0.2, roughness)
    light, sine = np.cos(np.radians(angle)), np.sin(np.radians(angle))

    def sent(around: float, polar: float) -> float:
        eye = np.cos(polar)
        between = light * eye + sine * np.sin(polar) * np.cos(around)
        # Above the surface: at its rim the cosine is 6e-17.
        return float(reflected(model, material, light, eye, between)) * eye * np.sin(polar)

    whole = 2 * dblquad(sent, 0, np.pi / 2, 0, np.pi, epsabs=2e-4, epsrel=2e-4)[0]
    assert sent_back(model, material, light) == pytest.approx(whole, abs=1e-3)


@pytest.mark.parametrize(("roughness", "angle"), [(0.15, 88.0), (0.15, 89.5), (0.3, 89.5)])
def test_facets_send_back_what_ten_times_as_many_directions_say(
    roughness: float, angle: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    metal, cosine = Material(0.0, 1.0, roughness), np.cos(np.radians(angle))
    found = sent_back("microfacets", metal, cosine)
    monkeypatch.setattr(brdf, "AROUND", 480)
    monkeypatch.setattr(brdf, "UP", 640)
    brdf._hemisphere.cache_clear()
    finer = sent_back("microfacets", metal, cosine)
    brdf._hemisphere.cache_clear()
    assert found == pytest.approx(finer, abs=5e-4)
