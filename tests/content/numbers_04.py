"""Chapter 4: the distortion of lenses."""

from math import asin, atan, degrees, inf, isclose, pi, sin, sqrt, tan

import numpy as np
from support.worked_numbers import Says

from simulations.models.distortion.fisheye import project_ideal
from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    fold_radius,
    jacobian,
    largest_distorted_radius,
    undistort,
)
from simulations.models.distortion.undistortion import undistort_fixed_point, undistort_newton
from simulations.models.lens.singlet import (
    Singlet,
    paraxial_image_mm,
    power_per_mm,
    thin_image_mm,
    thin_power_per_mm,
    through_exact,
    through_paraxial,
)
from simulations.models.lens.vignetting import vignetting_cos4
from simulations.scenes.lens_aberrations.stages import RIM_MM, light
from simulations.scenes.lens_distortion.radii import inversion_error_px

CHAPTER = "04-lens-distortion"
BARREL, PINCUSHION = Distortion(k1=-0.2), Distortion(k1=0.2)


def opening_of_a_lens() -> Says:
    wide = 50 / 2
    yield f"A 50 mm lens at f/2 has an opening {wide:g} mm across"
    pinhole = sqrt(2.44 * 550e-6 * 50)
    assert 0.24 < pinhole < 0.27, "about a quarter of a millimetre"
    assert 0.85e4 < (wide / pinhole) ** 2 < 1.15e4, "some ten thousand times as much light"
    yield "about a quarter of a millimetre wide. The lens gathers some ten thousand times"


EXAMPLE = Singlet(1 / 40, -1 / 40, 10.0, 1.5)


def two_spheres_of_40_mm() -> Says:
    thin = 1000 * thin_power_per_mm(EXAMPLE)
    yield f"$1/f = 0.5 \\cdot (25 + 25) = {thin:g}$, so $f = {1000 / thin:g}$ mm"
    thick = 1000 * power_per_mm(EXAMPLE)
    yield f"$25 - 0.5^2 \\cdot 0.010 \\cdot 25 \\cdot 25/1.5 = {thick:.2f}$ per metre"
    yield f"and $f = {1000 / thick:.1f}$ mm"
    image = paraxial_image_mm(EXAMPLE, inf)
    yield f"The image of a star lies {image:.1f} mm behind the middle of the lens"
    yield f"$\\arcsin(10/40) = {degrees(asin(0.25)):.1f}^\\circ$"
    yield f"$\\arcsin(0.25/1.5) = {degrees(asin(0.25 / 1.5)):.1f}^\\circ$"
    crossing = _crossing(10)
    yield f"it crosses the axis at {crossing:.1f} mm, nearly 4 mm short of the image"
    assert 3.5 < image - crossing < 4


def which_way_round() -> Says:
    """How much of the turn falls to the front, by small angles and by Snell's law."""
    for front, share in ((1 / 25, 2 / 3), (0.0, 0.0)):
        turn = -through_paraxial(Singlet(front, front - 1 / 25, 1e-6, 1.5), inf, [1.0]).slope[0]
        assert isclose((1 - 1 / 1.5) * front / turn, share, abs_tol=1e-9)
    yield "the first twice as much as the second"
    forwards, backwards = (
        paraxial_image_mm(lens, inf) - float(through_exact(lens, inf, [10.0], 22.0).crossing_mm[0])
        for lens in (Singlet(1 / 25, 0.0, 6.0, 1.5), Singlet(0.0, -1 / 25, 6.0, 1.5))
    )
    assert 3.7 < backwards / forwards < 4.3
    yield ": four times as much. A sine is smaller"


def how_much_lens_a_picture_needs() -> Says:
    image = paraxial_image_mm(EXAMPLE, inf)
    assert _crossing(2) - thin_image_mm(EXAMPLE, inf) > 3
    yield "At 2 mm the thin lens is more than 3 mm off"
    yield f"{image - _crossing(2):.2f} mm: here the thickness matters"
    yield f"At 10 mm the thick lens is off by {image - _crossing(10):.1f} mm"
    yield f"is off by {thin_image_mm(EXAMPLE, inf) - _crossing(10):.1f} mm only because"
    assert isclose((image - _crossing(10)) / (image - _crossing(5)), 4, rel_tol=0.1)
    yield "Half the opening means a quarter of the error along the axis"


def _crossing(height_mm: float) -> float:
    return float(through_exact(EXAMPLE, inf, [height_mm], 22.0).crossing_mm[0])


def bending_a_line_by_hand() -> Says:
    middle, end = np.array((0, 0.5)), np.array((0.8, 0.5))
    for point, phrase in (
        (middle, r"$r^2 = {0:g}$. The factor is $1 - 0.2 \cdot {0:g} = {1:g}$."),
        (end, r"$r^2 = 0.64 + 0.25 = {0:.2f}$. The factor is $1 - 0.2 \cdot {0:.2f} = {1:.3f}$."),
    ):
        squared = float(point @ point)
        yield phrase.format(squared, 1 - 0.2 * squared)
    low, far = distort([middle, end], BARREL)
    yield f"moves to $(0, {low[1]:.3f})$"
    yield rf"move to $(\pm {far[0]:.4f}, {far[1]:.3f})$"
    bow = round(low[1] - far[1], 3)
    yield rf"The middle is now ${low[1]:.3f} - {far[1]:.3f} = {bow:.3f}$ farther"
    yield rf"the bow is $800 \cdot {bow:.3f} = {800 * bow:.0f}$ px"
    low, far = distort([middle, end], PINCUSHION)
    yield f"the factors are {low[1] / 0.5:.2f} and {far[1] / 0.5:.3f}"
    yield f"goes to {low[1]:.3f} and the ends to {far[1]:.3f}"


def how_far_the_corner_moves() -> Says:
    corner, half = (distort([r, 0], BARREL)[0] - r for r in (1.0, 0.5))
    yield rf"$-0.2 \cdot 1 \cdot 200 = {200 * corner:.0f}$ px"
    yield f"an eighth of that, {-200 * half:.0f} px"
    yield f"beyond the radius {largest_distorted_radius(BARREL):.3f} no light arrives"
    both = distort([1, 0], Distortion(k1=-0.2, k2=0.1))[0] - 1
    yield rf"$(-0.2 + 0.1) \cdot 200 = {200 * both:.0f}$ px"


def where_two_coefficients_cancel() -> Says:
    back, farthest = sqrt(0.2 / 0.2), sqrt(0.2 / (2 * 0.2))
    assert distort([back, 0], Distortion(k1=-0.2, k2=0.2))[0] == back
    yield f"this is {back:g}: a point at $r = {back:g}$ does not move at all"
    yield rf"$r = \sqrt{{-k_1 / (2k_2)}} = {farthest:.2f}$"


def two_steps_back() -> Says:
    one, two = (float(undistort_fixed_point([0.475, 0], BARREL, steps)[0]) for steps in (1, 2))
    yield rf"$0.475/(1 - 0.2 \cdot 0.475^2) = {one:.6f}$"
    yield rf"$0.475/(1 - 0.2 \cdot {one:.6f}^2) = {two:.6f}$"
    assert 9 < (0.5 - one) / (0.5 - two) < 10, "each step divides the error by nearly ten"
    first = newton_by_hand(0.475)
    yield f"the first step gives {first:.6f}, the second {newton_by_hand(first):.8f}"
    quick, two = (float(undistort_newton([0.475, 0], BARREL, steps)[0]) for steps in (1, 2))
    assert np.isclose(quick, newton_by_hand(one), rtol=1e-15)
    yield f"fixed point, {one:.6f}, Newton gives {quick:.8f} and then {two:.12f}"


def newton_by_hand(r: float) -> float:
    return r - (r - 0.2 * r**3 - 0.475) / (1 - 0.6 * r**2)


def five_steps_of_newton_near_a_fold() -> Says:
    fixed_point, newton = (
        inversion_error_px(BARREL, tier) for tier in ("fixed-point-5", "newton-5")
    )
    assert 300 < fixed_point / newton < 400
    yield "Five steps of Newton are three hundred times as good"
    nearly = Distortion(k1=-0.45, k2=0.1)
    assert fold_radius(nearly) == np.inf
    slope = min(jacobian([[r, 0.0] for r in np.linspace(0, 2, 2001)], nearly)[:, 0, 0])
    assert 0 < slope < 0.1, "the slope comes close to zero"
    off_px = inversion_error_px(nearly, "newton-5")
    yield f"five steps of Newton are off by {off_px:.0f} px in the RMS"


def what_the_rim_cuts() -> Says:
    corner = np.array(1.0)  # the tangent of 45°
    for rim, rest in ((6.0, 1.0), (10.0, 0.0)):
        _, share = light(corner, 16.0, rim, natural=True)
        assert share == rest
    yield "With the rim 6 mm before the aperture stop, the narrow bundle passes it untouched"
    yield f"At 10 mm the rim is farther from the aperture stop than its radius of {RIM_MM:g} mm"
    yield "at f/16 nothing is left of the corner"


def where_the_map_folds() -> Says:
    lens = Distortion(k1=-0.3)
    fold, largest = fold_radius(lens), largest_distorted_radius(lens)
    yield (
        f"the fold lies at $r = {fold:.3f}$, about {degrees(atan(fold)):.1f}° from the axis, "
        f"and the largest distorted radius is {largest:.3f}"
    )
    yield f"the distorted radius {largest_distorted_radius(Distortion(k1=-0.5)):.3f} the photograph"


def cos4_at_45_degrees() -> Says:
    assert np.isclose(vignetting_cos4(1.0), 1 / 4), "two stops"
    yield "its fourth power ¼, so the corners lose two stops"


def the_fisheye_s_right_angle() -> Says:
    assert tan(pi / 2) > 1e15
    sideways, _ = project_ideal([1, 0, 0], "equidistant")
    yield f"puts 90° at {sideways[0]:.3f}"


def sign_of_k1() -> Says:
    ideal, seen = 400 / 800, 390 / 800
    k1 = (seen / ideal - 1) / ideal**2
    assert np.isclose(distort([ideal, 0], Distortion(k1=k1))[0], seen)
    yield f"The factor is $390/400 = {390 / 400:g}$, so $k_1 \\cdot 0.25 = {390 / 400 - 1:.3f}$"
    yield f"and $k_1 = {k1:.1f}$, a barrel"


def cubic_growth() -> Says:
    near, far = (distort([r, 0], PINCUSHION)[0] - r for r in (0.2, 0.6))
    assert np.isclose(2 * far / near, 54)
    yield "a point at $r = 0.2$ is moved by 2 px. At which radius is a point moved by 54 px?"
    yield "- [x] `0.2 * 27 ** (1 / 3)`"


def beyond_the_fold() -> Says:
    lens = Distortion(k1=-0.12)
    fold, largest = fold_radius(lens), largest_distorted_radius(lens)
    assert not undistort([1.2, 0], lens)[1]
    yield rf"The fold is at $r = \sqrt{{1/0.36}} = {fold:.3f}$"
    yield f"two thirds of it, {largest:.3f}."
    yield f"does $r - 0.12r^3$ exceed {largest:.3f}"
    yield f"At $r = 1.2$ the formula already gives {distort([1.2, 0], lens)[0]:.3f}"


def the_root_of_a_cubic() -> Says:
    fold, largest = fold_radius(BARREL), largest_distorted_radius(BARREL)
    assert np.isclose(2 * fold * sin(asin(0.475 / largest) / 3), 0.5, rtol=1e-14)
    yield rf"$2 \cdot {fold:.3f} \cdot \sin(\tfrac13 \arcsin {0.475 / largest:.4f}) = 0.5$"


def lines_between_coefficients_that_cancel() -> Says:
    """Level lines turn back on their way outwards, the upright ones at the border do not."""
    lens, along = Distortion(k1=-0.2, k2=0.2), np.linspace(0, 0.8, 41)
    for height in (0.2, 0.4, 0.6):
        level = distort(np.stack([along, np.full_like(along, height)], -1), lens)[:, 1]
        assert 0 < np.argmin(level) < 40
    side = distort(np.stack([np.full_like(along, 0.8), along], -1), lens)[:31, 0]
    assert (np.diff(side) > 0).all()
    yield "Level lines bend one way in their middle and back at their ends."
    yield "The upright lines at the border bow inwards."


WORKED = (
    opening_of_a_lens,
    two_spheres_of_40_mm,
    which_way_round,
    how_much_lens_a_picture_needs,
    bending_a_line_by_hand,
    how_far_the_corner_moves,
    where_two_coefficients_cancel,
    two_steps_back,
    five_steps_of_newton_near_a_fold,
    what_the_rim_cuts,
    where_the_map_folds,
    cos4_at_45_degrees,
    the_fisheye_s_right_angle,
    sign_of_k1,
    cubic_growth,
    beyond_the_fold,
    the_root_of_a_cubic,
    lines_between_coefficients_that_cancel,
)
