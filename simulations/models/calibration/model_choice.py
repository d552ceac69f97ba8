"""Which coefficients of the lens do the photographs support?

A richer model always fits the photographs that it is fitted to better. Two judges do not fall for
that: the error on photographs left out of the fit, and Akaike's criterion, which charges for each
parameter. H. Akaike, *A new look at the statistical model identification*, 1974; M. Stone,
*Cross-validatory choice and assessment of statistical predictions*, 1974.
"""

import math
from dataclasses import dataclass

import numpy as np

from simulations.models.calibration.bundle_adjustment import Adjusted, refine
from simulations.models.calibration.camera import LENSES, PINHOLE, Camera, Poses
from simulations.models.calibration.left_out import left_out_px
from simulations.models.calibration.standard_errors import rms_px
from simulations.models.calibration.views import Views

ALIKE = 0.01
"""Relative difference of errors below which the simpler model is preferred."""


@dataclass(frozen=True, slots=True)
class Trial:
    """One model of the lens, fitted to all photographs."""

    lens: str
    """Its name in `LENSES`."""
    fit: Adjusted
    rms_px: float
    """Error on the photographs that it was fitted to."""
    left_out_px: float
    """Error on photographs left out."""
    aic: float
    """Akaike's criterion; smaller is better, and only differences count."""

    @property
    def free(self) -> tuple[str, ...]:
        """The camera's free parameters."""
        return PINHOLE + LENSES[self.lens]


def compare(views: Views, camera: Camera, poses: Poses) -> tuple[Trial, ...]:
    """All models of the lens, simple to rich; each starts from the one before it."""
    trials: list[Trial] = []
    for lens, coefficients in LENSES.items():
        fit = refine(views, camera, poses, PINHOLE + coefficients)
        camera, poses = fit.camera, fit.poses
        trials.append(_trial(views, fit, lens))
    return tuple(trials)


def _trial(views: Views, fit: Adjusted, lens: str) -> Trial:
    free = PINHOLE + LENSES[lens]
    counts = views.found.sum(axis=-1)
    try:
        squares = float((counts * left_out_px(views, fit, free) ** 2).sum())
    except np.linalg.LinAlgError:
        squares = math.inf
    return Trial(
        lens,
        fit,
        rms_px(views, fit),
        math.sqrt(squares / views.corners),
        akaike(2 * views.corners, fit.cost, len(free) + 6 * len(views)),
    )


def akaike(numbers: int, squares: float, parameters: int) -> float:
    """AIC of a least-squares fit whose noise is not known: n ln(Σr²/n) + 2k."""
    return numbers * math.log(max(squares, 1e-300) / numbers) + 2.0 * parameters


def supported(trials: tuple[Trial, ...]) -> Trial:
    """The simplest model whose error on photographs left out is within `ALIKE` of the least."""
    least = min(trial.left_out_px for trial in trials)
    return next(trial for trial in trials if trial.left_out_px <= (1.0 + ALIKE) * least)
