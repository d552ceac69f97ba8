"""The controls of the BRDF figure."""

from dataclasses import dataclass

from simulations.engine.settings import choice, slider

LARGEST_DEG = 88
"""Directions nearer to the horizon have almost no light."""
MODELS = {
    "microfacets": "Microfacets over matte",
    "lambert": "Matte (Lambert)",
    "phong": "Phong, as of 1975",
    "normalised": "Phong, normalised",
}


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    model: str = choice("Model", MODELS)
    light_angle: float = slider("Light angle", -50, -LARGEST_DEG, LARGEST_DEG, 1, unit="°")
    view_angle: float = slider("Camera angle", 38, -LARGEST_DEG, LARGEST_DEG, 1, unit="°")
    roughness: float = slider("Roughness m", 0.3, 0.15, 1, 0.01)
    specular: float = slider("Specular: kₛ, or F₀ head-on", 0.15, 0, 1, 0.01)
    albedo: float = slider("Albedo ρ of the matte part", 0.5, 0, 1, 0.01)
