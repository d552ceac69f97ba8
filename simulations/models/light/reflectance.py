"""How bright a surface looks: Lambert, Phong and Blinn-Phong reflection, and several lights.

Szeliski, 2nd ed., section 2.2.2. All light is linear. Directions are unit vectors that point
*away* from the surface: towards the light, towards the eye.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_floats
from simulations.models.require import require

SMALLEST_RADIUS = 1e-15
"""Least radius of a lamp: its square and the inverse of that are finite in float32 too."""

UNIT_TOLERANCE = 1e-4
"""Tolerance for the length of a direction, which should be 1."""

SHARPEST = 1e30
"""Largest shininess, finite in float32: a cosine of 1 has the power 1, all others have 0."""

BRIGHTEST = 1e30
"""Largest colour of a light: finite in float32, also times that of a pixel."""


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
    """A small lamp, whose light falls with the square of the distance."""

    position: tuple[float, float, float]
    """Position in the frame and unit of the lit points."""
    intensity: tuple[float, float, float] = (1.0, 1.0, 1.0)
    """Linear RGB on a surface that faces the lamp at distance 1."""
    radius: float = 0.01
    """Radius of the lamp: the least distance to a lit point."""

    def __post_init__(self) -> None:
        _check_colour("intensity", self.intensity)


type Light = DirectionalLight | PointLight


def normalise(vectors: ArrayLike) -> Floats:
    """Vectors (..., 3) scaled to length 1; a zero vector has no direction and stays zero.

    Vectors with an entry that is infinite or NaN become zero. The largest component is divided out
    first, so that huge and tiny vectors neither overflow nor vanish when they are squared.
    """
    v = as_floats(vectors)
    largest = _largest(v)
    if not np.isfinite(largest).all():
        v = np.where(np.isfinite(largest)[..., None], v, 0)
        largest = _largest(v)
    scaled = v / np.where(largest > 0, largest, 1)[..., None]
    length = np.sqrt(_dot(scaled, scaled))
    return scaled / np.where(length > 0, length, 1)[..., None]


def cosine(a: ArrayLike, b: ArrayLike) -> Floats:
    """max(0, a . b) of unit vectors (..., 3), at most 1.

    The upper clamp matters: in float32 the product of a unit vector with itself can exceed 1 by an
    ulp, which a large shininess would blow up. A zero vector gives 0.
    """
    u, v = as_floats(a), as_floats(b)
    if u.shape[-1:] != (3,) or v.shape[-1:] != (3,):
        raise ValueError(f"vectors of shapes {u.shape} and {v.shape}; legal: both (..., 3)")
    return np.clip(_dot(u, v), 0.0, 1.0)


def lambert(normals: ArrayLike, light: ArrayLike, albedo: ArrayLike = 1.0) -> Floats:
    """Matte reflection, ``I = albedo * max(0, n . l)``: the same from every side.

    Parameters
    ----------
    normals : (..., 3)
        Unit normals; a zero vector is dark.
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
        If a single light is not a unit vector, or the albedo is outside [0, 1].
    """
    n = as_floats(normals)
    return _albedo(albedo, n.dtype) * cosine(n, _direction("light", light, n.dtype))


def phong(
    normals: ArrayLike,
    light: ArrayLike,
    view: ArrayLike,
    albedo: ArrayLike = 1.0,
    *,
    specular: ArrayLike = 0.5,
    shininess: ArrayLike = 32.0,
    ambient: float = 0.0,
) -> Floats:
    """Phong's model: ambient, matte, and a highlight about the mirrored light direction.

    ``I = albedo (ambient + max(0, n . l)) + specular max(0, r . v)^shininess`` where ``n . l > 0``,
    with ``r = 2 (n . l) n - l``. Where ``n . l <= 0`` the light is below the horizon, and the
    ambient part alone is left. Shininess 0 spreads the highlight evenly over the lit side; a very
    large one shrinks it to a point. An eye without direction (a zero vector in a field of them)
    sees no highlight.

    Parameters
    ----------
    normals, light, albedo
        As for `lambert`.
    view : (3,) or (..., 3)
        Unit direction towards the eye.
    specular, shininess : broadcastable to (...)
        Strength of the highlight, and the power that makes it narrow.

    Returns
    -------
    (...) relative radiance: up to ``albedo (ambient + 1) + specular``, which may exceed 1.
    A power multiplies the rounding of the cosine: the highlight errs by up to
    ``10 max(shininess, 1) specular`` times the precision of the floats. Likewise for errors in the
    length of a vector.
    """
    n = as_floats(normals)
    to_light = _direction("light", light, n.dtype)
    to_eye = _direction("view", view, n.dtype)
    n_dot_l = cosine(n, to_light)
    # r . v from the cosines, without an array of mirrored rays.
    r_dot_v = np.clip(2 * n_dot_l * _dot(n, to_eye) - _dot(to_light, to_eye), 0.0, 1.0)
    lit = (n_dot_l > 0) & to_eye.any(axis=-1)
    shade: Floats = _matte(albedo, n_dot_l, ambient)
    return shade + _highlight(r_dot_v, lit, specular, shininess)


def blinn_phong(
    normals: ArrayLike,
    light: ArrayLike,
    view: ArrayLike,
    albedo: ArrayLike = 1.0,
    *,
    specular: ArrayLike = 0.5,
    shininess: ArrayLike = 128.0,
    ambient: float = 0.0,
) -> Floats:
    """Blinn's variant: the highlight follows ``n . h``, with ``h`` halfway between light and eye.

    ``I = albedo (ambient + max(0, n . l)) + specular max(0, n . h)^shininess`` where ``n . l > 0``,
    with ``h = (l + v) / |l + v|``; elsewhere as for `phong`.

    The angle to ``h`` is about half of the angle to the mirrored light, so that a fourfold
    shininess gives a highlight of about Phong's size. If light and eye are opposed, to a hundredth
    of a degree (`UNIT_TOLERANCE`), there is no halfway direction and no highlight. Parameters and
    return as for `phong`; the halfway direction loses digits as light and eye come near to opposed,
    as one over ``|l + v|``.
    """
    n = as_floats(normals)
    to_light = _direction("light", light, n.dtype)
    to_eye = _direction("view", view, n.dtype)
    n_dot_l = cosine(n, to_light)
    between = to_light + to_eye
    square = _dot(between, between)
    lit = (n_dot_l > 0) & to_eye.any(axis=-1) & (square > (2 * UNIT_TOLERANCE) ** 2)
    n_dot_h = np.clip(_dot(n, between) / np.sqrt(np.where(lit, square, 1)), 0.0, 1.0)
    shade: Floats = _matte(albedo, n_dot_l, ambient)
    return shade + _highlight(n_dot_h, lit, specular, shininess)


def attenuation(distance: ArrayLike, radius: float = 0.01) -> Floats:
    """Inverse-square law, ``1 / max(distance, radius)^2``: 1 at distance 1, 0 at infinity.

    Raises `ValueError` for a negative or undefined distance and for a radius of 0, whose
    light would be infinite at the lamp.
    """
    require("radius", radius, radius >= SMALLEST_RADIUS, f"{SMALLEST_RADIUS:g} or more")
    d = as_floats(distance)
    if not np.all(d >= 0):
        raise ValueError(f"distance {d.min()}; legal: 0 or more")
    with np.errstate(over="ignore"):  # light from that distance is 0 to all digits
        return 1.0 / np.square(np.maximum(d, radius))


def irradiance(points: ArrayLike, normals: ArrayLike, lights: Sequence[Light]) -> Floats:
    """Light that falls on a surface from several lights, which simply add: (..., 3) linear RGB.

    ``points`` and ``normals`` (..., 3) are in the frame of the lights. Multiply by the
    albedo to get what a matte surface reflects. No light casts a shadow here.
    """
    p, n = as_floats(points), as_floats(normals)
    total: Floats = np.zeros(np.broadcast_shapes(p.shape, n.shape), n.dtype)
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


def _dot(u: Floats, v: Floats) -> Floats:
    """(...) from (..., 3): component by component, which NumPy does faster than a short sum."""
    return u[..., 0] * v[..., 0] + u[..., 1] * v[..., 1] + u[..., 2] * v[..., 2]


def _largest(v: Floats) -> Floats:
    """(...) the largest magnitude of the components of (..., 3); NaN where one is NaN."""
    size = np.abs(v)
    return np.maximum(np.maximum(size[..., 0], size[..., 1]), size[..., 2])


def _check_colour(name: str, rgb: tuple[float, float, float]) -> None:
    legal = len(rgb) == 3 and all(0 <= part <= BRIGHTEST for part in rgb)
    require(name, rgb, legal, f"three numbers from 0 to {BRIGHTEST:g}")


def _matte(albedo: ArrayLike, n_dot_l: Floats, ambient: float) -> Floats:
    require("ambient", ambient, 0 <= ambient < np.inf, "0 or more, finite")
    return _albedo(albedo, n_dot_l.dtype) * (ambient + n_dot_l)


def _highlight(cosines: Floats, lit: Mask, specular: ArrayLike, shininess: ArrayLike) -> Floats:
    """The power where ``lit``, else 0: the cosine is 0 there, whose power 0 would be 1. Powers
    below the normal numbers, which take long, are 0 as well."""
    for name, value in (("shininess", shininess), ("specular", specular)):
        sizes = np.asarray(value, float)
        require(name, value, ((sizes >= 0) & (sizes < np.inf)).all(), "0 or more, finite")
    power = np.minimum(shininess, SHARPEST).astype(cosines.dtype)
    with np.errstate(divide="ignore", invalid="ignore"):
        normal = power * np.log(cosines) >= np.log(np.finfo(cosines.dtype).tiny)
    shines = lit & (normal | (power == 0))
    dark = np.zeros(np.broadcast_shapes(cosines.shape, power.shape), cosines.dtype)
    powers = np.power(cosines, power, out=dark, where=shines)
    return np.asarray(np.asarray(specular, cosines.dtype) * powers)


def _direction(name: str, direction: ArrayLike, dtype: np.dtype[np.floating]) -> Floats:
    """A direction in the dtype of the normals. A single one is checked, a field of them is not."""
    v = np.asarray(direction, dtype)
    unit = v.ndim != 1 or abs(float(np.sqrt(np.sum(v * v))) - 1) < UNIT_TOLERANCE
    require(name, v, unit, "a vector of length 1")
    return v


def _albedo(albedo: ArrayLike, dtype: np.dtype[np.floating]) -> Floats:
    a = np.asarray(albedo, dtype)
    if not np.all((a >= 0) & (a <= 1)):
        raise ValueError(f"albedo {a.min()} to {a.max()}; legal: 0 to 1")
    return a
