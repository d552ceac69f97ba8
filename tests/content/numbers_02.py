"""Chapter 2: rotations and poses."""

from math import acos, cos, exp, radians, sin, sqrt, tan

import numpy as np
from support.worked_numbers import Says

from simulations.models.arrays import Floats
from simulations.models.geometry import euler, quaternions, rotations, transforms_3d
from simulations.models.geometry.lines_and_planes import plane_through
from simulations.models.geometry.quaternion_blends import bisected_arc, turn_between_rad
from simulations.models.geometry.rotation_paths import matrix_blend, rate_axes
from simulations.models.projection.pinhole import rigid_pose, world_to_camera

CHAPTER = "02-3d-transformations"


def crossing(vector: Floats) -> Floats:
    """The matrix (3, 3) that takes the cross product with a vector (3,)."""
    x, y, z = vector
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def the_shortcut_of_small_angles() -> Says:
    p, angle = np.array((1.0, 0, 0)), radians(5)
    short = p + angle * np.cross((0, 0, 1), p)
    off = np.linalg.norm(short - rotations.exponential([0, 0, angle]) @ p)
    yield rf"At 5° this is off by at most {off:.3f} of the length"


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


def two_frames_of_a_film() -> Says:
    start, end = quaternions.from_rotation_vector(np.radians([(0, 0, 0), (0, 0, 2)]))
    share = np.linspace(0, 1, 101)
    off = turn_between_rad(rotations.nlerp(start, end, share), bisected_arc(start, end, share))
    assert 0.9e-5 < np.degrees(off.max()) < 1e-5
    yield "a degree or two apart, by less than 0.00001°"


def a_camera_centre_by_hand() -> Says:
    R, t = np.array([[0, 0, -1], [0, 1, 0], [1, 0, 0]]), np.array([4, 1, -3])
    assert np.isclose(np.linalg.det(R), 1.0)
    assert np.allclose(R[2], [1, 0, 0]), "it looks along the world's right"
    wrong = (R.T @ t, -R @ t, t)
    for x, y, z in (-R.T @ t, *wrong):
        yield f"At $({x}, {y}, {z})$ m"
    assert not any(np.allclose(R @ each + t, 0) for each in wrong)


def a_quaternion_by_hand() -> Says:
    axis = np.ones(3) / np.sqrt(3)
    turn = rotations.from_axis_angle(axis, radians(120))
    assert np.allclose(quaternions.from_matrix(turn), 0.5)
    assert np.allclose(turn, [[0, 0, 1], [1, 0, 0], [0, 1, 0]])
    yield "three times 120° is a full turn"
    yield rf"$\cos 60^\circ = {cos(radians(60)):g}$"
    across = crossing(np.full(3, 0.5))
    assert np.allclose(np.eye(3) + across + 2 * across @ across, turn)
    assert np.allclose(2 * across, [[0, -1, 1], [1, 0, -1], [-1, 1, 0]])
    assert np.allclose(4 * across @ across, [[-2, 1, 1], [1, -2, 1], [1, 1, -2]])


def a_matrix_without_sines() -> Says:
    for vector in ((0.3, -1.2, 0.4), (2.0, 1.5, 0.1), (0.0, 0.0, 0.0)):
        w, *u = quaternions.from_rotation_vector(vector)
        across = crossing(np.array(u))
        assert np.allclose(across @ [1, 2, 3], np.cross(u, [1, 2, 3]))
        expected = rotations.exponential(vector)
        assert np.allclose(np.eye(3) + 2 * w * across + 2 * across @ across, expected)
    yield r"$$R = I + 2w\,[\mathbf{u}]_\times + 2\,[\mathbf{u}]_\times^2$$"


def the_exponential_of_a_cross_product_matrix() -> Says:
    vector = np.array([0.3, -1.2, 0.4])
    total = term = np.eye(3)
    for n in range(1, 30):
        term = term @ crossing(vector) / n
        total = total + term
    assert np.allclose(total, rotations.exponential(vector), atol=1e-14)
    unit = crossing(vector / np.linalg.norm(vector))
    assert np.allclose(unit @ unit @ unit, -unit)
    yield r"$[\hat{\mathbf{n}}]_\times^3 = -[\hat{\mathbf{n}}]_\times$"


def gimbal_lock() -> Says:
    def axes(pan: float, tilt: float, roll: float) -> Floats:
        return euler.to_matrix("YXZ", np.radians([pan, tilt, roll]))

    c, s = cos(radians(30)), sin(radians(30))
    assert np.allclose(axes(40, 90, 10), [[c, s, 0.0], [0.0, 0, -1], [-s, c, 0.0]])
    assert np.allclose(axes(40, 90, 10), axes(30, 90, 0))
    yield "a pan of 40° with a roll of 10° gives exactly the matrix of a pan of 30° with none"
    assert np.allclose(axes(0, 90, 0), axes(40, 90, 40))
    assert np.isclose(np.trace(axes(0, 90, 0).T @ axes(40, 90, -40)), 1 + 2 * cos(radians(80)))
    yield "the camera has then turned by 80°"
    assert np.allclose(axes(50, -90, 20), axes(70, -90, 0))
    yield r"the matrix depends on $\psi + \rho$ alone"


def near_the_lock() -> Says:
    """In the worst direction, pan and roll must change as much as one another."""
    for tilt in np.radians((-70, 20, 60, 80)):
        smallest = np.linalg.svd(rate_axes("YXZ", [0.3, tilt, 0.7]))[1][2]
        assert np.isclose(smallest, np.sqrt(1 - abs(sin(tilt))))
    yield r"The smallest singular value is $\sqrt{1 - |\sin\tau|}$"
    for degrees in range(80, 90):
        _, factors, inputs = np.linalg.svd(rate_axes("YXZ", [0.3, radians(degrees), 0.7]))
        pan, tilt, roll = np.abs(inputs[2] / factors[2])
        assert np.isclose(pan, roll)
        assert tilt < 1e-9
        assert (factors[2] < 0.1) == (pan > 7.08)
    yield "pan and roll must each change by more than seven degrees to turn the camera by one"


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


def coordinates_far_from_the_origin() -> Says:
    step = float(np.spacing(np.float32(4e6)))
    yield f"neighbouring numbers there are {step:g} m apart"
    yield f"in steps of {100 * step:.0f} cm"


def the_ladder_in_space() -> Says:
    """As many freedoms as independent directions in which the matrix can start to move."""

    def projective(p: np.ndarray) -> np.ndarray:
        H: np.ndarray = np.eye(4) + p.reshape(4, 4)
        H /= np.linalg.norm(H)  # a factor changes nothing
        return H

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


def cosines_that_are_flat() -> Says:
    spacing = 1 - np.nextafter(1.0, 0.0)
    assert np.isclose(spacing, 1.1e-16, rtol=0.01)
    yield r"which are $1.1\cdot 10^{-16}$ apart there"
    assert np.isclose(spacing / 2, 5.6e-17, rtol=0.01)
    assert np.isclose(sqrt(spacing), 1.05e-8, rtol=0.005)
    yield r"\approx 5.6\cdot 10^{-17} \quad\Rightarrow\quad \theta \approx 1.05\cdot 10^{-8}$$"
    assert acos(cos(1.04e-8)) == 0 < acos(cos(1.07e-8))
    yield "only two digits are left of an angle ten times as large"
    larger = np.linspace(0.95e-7, 1.05e-7, 1001)
    assert 0.002 < np.abs(np.arccos(np.cos(larger)) / larger - 1).max() < 0.01
    small = rotations.logarithm(rotations.exponential([1e-10, 0, 0]))
    assert np.allclose(small, [1e-10, 0, 0], rtol=1e-15)
    yield "It recovers $10^{-10}$ to all digits"


def a_line_by_six_numbers() -> Says:
    start, end = np.array([1.0, 0, 0]), np.array([1.0, 0, 2])
    v, m = end - start, np.cross(start, end)
    assert v @ m == 0.0
    for name, (x, y, z) in (("v", v), ("m", m)):
        yield rf"$\mathbf{{{name}}} = ({x:g}, {y:g}, {z:g})$"
    yield f"so it is {np.linalg.norm(m) / np.linalg.norm(v):g} m from the origin"


def a_plane_that_keeps_its_points() -> Says:
    R, t = rotations.exponential([0.3, -0.5, 0.2]), np.array([1.0, -2, 3])
    corners = np.array([[0.0, 1, 3], [2, 1, 3], [0, 0, 4]])
    desk, _ = plane_through(*corners)
    n = R @ desk[:3]
    moved, _ = plane_through(*(corners @ R.T + t))
    assert np.allclose(moved, [*n, desk[3] - n @ t])
    yield r"$d' = d - \mathbf{n}' \cdot \mathbf{t}$"


WORKED = (
    a_hundredth_of_a_degree,
    cosines_that_are_flat,
    a_line_by_six_numbers,
    a_plane_that_keeps_its_points,
    the_shortcut_of_small_angles,
    to_pan_tilt_and_roll_a_camera,
    two_frames_of_a_film,
    a_camera_centre_by_hand,
    a_quaternion_by_hand,
    a_matrix_without_sines,
    the_exponential_of_a_cross_product_matrix,
    gimbal_lock,
    near_the_lock,
    averages_of_matrices,
    the_ladder_in_space,
    coordinates_far_from_the_origin,
)
