"""The light of a glossy ball, by Phong's model and by Blinn's variant of it.

Light, camera and the probed point are in the horizontal plane through the ball's centre, at angles
from the camera's direction.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats
from simulations.models.light.reflectance import blinn_phong, lambert, phong
from simulations.scenes._ball.ball import Ball, light_direction, true_cosine, true_normals

ALBEDO = np.array([0.60, 0.06, 0.05], np.float32)
"""Linear RGB of the ball's paint; the plot and the readouts follow red, the first."""
VIEW = (0.0, 0.0, 1.0)
"""Unit vector towards the camera, which is far away: the same for every point."""


@dataclass(frozen=True, slots=True)
class Model:
    """A model of a highlight as a power of a cosine."""

    name: str
    cosine: str
    """The cosine, in the letters of the plot."""
    light: Callable[..., Floats]
    turn: float
    """Turn of the camera per increase of the cosine's angle."""
    true_cosine: Callable[[Ball, float], Floats]
    """Computes the cosine (h, w) in float64, for the angle of a light."""


def _mirrored_camera(ball: Ball, light_angle: float) -> Floats:
    """r · v, with the camera mirrored in place of the light."""
    normals = true_normals(ball)
    return (2 * normals[..., 2:] * normals - np.array(VIEW)) @ light_direction(light_angle)


def _halved_angle(ball: Ball, light_angle: float) -> Floats:
    """n · h, with h at half the light's angle."""
    return true_cosine(ball, light_angle / 2)


MODELS: Mapping[str, Model] = {
    "phong": Model("Phong", "r · v", phong, 1, _mirrored_camera),
    "blinn_phong": Model("Blinn–Phong", "n · h", blinn_phong, 2, _halved_angle),
}


def highlight(
    normals: Floats, light_angle: float, view: Floats, model: str, shininess: float
) -> Floats:
    """The second term of the model alone, for a strength of 1."""
    return MODELS[model].light(
        normals, light_direction(light_angle), view, 0.0, specular=1.0, shininess=shininess
    )


def half_width_rad(model: str, shininess: float) -> float:
    """Turn of the camera, in the plane of n and l, that halves the highlight.

    A turn of the camera turns ``h`` by only half as much, so that Blinn's lobe is twice as wide:
    at a shininess of 1, the least that there is here, 120°.
    """
    return MODELS[model].turn * math.acos(2 ** (-1 / shininess))


def shininess_of_width(model: str, turn_rad: float) -> float:
    """The shininess with that half-width, which is above 0 and below a right angle."""
    return math.log(0.5) / math.log(math.cos(turn_rad / MODELS[model].turn))


def fading(model: str, shininess: float, turn_rad: Floats) -> Floats:
    """The highlight (...) as a share of its middle, to a camera that turns away in the plane of n
    and l, by less than a right angle."""
    return np.cos(turn_rad / MODELS[model].turn) ** shininess


@dataclass(frozen=True, slots=True)
class Angles:
    """Cosines at the probed point, none of them clamped."""

    n_dot_l: float
    r_dot_v: float
    n_dot_h: float
    """nan if light and camera are exactly opposed, without a halfway direction."""


def angles_at(light_angle: float, probe: float) -> Angles:
    """All directions are in one plane, so that each cosine is that of a difference of angles."""
    light_rad, normal_rad = math.radians(light_angle), math.radians(probe)
    turn = math.remainder(light_rad, 2 * math.pi)
    opposed = abs(light_angle) == 180
    return Angles(
        math.cos(light_rad - normal_rad),
        math.cos(2 * normal_rad - light_rad),
        math.nan if opposed else math.cos(normal_rad - turn / 2),
    )


def brightness_at(
    light_angle: float, probe: float, model: str, shininess: float, specular: float
) -> tuple[float, float]:
    """Matte part and highlight of the probed point, in red light."""
    normal = light_direction(probe)
    shine = highlight(normal, light_angle, np.array(VIEW), model, shininess)
    matte = lambert(normal, light_direction(light_angle), ALBEDO[0])
    return float(matte), specular * float(shine)


def lobe(light: float, model: str, shininess: float, specular: float) -> Floats:
    """Brightness (181,) that cameras at −90°…90° from the normal would see at a point.

    ``light`` is its angle from the normal, too.
    """
    around = np.radians(np.arange(-90.0, 91.0))
    cameras = np.stack([np.sin(around), np.zeros_like(around), np.cos(around)], axis=-1)
    normals = np.broadcast_to(np.array(VIEW), cameras.shape)
    shine = highlight(normals, light, cameras, model, shininess)
    matte = float(ALBEDO[0]) * max(0.0, math.cos(math.radians(light)))
    return matte + specular * shine


def true_light(
    ball: Ball, light_angle: float, model: str, shininess: float, specular: float
) -> NDArray[np.float64]:
    """Red light (h, w) in float64.

    If light and camera are exactly opposed, no visible point is lit.
    """
    n_dot_l = true_cosine(ball, light_angle)
    cosine = MODELS[model].true_cosine(ball, light_angle)
    red = float(ALBEDO[0]) * n_dot_l + specular * np.maximum(cosine, 0.0) ** shininess
    return np.where((n_dot_l > 0) & (abs(light_angle) < 180), red, 0.0)
