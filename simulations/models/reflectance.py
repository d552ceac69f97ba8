"""How bright a surface looks: Lambert, Phong and Blinn-Phong reflection, and several lights.

Szeliski, 2nd ed., section 2.2.2. All light is linear. Directions are unit vectors that point
*away* from the surface: towards the light, towards the eye.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.floats import as_floats

type Array = NDArray[np.floating]

SMALLEST_RADIUS = 1e-15
"""Of a lamp: its square, and one over it, are still numbers in float32 as well."""

BRIGHTEST = 1e30
"""Of a light's colour: still a number in float32, also times that of a pixel."""


@dataclass(frozen=True, slots=True)
class DirectionalLight:
    """A light so far away that its rays are parallel, such as the sun."""

    direction: tuple[float, float, float]
    """Unit vector towards the light."""
    irradiance: tuple[float, float, float] = (1.0, 1.0, 1.0)
    """Linear RGB on a surface that faces the light."""

    def __post_init__(self) -> None:
        _check_colour("irradiance", self.irradiance)


@dataclass(frozen=True, slots=True)
class PointLight:
    """A small lamp, whose light thins out with the square of the distance."""

    position: tuple[float, float, float]
    """In the same frame and unit as the points that it lights."""
    intensity: tuple[float, float, float] = (1.0, 1.0, 1.0)
    """Linear RGB on a surface that faces the lamp at distance 1."""
    radius: float = 0.01
    """Radius of the lamp: no point is lit from nearer than this."""

    def __post_init__(self) -> None:
        _check_colour("intensity", self.intensity)


type Light = DirectionalLight | PointLight


def normalise(vectors: ArrayLike) -> Array:
    """Vectors (..., 3) scaled to length 1; a zero vector has no direction and stays zero.

    So does a vector with an entry that is infinite or NaN: nothing there is lit. The largest
    component is divided out first, so that huge and tiny vectors neither overflow nor vanish
    when they are squared.
    """
    v = as_floats(vectors)
    largest = np.abs(v).max(axis=-1, keepdims=True)
    if not np.isfinite(largest).all():
        v, largest = (
            np.where(np.isfinite(largest), v, 0),
            np.where(np.isfinite(largest), largest, 0),
        )
    scaled = v / np.where(largest > 0, largest, 1)
    length = np.sqrt(np.sum(scaled * scaled, axis=-1, keepdims=True))
    unit: Array = scaled / np.where(length > 0, length, 1)
    return unit


def cosine(a: ArrayLike, b: ArrayLike) -> Array:
    """max(0, a . b) of unit vectors (..., 3), held to at most 1.

    The upper clamp matters: in float32 the product of a unit vector with itself can exceed 1
    by an ulp, which a large shininess would blow up. A zero vector gives 0.
    """
    u, v = as_floats(a), as_floats(b)
    if u.shape[-1:] != (3,) or v.shape[-1:] != (3,):
        raise ValueError(f"vectors of shapes {u.shape} and {v.shape}; legal: both (..., 3)")
    product = u[..., 0] * v[..., 0] + u[..., 1] * v[..., 1] + u[..., 2] * v[..., 2]
    clamped: Array = np.clip(product, 0.0, 1.0)
    return clamped


def lambert(normals: ArrayLike, light: ArrayLike, albedo: ArrayLike = 1.0) -> Array:
    """Matte reflection, ``I = albedo * max(0, n . l)``: the same from every side.

    Parameters
    ----------
    normals : (..., 3)
        Unit normals. Where there is none, a zero vector gives darkness.
    light : (3,) or (..., 3)
        Unit direction towards the light. Below the horizon of a surface it lights nothing.
    albedo : broadcastable to (...)
        Fraction of the light that is reflected, 0 to 1.

    Returns
    -------
    (...) relative radiance; 1 is a white surface that faces the light.

    Raises
    ------
    ValueError
        If a single light is no unit vector, or the albedo is outside [0, 1].
    """
    n = as_floats(normals)
    shade: Array = _albedo(albedo, n.dtype) * cosine(n, _direction("light", light, n.dtype))
    return shade


def phong(
    normals: ArrayLike,
    light: ArrayLike,
    view: ArrayLike,
    albedo: ArrayLike = 1.0,
    *,
    specular: float = 0.5,
    shininess: float = 32.0,
    ambient: float = 0.0,
) -> Array:
    """Phong's model: ambient, matte, and a highlight about the mirrored light direction.

    ``I = albedo (ambient + max(0, n . l)) + specular max(0, r . v)^shininess`` with
    ``r = 2 (n . l) n - l``. The highlight is cut where the light is below the horizon.
    Shininess 0 spreads it evenly over the lit side; a very large one shrinks it to a point.

    Parameters
    ----------
    normals, light, albedo
        As for `lambert`.
    view : (3,) or (..., 3)
        Unit direction towards the eye.

    Returns
    -------
    (...) relative radiance, which may exceed 1 in the highlight.
    """
    n = as_floats(normals)
    to_light = _direction("light", light, n.dtype)
    n_dot_l = cosine(n, to_light)
    mirrored = 2 * n_dot_l[..., None] * n - to_light
    to_eye = _direction("view", view, n.dtype)
    highlight = _highlight(cosine(mirrored, to_eye), n_dot_l, specular, shininess)
    shade: Array = _matte(albedo, n_dot_l, ambient) + highlight
    return shade


def blinn_phong(
    normals: ArrayLike,
    light: ArrayLike,
    view: ArrayLike,
    albedo: ArrayLike = 1.0,
    *,
    specular: float = 0.5,
    shininess: float = 128.0,
    ambient: float = 0.0,
) -> Array:
    """Blinn's variant: the highlight follows ``n . h``, with ``h`` halfway between light and eye.

    The angle to ``h`` is about half of the angle to the mirrored light, so that a fourfold
    shininess gives a highlight of about Phong's size. Light and eye exactly opposed have no
    halfway direction, and no highlight. Parameters and return as for `phong`.
    """
    n = as_floats(normals)
    to_light = _direction("light", light, n.dtype)
    n_dot_l = cosine(n, to_light)
    halfway = normalise(to_light + _direction("view", view, n.dtype))
    highlight = _highlight(cosine(n, halfway), n_dot_l, specular, shininess)
    shade: Array = _matte(albedo, n_dot_l, ambient) + highlight
    return shade


def attenuation(distance: ArrayLike, radius: float = 0.01) -> Array:
    """Inverse-square law, ``1 / max(distance, radius)^2``: 1 at distance 1, 0 at infinity.

    Raises `ValueError` for a negative or undefined distance and for a radius of 0, whose
    light would be infinite at the lamp.
    """
    if not radius >= SMALLEST_RADIUS:
        raise ValueError(f"radius {radius}; legal: {SMALLEST_RADIUS:g} or more")
    d = as_floats(distance)
    if not np.all(d >= 0):
        raise ValueError(f"distance {d.min()}; legal: 0 or more")
    with np.errstate(over="ignore"):  # light from that far is 0 to all digits
        falloff: Array = 1.0 / np.square(np.maximum(d, radius))
    return falloff


def irradiance(points: ArrayLike, normals: ArrayLike, lights: Sequence[Light]) -> Array:
    """Light that falls on a surface from several lights, which simply add: (..., 3) linear RGB.

    ``points`` and ``normals`` (..., 3) are in the frame of the lights. Multiply by the
    albedo to get what a matte surface reflects. No light casts a shadow here.
    """
    p, n = as_floats(points), as_floats(normals)
    total: Array = np.zeros(np.broadcast_shapes(p.shape, n.shape), n.dtype)
    for light in lights:
        match light:
            case DirectionalLight():
                strength = cosine(n, _direction("light", light.direction, n.dtype))
                colour = light.irradiance
            case PointLight():
                with np.errstate(over="ignore", invalid="ignore"):
                    to_light = np.asarray(light.position, n.dtype) - p
                    distance = np.sqrt(np.sum(np.square(to_light), axis=-1))
                fall = attenuation(distance, light.radius)
                strength = cosine(n, normalise(to_light)) * fall
                colour = light.intensity
        total += strength[..., None] * np.asarray(colour, n.dtype)
    return total


def _check_colour(name: str, rgb: tuple[float, float, float]) -> None:
    if len(rgb) != 3 or not all(0 <= part <= BRIGHTEST for part in rgb):
        raise ValueError(f"{name} {rgb}; legal: three numbers from 0 to {BRIGHTEST:g}")


def _matte(albedo: ArrayLike, n_dot_l: Array, ambient: float) -> Array:
    if not 0 <= ambient < np.inf:
        raise ValueError(f"ambient {ambient}; legal: 0 or more, finite")
    matte: Array = _albedo(albedo, n_dot_l.dtype) * (ambient + n_dot_l)
    return matte


def _highlight(cosines: Array, n_dot_l: Array, specular: float, shininess: float) -> Array:
    for name, value in (("shininess", shininess), ("specular", specular)):
        if not 0 <= value < np.inf:
            raise ValueError(f"{name} {value}; legal: 0 or more, finite")
    lit: Array = np.where(n_dot_l > 0, specular * cosines**shininess, 0)
    return lit


def _direction(name: str, direction: ArrayLike, dtype: np.dtype[np.floating]) -> Array:
    """A direction in the dtype of the normals; one alone is checked, a field of them is trusted."""
    v = np.asarray(direction, dtype)
    if v.ndim == 1 and not abs(float(np.sqrt(np.sum(v * v))) - 1) < 1e-4:
        raise ValueError(f"{name} {v.tolist()}; legal: a vector of length 1")
    return v


def _albedo(albedo: ArrayLike, dtype: np.dtype[np.floating]) -> Array:
    a = np.asarray(albedo, dtype)
    if not np.all((a >= 0) & (a <= 1)):
        raise ValueError(f"albedo {a.min()} to {a.max()}; legal: 0 to 1")
    return a
