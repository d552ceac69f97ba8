"""Chapter 3: perspective projection."""

from math import atan, degrees, isclose, radians

import numpy as np
from support.worked_numbers import Says

from simulations.models.geometry.rotations import exponential
from simulations.models.geometry.transforms import apply_homography
from simulations.models.lens.thin_lens import principal_distance_mm
from simulations.models.projection.pinhole import (
    field_of_view_rad,
    intrinsics,
    look_at,
    project,
)
from simulations.models.projection.vanishing import vanishing_point
from simulations.models.projection.view_homographies import plane_between_views, turned_camera

CHAPTER = "03-perspective-projection"


def focusing_makes_the_picture_larger() -> Says:
    sensor = principal_distance_mm(50, 3200)
    yield rf"$50 \cdot 3200/3150 = {sensor:.3f}$ mm behind it"
    yield rf"$f_x = {sensor:.3f} \cdot 6000/36 = {round(sensor, 3) * 6000 / 36:.0f}$ px"
    share = f"{100 * (sensor / 50 - 1):.1f} %"
    yield f"That is {share} more than before, and everything in the picture is {share} larger."
    far, near = (degrees(field_of_view_rad(distance, 36)) for distance in (50, sensor))
    yield rf"has shrunk from ${far:.1f}^\circ$ to ${near:.1f}^\circ$"
    face = principal_distance_mm(135, 1000) / 135 - 1
    yield f"With a 135 mm lens and a face at 1 m, the picture grows by {100 * face:.0f} %."


def where_two_rails_meet() -> Says:
    left = np.cross((100, 480, 1), (250, 300, 1)) / 30
    right = np.cross((540, 480, 1), (390, 300, 1)) / 30
    for line in (left, right):
        column = r" \\ ".join(f"{entry:.0f}" for entry in line)
        yield rf"\sim \begin{{bmatrix}} {column} \end{{bmatrix}}"
    meet = np.cross(left, right)
    u, v = meet[:2] / meet[2]
    yield rf"\sim \begin{{bmatrix}} {u:.0f} \\ {v:.0f} \\ 1 \end{{bmatrix}}"
    yield f"The rails meet at $({u:.0f}, {v:.0f})$."
    yield f"Then the rails meet {240 - v:.0f} px above the principal point"
    yield rf"$\arctan(24/800) = {degrees(atan(24 / 800)):.1f}^\circ$"
    down = look_at([0, 0, 0], [0, -24 / 800, 1], [0, 1, 0])  # heights upwards, z along the track
    seen, valid = vanishing_point(down[:3, :3] @ (0, 0, 1), intrinsics(800, (320, 240)))
    assert valid
    yield f"the horizon is row {seen[1]:.0f}."


def a_turn_and_a_step_aside() -> Says:
    K = intrinsics(800, (320, 240))
    turned, _ = apply_homography(turned_camera(K, K, exponential([0, -radians(10), 0])), (320, 240))
    yield rf"$320 - 800\tan 10^\circ = {turned[0]:.1f}$ px"
    aside = K @ [-0.1, 0, 0]
    yield r"$K\mathbf{t} = (" + ", ".join(f"{part:g}" for part in aside) + ")$"
    near, far = (
        project([1.0, 0, depth], K)[0][0] - project([0.9, 0, depth], K)[0][0] for depth in (4, 40)
    )
    yield f"{near:.0f} px to the left for a thing at 4 m, {far:.0f} px for one at 40 m"


def a_wall_between_two_views() -> Says:
    K, motion = intrinsics(800, (320, 240)), np.eye(4)
    motion[0, 3] = -0.1
    H = plane_between_views(K, K, motion, (0, 0, -1, 4))
    yield f"$-0.1/4 = {(np.linalg.inv(K) @ H @ K)[0, 2]:g}$"
    pixels = np.array([[320.0, 240], [10, 20]])
    moved, _ = apply_homography(H, pixels)
    assert np.allclose(moved - pixels, [-20, 0])
    yield "$f$ times that is 20 px to the left"


ROAD = np.array([[1, 0, 0], [0, 1, 0], [0.5, 0, 1]])


def the_picture_of_a_circle() -> Says:
    back = np.linalg.inv(ROAD)
    C = back.T @ np.diag([1, 1, -1]) @ back
    assert np.isclose(C[0, 1], 0)
    yield f"${C[0, 0]:g}x^2 + x + y^2 - 1 = 0$"
    assert np.allclose([2 * C[0, 2], C[1, 1], C[2, 2]], [1, 1, -1])
    left, right = (float(apply_homography(ROAD, [x, 0.0])[0][0]) for x in (-1.0, 1.0))
    yield f"from $x = {left:g}$ to $x = {right:.3f}$, the images of $(-1, 0)$ and $(1, 0)$"
    yield f"Its middle is at ${(left + right) / 2:.3f}$"


def a_ratio_of_ratios() -> Says:
    def ratio(a: float, b: float, c: float, d: float) -> float:
        return (b - a) * (d - c) / ((c - a) * (d - b))

    after = [float(apply_homography(ROAD, [x, 0.0])[0][0]) for x in range(4)]
    yield "become {:g}, {:.3f}, {:g} and {:g}".format(*after)
    yield f"$1 \\cdot 1/(2 \\cdot 2) = {ratio(0, 1, 2, 3):g}$"
    yield f"/(1 \\cdot {after[3] - after[1]:.3f}) = {ratio(*after):g}$"


def a_step_forwards() -> Says:
    """Two metres towards things 4 m and 8 m away: the slide goes with the second depth."""
    K = intrinsics(800, (0, 0))
    slides = []
    for depth in (4.0, 8.0):
        point = np.array([100 / 800 * depth, 0, depth])
        assert isclose(project(point, K)[0][0], 100)
        slides.append(project(point - (0, 0, 2.0), K)[0][0] - 100)
    yield f"the pixel slides by {slides[0]:.0f} px. If it was 8 m away"
    yield f"the pixel slides by {slides[1]:.1f} px"
    assert isclose(slides[0] / slides[1], (8 - 2) / (4 - 2))


WORKED = (
    the_picture_of_a_circle,
    a_ratio_of_ratios,
    a_step_forwards,
    a_turn_and_a_step_aside,
    a_wall_between_two_views,
    focusing_makes_the_picture_larger,
    where_two_rails_meet,
)
