"""Chapter 2: rotations and poses."""

from collections.abc import Callable
from math import degrees, exp

import numpy as np
from support.worked_numbers import Phrases

from simulations.models.geometry import rotations
from simulations.scenes.rotation_3d import orientation, paths

CHAPTER = "02-3d-transformations"


def the_ladder_in_space() -> Phrases:
    """Degrees of freedom are independent directions in which the matrix can start to move."""

    def projective(p: np.ndarray) -> np.ndarray:
        H: np.ndarray = np.eye(4) + p.reshape(4, 4)
        H /= np.linalg.norm(H)  # a factor changes nothing
        return H

    def moved(matrix: np.ndarray, offset: np.ndarray) -> np.ndarray:
        return np.block([[matrix, offset[:, None]], [np.zeros((1, 3)), np.ones((1, 1))]])

    turned = rotations.exponential
    rungs: dict[str, tuple[int, Callable[[np.ndarray], np.ndarray]]] = {
        "Translation": (3, lambda p: moved(np.eye(3), p)),
        "Rigid": (6, lambda p: moved(turned(p[:3]), p[3:])),
        "Similarity": (7, lambda p: moved(exp(p[6]) * turned(p[:3]), p[3:6])),
        "Affine": (12, lambda p: moved(np.eye(3) + p[:9].reshape(3, 3), p[9:])),
        "Projective": (16, projective),
    }
    for rung, (parameters, matrix) in rungs.items():
        steps = 1e-5 * np.eye(parameters)
        moves = [(matrix(step) - matrix(-step)).ravel() / 2e-5 for step in steps]
        yield f"| {rung} | {np.linalg.matrix_rank(moves, tol=1e-6)} |"


def distance_of_the_euler_path_from_slerp() -> Phrases:
    ways = paths(orientation(100, 90, 100), "slerp")
    between = ways["slerp"](0.5).T @ ways["euler"](0.5)
    apart_deg = degrees(np.linalg.norm(rotations.logarithm(between)))
    yield f"at the *same* progress the first is {apart_deg:.1f}° away"
