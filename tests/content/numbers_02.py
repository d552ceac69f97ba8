"""Chapter 2: rotations and poses."""

from math import cos, exp, radians

import numpy as np
from support.worked_numbers import Says

from simulations.models import euler, quaternions, rotations, transforms_3d
from simulations.models.projection import look_at, rigid_pose, world_to_camera
from simulations.models.rotation_paths import matrix_blend

CHAPTER = "02-3d-transformations"


def a_camera_that_looks_to_the_left() -> Says:
    pose = look_at((10, 0, 0), (0, 0, 0), (0, -1, 0))
    assert np.allclose(pose[:3, :3], [[0, 0, 1], [0, 1, 0], [-1, 0, 0]])
    assert np.allclose(pose[:3, 3], [0, 0, 10])
    lamp = np.array((2, -1, 3))
    turned = pose[:3, :3] @ lamp
    yield rf"Then $R\mathbf{{p}} = ({turned[0]:.0f}, {turned[1]:.0f}, {turned[2]:.0f})$"
    seen = world_to_camera(lamp, rigid_pose(pose[:3, :3], pose[:3, 3]))
    yield rf"+ (0, 0, 10) = ({seen[0]:.0f}, {seen[1]:.0f}, {seen[2]:.0f})\ \text{{m}}$$"
    yield rf"$\sqrt{{9 + 1 + 64}} = {np.linalg.norm(seen):.2f}$ m"
    assert np.isclose(np.linalg.norm(seen), np.linalg.norm(lamp - (10, 0, 0)))


def the_shortcut_of_small_angles() -> Says:
    p, angle = np.array((1.0, 0, 0)), radians(5)
    short = p + angle * np.cross((0, 0, 1), p)
    off = np.linalg.norm(short - rotations.exponential([0, 0, angle]) @ p)
    yield rf"the error of that shortcut is about {off:.3f} of the length"


def a_quaternion_by_hand() -> Says:
    axis = np.ones(3) / np.sqrt(3)
    turn = rotations.from_axis_angle(axis, radians(120))
    assert np.allclose(quaternions.from_matrix(turn), 0.5)
    assert np.allclose(turn, [[0, 0, 1], [1, 0, 0], [0, 1, 0]])
    yield "three times 120° is a full turn"
    yield rf"$\cos 60^\circ = {cos(radians(60)):g}$"
    yield rf"$1 - \cos\theta = {1 - cos(radians(120)):g}$"


def the_determinant_of_an_average() -> Says:
    half = matrix_blend(np.eye(3), rotations.exponential([0, 0, radians(90)]), 0.5)
    yield f"the plain average of the two matrices has the determinant {np.linalg.det(half):.1f}"


def gimbal_lock() -> Says:
    locked = euler.to_matrix("ZYX", [radians(10), radians(90), radians(40)])
    alike = euler.to_matrix("ZYX", [0, radians(90), radians(30)])
    assert np.allclose(locked, alike)
    yield "40° of roll with 10° of yaw gives exactly the matrix of 30° of roll with none"


def the_average_of_two_matrices() -> Says:
    turn = rotations.exponential([0, 0, radians(90)])
    half = matrix_blend(np.eye(3), turn, 0.5)
    assert np.isclose(np.linalg.det(half), 0.5)
    across = np.linalg.norm(half[:, 0])
    yield f"shrinks everything across the axis to {100 * across:.0f} %"
    yield f"Its first two columns have length {across:.2f}."


def a_rolling_shutter() -> Says:
    yield f"has turned by {90 * 0.020:g}° between the first row and the last"


def coordinates_far_from_the_origin() -> Says:
    step = float(np.spacing(np.float32(4e6)))
    yield f"neighbouring numbers there are {step:g} m apart"
    yield f"in steps of {100 * step:.0f} cm"


def the_ladder_in_space() -> Says:
    """As many freedoms as independent directions in which the matrix can start to move."""

    def projective(p: np.ndarray) -> np.ndarray:
        H = np.eye(4) + p.reshape(4, 4)
        return H / np.linalg.norm(H)  # a factor changes nothing

    turned = rotations.exponential
    rungs = {
        "Translation": (3, transforms_3d.translation),
        "Rigid": (6, lambda p: transforms_3d.rigid(turned(p[:3]), p[3:])),
        "Similarity": (7, lambda p: transforms_3d.similarity(exp(p[6]), turned(p[:3]), p[3:6])),
        "Affine": (12, lambda p: transforms_3d.affine(np.eye(3) + p[:9].reshape(3, 3), p[9:])),
        "Projective": (16, projective),
    }
    for rung, (parameters, matrix) in rungs.items():
        steps = 1e-5 * np.eye(parameters)
        moves = [(matrix(step) - matrix(-step)).ravel() / 2e-5 for step in steps]
        yield f"| {rung} | {np.linalg.matrix_rank(moves, tol=1e-6)} |"


WORKED = (
    a_camera_that_looks_to_the_left,
    the_shortcut_of_small_angles,
    a_quaternion_by_hand,
    the_determinant_of_an_average,
    gimbal_lock,
    the_average_of_two_matrices,
    a_rolling_shutter,
    the_ladder_in_space,
    coordinates_far_from_the_origin,
)
