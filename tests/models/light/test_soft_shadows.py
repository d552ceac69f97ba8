"""What solids hide of a lamp and of the sky: penumbrae, bounds, and form factors."""

import math

import numpy as np
import pytest
from support.rays import unit

from simulations.models.light.raycasting import Box, Sphere
from simulations.models.light.soft_shadows import (
    bounding_radius,
    shadow_bounds,
    sphere_occlusion,
    visibility,
)


@pytest.mark.parametrize("solid", [Sphere((0, 0, 2), 0.5), Box((0, 0, 2), (1, 1, 1))])
def test_shadow_is_full_below_and_absent_aside(solid: Box | Sphere) -> None:
    points = np.array([[0, 0, 0], [3.0, 0, 0], [0, 0, 5.0]])
    seen = visibility(solid, points, (0, 0, 1.0), math.radians(3))
    assert seen == pytest.approx([0, 1, 1])


@pytest.mark.parametrize(
    ("offset", "share"), [(-1.0, 0.0), (-0.5, 0.15625), (0.0, 0.5), (0.5, 0.84375), (1.0, 1.0)]
)
def test_the_penumbra_of_a_sphere_is_a_smooth_ramp_as_wide_as_the_lamp(
    offset: float, share: float
) -> None:
    """At 2 m the lamp of 3° spreads over 2 tan 3°; s²(3 − 2 s) at a quarter is 5/32."""
    width = 2.0 * math.tan(math.radians(3))
    point = (0.5 + offset * width, 0, 0)
    seen = visibility(Sphere((0, 0, 2), 0.5), point, (0, 0, 1.0), math.radians(3))
    assert seen == pytest.approx(share, abs=1e-9)


def test_the_shadow_of_a_box_deepens_with_the_chord_of_its_ray() -> None:
    """Light from the side at 45°: near an edge the ray cuts off a corner."""
    box, light, lamp = Box((0, 0, 2), (2, 2, 2)), unit([1.0, 0, 1]), math.radians(3)
    for x in (-0.05, -0.2, -1.0):
        start = (x - 0.0, 0.0, 0.0)  # meets the lower face z = 1 at x + 1, leaves at the side x = 1
        entry = math.sqrt(2)
        leave = math.sqrt(2) * min(1 - x, 3)
        ramp = min((leave - entry) / (2 * entry * math.tan(lamp)), 1)
        expected = 1 - ramp * ramp * (3 - 2 * ramp)
        assert visibility(box, start, light, lamp) == pytest.approx(expected)
    assert visibility(box, (0.05, 0.0, 0.0), light, lamp) == 1
    for z in (0.6, 0.995):  # the nearer the face, the sharper; but not nearer than 2 cm
        entry = math.sqrt(2) * (1 - z)
        width = 2 * max(entry, 0.02) * math.tan(lamp)
        x = z - 0.3 * width / math.sqrt(2)  # so that the ray cuts off 0.3 of the width
        assert visibility(box, (x, 0.0, z), light, lamp) == pytest.approx(1 - 0.09 * 2.4)
    just_below = visibility(box, (0.0, 0.0, 0.99), (0, 0, 1.0), lamp)
    assert just_below == 0


@pytest.mark.parametrize("turn", [0.4, math.pi / 2, -2.0])
def test_turning_box_points_and_lamp_together_changes_no_shadow(turn: float) -> None:
    box, light = Box((0.3, -0.2, 2), (2, 1, 1.5), 0.2), unit([0.5, -0.7, 0.9])
    points = np.random.default_rng(2).uniform([-3, -3, 0], [3, 3, 0], (200, 3))
    seen = visibility(box, points, light, 0.05)
    assert 0 < (seen < 1).sum() < 200
    R = Box((0, 0, 0), (1, 1, 1), turn).world_to_box.T
    turned = Box(tuple(R @ box.centre), box.size, 0.2 + turn)
    assert visibility(turned, points @ R.T, R @ light, 0.05) == pytest.approx(seen, abs=1e-9)


def test_the_bounds_of_a_shadow_straight_below_are_those_of_a_cone() -> None:
    """Ball of 0.5 at height 2: the shadow falls 2.5 m and widens by 2.5 tan α."""
    spread = 2.5 * math.tan(math.radians(5))
    low, high = shadow_bounds(Sphere((1, 3, 2), 0.5), (0.0, 0.0, 1.0), math.radians(5))
    assert low == pytest.approx([0.5 - spread, 2.5 - spread, -0.5 - 0.5 - spread])
    assert high == pytest.approx([1.5 + spread, 3.5 + spread, max(2.5, 0.0 + spread)])
    box = Box((1, 3, 2), (1.0, 2.0, 2.0))
    assert bounding_radius(box) == pytest.approx(1.5)
    assert bounding_radius(Sphere((0, 0, 0), 0.7)) == 0.7
    slanted = shadow_bounds(Sphere((0, 0, 1), 0.5), (0.6, 0.0, 0.8), math.radians(5))
    length = 1.5 / 0.8
    assert slanted[0][0] == pytest.approx(-0.6 * length - 0.5 - length * math.tan(math.radians(5)))
    assert slanted[1][0] == pytest.approx(
        max(0.5, -0.6 * length + 0.5 + length * math.tan(math.radians(5)))
    )


def test_a_sphere_hides_its_form_factor_from_each_point() -> None:
    points = np.array([[0, 0, 0], [0, 0, 1.0], [3, 0, 0], [0, 0, 9.0], [0, 0, 4.9]])
    hidden = sphere_occlusion((0, 0, 5), 0.5, points, (0, 0, 1.0))
    by_hand = [0.5**2 / 25, 0.5**2 / 16, 5 / math.sqrt(34) * 0.25 / 34, 0.0, 1.0]
    assert hidden == pytest.approx(by_hand)


def test_a_ball_as_large_as_all_space_hides_the_whole_sky() -> None:
    assert sphere_occlusion((0.0, 0.0, 1.0), 1e100, [[0.0, 0.0, 0.0]], [[0.0, 0.0, 1.0]]) == 1
