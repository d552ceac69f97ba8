"""The controls of the BRDF figure."""

from dataclasses import dataclass

from simulations.engine.settings import choice, slider

LARGEST_DEG = 88
"""Directions nearer to the horizon have almost no light."""
SMOOTHEST, ROUGHEST = 0.15, 1.0
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
    light_angle: float = slider("Light angle", -40, -LARGEST_DEG, LARGEST_DEG, 1, unit="°")
    view_angle: float = slider("Camera angle", 20, -LARGEST_DEG, LARGEST_DEG, 1, unit="°")
    roughness: float = slider("Roughness m", 0.3, SMOOTHEST, ROUGHEST, 0.01)
    specular: float = slider("Specular strength kₛ or F₀", 0.15, 0, 1, 0.01)
    albedo: float = slider("Albedo ρ of the matte part", 0.5, 0, 1, 0.01)
