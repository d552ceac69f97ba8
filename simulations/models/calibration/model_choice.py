"""Which coefficients of the lens, and which shape of the board, do the photographs support?

A richer model always fits the photographs that it is fitted to better. Two judges do not fall for
that: the error on photographs left out of the fit, and Akaike's criterion, which charges for each
parameter. H. Akaike, *A new look at the statistical model identification*, 1974; M. Stone,
*Cross-validatory choice and assessment of statistical predictions*, 1974.
"""

import math
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np

from simulations.models.arrays import Floats, quantile_of
from simulations.models.calibration.board_shape import SHAPES, corners_numbered_alike, flat_shape
from simulations.models.calibration.bundle_adjustment import MOST_STEPS, Adjusted, refine
from simulations.models.calibration.camera import LENSES, PINHOLE, Camera, Poses
from simulations.models.calibration.left_out import left_out_px
from simulations.models.calibration.standard_errors import (
    Uncertainty,
    rms_of_each,
    rms_px,
    uncertainty,
)
from simulations.models.calibration.views import Views
from simulations.models.calibration.zhang import (
    TILT,
    UndeterminedError,
    closed_form,
    estimate_poses,
)
from simulations.models.distortion.fisheye import EQUIDISTANT, Fisheye

ALIKE = 0.005
"""Relative difference of errors below which the simpler model of the lens, or of the board, is
preferred."""

ENOUGH_STEPS = 25
"""Steps that tell models apart: those that fit need ten, and those that do not creep on. The
rational model takes up to `MOST_STEPS`, as its coefficients make up for each other."""
RATIONAL, FISHEYE = "rational", "fisheye"
WIDE = 1.5
"""Longer side of the picture in focal lengths from which on the rational model is tried."""
START_STEPS = 6
"""Steps that decide between the starts for a fisheye."""
DRAFT_STEPS = 3
"""Steps to within a standard error, mostly a hundredth, from results for more photographs."""
BEYOND_A_STEP = 2.0
"""Error of a photograph that is left out, in those that the fit leaves, from which it is fitted
anew without it."""
OFF = 2.0
"""Error of a photograph, in that of most others, from which another pose of its board is tried."""


@dataclass(frozen=True, slots=True, kw_only=True)
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
        return next(name for name, known in SHAPES.items() if known == terms)


def shapes(views: Views, flat: tuple[Trial, ...]) -> tuple[Trial, ...]:
    """The best of the three richest models of the lens, with each shape of the board that the
    photographs determine; from the results for a flat board.

    A fisheye must be plainly better, as a shape would make up for the decentring that it lacks; and
    so must the rational model, which makes up for a shape.
    """
    richest = min(flat[-3:], key=lambda t: t.left_out_px * (1 + (t.lens in (RATIONAL, FISHEYE))))
    found = [richest]
    for name in list(SHAPES)[1:] if corners_numbered_alike(views) else ("bent",):
        last = found[-1].fit
        poses = replace(last.poses, shape=flat_shape(name, views))
        try:
            found.append(fitted(views, last.camera, poses, richest.lens))
        except UndeterminedError:
            continue
    return tuple(found)


def with_shape(views: Views, trials: tuple[Trial, ...], shape: Trial) -> tuple[Trial, ...]:
    """The models of the lens with the shape of this trial."""
    start = shape.fit.poses.shape
    return _determined(
        views, ((t.lens, t.fit.camera, replace(t.fit.poses, shape=start)) for t in trials)
    )


def best_shape(tried: tuple[Trial, ...]) -> Trial:
    """The simplest shape whose error on photographs left out is nearly the least."""
    return _simplest(tried)


def compare(views: Views, size: tuple[int, int]) -> tuple[Trial, ...]:
    """All models of the lens that the photographs determine, simple to rich.

    Raises `UndeterminedError` if there is none.
    """
    camera, poses = closed_form(views, size)
    trials: list[Trial] = []
    problem = UndeterminedError(TILT)
    for lens in LENSES:
        if lens == RATIONAL and max(size) < WIDE * camera.fx:
            continue
        try:
            if lens == FISHEYE:
                camera, poses = fisheye_start(views, size, camera, poses)
            trials.append(fitted(views, camera, poses, lens))
        except UndeterminedError as found:
            problem = found
            continue
        camera, poses = trials[-1].fit.camera, _turned_back(views, trials[-1].fit)
    if not trials:
        raise problem
    return tuple(trials)


def _turned_back(views: Views, fit: Adjusted) -> Poses:
    """The poses; of boards that fit far worse than the others, the pose from their corners alone if
    that fits better. Turned over, a board looks nearly the same, and a model too poor may lead to
    that pose."""
    off, R, t = rms_of_each(views, fit), fit.poses.R.copy(), fit.poses.t.copy()
    for index in np.flatnonzero(off > OFF * quantile_of(off)).tolist():
        one = views.take([index])
        with suppress(UndeterminedError):
            pose = estimate_poses(one, fit.camera)
            found = refine(one, fit.camera, pose, (), ENOUGH_STEPS, draft=True)
            if rms_px(one, found) < off[index]:
                R[index], t[index] = found.poses.R[0], found.poses.t[0]
    return replace(fit.poses, R=R, t=t)


def fisheye_start(
    views: Views, size: tuple[int, int], camera: Camera, poses: Poses
) -> tuple[Camera, Poses]:
    """A start for the fisheye: whichever of some equidistant lenses, and of the camera found with
    another model, is nearest after a few steps. Raises `UndeterminedError` if none can be tried."""
    starts = [(replace(camera, lens=Fisheye()), poses)]
    x, y = (0.5 * (side - 1.0) for side in size)
    for share in EQUIDISTANT:
        guess = Camera(share * max(size), share * max(size), x, y, Fisheye())
        with suppress(UndeterminedError):
            starts.append((guess, estimate_poses(views, guess)))
    found, free = [], PINHOLE + LENSES[FISHEYE]
    for start in starts:
        with suppress(UndeterminedError):
            found.append(refine(views, *start, free, START_STEPS, draft=True))
    best = min(found, key=lambda fit: fit.cost, default=None)
    if best is None or not np.isfinite(best.cost):
        raise UndeterminedError(TILT)
    return best.camera, best.poses


def compare_first(
    trials: tuple[Trial, ...], views: Views, draft: bool = False
) -> tuple[Trial, ...]:
    """The same for the first of the photographs, starting from the results for all of them; a
    draft takes `DRAFT_STEPS`."""
    first = slice(len(views))
    return _determined(
        views, ((t.lens, t.fit.camera, t.fit.poses.take(first)) for t in trials), draft
    )


def _determined(
    views: Views, starts: Iterable[tuple[str, Camera, Poses]], draft: bool = False
) -> tuple[Trial, ...]:
    """The models that the photographs determine, each from a start of its own; raises
    `UndeterminedError` if there is none."""
    found: list[Trial] = []
    problem = UndeterminedError(TILT)
    for lens, camera, poses in starts:
        try:
            found.append(fitted(views, camera, poses, lens, draft))
        except UndeterminedError as open_:
            problem = open_
    if not found:
        raise problem
    return tuple(found)


def fitted(views: Views, camera: Camera, poses: Poses, lens: str, draft: bool = False) -> Trial:
    """One model of the lens, fitted from a start; raises `UndeterminedError`."""
    free = PINHOLE + LENSES[lens] + poses.shape.names
    most, left_out = ENOUGH_STEPS, left_out_px
    if lens == RATIONAL:
        most, left_out = MOST_STEPS, _left_out_anew
    fit = refine(views, camera, poses, free, DRAFT_STEPS if draft else most, draft)
    counts = views.found.sum(axis=-1)
    try:
        squares = float((counts * left_out(views, fit, free) ** 2).sum())
    except np.linalg.LinAlgError:
        squares = math.inf
    return Trial(
        lens=lens,
        fit=fit,
        uncertainty=uncertainty(views, fit, free),
        rms_px=rms_px(views, fit),
        left_out_px=math.sqrt(squares / views.corners),
        aic=akaike(2 * views.corners, fit.cost, len(free) + 6 * len(views)),
    )


def _left_out_anew(views: Views, fit: Adjusted, free: tuple[str, ...]) -> Floats:
    """`left_out_px`, by a new fit to the others where it is so large that one step may not lead to
    their camera: the rational model's coefficients make up for each other."""
    off = left_out_px(views, fit, free)
    for index in np.flatnonzero(off > BEYOND_A_STEP * rms_of_each(views, fit)).tolist():
        rest, one = [*range(index), *range(index + 1, len(views))], views.take([index])
        with suppress(UndeterminedError):
            others = refine(
                views.take(rest), fit.camera, fit.poses.take(rest), free, ENOUGH_STEPS, draft=True
            )
            pose = replace(fit.poses.take([index]), shape=others.poses.shape)
            alone = refine(one, others.camera, pose, (), ENOUGH_STEPS, draft=True)
            off[index] = min(off[index], rms_px(one, alone))
    return off


def akaike(numbers: int, squares: float, parameters: int) -> float:
    """AIC of a least-squares fit whose noise is not known: n ln(Σr²/n) + 2k."""
    return numbers * math.log(max(squares, 1e-300) / numbers) + 2.0 * parameters


def supported(trials: tuple[Trial, ...]) -> Trial:
    """The simplest model whose error on photographs left out is within `ALIKE` of the least."""
    return as_chosen(_simplest(trials), trials)


def as_chosen(trial: Trial, trials: tuple[Trial, ...]) -> Trial:
    """With errors that count how far away the richest model of the same kind of lens puts
    focal lengths and principal point."""
    kind = type(trial.fit.camera.lens)
    richest = [other for other in trials if isinstance(other.fit.camera.lens, kind)][-1]
    off = np.zeros(len(trial.uncertainty.names))
    off[: len(PINHOLE)] = richest.fit.camera.values(PINHOLE) - trial.fit.camera.values(PINHOLE)
    return replace(trial, uncertainty=replace(trial.uncertainty, choice=off))


def _simplest(trials: tuple[Trial, ...]) -> Trial:
    least = min(trial.left_out_px for trial in trials)
    good = [trial for trial in trials if trial.left_out_px <= (1.0 + ALIKE) * least]
    return min(good, key=lambda trial: trial.lens == RATIONAL)  # a fisheye has fewer coefficients
