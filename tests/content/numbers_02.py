"""Chapter 2: rotations and poses."""

from collections.abc import Callable
from math import cos, exp, radians, sin, tan

import numpy as np
from support.worked_numbers import Says

from simulations.models.geometry import euler, rotations
from simulations.models.geometry.rotation_paths import matrix_blend
from simulations.models.projection.pinhole import rigid_pose, world_to_camera

CHAPTER = "02-3d-transformations"


def to_pan_tilt_and_roll_a_camera() -> Says:
    """The camera's axes as columns, in a world whose axes are right, down and ahead."""
    x, y, z = np.eye(3)
    pan, tilt, roll = radians(30), radians(20), radians(10)
    assert (rotations.from_axis_angle(y, pan) @ z)[0] > 0
    yield r"A positive pan $\psi$ turns the camera to the right"
    assert (rotations.from_axis_angle(x, tilt) @ z)[1] < 0
    yield r"a positive tilt $\tau$ makes it look up"
    assert (rotations.from_axis_angle(z, roll) @ x)[1] > 0
    yield r"a positive roll $\rho$ leans it over to the right"
    yield r"\cos\psi & 0 & \sin\psi \\ 0 & 1 & 0 \\ -\sin\psi & 0 & \cos\psi"
    c, s = cos(pan), sin(pan)
    assert np.allclose(rotations.from_axis_angle(y, pan), [[c, 0.0, s], [0.0, 1, 0], [-s, 0.0, c]])
    yield r"1 & 0 & 0 \\ 0 & \cos\tau & -\sin\tau \\ 0 & \sin\tau & \cos\tau"
    c, s = cos(tilt), sin(tilt)
    assert np.allclose(rotations.from_axis_angle(x, tilt), [[1.0, 0, 0], [0, c, -s], [0, s, c]])
    yield r"\cos\rho & -\sin\rho & 0 \\ \sin\rho & \cos\rho & 0 \\ 0 & 0 & 1"
    c, s = cos(roll), sin(roll)
    assert np.allclose(rotations.from_axis_angle(z, roll), [[c, -s, 0], [s, c, 0], [0.0, 0, 1]])
    camera = euler.to_matrix("YXZ", [pan, tilt, 0])
    yield r"= \begin{bmatrix} " + r" \\ ".join(f"{part:.3f}" for part in camera[:, 2])
    aims = [sin(pan) * cos(tilt), -sin(tilt), cos(pan) * cos(tilt)]
    assert np.allclose(camera[:, 2], aims)
    seen = world_to_camera([0, 0, 10], rigid_pose(camera.T, [0, 0, 0]))
    yield f"$R\\,(0, 0, 10)^\\top = ({', '.join(f'{part:.2f}' for part in seen)})$ m"
    assert np.isclose(np.linalg.norm(seen), 10)
    other = euler.to_matrix("XYZ", [tilt, pan, 0])
    _, up, slant = np.degrees(euler.from_matrix(other, "YXZ")[0])
    yield f"looks up by only {up:.1f}°, and its horizon slants by {slant:.1f}°"


def averages_of_matrices() -> Says:
    half = matrix_blend(np.eye(3), rotations.exponential([0, radians(90), 0]), 0.5)
    assert np.isclose(np.linalg.det(half), 0.5)
    assert np.isclose(np.degrees(np.arctan2(half[0, 2], half[2, 2])), 45)
    yield f"shrinks everything across the axis to {100 * np.linalg.norm(half[:, 0]):.0f} %"
    flat = matrix_blend(np.eye(3), rotations.exponential([0, radians(180), 0]), 0.5)
    assert np.isclose(np.linalg.det(flat), 0.0)
    yield "They become dependent only for half a turn."
    other = matrix_blend(np.eye(3), rotations.exponential([0, 0, radians(60)]), 0.5)
    yield f"Its first two columns have length {np.linalg.norm(other[:, 0]):.2f}."


def the_ladder_in_space() -> Says:
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


def a_hundredth_of_a_degree() -> Says:
    angle = radians(0.01)
    assert 0.45 < 3000 * tan(angle) < 0.55, "half a pixel"
    yield rf"$\theta = {1e4 * angle:.2f}\cdot 10^{{-4}}$"
    yield rf"$1 - \theta^2/2 = 1 - {1e8 * angle**2 / 2:.1f}\cdot 10^{{-8}}$"
    step = 1 - np.nextafter(np.float32(1), np.float32(0))
    yield rf"these are ${1e8 * step:.1f}\cdot 10^{{-8}}$ apart"
    assert np.arccos(np.float32(cos(angle))) == 0
    near = angle * np.linspace(0.9, 1.1, 2001)
    assert 1e-9 < np.abs(np.arccos(np.cos(near)) / near - 1).max() < 5e-9
    yield "The 0.01° are then right to eight digits."
