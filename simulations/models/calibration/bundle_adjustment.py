"""Bundle adjustment: the camera and all poses that predict the found corners best.

The sum of squared distances between predicted and found corners is minimised by
Levenberg–Marquardt: a Gauss–Newton step on damped normal equations, taken only if it lowers the
sum; the damping falls after a success and rises after a failure. Z. Zhang 2000, §3.2; W. H. Press
et al., *Numerical Recipes*, 2007, §15.5.

Derivatives are in closed form. A corner P of the board lies at Q = R P + t in the camera frame, at
(x, y) = (Q₁, Q₂) / Q₃ in normalised coordinates, and at (f_x x_d + c_x, f_y y_d + c_y) in the
picture, where (x_d, y_d) is the distorted point. Each picture's corners depend on its own pose
alone, so that the Jacobian of P pictures is sparse: a block (2N, m) for the camera and one (2N, 6)
for the pose of each.

The normal equations are solved by blocks. The camera's m parameters affect every picture, a pose
only its own. So JᵀJ has a block U for the camera, a block Vᵢ (6, 6) for each pose and Wᵢ (m, 6)
between them. Eliminating the poses leaves m equations, whose matrix is a sum over the pictures (the
Schur complement)::

    S = Σ (Uᵢ − Wᵢ Vᵢ⁻¹ Wᵢᵀ)

What each picture contributes is what it says about the camera once its own pose is paid for. B.
Triggs et al., *Bundle adjustment: a modern synthesis*, 2000, §6.1.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.camera import Camera, Poses, predicted
from simulations.models.calibration.views import Views
from simulations.models.calibration.zhang import TILT, UndeterminedError
from simulations.models.distortion.lens import coefficient_derivatives, linearised


@dataclass(frozen=True, slots=True)
class Linearised:
    """Residuals and their derivatives; rows are the N corners' x, then their y."""

    residual: Floats
    """(P, 2N): predicted minus found, px; 0 where no corner was found, infinite behind the
    camera."""
    by_camera: Floats
    """(P, 2N, m): by the free parameters of the camera, and of the shape of the board."""
    by_pose: Floats
    """(P, 2N, 6): by a small turn in the camera frame (radians) and a shift (squares)."""


def linearise(views: Views, camera: Camera, poses: Poses, free: tuple[str, ...]) -> Linearised:
    """Residuals and derivatives with respect to the parameters ``free`` of the camera."""
    X, Y, Z = np.moveaxis(poses.place(views.board), -1, 0)
    ahead = Z > 0.0
    Z = np.where(ahead, Z, 1.0)
    x, y = X / Z, Y / Z
    xd, yd, xx, xy, yy = linearised(x, y, camera.lens)
    fx, fy = camera.fx, camera.fy
    off = np.stack((fx * xd + camera.cx, fy * yd + camera.cy), 1) - np.moveaxis(views.pixels, -1, 1)
    seen = np.repeat(views.found[:, None], 2, axis=1)
    off = np.where(np.repeat(ahead[:, None], 2, axis=1), off, np.inf)
    residual = np.where(seen, off, 0.0)
    shape = poses.shape
    by_camera = _by_camera(x, y, xd, yd, camera, camera_names(free, poses))
    by_point = np.stack(  # (P, 2, N, 3), by Q
        (
            np.stack((xx / Z, xy / Z, -(xx * x + xy * y) / Z), -1) * fx,
            np.stack((xy / Z, yy / Z, -(xy * x + yy * y) / Z), -1) * fy,
        ),
        1,
    )
    if shape.terms and shape.names[0] in free:
        slopes = shape.coefficient_derivatives(views.board, by_point @ poses.R[:, None])
        by_camera = np.concatenate((by_camera, slopes), axis=-1)
    turned = np.stack((X, Y, Z), -1) - poses.t[:, None]  # R P, which the small turn moves
    by_turn = np.cross(turned[:, None], by_point)  # d (ω × RP)·q = ω · (RP × q)
    by_pose = np.concatenate((by_turn, by_point), axis=-1)
    weight = seen[..., None]
    pictures, _, corners, _ = by_pose.shape
    rows = (pictures, 2 * corners)
    return Linearised(
        residual.reshape(rows),
        (by_camera * weight).reshape(*rows, len(free)),
        (by_pose * weight).reshape(*rows, 6),
    )


def camera_names(free: tuple[str, ...], poses: Poses) -> tuple[str, ...]:
    """The free parameters of the camera; those of the board's shape follow them in ``free``."""
    return tuple(name for name in free if name not in poses.shape.names)


def _by_camera(
    x: Floats, y: Floats, xd: Floats, yd: Floats, camera: Camera, free: tuple[str, ...]
) -> Floats:
    """(P, 2, N, m) derivatives by the free parameters of the camera."""
    none, one = np.zeros_like(x), np.ones_like(x)
    moved = coefficient_derivatives(x, y, camera.lens)  # the distorted point
    columns = {
        "fx": (xd, none),
        "fy": (none, yd),
        "cx": (one, none),
        "cy": (none, one),
        **{name: (camera.fx * u, camera.fy * v) for name, (u, v) in moved.items()},
    }
    derivatives = np.empty((len(x), 2, x.shape[1], len(free)))
    for index, name in enumerate(free):
        derivatives[:, 0, :, index], derivatives[:, 1, :, index] = columns[name]
    return derivatives


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


FIRST_DAMPING, EASED, RAISED = 1e-6, 0.1, 10.0
LEAST_DAMPING, MOST_DAMPING = 1e-12, 1e12
MOST_STEPS = 100
SETTLED = 1e-12
"""Share of the sum of squares that a last step may promise to gain: a ten-thousandth of a
standard error, for some thousand corners."""
CREEPING = 1e-4
"""Largest share that the last permitted step may gain. A model that fits badly creeps to a flat
minimum; one with an undetermined parameter keeps descending."""
ROUNDING_PX = 1e-10
"""A smaller residual is rounding."""


@dataclass(frozen=True, slots=True)
class Adjusted:
    """A camera, the poses, and how well they fit."""

    camera: Camera
    poses: Poses
    cost: float
    """Sum of squared residuals, px²."""
    settled: bool = False
    """Whether no further step is worth it."""


def refine(
    views: Views,
    camera: Camera,
    poses: Poses,
    free: tuple[str, ...],
    most_steps: int = MOST_STEPS,
    draft: bool = False,
) -> Adjusted:
    """The minimum near a starting value, over the parameters ``free`` and all poses.

    With nothing free, only the poses are fitted. A draft is where ``most_steps`` lead to. Raises
    `UndeterminedError` if they lead to no minimum, unless it is a draft.
    """
    try:
        steps = list(islice(descend(views, camera, poses, free), most_steps))
    except np.linalg.LinAlgError:
        raise UndeterminedError(TILT) from None
    last = steps[-1]
    slope = not draft and not last.settled and len(steps) > 1
    if np.isinf(last.cost) or (slope and steps[-2].cost - last.cost > CREEPING * last.cost):
        raise UndeterminedError(TILT)
    return last


def descend(
    views: Views,
    camera: Camera,
    poses: Poses,
    free: tuple[str, ...],
    damping: float = FIRST_DAMPING,
) -> Iterator[Adjusted]:
    """The start, and the result of every step that lowers the sum, until none is worth it.

    With a damping of 0 these are plain Gauss–Newton steps, taken whatever they do to the sum.
    """
    now = Adjusted(camera, poses, cost_of(views, camera, poses))
    yield now
    if np.isinf(now.cost):
        return  # a corner is behind the camera
    guarded, blocks = damping > 0.0, _blocks(views, now, free)
    while damping <= MOST_DAMPING:
        by_camera, by_pose = solve(damped(blocks, damping) if guarded else blocks)
        gain = -float((by_camera * blocks.a.sum(axis=0)).sum() + (by_pose * blocks.b).sum())
        settled = gain <= SETTLED * now.cost + views.corners * ROUNDING_PX**2
        moved = _moved(views, now, free, by_camera, by_pose, settled)
        if guarded and not settled and not moved.cost < now.cost:
            damping *= RAISED
            continue
        now, damping = moved, max(damping * EASED, LEAST_DAMPING) if guarded else 0.0
        yield now
        if settled or not np.isfinite(now.cost):
            return
        blocks = _blocks(views, now, free)


def _blocks(views: Views, at: Adjusted, free: tuple[str, ...]) -> Blocks:
    return blocks_of(linearise(views, at.camera, at.poses, free))


def _moved(
    views: Views,
    now: Adjusted,
    free: tuple[str, ...],
    by_camera: Floats,
    by_pose: Floats,
    settled: bool,
) -> Adjusted:
    """After a step; of infinite cost where no camera is left."""
    names = camera_names(free, now.poses)
    poses = now.poses.moved(by_pose)
    if len(free) > len(names):
        poses = replace(poses, shape=poses.shape.moved(by_camera[len(names) :]))
    try:
        camera = now.camera.changed(names, now.camera.values(names) + by_camera[: len(names)])
    except ValueError:
        return Adjusted(now.camera, now.poses, np.inf)
    return Adjusted(camera, poses, cost_of(views, camera, poses), settled)


def cost_of(views: Views, camera: Camera, poses: Poses) -> float:
    """Sum of squared residuals in px²; infinite if a corner is behind the camera."""
    off = residuals(views, camera, poses)
    return float((off * off).sum())


def residuals(views: Views, camera: Camera, poses: Poses) -> Floats:
    """(P, N, 2) found minus predicted corners, px; 0 where no corner was found."""
    off = views.pixels - predicted(camera, poses, views.board)
    return np.where(views.found[..., None], off, 0.0)
