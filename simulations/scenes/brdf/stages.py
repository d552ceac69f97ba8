"""The stages of the BRDF figure: a ball of the material, its lobe, and the reflected share.

All directions of the lobe are in the plane of the light and the normal; angles are from the normal,
positive to the right.
"""

from dataclasses import dataclass

import numpy as np

from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.light.brdf import Material, reflected, sent_back
from simulations.scenes.brdf.materials import BALL, chart, lit_samples, with_ball
from simulations.scenes.brdf.spheres import Lit, lit

AROUND_DEG = np.arange(-89.0, 90.0, 2.0)
"""(90,) cameras of the lobe."""
INCIDENCE_DEG = np.arange(0.0, 89.0, 4.0)
"""(23,) lights of the curve of the reflected share."""


@dataclass(frozen=True, slots=True)
class Exchange:
    """The BRDF at the probed point, in both directions."""

    there: float
    """BRDF from the light to the camera, 1/sr."""
    back: float
    """BRDF from the camera to the light, 1/sr."""
    sent: float
    """Share of the light that is reflected in all directions together."""


def _material(albedo: float, specular: float, roughness: float) -> Material:
    return Material(albedo, specular, roughness)


def _between(model: str, material: Material, light_deg: float, view_deg: Floats) -> Floats:
    light, view = np.radians(light_deg), np.radians(view_deg)
    return reflected(model, material, np.cos(light), np.cos(view), np.cos(light - view))


def _lobe(material: Material, model: str, light_angle: float) -> Floats:
    """Brightness (90,) that each camera sees; 1 is a perfect white that faces the light."""
    shade = np.cos(np.radians(light_angle))
    return np.pi * shade * _between(model, material, light_angle, AROUND_DEG)


def _exchange(material: Material, model: str, light_angle: float, view_angle: float) -> Exchange:
    view = np.array([view_angle])
    return Exchange(
        float(_between(model, material, light_angle, view)[0]),
        float(_between(model, material, view_angle, np.array([light_angle]))[0]),
        float(sent_back(model, material, np.cos(np.radians(light_angle)))),
    )


def _curve(material: Material, model: str) -> Floats:
    """(23,) reflected share, by the angle of the light."""
    return sent_back(model, material, np.cos(np.radians(INCIDENCE_DEG)))


def _light(
    model: str, specular: float, roughness: float, light_angle: float, view_angle: float
) -> Lit:
    """The light of the ball of the chosen material."""
    return lit(BALL, model, specular, roughness, light_angle, view_angle)


STAGES = (
    Stage("material", _material),
    Stage("lobe", _lobe, ("material",)),
    Stage("exchange", _exchange, ("material",)),
    Stage("sent back", _curve, ("material",)),
    Stage("samples", lit_samples),
    Stage("chart", chart, ("samples",)),
    Stage("light", _light),
    Stage("picture", with_ball, ("chart", "light")),
)
