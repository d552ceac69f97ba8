"""A corner as the crossing of two blurred edges, fitted to the pixels about it.

The brightness is a + b c(h/s, k/s, ρ) + gx x + gy y, with the blurred corner c of `blurred_corner`,
distances h and k from the two edges, and ρ, the cosine of the angle between their normals. Nine
numbers are found for each corner, by Gauss–Newton for all corners at once: its place, the
directions of both edges, the blur s, and the light: a, b and its slopes gx and gy, without which
glare would draw corners towards it. R. Deriche and G. Giraudon, *A computational approach for
corner and vertex detection*, 1993, fit models of edges and corners in this way.
"""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats, Mask
from simulations.models.chequerboard.blurred_corner import blurred_corner, blurred_edge
from simulations.models.chequerboard.corner_windows import Picture, cone, windows

STEPS, ENOUGH_PX = 8, 0.002
"""Most steps; they end when no corner moves farther than this."""
LARGEST_STEP = np.array([1.0, 1.0, 0.3, 0.3, 0.5])
"""Largest change in one step: px, px, rad, rad, and of the logarithm of the blur."""
LEAST_BLUR, MOST_BLUR = 0.25, 1.0
"""Least blur in px; largest blur as a share of the window's radius."""
STEEPEST_RAD = 0.15
"""Smallest angle between the two edges."""


@dataclass(frozen=True, slots=True)
class Fit:
    """N fitted corners."""

    places: Floats
    """(N, 2) px, NaN where the fit failed."""
    blur_px: Floats
    """(N,) standard deviation of the blur."""
    contrast: Floats
    """(N,) difference of light and dark, codes; positive if it is light between the two edges."""
    misfit: Floats
    """(N,) RMS difference of pixels and model as a share of the contrast."""


@dataclass(frozen=True, slots=True)
class _Model:
    """The corner model at all pixels of the windows."""

    value: Floats
    """(N, M)"""
    slopes: Floats
    """(N, M, 5) derivatives by x, y, the two directions and the logarithm of the blur."""


def fit_corners(picture: Picture, places: Floats, edges: Floats, radius: int) -> Fit:
    """Corners near places (N, 2), within ``radius`` px, in the windows of that radius.

    Parameters
    ----------
    picture : (H, W) or (H, W, 3) codes.
    places : (N, 2) px, right to half the radius.
    edges : (N, 2, 2) the directions in which the two edges leave the corner, to 15°; of any length.
    """
    count = len(places)
    angles = np.arctan2(edges[..., 1], edges[..., 0])
    state = np.column_stack([places, angles, np.full(count, np.log(0.15 * radius + 0.4))])
    lost = np.zeros(count, bool)
    for _ in range(STEPS):
        seen = _compare(picture, state, radius)
        slopes = np.concatenate([seen.size[:, None, None] * seen.model.slopes, seen.light], axis=-1)
        step = _least_squares(slopes, seen.weight, seen.rest)[:, :5]
        step = np.clip(np.where(lost[:, None], 0.0, step), -LARGEST_STEP, LARGEST_STEP)
        state += step
        state[:, 4] = np.clip(state[:, 4], np.log(LEAST_BLUR), np.log(MOST_BLUR * radius))
        lost |= _lost(state, places, radius)
        if np.abs(step[:, :2]).max(initial=0.0) < ENOUGH_PX:
            break
    seen = _compare(picture, state, radius)
    rms = np.sqrt((seen.weight * seen.rest**2).sum(axis=1) / seen.weight.sum(axis=1))
    contrast = 2.0 * seen.size
    found = np.where(lost[:, None], np.nan, state[:, :2])
    return Fit(found, np.exp(state[:, 4]), contrast, rms / np.maximum(np.abs(contrast), 1e-9))


@dataclass(frozen=True, slots=True)
class _Compared:
    """Pixels beside the model, whose light follows by least squares."""

    model: _Model
    weight: Floats
    """(N, M)"""
    light: Floats
    """(N, M, 4) what the light is a sum of: level, corner, slopes across and down."""
    size: Floats
    """(N,) half the contrast."""
    rest: Floats
    """(N, M) pixels less the model."""


def _compare(picture: Picture, state: Floats, radius: int) -> _Compared:
    sight = windows(picture, state[:, :2], radius)
    dx, dy = sight.x - state[:, :1], sight.y - state[:, 1:2]
    weight = cone(dx, dy, radius)
    model = _model(dx, dy, state)
    light = np.stack([np.ones_like(dx), model.value, dx, dy], axis=-1)
    sizes = _least_squares(light, weight, sight.values)
    rest = sight.values - (light @ sizes[..., None])[..., 0]
    return _Compared(model, weight, light, sizes[:, 1], rest)


def _least_squares(terms: Floats, weight: Floats, values: Floats) -> Floats:
    """(N, K) the factors of terms (N, M, K) whose sum is nearest to values (N, M)."""
    weighted = np.swapaxes(weight[..., None] * terms, 1, 2)
    normal = weighted @ terms
    floor = 1e-6 * np.trace(normal, axis1=1, axis2=2) + 1e-12
    normal += floor[:, None, None] * np.eye(terms.shape[-1])
    factors: Floats = np.linalg.solve(normal, weighted @ values[..., None])[..., 0]
    return factors


def _lost(state: Floats, places: Floats, radius: int) -> Mask:
    apart = np.abs(np.sin(state[:, 2] - state[:, 3])) < np.sin(STEEPEST_RAD)
    gone: Mask = (np.hypot(*(state[:, :2] - places).T) > radius) | apart
    return gone


def _model(dx: Floats, dy: Floats, state: Floats) -> _Model:
    """The blurred corner at offsets (N, M); its derivatives are those of the bivariate normal law.

    A point lies right of an edge, seen along its direction, at a positive distance.
    """
    first, second, blur = state[:, 2:3], state[:, 3:4], np.exp(state[:, 4:5])
    along_h = dx * np.cos(first) + dy * np.sin(first)
    along_k = dx * np.cos(second) + dy * np.sin(second)
    h = (dy * np.cos(first) - dx * np.sin(first)) / blur
    k = (dx * np.sin(second) - dy * np.cos(second)) / blur
    rho = -np.cos(first - second)
    across = np.maximum(np.abs(np.sin(first - second)), 0.1)
    by_h = 2.0 * _normal(h) * blurred_edge((k - rho * h) / across)
    by_k = 2.0 * _normal(k) * blurred_edge((h - rho * k) / across)
    by_rho = (2.0 / np.pi / across) * np.exp((rho * h * k - 0.5 * (h * h + k * k)) / across**2)
    turn = np.sin(first - second)
    slopes = (
        (by_h * np.sin(first) - by_k * np.sin(second)) / blur,
        (by_k * np.cos(second) - by_h * np.cos(first)) / blur,
        by_rho * turn - by_h * along_h / blur,
        by_k * along_k / blur - by_rho * turn,
        -(by_h * h + by_k * k),
    )
    value = blurred_corner(h, k, np.broadcast_to(rho, h.shape))
    return _Model(value, np.stack(slopes, axis=-1))


def _normal(h: Floats) -> Floats:
    density: Floats = np.exp(-0.5 * h * h) / np.sqrt(2.0 * np.pi)
    return density
