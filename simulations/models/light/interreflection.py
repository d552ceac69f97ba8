"""Light between the six matte walls of a closed room: bounce after bounce.

The room is a cube of side 1. Its faces are x = 0, x = 1, y = 0, y = 1, z = 0 and z = 1, in this
order, cut into `CELLS`² square patches; a patch [face, i, j] counts along the other two axes, in
alphabetical order. Brightness is radiosity: 1 for a perfect white with an irradiance of 1.

Szeliski, 2nd ed., section 2.2.2; Goral et al., "Modeling the Interaction of Light Between Diffuse
Surfaces", SIGGRAPH 1984; Ehlert and Smith, "View factors for perpendicular and parallel rectangular
plates", Journal of Thermophysics and Heat Transfer 7(1), 1993.
"""

import math
from functools import cache
from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_array
from simulations.models.require import as_whole, require

CELLS = 8
"""Patches along a side of a wall."""
SHAPE = (6, CELLS, CELLS)
SERIES = 32
"""Bounces after which each is taken for the same share of the one before."""


@cache
def exchange() -> Floats:
    """(6 · CELLS², 6 · CELLS²) form factors: the share of a patch's view that another one fills.

    Each row has the sum 1: a closed room has nothing else to see.
    """
    factors = np.zeros((6, 6, *[CELLS] * 4))
    aside, facing = _perpendicular(), _parallel()
    for one, other in product(range(6), repeat=2):
        (i, at_one), (j, at_other) = divmod(one, 2), divmod(other, 2)
        if one == other:
            continue
        if i == j:
            factors[one, other] = facing
            continue
        k = 3 - i - j  # the axis of their common edge
        turned = aside[:: -1 if at_other else 1, :, :: -1 if at_one else 1]
        turned = turned.swapaxes(0, 1) if j > k else turned
        factors[one, other] = turned.swapaxes(2, 3) if i > k else turned
    return factors.transpose(0, 2, 3, 1, 4, 5).reshape(6 * CELLS**2, 6 * CELLS**2)


def _corners() -> tuple[Floats, Floats, Floats, Floats]:
    """The borders of the patches, along four axes."""
    a, b, c, d = np.meshgrid(*[np.linspace(0.0, 1.0, CELLS + 1)] * 4, indexing="ij", sparse=True)
    return a, b, c, d


def _parallel() -> Floats:
    """(CELLS, CELLS, CELLS, CELLS) between two walls that face each other."""
    x, y, there_x, there_y = _corners()
    p, q = x - there_x, y - there_y
    far, high = np.hypot(p, 1.0), np.hypot(q, 1.0)
    whole = q * far * np.arctan(q / far) + p * high * np.arctan(p / high)
    return _patches(whole - 0.5 * np.log(1.0 + p * p + q * q))


def _perpendicular() -> Floats:
    """(CELLS, CELLS, CELLS, CELLS) between two walls with an edge: off it and along it, twice."""
    off, along, there_off, there_along = _corners()
    s, t = np.hypot(off, there_off), along - there_along
    square = np.maximum(s * s + t * t, np.finfo(float).tiny)
    return _patches(s * t * np.arctan2(t, s) - 0.25 * (s * s - t * t) * np.log(square))


def _patches(whole: Floats) -> Floats:
    """From a fourfold integral, known at the corners of the patches."""
    for axis in range(4):
        whole = np.diff(whole, axis=axis)
    return np.asarray(whole * CELLS**2 / (2.0 * math.pi))


def bounced(direct: ArrayLike, albedos: ArrayLike, bounces: int | None) -> Floats:
    """Brightness (6, CELLS, CELLS) of the patches after some bounces, or after infinitely many.

    Parameters
    ----------
    direct : (6, CELLS, CELLS) irradiance by the lamps
    albedos : (6,) of the walls, from 0 to 1
    bounces : count of passages of light from wall to wall; ``None`` for infinitely many. Their sum
        is refused in a room without any losses.
    """
    share = as_array("albedos", albedos, 6)
    require("albedos", share, ((share >= 0) & (share <= 1)).all(), "0 to 1")
    endless = bounces is None
    require("albedos", share, not endless or share.min() < 1, "one below 1, for endless bounces")
    albedo = np.repeat(share, CELLS**2)
    step = albedo * as_array("direct", direct, *SHAPE).ravel()
    light, across, before = step.copy(), exchange(), 0.0
    for _ in range(SERIES if bounces is None else as_whole("bounces", bounces, 0)):
        before = float(step.sum())
        step = albedo * (across @ step)
        light += step
    if endless and before > 0.0:
        ratio = float(step.sum()) / before
        light += step * (ratio / (1.0 - ratio) if ratio < 1.0 else math.inf)
    return light.reshape(SHAPE)


def edge_factor(albedo: float, opening_rad: float) -> float:
    """Brightness of the edge of two planes relative to the lamp's light alone, if both are alike.

    Next to the edge the other plane fills the share V = (1 + cos φ)/2 of each point's view, and is
    as bright as the point itself: B = I + ρVB, which is I/(1 − ρV). A closed room is an edge with
    φ = 0: V = 1.
    """
    require("opening_rad", opening_rad, 0.0 <= opening_rad < np.pi, "0 or more, below π")
    require("albedo", albedo, 0 <= albedo <= 1, "0 to 1")
    lost = 1.0 - albedo * 0.5 * (1.0 + math.cos(opening_rad))
    return 1.0 / lost if lost > 0.0 else math.inf
