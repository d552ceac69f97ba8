"""The controls of the Phong figure."""

from dataclasses import dataclass

from simulations.engine.settings import choice, slider
from simulations.scenes.phong.gloss import MODELS


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    light_angle: float = slider("Light angle", 60, -180, 180, 1, unit="°")
    probe: float = slider("Probed point", 20, -90, 90, 1, unit="°")
    shininess: float = slider("Shininess α", 20, 1, 500, 1)
    specular: float = slider("Specular strength kₛ", 0.6, 0, 1, 0.05)
    model: str = choice(
        "Model", {name: f"{model.name} ({model.cosine})" for name, model in MODELS.items()}
    )
