"""Chapter 3: perspective projection."""

from math import atan, cos, degrees, isclose, radians, sqrt

import numpy as np
from support.worked_numbers import Says

from simulations.models.lens.thin_lens import principal_distance_mm
from simulations.models.projection.affine_cameras import project_affine, scaled_orthographic_camera
from simulations.models.projection.pinhole import field_of_view_rad, intrinsics, look_at, project
from simulations.models.projection.vanishing import vanishing_point

CHAPTER = "03-perspective-projection"


def image_px(x_m: float, depth_m: float, focal_px: float) -> float:
    pixel, _ = project([x_m, 0, depth_m], intrinsics(focal_px, (0, 0)))
    return float(pixel[0])


def a_thumb_s_distance() -> Says:
    yield f"the person stands thirty times as far away: {0.60 * 1.8 / 0.06:.0f} m"


def five_metres_away() -> Says:
    yield rf"x = 80 \cdot \frac{{1.0}}{{5.0}} = {image_px(1, 5, 80):g}\ \text{{px}}"
    yield f"Move the point to 10 m: $x = {image_px(1, 10, 80):g}$ px."
    yield f"Move it to 2.5 m: $x = {image_px(1, 2.5, 80):g}$ px."
    yield f"double the focal length to 160 px: $x = {image_px(1, 5, 160):g}$ px"


def unequal_steps() -> Says:
    yield f"a step of {image_px(1, 2, 80) - image_px(1, 3, 80):.1f} px"
    far = image_px(1, 19, 80) - image_px(1, 20, 80)
    assert 0.2 < far < 0.22, "a fifth of a pixel"
    yield rf"$80 \cdot 1/(-2) = {80 * 1 / -2:.0f}$ px"


def focal_length_in_pixels() -> Says:
    yield f"has $f_x = {50 * 6000 / 36:.0f}$ px"
    angle = degrees(field_of_view_rad(50, 36))
    yield rf"2\arctan {36 / (2 * 50):g} = {angle:.1f}^\circ$"


def focusing_makes_the_picture_larger() -> Says:
    sensor = principal_distance_mm(50, 3200)
    yield rf"$50 \cdot 3200/3150 = {sensor:.3f}$ mm behind it"
    yield rf"$f_x = {sensor:.3f} \cdot 6000/36 = {round(sensor, 3) * 6000 / 36:.0f}$ px"
    share = f"{100 * (sensor / 50 - 1):.1f} %"
    yield f"That is {share} more than before, and everything in the picture is {share} larger."
    far, near = (degrees(field_of_view_rad(distance, 36)) for distance in (50, sensor))
    yield rf"has shrunk from ${far:.1f}^\circ$ to ${near:.1f}^\circ$"
    face = principal_distance_mm(135, 1000) / 135 - 1
    yield f"With a 135 mm lens and a face at 1 m it is {100 * face:.0f} %."


def photographing_the_lamp() -> Says:
    K = intrinsics(800, (320, 240))
    u, v, w = K @ (3, -1, 8)
    yield rf"\begin{{bmatrix}} {u:.0f} \\ {v:.0f} \\ {w:.0f} \end{{bmatrix}}"
    pixel, _ = project([3, -1, 8], K)
    yield f"$(u, v) = ({pixel[0]:.0f}, {pixel[1]:.0f})$ px"
    yield rf"$800 \cdot 3/8 = {pixel[0] - 320:.0f}$ px to the right of the centre"
    yield f"$800/8 = {240 - pixel[1]:.0f}$ px above it"


def the_sharpest_pinhole() -> Says:
    yield f"that is {sqrt(2.44 * 550e-6 * 100):.2f} mm"


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
    yield f"There the rails meet {240 - v:.0f} px above it"
    yield rf"$\arctan(24/800) = {degrees(atan(24 / 800)):.1f}^\circ$"
    down = look_at([0, 0, 0], [0, -24 / 800, 1], [0, 1, 0])  # heights upwards, z along the track
    seen, valid = vanishing_point(down[:3, :3] @ (0, 0, 1), intrinsics(800, (320, 240)))
    assert valid
    yield f"the horizon is row {seen[1]:.0f}."


def what_one_depth_for_all_costs() -> Says:
    K = intrinsics(160, (0, 0))
    near, _ = project([1, 0, 1.9], K)
    flat, _ = project_affine([1, 0, 1.9], scaled_orthographic_camera(K, 2.0))
    assert isclose(60 * flat[0] / near[0], 60 * 1.9 / 2)
    yield "- [x] `60 * 1.9 / 2`"
    K = intrinsics(80, (0, 0))
    (true, _), _ = project([1, 0, 20], K)
    (wrong, _), _ = project_affine([1, 0, 20], scaled_orthographic_camera(K, 5.0))
    yield (
        f"At 20 m the true image is {true:g} px to the right of the middle, the share is "
        f"{(wrong - true) / true:.0f}"
    )


def a_ball_near_the_border() -> Says:
    assert np.isclose(1 / cos(radians(60)), 2), "about twice as long as it is wide"
    yield r"At $\theta = 60^\circ$ it is about twice as long as it is wide"


def how_tall_the_tree_is() -> Says:
    assert isclose(image_px(1, 20, 80) / image_px(1, 10, 80), 1 / 2)
    yield "A tree is 200 px tall"
    yield "- [x] `200 / 2`"
    yield "- [ ] `200 / sqrt(2)`\n  : Halving the area would do that."


def the_share_that_is_lost() -> Says:
    assert isclose((100.1 - 100) / 100, 1e-3, rel_tol=1e-6)
    assert isclose(0.1 / 0.6, 1 / 6)
    yield "that is a thousandth: a tenth of a pixel for a nose that is 100 px"


def focal_against_depth() -> Says:
    yield "- [x] Focal length 120 px, depth 5 m\n  : $x$ is proportional to $f$"
    assert isclose(image_px(1, 10, 160), image_px(1, 5, 80))
    yield f"$x$ is 16/1.5 = {16 / 1.5:.1f} px"
    yield rf"120/80 = {120 / 80:g}. With $X = 1$ m: $120 \cdot 1/5 = {image_px(1, 5, 120):g}$ px"
    yield rf"only $8 \cdot 1/5 = {image_px(1, 5, 8):g}$ px"


WORKED = (
    a_thumb_s_distance,
    five_metres_away,
    unequal_steps,
    focal_length_in_pixels,
    focusing_makes_the_picture_larger,
    photographing_the_lamp,
    the_sharpest_pinhole,
    where_two_rails_meet,
    what_one_depth_for_all_costs,
    the_share_that_is_lost,
    how_tall_the_tree_is,
    a_ball_near_the_border,
    focal_against_depth,
)
