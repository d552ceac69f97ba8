"""How far a board that was estimated with a camera is from flat, and its squares from square."""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.model_choice import Trial
from simulations.models.calibration.views import Views

NOTED, NOTED_SHARE = 3.0, 2e-3
"""A ratio of sides that differs from 1 by more standard errors, and by a larger share, is told."""
NARROW = (
    "The picture is {share:.1f} % {way} than a camera with square pixels would make it: "
    "the squares of the board are not square, or the picture was stretched."
)


@dataclass(frozen=True, slots=True)
class Measured:
    """A board in squares of its own width."""

    bent: bool
    """Whether its shape was estimated at all."""
    relief: Floats
    """(R, C) of its corners along z, away from the camera, about the plane that fits best."""
    height_error: float
    """Standard error of the relief's range."""
    aspect: float
    """Height of a square by its width."""
    aspect_error: float

    @property
    def height(self) -> float:
        """From the lowest to the highest corner."""
        return float(np.ptp(self.relief))


def measure_shape(views: Views, trial: Trial) -> Measured:
    """The board of a trial."""
    shape = trial.fit.poses.shape
    columns, rows = views.board[views.found].max(axis=0).astype(int) + 1
    board = np.stack(np.meshgrid(np.arange(columns), np.arange(rows)), axis=-1).astype(float)
    if not shape.terms:
        return Measured(False, np.zeros((rows, columns)), 0.0, 1.0, 0.0)
    out_of_plane = np.array([axis == 2 for axis, _, _ in shape.terms])
    plane = np.column_stack((board.reshape(-1, 2), np.ones(rows * columns)))
    powers = shape.powers(board).reshape(-1, len(out_of_plane)) * out_of_plane
    powers = powers - plane @ np.linalg.lstsq(plane, powers, rcond=None)[0]
    relief = powers @ shape.values
    row = powers[relief.argmax()] - powers[relief.argmin()]
    errors = trial.uncertainty.errors
    names = list(trial.uncertainty.names)
    start = names.index(shape.names[0])
    covariance = trial.uncertainty.covariance[start:, start:]
    return Measured(
        True,
        relief.reshape(rows, columns),
        float(np.sqrt(row @ covariance @ row)),
        shape.aspect,
        errors["y01"] / shape.reach,
    )


def stretched(trial: Trial) -> str:
    """A sentence if the focal lengths across and down differ, which those of few cameras do."""
    camera, covariance = trial.fit.camera, trial.uncertainty.covariance
    off = camera.fy / camera.fx - 1.0
    error = float(np.sqrt((1.0, -1.0) @ covariance[:2, :2] @ (1.0, -1.0))) / camera.fx
    if abs(off) < max(NOTED * error, NOTED_SHARE):
        return ""
    return NARROW.format(share=100.0 * abs(off), way="higher" if off > 0.0 else "wider")
