"""Calibrating a camera: the closed form alone, and two ways to refine it."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from itertools import islice

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.calibration.bundle_adjustment import FIRST_DAMPING, MOST_STEPS, descend
from simulations.models.calibration.camera import LENSES, PINHOLE, Camera, Poses, predicted
from simulations.models.calibration.simulated import sitting
from simulations.models.calibration.views import Views
from simulations.models.calibration.zhang import closed_form, homographies, linear_lens, poses_of
from simulations.models.chequerboard.board import Board
from simulations.models.distortion.lens_model import Distortion

SIZE = (640, 480)
TRUTH = Camera(520.0, 520.0, 322.0, 238.0, Distortion(k1=-0.25, k2=0.08))
PHOTOGRAPHS, NOISE_PX = 10, 0.1
FREE = PINHOLE + LENSES["k1k2"]
GUESSES = (0.3, 0.4, 0.5, 0.7, 1.4, 2.0, 3.0, 4.0, 6.0, 8.0)
"""Focal lengths of poor starts, in units of the true one; the axis is in the middle."""
ARRIVED_PX = 1e-3
"""RMS distance of the corners from the corners of the minimum below which a start has converged."""
FAR_PX = 1e3

type Start = tuple[Camera, Poses]


@dataclass(frozen=True, slots=True)
class Workload:
    """Corners, and starts of the search: the closed form, and poor ones."""

    views: Views
    poor: tuple[Start, ...]
    poses: Poses
    """The true ones, hidden from the tiers."""


def prepare() -> Workload:
    return _workload(2, 0)


def draw(index: int) -> Workload:
    """Other poses of the board and other noise."""
    return _workload(100 + index, 1 + index)


def _workload(seed: int, noise_seed: int) -> Workload:
    session = sitting(TRUTH, SIZE, PHOTOGRAPHS, Board(), seed)
    views = session.views(NOISE_PX, noise_seed)
    H = homographies(views)
    guesses = [Camera(s * TRUTH.fx, s * TRUTH.fx, 319.5, 239.5) for s in GUESSES]
    return Workload(
        views, tuple((camera, poses_of(H, camera.matrix)) for camera in guesses), session.poses
    )


def reference(workload: Workload) -> Floats:
    """(P, N, 2) corners predicted at the minimum: from the true camera, by derivatives that are
    differences, in one dense system."""
    views, poses = workload.views, workload.poses
    values = np.concatenate((TRUTH.values(FREE), np.zeros(6 * len(views))))
    for _ in range(8):
        J, off = _differences(views, values, poses)
        values = values - np.linalg.lstsq(J, off, rcond=1e-14)[0]
    return _corners(views, values, poses)


def _corners(views: Views, values: Floats, poses: Poses) -> Floats:
    camera = TRUTH.changed(FREE, values[: len(FREE)])
    moved = poses.moved(values[len(FREE) :].reshape(-1, 6))
    return predicted(camera, moved, views.board)


def _differences(views: Views, values: Floats, poses: Poses) -> tuple[Floats, Floats]:
    """(2PN, m + 6P) derivatives of all corners, and (2PN,) how far these are off."""
    columns = []
    for index, value in enumerate(values):
        step = np.zeros_like(values)
        step[index] = 1e-5 * max(abs(value), 1.0)
        change = _corners(views, values + step, poses) - _corners(views, values - step, poses)
        columns.append(change.ravel() / (2.0 * step[index]))
    return np.stack(columns, axis=-1), (_corners(views, values, poses) - views.pixels).ravel()


type Search = Callable[[Views, Camera, Poses], Start]


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a tier found from the start of the closed form."""

    corners: Floats
    """(P, N, 2) predicted."""
    search: Search
    """The tier's search, to be tried from other starts."""


def run(workload: Workload, *, search: Search) -> Outcome:
    views = workload.views
    camera, poses = search(views, *closed_form(views, SIZE))
    return Outcome(predicted(camera, poses, views.board), search)


def as_it_is(_views: Views, camera: Camera, poses: Poses) -> Start:
    return camera, poses


def with_linear_lens(views: Views, camera: Camera, poses: Poses) -> Start:
    return linear_lens(views, camera, poses), poses


def stepped(views: Views, camera: Camera, poses: Poses, *, damping: float, steps: int) -> Start:
    """Up to so many steps, or fewer if the search settles."""
    *_, last = islice(descend(views, camera, poses, FREE, damping), steps + 1)
    return last.camera, last.poses


def rms_px(result: Outcome, truth: Floats, _workload: Workload) -> float:
    """RMS distance of the predicted corners from those at the minimum."""
    return _distance_px(result.corners, truth)


def arrived(result: Outcome, truth: Floats, workload: Workload) -> float:
    """Per cent of the poor starts from which the minimum is found."""
    views, count = workload.views, 0
    for start in workload.poor:
        try:
            with np.errstate(all="ignore"):
                camera, poses = result.search(views, *start)
        except (np.linalg.LinAlgError, ValueError):
            continue
        count += _distance_px(predicted(camera, poses, views.board), truth) < ARRIVED_PX
    return 100.0 * count / len(workload.poor)


def _distance_px(corners: Floats, truth: Floats) -> float:
    off = np.minimum(np.hypot(*np.moveaxis(corners - truth, -1, 0)), FAR_PX)
    return float(np.sqrt((off * off).mean()))


TIERS: tuple[tuple[str, str, str, Search], ...] = (
    ("closed-form", "Zhang’s closed form", "10 homographies, one 20 × 5 SVD", as_it_is),
    ("linear-lens", "and k₁, k₂ by linear equations", "one 1080 × 2 system", with_linear_lens),
    *(
        (
            f"gauss-newton-{steps}",
            f"Gauss–Newton, {steps} step{'s' if steps > 1 else ''}",
            f"{steps} × 10 systems of 6 × 6, one of 6 × 6",
            partial(stepped, damping=0.0, steps=steps),
        )
        for steps in (1, 3)
    ),
    (
        "gauss-newton",
        "Gauss–Newton, to the end",
        "as many steps as it takes, here 6",
        partial(stepped, damping=0.0, steps=MOST_STEPS),
    ),
    (
        "levenberg-marquardt",
        "Levenberg–Marquardt, to the end",
        "the same, and a sum of squares each",
        partial(stepped, damping=FIRST_DAMPING, steps=MOST_STEPS),
    ),
)

LADDER = Ladder(
    id="camera-calibration",
    title="Calibrating a camera",
    workload="540 corners of a board in 10 photographs, 640 × 480 px, σ = 0.1 px, k₁ = −0.25",
    prepare=prepare,
    tiers=tuple(
        Tier(name, label, cost, partial(run, search=search)) for name, label, cost, search in TIERS
    ),
    reference=reference,
    reference_label="dense least squares from the true camera, by numeric derivatives",
    metrics=(
        Metric("rms", "RMS distance from the minimum", "px", rms_px),
        Metric("arrived", "Poor starts that arrive", "%", arrived, higher_is_better=True),
    ),
    draw=draw,
    default_tier="levenberg-marquardt",
    items=540,
    item="corner",
)
