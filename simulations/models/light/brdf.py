"""Reflectance distributions: how much of the light from one direction goes into another.

A bidirectional reflectance distribution function (BRDF) is the radiance that leaves a surface per
irradiance that falls on it, in 1/sr. Those here are isotropic: of the directions n (the normal), l
(to the light) and v (to the eye) they need the cosines n · l, n · v and l · v alone, arrays (...)
that broadcast. Below the horizon, where n · l or n · v is 0 or less, they are 0.

Szeliski, 2nd ed., section 2.2.2. Phong, "Illumination for Computer Generated Pictures", CACM 18,
1975; Lafortune and Willems, "Using the Modified Phong Reflectance Model for Physically Based
Rendering", 1994; Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR
2007; Heitz, "Understanding the Masking-Shadowing Function", JCGT 3, 2014; Schlick, "An Inexpensive
BRDF Model for Physically-based Rendering", Computer Graphics Forum 13, 1994.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_floats
from simulations.models.require import require, require_one_of

SMOOTHEST = 0.01
"""Least roughness: a mirror would be infinite in one direction, and 0 in all others."""
NEARLY_ZERO = 1e-6
"""Lower bound of cosines in denominators."""


@dataclass(frozen=True, slots=True)
class Material:
    """The parameters of a surface."""

    albedo: float
    """Share of the light that the matte part reflects, 0 to 1."""
    specular: float
    """Strength of the highlight, 0 to 1: Phong's kₛ, or the reflectance F₀ of a facet head-on."""
    roughness: float
    """Width m of the distribution of facets, `SMOOTHEST` to 1; their slopes are about as large."""

    def __post_init__(self) -> None:
        for name in ("albedo", "specular"):
            value = getattr(self, name)
            require(name, value, 0 <= value <= 1, "0 to 1")
        legal = f"{SMOOTHEST:g} to 1"
        require("roughness", self.roughness, SMOOTHEST <= self.roughness <= 1, legal)

    @property
    def shininess(self) -> float:
        """Exponent of the Phong lobe that is about as wide as the reflection of the facets."""
        return 0.5 * (1.0 / self.roughness**2 - 1.0)


type Parts = tuple[Floats, Floats]
"""The matte part for an albedo of 1, and the specular part, in 1/sr."""


def _lambert(n_l: Floats, n_v: Floats, l_v: Floats, _of: Material) -> Parts:
    """ρ/π: the same in all directions."""
    return _matte(n_l), np.zeros(np.broadcast_shapes(n_l.shape, n_v.shape, l_v.shape), n_l.dtype)


def _phong(n_l: Floats, n_v: Floats, l_v: Floats, of: Material) -> Parts:
    """Phong's model of 1975. His formula is for radiance; divided by n · l, it is a BRDF."""
    lobe = _mirrored(n_l, n_v, l_v) ** of.shininess
    return _matte(n_l), of.specular / np.pi * lobe / np.maximum(n_l, NEARLY_ZERO)


def _normalised_phong(n_l: Floats, n_v: Floats, l_v: Floats, of: Material) -> Parts:
    """Phong's model without that division, with a lobe that reflects kₛ of the light at normal
    incidence."""
    lobe = _mirrored(n_l, n_v, l_v) ** of.shininess
    return _matte(n_l), of.specular / np.pi * (0.5 * of.shininess + 1.0) * lobe


def _microfacets(n_l: Floats, n_v: Floats, l_v: Floats, of: Material) -> Parts:
    """F D G / (4 n·l n·v) over a matte body, lit and seen through the surface."""
    half = np.sqrt(np.maximum(2.0 + 2.0 * l_v, NEARLY_ZERO))
    n_h = np.minimum((n_l + n_v) / half, 1.0)
    mirror = schlick(0.5 * half, of.specular) * facets(n_h, of.roughness)
    passed = (1.0 - schlick(n_l, of.specular)) * (1.0 - schlick(n_v, of.specular))
    return passed / np.pi, mirror * unhidden(n_l, n_v, of.roughness)


MODELS: Mapping[str, Callable[[Floats, Floats, Floats, Material], Parts]] = {
    "lambert": _lambert,
    "phong": _phong,
    "normalised": _normalised_phong,
    "microfacets": _microfacets,
}


def reflected(
    model: str, material: Material, n_l: ArrayLike, n_v: ArrayLike, l_v: ArrayLike
) -> Floats:
    """The BRDF (...) in 1/sr. Raises `ValueError` for a model that is not in `MODELS`."""
    matte, mirrored = parts(model, material, n_l, n_v, l_v)
    return material.albedo * matte + mirrored


def parts(model: str, material: Material, n_l: ArrayLike, n_v: ArrayLike, l_v: ArrayLike) -> Parts:
    """The two parts of the BRDF, which may have different colours: see `Parts`."""
    require_one_of("model", model, MODELS)
    light, eye, between = as_floats(n_l), as_floats(n_v), as_floats(l_v)
    above = (light > 0) & (eye > 0)
    matte, mirrored = MODELS[model](np.maximum(light, 0), np.maximum(eye, 0), between, material)
    return np.where(above, matte, 0), np.where(above, mirrored, 0)


def schlick(cosine: Floats, head_on: float) -> Floats:
    """Share of the light that a smooth facet reflects, ``F₀ + (1 − F₀)(1 − cos θ)⁵``.

    Schlick's approximation to Fresnel's formulae; ``cosine`` (...) is that of the angle to the
    facet's normal, 0 to 1.
    """
    off = 1.0 - cosine
    square = off * off
    return head_on + (1.0 - head_on) * square * square * off


def facets(n_h: Floats, roughness: float) -> Floats:
    """Density of facets (...) in 1/sr whose normal is h (Trowbridge and Reitz, "GGX")."""
    square = roughness * roughness
    spread = 1.0 - (1.0 - square) * n_h * n_h
    return square / (np.pi * spread * spread)


def unhidden(n_l: Floats, n_v: Floats, roughness: float) -> Floats:
    """Share of facets (...) that are hidden neither from the light nor from the eye, over 4 n·l
    n·v.

    Smith's function for correlated heights. The quotient is finite at grazing angles.
    """
    square = roughness * roughness
    to_light = n_v * np.sqrt(square + (1.0 - square) * n_l * n_l)
    to_eye = n_l * np.sqrt(square + (1.0 - square) * n_v * n_v)
    return 0.5 / np.maximum(to_light + to_eye, NEARLY_ZERO)


def _matte(n_l: Floats) -> Floats:
    return np.full(n_l.shape, 1.0 / np.pi, n_l.dtype)


def _mirrored(n_l: Floats, n_v: Floats, l_v: Floats) -> Floats:
    """max(0, r · v), from the cosines: r = 2 (n · l) n − l."""
    return np.clip(2.0 * n_l * n_v - l_v, 0.0, 1.0)


AROUND, UP = 48, 64
"""Directions of the quadrature around half of the normal, and from the normal to the horizon."""


@cache
def _hemisphere() -> tuple[Floats, Floats, Floats]:
    """Cosines of the angles around (AROUND,) and from the normal (UP,), and weights (UP, AROUND).

    Gauss–Legendre quadrature in both angles. The weights include the cosine of the irradiance, the
    sine of the sphere, and both halves of the circle: they sum to π.
    """
    x, across = np.polynomial.legendre.leggauss(AROUND)
    y, down = np.polynomial.legendre.leggauss(UP)
    polar = 0.25 * np.pi * (y + 1.0)
    weights = 2.0 * (0.25 * np.pi * down * np.sin(polar) * np.cos(polar))[:, None]
    return np.cos(0.5 * np.pi * (x + 1.0)), np.cos(polar), weights * (0.5 * np.pi * across)


def sent_back(model: str, material: Material, n_l: ArrayLike) -> Floats:
    """Share (...) of the light from one direction that is reflected in any direction.

    The *directional-hemispherical reflectance*: the integral of the BRDF times n · v over all
    directions v of the hemisphere, by quadrature. More than 1 violates conservation of energy.

    For a roughness of 0.15 or more it is good to 0.0005 for microfacets, and to 1 % of itself for
    Phong's lobes: near a roughness of 1 their exponent is close to 0, and they end in a step
    between the directions. Lobes narrower than 0.15 fall between the directions as a whole.
    """
    cosines = as_floats(n_l)
    around, eye, weights = _hemisphere()
    light = cosines[..., None, None]
    sines = np.sqrt(np.maximum(1.0 - light * light, 0.0)) * np.sqrt(1.0 - eye * eye)[:, None]
    between = light * eye[:, None] + sines * around
    found = reflected(model, material, light, eye[:, None], between)
    return np.asarray((found * weights).sum(axis=(-2, -1)))
