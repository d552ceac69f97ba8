"""The normal equations of bundle adjustment, solved by blocks.

The camera's m parameters affect every picture, a pose only its own. So JᵀJ has a block U for the
camera, a block Vᵢ (6, 6) for each pose and Wᵢ (m, 6) between them. Eliminating the poses leaves
m equations, whose matrix is a sum over the pictures (the Schur complement)::

    S = Σ (Uᵢ − Wᵢ Vᵢ⁻¹ Wᵢᵀ)

What each picture contributes is what it says about the camera once its own pose is paid for.
B. Triggs et al., *Bundle adjustment: a modern synthesis*, 2000, §6.1.
"""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.jacobian import Linearised


@dataclass(frozen=True, slots=True)
class Blocks:
    """JᵀJ by blocks and Jᵀr, for P pictures and m parameters of the camera."""

    U: Floats
    """(P, m, m)"""
    W: Floats
    """(P, m, 6)"""
    V: Floats
    """(P, 6, 6)"""
    a: Floats
    """(P, m), each picture's part of Jᵀr for the camera"""
    b: Floats
    """(P, 6), Jᵀr for the poses"""


def blocks_of(at: Linearised) -> Blocks:
    """The blocks at a point."""
    A, B = at.by_camera, at.by_pose
    A_turned, B_turned = np.swapaxes(A, -1, -2), np.swapaxes(B, -1, -2)
    r = at.residual[..., None]
    return Blocks(
        A_turned @ A, A_turned @ B, B_turned @ B, (A_turned @ r)[..., 0], (B_turned @ r)[..., 0]
    )


def damped(blocks: Blocks, damping: float) -> Blocks:
    """Marquardt's: the diagonal of JᵀJ times 1 + ``damping``."""
    return Blocks(
        _raised(blocks.U, damping), blocks.W, _raised(blocks.V, damping), blocks.a, blocks.b
    )


def _raised(matrices: Floats, damping: float) -> Floats:
    raised = matrices.copy()
    diagonal = np.arange(matrices.shape[-1])
    raised[..., diagonal, diagonal] *= 1.0 + damping
    return raised


def reduced(blocks: Blocks) -> tuple[Floats, Floats]:
    """Each picture's part of the camera's equations: (P, m, m) and (P, m).

    Raises `LinAlgError` where the corners of a picture do not determine its pose.
    """
    WV = np.swapaxes(np.linalg.solve(blocks.V, np.swapaxes(blocks.W, -1, -2)), -1, -2)
    S = blocks.U - WV @ np.swapaxes(blocks.W, -1, -2)
    return S, blocks.a - (WV @ blocks.b[..., None])[..., 0]


def solve(blocks: Blocks) -> tuple[Floats, Floats]:
    """The steps (m) of the camera and (P, 6) of the poses; raises `LinAlgError`."""
    S, g = reduced(blocks)
    camera = -solve_scaled(S.sum(axis=0), g.sum(axis=0)) if S.shape[-1] else np.zeros(0)
    left = blocks.b + (np.swapaxes(blocks.W, -1, -2) @ camera)
    return camera, -np.linalg.solve(blocks.V, left[..., None])[..., 0]


def solve_scaled(S: Floats, g: Floats) -> Floats:
    """S⁻¹ g of a symmetric S (..., m, m) whose parameters have different units: its diagonal is
    made 1 first."""
    scale = 1.0 / np.sqrt(np.diagonal(S, axis1=-2, axis2=-1))
    even = S * scale[..., :, None] * scale[..., None, :]
    return scale * np.linalg.solve(even, (scale * g)[..., None])[..., 0]
