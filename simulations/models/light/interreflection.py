"""Light between two matte planes that meet in an edge: shadows, and bounce after bounce.

The planes are strips of width 1, infinite along their common edge, so that the problem is
two-dimensional. ``opening_rad`` is the angle between them, on the lit side. Positions are distances
from the edge, 0 to 1. Brightness is radiosity: 1 for a perfect white that faces the lamp.

Szeliski, 2nd ed., section 2.2.2; Goral et al., "Modeling the Interaction of Light Between Diffuse
Surfaces", SIGGRAPH 1984; Hottel and Sarofim, Radiative Transfer, 1967 (crossed strings).
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_array
from simulations.models.require import as_whole, require

CELLS = 40
"""Strips per plane, narrower towards the edge."""
EDGES: Floats = np.linspace(0.0, 1.0, CELLS + 1) ** 2
"""(CELLS + 1,) their borders."""


def lamp_light(places: ArrayLike, light_rad: float, opening_rad: float) -> Floats:
    """Irradiance (...) of one plane by a distant lamp, with the shadow of the other plane.

    ``light_rad`` counts from the plane, on the side of the other: 0 grazes it, π/2 stands over it,
    and above ``opening_rad`` the lamp is behind the other plane. 0 where it is below this one.
    """
    _check_opening(opening_rad)
    at = np.asarray(places, float)
    return _over(light_rad) * (at >= shadow_end(light_rad, opening_rad))


def shadow_end(light_rad: float, opening_rad: float) -> float:
    """Distance from the edge to the end of the other plane's shadow; 0 without one, at most ∞."""
    if light_rad <= opening_rad or _over(light_rad) == 0.0:
        return 0.0
    return float(np.sin(light_rad - opening_rad) / np.sin(light_rad))


def mean_lamp_light(light_rad: float, opening_rad: float) -> Floats:
    """(CELLS,) irradiance of each strip; the strip at the shadow's border is partly lit."""
    end = np.clip(shadow_end(light_rad, opening_rad), 0.0, 1.0)
    lit = (EDGES[1:] - np.clip(end, EDGES[:-1], EDGES[1:])) / np.diff(EDGES)
    return _over(light_rad) * lit


def seen_of(places: ArrayLike, opening_rad: float) -> Floats:
    """Form factors (..., CELLS) of the strips of the other plane, seen from places on one plane.

    They are weighted by the cosine to the normal, with sum 1 over all directions: half the
    difference of the sines at which the borders of a strip are seen; at the edge itself, the limit.
    """
    _check_opening(opening_rad)
    at = np.maximum(np.asarray(places, float), 1e-9)[..., None]
    along = EDGES * np.cos(opening_rad) - at
    sines = along / np.hypot(along, EDGES * np.sin(opening_rad))
    return np.maximum(0.5 * np.diff(sines, axis=-1), 0.0)


def exchange(opening_rad: float) -> Floats:
    """(CELLS, CELLS) mean form factors from the strips of one plane to those of the other.

    Hottel's crossed strings: the crossed ones minus the uncrossed ones, over twice the width.
    """
    _check_opening(opening_rad)
    here, there = EDGES[:, None], EDGES
    square = here**2 + there**2 - 2.0 * here * there * np.cos(opening_rad)
    strings = np.sqrt(np.maximum(square, 0.0))
    crossed = strings[:-1, 1:] + strings[1:, :-1] - strings[:-1, :-1] - strings[1:, 1:]
    return 0.5 * crossed / np.diff(EDGES)[:, None]


def bounced(
    direct: ArrayLike, albedos: ArrayLike, opening_rad: float, bounces: int | None
) -> Floats:
    """Brightness (2, CELLS) of both planes after some bounces between them, or after infinitely
    many.

    Parameters
    ----------
    direct : (2, CELLS) irradiance by the lamp of either plane
    albedos : (2,) from 0 to 1
    bounces : count of passages of light from one plane to the other; ``None`` for infinitely many,
        by a linear system.
    """
    lamp = as_array("direct", direct, 2, CELLS)
    share = as_array("albedos", albedos, 2)
    require("albedos", share, ((share >= 0) & (share <= 1)).all(), "0 to 1")
    across = exchange(opening_rad)
    first = share[:, None] * lamp
    if bounces is not None:
        light = first
        for _ in range(as_whole("bounces", bounces, 0)):
            light = first + share[:, None] * (light[::-1] @ across.T)
        return light
    # Light returns to the floor by way of the wall.
    twice = share.prod() * across @ across
    floor = np.linalg.solve(np.eye(CELLS) - twice, first[0] + share[0] * across @ first[1])
    return np.stack([floor, first[1] + share[1] * across @ floor])


def edge_factor(albedo: float, opening_rad: float) -> float:
    """Brightness of the edge relative to the lamp's light alone, for equal and lit planes.

    Next to the edge the other plane fills the share V = (1 + cos φ)/2 of each point's view, and is
    as bright as the point itself: B = I + ρVB, which is I/(1 − ρV).
    """
    _check_opening(opening_rad)
    require("albedo", albedo, 0 <= albedo <= 1, "0 to 1")
    lost = 1.0 - albedo * 0.5 * (1.0 + math.cos(opening_rad))
    return 1.0 / lost if lost > 0.0 else math.inf


def _over(light_rad: float) -> float:
    """Cosine to the plane's normal; 0 below it."""
    require("light_rad", light_rad, -np.pi <= light_rad <= np.pi, "-π to π")
    return float(np.sin(light_rad)) if 0.0 < light_rad < np.pi else 0.0


def _check_opening(opening_rad: float) -> None:
    require("opening_rad", opening_rad, 0.0 < opening_rad < np.pi, "above 0, below π")
