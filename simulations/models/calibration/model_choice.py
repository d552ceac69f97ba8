"""Which coefficients of the lens, and which shape of the board, do the photographs support?

A richer model always fits the photographs that it is fitted to better. Two judges do not fall for
that: the error on photographs left out of the fit, and Akaike's criterion, which charges for each
parameter. H. Akaike, *A new look at the statistical model identification*, 1974; M. Stone,
*Cross-validatory choice and assessment of statistical predictions*, 1974.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from simulations.models.calibration.board_shape import SHAPES, shape_of, shown_whole
from simulations.models.calibration.bundle_adjustment import Adjusted, refine
from simulations.models.calibration.camera import LENSES, PINHOLE, Camera, Poses
from simulations.models.calibration.left_out import left_out_px
from simulations.models.calibration.standard_errors import Uncertainty, rms_px, uncertainty
from simulations.models.calibration.views import Views
from simulations.models.calibration.zhang import UndeterminedError, closed_form

ALIKE, ALIKE_BOARDS = 0.005, 0.001
"""Relative difference of errors below which the simpler model of the lens, or of the board, is
preferred. A shape that is left out moves the focal length by several standard errors at once."""

ENOUGH_STEPS = 25
"""Steps that tell models apart: those that fit need ten, and those that do not creep on."""
DRAFT_STEPS = 3
"""Steps to within a standard error, mostly a hundredth, from results for more photographs."""


@dataclass(frozen=True, slots=True)
class Trial:
    """One model of the lens, fitted to all photographs."""

    lens: str
    """Its name in `LENSES`."""
    fit: Adjusted
    uncertainty: Uncertainty
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

    @property
    def shape(self) -> str:
        """Of the board, its name in `SHAPES`."""
        terms = self.fit.poses.shape.terms
        return next(name for name, own in SHAPES.items() if own == terms)


def shapes(views: Views, flat: tuple[Trial, ...]) -> tuple[Trial, ...]:
    """The richest of the models of the lens, with each shape of the board that the photographs
    determine; from the results for a flat board."""
    richest = flat[-1]
    found = [richest]
    for name in list(SHAPES)[1:] if shown_whole(views) else ("bent",):
        last = found[-1].fit
        poses = replace(last.poses, shape=shape_of(name, views))
        try:
            found.append(fitted(views, last.camera, poses, richest.lens))
        except UndeterminedError:
            continue
    return tuple(found)


def with_shape(views: Views, trials: tuple[Trial, ...], shape: Trial) -> tuple[Trial, ...]:
    """The models of the lens with the shape of this trial."""
    found = []
    for trial in trials:
        poses = replace(trial.fit.poses, shape=shape.fit.poses.shape)
        try:
            found.append(fitted(views, trial.fit.camera, poses, trial.lens))
        except UndeterminedError:
            continue
    return tuple(found)


def best_shape(tried: tuple[Trial, ...]) -> Trial:
    """The simplest shape whose error on photographs left out is nearly the least."""
    return _simplest(tried, ALIKE_BOARDS)


def compare(views: Views, size: tuple[int, int]) -> tuple[Trial, ...]:
    """All models of the lens that the photographs determine, simple to rich.

    Raises `UndeterminedError` if there is none.
    """
    camera, poses = closed_form(views, size)
    trials: list[Trial] = []
    problem: UndeterminedError | None = None
    for lens in LENSES:
        try:
            trials.append(fitted(views, camera, poses, lens))
        except UndeterminedError as found:
            problem = found
            continue
        camera, poses = trials[-1].fit.camera, trials[-1].fit.poses
    if problem and not trials:
        raise problem
    return tuple(trials)


def compare_first(
    trials: tuple[Trial, ...], views: Views, draft: bool = False
) -> tuple[Trial, ...]:
    """The same for the first of the photographs, starting from the results for all of them; a
    draft takes `DRAFT_STEPS`."""
    found: list[Trial] = []
    problem: UndeterminedError | None = None
    for trial in trials:
        fit = trial.fit
        try:
            poses = fit.poses.take(slice(len(views)))
            found.append(fitted(views, fit.camera, poses, trial.lens, draft))
        except UndeterminedError as open_:
            problem = open_
    if problem and not found:
        raise problem
    return tuple(found)


def fitted(views: Views, camera: Camera, poses: Poses, lens: str, draft: bool = False) -> Trial:
    """One model of the lens, fitted from a start; raises `UndeterminedError`."""
    free = PINHOLE + LENSES[lens] + poses.shape.names
    fit = refine(views, camera, poses, free, DRAFT_STEPS if draft else ENOUGH_STEPS, draft)
    counts = views.found.sum(axis=-1)
    try:
        squares = float((counts * left_out_px(views, fit, free) ** 2).sum())
    except np.linalg.LinAlgError:
        squares = math.inf
    return Trial(
        lens,
        fit,
        uncertainty(views, fit, free),
        rms_px(views, fit),
        math.sqrt(squares / views.corners),
        akaike(2 * views.corners, fit.cost, len(free) + 6 * len(views)),
    )


def akaike(numbers: int, squares: float, parameters: int) -> float:
    """AIC of a least-squares fit whose noise is not known: n ln(Σr²/n) + 2k."""
    return numbers * math.log(max(squares, 1e-300) / numbers) + 2.0 * parameters


def supported(trials: tuple[Trial, ...]) -> Trial:
    """The simplest model whose error on photographs left out is within `ALIKE` of the least."""
    return _simplest(trials, ALIKE)


def _simplest(trials: tuple[Trial, ...], alike: float) -> Trial:
    least = min(trial.left_out_px for trial in trials)
    return next(trial for trial in trials if trial.left_out_px <= (1.0 + alike) * least)
