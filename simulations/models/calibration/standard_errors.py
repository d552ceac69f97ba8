"""Standard errors of a calibration, from the Jacobian at the minimum.

If the corners err independently by σ in x and in y, the parameters have the covariance
σ² (JᵀJ)⁻¹, to first order. Its block of the camera is σ² S⁻¹ with the Schur complement S. σ is
estimated from the residuals, divided by the count of coordinates less the count of parameters.
W. H. Press et al., *Numerical Recipes*, 2007, §15.6.

Where something is left that is no noise, neighbours err alike, and the formula counts each corner
as one more witness. So the spread between photographs is asked as well: by how much would the
parameters move without each of them? That is the jackknife, which needs no more than that
photographs are independent. B. Efron and C. Stein, *The jackknife estimate of variance*, 1981. The
larger of the two is the standard error.

A model that was chosen from several leaves out what the photographs cannot tell from zero, such as
a small decentring, which then moves the principal point. So the square of the difference from the
richest model is added. K. P. Burnham and D. R. Anderson, *Multimodel inference*, 2004.
"""

import math
from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.bundle_adjustment import (
    Adjusted,
    blocks_of,
    linearise,
    reduced,
    residuals,
)
from simulations.models.calibration.camera import PINHOLE
from simulations.models.calibration.left_out import spread
from simulations.models.calibration.views import Views
from simulations.models.calibration.zhang import TILT, UndeterminedError

UNSURE = 0.1
"""Relative standard error of a focal length from which it counts as undetermined."""
ROUNDING = 1e-13
"""Share of the information that counts as none. Coefficients of the rational model that make up for
each other may have no more, and the focal length has the rest."""
PARALLEL = math.cos(math.radians(1.0))
"""Cosine of the angle within which all boards are parallel. Parallel boards tell no focal length;
only noise, or a lens that bends them, pretends that they do."""


@dataclass(frozen=True, slots=True)
class Uncertainty:
    """How far a calibration can be trusted."""

    names: tuple[str, ...]
    covariance: Floats
    """(m, m) of the free parameters, if what is left is noise."""
    spread: Floats
    """(m) standard errors by the spread between photographs."""
    sigma_px: float
    """Estimated standard deviation of a corner's x and of its y."""
    choice: Floats
    """(m) how far away the richest model puts each, if this one was chosen from several."""

    @property
    def errors(self) -> dict[str, float]:
        """Standard error of each free parameter."""
        larger = np.maximum(np.sqrt(np.diagonal(self.covariance)), self.spread)
        return dict(zip(self.names, np.hypot(larger, self.choice).tolist(), strict=True))


def uncertainty(views: Views, fit: Adjusted, free: tuple[str, ...]) -> Uncertainty:
    """Standard errors at the minimum.

    Raises `UndeterminedError` if all boards are parallel, or a parameter is left open otherwise.
    """
    if _parallel(fit.poses.R[..., 2]):
        raise UndeterminedError(TILT)
    each, g = reduced(blocks_of(linearise(views, fit.camera, fit.poses, free)))
    S = each.sum(axis=0)
    sigma = noise_px(views, fit, len(free))
    scale = 1.0 / np.sqrt(np.maximum(np.diagonal(S), np.finfo(float).tiny))
    inverse = np.linalg.inv(S * scale[:, None] * scale + ROUNDING * np.eye(len(free)))
    covariance = sigma * sigma * inverse * scale[:, None] * scale
    needed = [name in PINHOLE + fit.poses.shape.names for name in free]
    is_open = np.diagonal(inverse)[needed] > 0.5 / ROUNDING
    focal = [i for i, name in enumerate(free) if name in PINHOLE[:2]]
    unsure = np.sqrt(np.diagonal(covariance)[focal]) > UNSURE * fit.camera.fx
    if np.any(is_open) or np.any(unsure):
        raise UndeterminedError(TILT)
    return Uncertainty(free, covariance, spread(each, g), sigma, np.zeros(len(free)))


def _parallel(normals: Floats) -> bool:
    """Whether all normals (P, 3) are within `PARALLEL` of their mean."""
    mean = normals.mean(axis=0)
    return bool(np.all(normals @ mean >= PARALLEL * np.linalg.norm(mean)))


def noise_px(views: Views, fit: Adjusted, free: int) -> float:
    """σ from the residuals; 0 if there are no more coordinates than parameters."""
    spare = 2 * views.corners - free - 6 * len(views)
    return float(np.sqrt(fit.cost / spare)) if spare > 0 else 0.0


def rms_px(views: Views, fit: Adjusted) -> float:
    """Root of the mean squared distance between predicted and found corners, as OpenCV has it."""
    return float(np.sqrt(fit.cost / views.corners))


def rms_of_each(views: Views, fit: Adjusted) -> Floats:
    """(P,) the same for each photograph."""
    off = residuals(views, fit.camera, fit.poses)
    return np.sqrt((off * off).sum(axis=(-2, -1)) / views.found.sum(axis=-1))
