"""Chapter 3: perspective projection."""

from math import atan, cos, degrees, isclose, pi, radians, sqrt

import numpy as np
from support.worked_numbers import Says

from simulations.models.geometry.rotations import exponential
from simulations.models.geometry.transforms import apply_homography
from simulations.models.lens.thin_lens import principal_distance_mm
from simulations.models.projection.level_ground import pose_above_ground
from simulations.models.projection.pinhole import (
    field_of_view_rad,
    intrinsics,
    look_at,
    project,
    rigid_pose,
    world_to_camera,
)
from simulations.models.projection.vanishing import angle_between, vanishing_point
from simulations.models.projection.view_homographies import plane_between_views, turned_camera

CHAPTER = "03-perspective-projection"


def image_px(x_m: float, depth_m: float, focal_px: float) -> float:
    pixel, _ = project([x_m, 0, depth_m], intrinsics(focal_px, (0, 0)))
    return float(pixel[0])


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


def a_ball_near_the_border() -> Says:
    assert np.isclose(1 / cos(radians(60)), 2), "about twice as long as it is wide"
    yield r"At $\theta = 60^\circ$ the ellipse is about twice as long as it is wide"


def how_tall_the_tree_is() -> Says:
    assert isclose(200 * image_px(1, 20, 40) / image_px(1, 30, 80), 150)
    yield "- [x] `200 * (30 / 20) / 2`"
    assert isclose(200 * 30 / 20, 300)
    yield "which makes 300 px"


def the_share_that_is_lost() -> Says:
    assert isclose((100.1 - 100) / 100, 1e-3, rel_tol=1e-6)
    assert isclose(0.1 / 0.6, 1 / 6)
    yield "so its share is a thousandth: a tenth of a pixel for a nose that is 100 px"


def the_cross_ratio_of_an_upright() -> Says:
    """As the formula has it, along the image of an upright that is seen from above."""
    yield r"\frac{h}{H} = \frac{(t - b)\,(g - c)}{(c - b)\,(g - t)}"
    K, pose = intrinsics(320, (200, 150)), pose_above_ground(1.6, 0, radians(40))
    b, t, c = project(world_to_camera([(1, 4, z) for z in (0, 1, 1.6)], pose), K)[0][:, 1]
    v = vanishing_point(pose[:3, 2], K)[0][1]
    assert isclose((t - b) * (v - c) / ((c - b) * (v - t)), 1 / 1.6)


def focal_length_from_a_floor() -> Says:
    f = sqrt((200 - 50) * (800 - 200))
    assert isclose(angle_between((50, 150, 1), (800, 150, 1), intrinsics(f, (200, 150))), pi / 2)
    yield "- [x] `sqrt(150 * 600)`"


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


def depths_before_two_cameras() -> Says:
    """A table 2 m below, seen by two cameras: w is the quotient of the depths."""
    K = intrinsics(800.0, (320.0, 240.0))
    pose = rigid_pose(exponential([0.2, -0.4, 0.1]), [0.5, -0.2, 0.3])
    H = plane_between_views(K, K, pose, [0.0, 1.0, 0.2, -2.0])
    X = np.array([0.4, 1.2, 4.0])
    assert X @ [0.0, 1.0, 0.2] == 2.0
    w = (H @ [*(K @ X)[:2] / X[2], 1.0])[2]
    assert np.isclose(w, world_to_camera(X, pose)[2] / X[2])
    yield "$w$ is the point's depth in front of the second camera divided by its depth in front"


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


def the_invertible_camera() -> Says:
    K, pose = np.eye(4), rigid_pose(exponential([0.2, -0.4, 0.1]), [0.5, -0.2, 0.3])
    K[:3, :3] = intrinsics(800, (320, 240))
    X = np.array([0.4, 1.2, 4.0, 1.0])
    image = K @ pose @ X
    image /= image[2]
    depth = (pose @ X)[2]
    pixel, _ = project((pose @ X)[:3], K[:3, :3])
    assert np.allclose(image, [*pixel, 1, 1 / depth])
    yield r"\tilde{P}\,\mathbf{X} \sim (u,\ v,\ 1,\ 1/Z)^\top"
    back = np.linalg.inv(K @ pose) @ image
    assert np.allclose(back / back[3], X)
    both = K @ pose @ np.linalg.inv(K)
    R, t = pose[:3, :3], pose[:3, 3]
    K3 = K[:3, :3]
    assert np.allclose(both[:3], np.column_stack([K3 @ R @ np.linalg.inv(K3), K3 @ t]))
    yield r"the upper three rows of $\tilde{P}_1\tilde{P}_0^{-1}$"
    yield f"{1 / 8:g} per metre for the lamp"


def only_a_level_view_along_the_rows_has_one_vanishing_point() -> Says:
    K = intrinsics(320, (200, 150))
    axes = np.array([(0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)])
    for (pitch, yaw), count in (((0, 0), 1), ((12, 0), 2), ((0, 45), 2), ((12, 45), 3)):
        pose = pose_above_ground(1.6, radians(yaw), radians(pitch))
        pixels, valid = vanishing_point(axes @ pose[:3, :3].T, K)
        near = np.abs(np.where(valid[:, None], pixels, np.inf)).max(axis=1) < 1e9
        assert near.sum() == count, (pitch, yaw)
    yield "Look level and straight along the rows: the lines across"
    yield "Turn by 45° and there are two"
    yield "Look down as well and there are three"


WORKED = (
    the_picture_of_a_circle,
    a_ratio_of_ratios,
    depths_before_two_cameras,
    a_step_forwards,
    the_invertible_camera,
    only_a_level_view_along_the_rows_has_one_vanishing_point,
    a_turn_and_a_step_aside,
    a_wall_between_two_views,
    focusing_makes_the_picture_larger,
    where_two_rails_meet,
    the_share_that_is_lost,
    how_tall_the_tree_is,
    a_ball_near_the_border,
    the_cross_ratio_of_an_upright,
    focal_length_from_a_floor,
)
