"""A glossy dome: light interpolated from the corners of a grid, or computed in every pixel."""

from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.error_measures import root_mean_square
from simulations.models.light.cell_blending import blend_cells
from simulations.models.light.reflectance import phong

INTERVALS = 256
"""The picture has one pixel more each way, so that the corners of all grids are on pixels."""
SHININESS, SPECULAR, ALBEDO = 32.0, 0.5, 0.5
LIGHT = (0.48, -0.36, 0.8)
"""Unit vector towards the light, 37° off the camera's axis."""
VIEW = (0.0, 0.0, 1.0)
"""Towards a camera far above."""
GRIDS = (8, 16, 32, 64)


def prepare() -> Floats:
    """Unit normals (257, 257, 3), float32, of a cap of a ball; its corners tilt by 64°.

    There the light is grazing or below the horizon, so the picture has smooth shading, a highlight
    and the edge of a shadow.
    """
    return _cap((0.0, 0.0), 0.636)


def draw(index: int) -> Floats:
    """Other parts of the ball, up to a quarter smaller; all show the highlight."""
    rng = np.random.default_rng(index)
    return _cap(rng.uniform(-0.06, 0.06, 2), rng.uniform(0.48, 0.636))


def _cap(middle: ArrayLike, reach: float) -> Floats:
    x, y = np.asarray(middle)[:, None] + np.linspace(-reach, reach, INTERVALS + 1)
    flat = np.stack(np.meshgrid(x, y), axis=-1)
    height = np.sqrt(1.0 - (flat * flat).sum(axis=-1, keepdims=True))
    return np.concatenate([flat, height], axis=-1).astype(np.float32)


def reference(normals: Floats) -> Floats:
    """Phong's formula with the eye mirrored in place of the light; the power by squaring."""
    n = normals.astype(np.float64)
    n_dot_l = n @ np.array(LIGHT)
    mirrored_eye = 2.0 * n[..., 2:] * n - np.array(VIEW)
    power = np.maximum(mirrored_eye @ np.array(LIGHT), 0.0)
    for _ in range(5):
        power = power * power
    lit = n_dot_l > 0.0
    return np.where(lit, ALBEDO * n_dot_l + SPECULAR * power, 0.0)


def phong_pixels(normals: Floats) -> Floats:
    return phong(normals, LIGHT, VIEW, ALBEDO, specular=SPECULAR, shininess=SHININESS)


def gouraud(normals: Floats, *, grid: int) -> Floats:
    """Phong's light at the grid's corners, interpolated across each cell (Gouraud 1971)."""
    corners = normals[:: INTERVALS // grid, :: INTERVALS // grid]
    return blend_cells(phong_pixels(corners), *normals.shape[:2])


def rms(result: Floats, truth: Floats, _normals: Floats) -> float:
    return root_mean_square(result.astype(np.float64) - truth)


def worst(result: Floats, truth: Floats, _normals: Floats) -> float:
    return float(np.abs(result.astype(np.float64) - truth).max())


LADDER = Ladder(
    id="shading",
    title="Shading a glossy surface",
    workload="257 × 257 pixels of a dome, albedo 0.5, highlight of shininess 32",
    prepare=prepare,
    tiers=(
        *(
            Tier(
                f"gouraud-{grid}",
                f"Light at {grid} × {grid} cells",
                f"{(grid + 1) ** 2} powers, 3 blends a pixel",
                partial(gouraud, grid=grid),
            )
            for grid in GRIDS
        ),
        Tier("phong", "Phong in every pixel", "2 cosines, 1 power a pixel", phong_pixels),
    ),
    reference=reference,
    reference_label="Phong's formula with the eye mirrored, float64",
    metrics=(
        Metric("rms", "RMS error", "of white", rms),
        Metric("worst", "Largest error", "of white", worst),
    ),
    draw=draw,
    default_tier="phong",
    items=66_049,
)
