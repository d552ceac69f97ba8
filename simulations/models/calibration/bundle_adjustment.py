"""Bundle adjustment: the camera and all poses that predict the found corners best.

The sum of squared distances between predicted and found corners is minimised by
Levenberg–Marquardt: a Gauss–Newton step on damped normal equations, taken only if it lowers the
sum; the damping falls after a success and rises after a failure. Z. Zhang 2000, §3.2; W. H. Press
et al., *Numerical Recipes*, 2007, §15.5.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.camera import LENSES, PINHOLE, Camera, Poses, predicted
from simulations.models.calibration.jacobian import linearise
from simulations.models.calibration.normal_equations import Blocks, blocks_of, damped, solve
from simulations.models.calibration.views import Views
from simulations.models.calibration.zhang import TILT, UndeterminedError, closed_form
from simulations.models.require import require_one_of

FIRST_DAMPING, EASED, RAISED = 1e-6, 0.1, 10.0
LEAST_DAMPING, MOST_DAMPING = 1e-12, 1e12
MOST_STEPS = 100
SETTLED = 1e-12
"""Share of the sum of squares that a last step may promise to gain: a ten-thousandth of a
standard error, for some thousand corners."""
CREEPING = 1e-4
"""Share that the very last of all steps may have gained. A model that is off by many standard
deviations has a minimum so flat that steps creep towards it; one that is open, a slope."""
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


def calibrate(views: Views, size: tuple[int, int], lens: str = "k3") -> Adjusted:
    """The camera by least squares, from nothing but corners.

    Parameters
    ----------
    views : at least three, of a board seen from different sides.
    size : width and height of the pictures in px.
    lens : one of `LENSES`.

    Raises `UndeterminedError` if the photographs do not determine it, saying what to photograph.
    """
    require_one_of("lens", lens, LENSES)
    camera, poses = closed_form(views, size)
    return refine(views, camera, poses, PINHOLE + LENSES[lens])


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
    if not draft and not last.settled and steps[-2].cost - last.cost > CREEPING * last.cost:
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
    values = now.camera.values(free) + by_camera
    poses = now.poses.moved(by_pose)
    try:
        camera = now.camera.changed(free, values)
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
