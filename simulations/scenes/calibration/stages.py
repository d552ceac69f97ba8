"""The stages: corners → all models of the lens → the chosen one → the photograph that is shown."""

from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from simulations.engine.accuracy import Level
from simulations.engine.photograph import Photograph
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.calibration.advice import Coverage, coverage, next_photograph
from simulations.models.calibration.bundle_adjustment import Adjusted, refine, residuals
from simulations.models.calibration.left_out import Growth, values_by_count
from simulations.models.calibration.mixed import differing
from simulations.models.calibration.model_choice import (
    Trial,
    as_chosen,
    best_shape,
    compare,
    compare_first,
    shapes,
    supported,
    with_shape,
)
from simulations.models.calibration.shape_size import Measured, measure_shape
from simulations.models.calibration.standard_errors import rms_of_each
from simulations.models.calibration.undistorted import undistorted
from simulations.models.calibration.views import Views
from simulations.models.calibration.zhang import (
    UndeterminedError,
    estimate_poses,
    homographies,
    poses_of,
)
from simulations.models.chequerboard.board_search import NoBoardError
from simulations.models.chequerboard.find_board import find_board
from simulations.scenes.calibration.boards import LEAST, MOST, Boards, boards, listed, rendered

type Codes = NDArray[np.uint8]

LEVELS = (
    Level("quick", "Small photograph, fits of few steps", {"quick": True}),
    Level("full", "Corners found, fits to the end", {"quick": False}),
)
QUICK_SCALE = 0.375
SHEET = "sheet"  # the detail that shows all photographs
MIXED = (
    "{these} in focal length or principal point: leave out what was taken with another zoom or "
    "focus, with the camera turned, mirrored, or of a board that was bent otherwise."
)
SUPPORTED = "supported"  # the model of the lens that the photographs support


@dataclass(frozen=True, slots=True)
class Trials:
    """All models of the lens, fitted to some of the photographs."""

    views: Views
    found: tuple[Trial, ...] = ()
    """Simple to rich; empty if the photographs do not determine the camera."""
    problem: str = ""
    """The reason why not, and what to do."""
    tried: tuple[Trial, ...] = ()
    """The shapes of the board that were compared."""

    def of(self, lens: str) -> Trial | None:
        """The trial of a model, or of the `SUPPORTED` one, if the photographs determine it."""
        if lens == SUPPORTED and self.found:
            return supported(self.found)
        return next((trial for trial in self.found if trial.lens == lens), None)


@dataclass(frozen=True, slots=True)
class Result:
    """The chosen model."""

    trial: Trial
    supported: Trial
    """The model that the photographs support."""
    grown: Growth | None
    """The focal length and its error by the count of photographs."""
    board: Measured
    covered: Coverage
    advice: str
    """Subject of the next photograph."""
    mixed: str
    """A sentence on photographs that differ from the others, if there are any."""


@dataclass(frozen=True, slots=True)
class Shown:
    """The photograph that is shown."""

    index: int
    codes: Codes | None
    """(H, W, 3), or (H, W, 1) grey; smaller than the photograph if that is large; None if it is
    not at hand."""


@dataclass(frozen=True, slots=True)
class Errors:
    """Found and predicted corners (N, 2) of one photograph or of many, px."""

    found: Floats
    off: Floats
    """Found minus predicted."""

    @property
    def rms_px(self) -> float:
        """Root of the mean squared distance."""
        return float(np.sqrt((self.off * self.off).sum(axis=-1).mean()))


def _used(given: Boards, without: int) -> Boards:
    return given.without(without)


def _every(
    given: Boards, used: Boards, of_all: Trials, shape: str, without: int, quick: bool
) -> Trials:
    """The models from all photographs but the one left out; quickly from the result for all."""
    views = used.views
    if len(views) == len(given.views):
        return of_all
    if of_all.problem or not quick:
        return _all(used, shape)
    rest = [index for index in range(len(given.views)) if index != without - 1]
    starts = tuple(
        replace(trial, fit=replace(trial.fit, poses=trial.fit.poses.take(rest)))
        for trial in of_all.found
    )
    try:
        return Trials(views, compare_first(starts, views, quick), tried=of_all.tried)
    except UndeterminedError as problem:
        return Trials(views, problem=problem.naming(used.names))


def _all(used: Boards, shape: str) -> Trials:
    """The models from photographs, with a shape of the board or with that which they support."""
    views = used.views
    try:
        flat = compare(views, used.size)
    except UndeterminedError as problem:
        return Trials(views, problem=problem.naming(used.names))
    if shape == "flat":
        return Trials(views, flat)
    tried = shapes(views, flat)
    same_shape = [trial for trial in tried if trial.shape == shape]
    chosen = same_shape[0] if same_shape else best_shape(tried)
    found = flat if chosen.shape == "flat" else with_shape(views, flat, chosen)
    return Trials(views, found, tried=tried)


def _trials(used: Boards, every: Trials, photographs: int, quick: bool) -> Trials:
    """The models from the first photographs; the search starts from the result for all."""
    views = every.views.take(slice(photographs))
    if every.problem or len(views) == len(every.views):
        return every
    try:
        found = compare_first(every.found, views, quick)
        return Trials(views, found, tried=every.tried)
    except UndeterminedError as problem:
        return Trials(views, problem=problem.naming(used.names))


def _result(used: Boards, every: Trials, trials: Trials, lens: str) -> Result | None:
    """The chosen model; none if the photographs do not determine it."""
    trial, grown = trials.of(lens), None
    if trial is None:
        return None
    of_all = every.of(trial.lens)
    if of_all and lens == SUPPORTED:
        of_all = as_chosen(of_all, every.found)
    if of_all is not None:
        sigma, choice = of_all.uncertainty.sigma_px, float(of_all.uncertainty.choice[0])
        grown = values_by_count(every.views, of_all.fit, of_all.free, sigma, "fx", LEAST, choice)
    best = supported(trials.found)
    covered = coverage(trials.views, best.fit, used.size)
    board = measure_shape(trials.views, trial)
    mixed = _mixed([used.names[index] for index in differing(trials.views, trial)], trials.views)
    return Result(trial, best, grown, board, covered, next_photograph(covered), mixed)


def _mixed(names: list[str], views: Views) -> str:
    """A sentence on the photographs that differ, if there are any."""
    if not names:
        return ""
    these = f"{listed(names, MOST)} differ{'s' * (len(names) == 1)} from the others"
    every = "The photographs differ from each other"
    return MIXED.format(these=every if len(names) == len(views) else these)


def _shown(given: Boards, photograph: Photograph | None, shown: int, quick: bool) -> Shown:
    """The reader's photograph that is chosen in the page, or the simulated one of a number."""
    if photograph and photograph.number in given.numbers:
        return Shown(given.numbers.index(photograph.number), photograph.codes)
    index = min(shown, len(given.views)) - 1
    if given.truth is None:
        return Shown(index, None)
    return Shown(index, rendered(index, QUICK_SCALE if quick else 1.0))


def _found(given: Boards, shown: Shown, quick: bool) -> Views | None:
    """The corners of that photograph, found in it if it is simulated and there is time.

    None if the finder refuses it.
    """
    if given.truth is None or quick or shown.codes is None:
        return given.views.take([shown.index])
    try:
        board = find_board(shown.codes[..., 0])
    except NoBoardError:
        return None
    return Views.stack([(board.indices, board.places)])


def _errors(found: Views | None, result: Result | None) -> Errors | None:
    """Errors of the found corners, with the pose that fits them best; none if there is no pose."""
    fit = None if result is None or found is None else _posed(found, result.trial)
    if found is None or fit is None:
        return None
    off = residuals(found, fit.camera, fit.poses)
    return Errors(found.pixels[found.found], off[found.found])


def _posed(view: Views, trial: Trial) -> Adjusted | None:
    """One photograph by the camera of a trial, with the pose that fits it best; none if its corners
    determine no pose."""
    camera = trial.fit.camera
    with suppress(UndeterminedError):
        poses = poses_of(homographies(view), camera.matrix)
        with suppress(UndeterminedError):  # corners may be beyond what this lens can see
            poses = estimate_poses(view, camera)
        poses = replace(poses, shape=trial.fit.poses.shape)
        return refine(view, camera, poses, (), draft=True)
    return None


def _photograph_errors(given: Boards, result: Result | None, detail: str) -> Floats | None:
    """(P,) the error of every photograph, used or not, with the pose that fits it best; NaN if
    there is none."""
    if detail != SHEET:
        return None
    views = [given.views.take([index]) for index in range(len(given.views))]
    fits = [(view, _posed(view, result.trial) if result else None) for view in views]
    return np.array([rms_of_each(view, fit)[0] if fit else np.nan for view, fit in fits])


def _map(trials: Trials, result: Result | None) -> Errors | None:
    """Errors of all photographs that the camera was fitted to."""
    if result is None:
        return None
    views, fit = trials.views, result.trial.fit
    off = residuals(views, fit.camera, fit.poses)
    return Errors(views.pixels[views.found], off[views.found])


def _codes(shown: Shown) -> Codes | None:
    return shown.codes


def _developed(codes: Codes | None, given: Boards, result: Result | None) -> Codes | None:
    """The photograph without distortion."""
    if codes is None or result is None:
        return codes
    return undistorted(codes, result.trial.fit.camera.scaled(codes.shape[1] / given.size[0]))


def _not_developed(share: float) -> str:
    return "the dividing line is at the right border" if share == 1.0 else ""


STAGES = (
    Stage("boards", boards),
    Stage("used", _used, ("boards",)),
    Stage("all", _all, ("boards",)),
    Stage("every", _every, ("boards", "used", "all")),
    Stage("trials", _trials, ("used", "every")),
    Stage("result", _result, ("used", "every", "trials")),
    Stage("looked", _shown, ("boards",)),
    Stage("found", _found, ("boards", "looked")),
    Stage("errors", _errors, ("found", "result")),
    Stage("map", _map, ("trials", "result")),
    Stage("each", _photograph_errors, ("boards", "result")),
    Stage("codes", _codes, ("looked",)),
    Stage("developed", _developed, ("codes", "boards", "result"), neutral=_not_developed),
)
"""The stages in order."""
