"""What the drawings show is what theory says, worked out here another way."""

import math
from itertools import pairwise
from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from simulations.illustrations import (
    axis_and_angle,
    bayer_cell,
    beam_on_desk,
    child_or_adult,
    circle_and_ellipse,
    circle_of_confusion,
    depth_error,
    f_numbers,
    five_families,
    flat_cosine,
    float_spacing,
    folding_radius,
    inverse_square,
    line_at_infinity,
    newton_steps,
    one_colour_two_spectra,
    order_of_turns,
    page_in_the_sun,
    paint_or_light,
    parallax,
    pixel_footprint,
    reflection_lobes,
    rolling_shutter,
    sheet_pinhole_lens,
    similar_triangles,
    steps_and_error,
    tilted_surface,
    vanishing_point,
)


def test_child_and_adult_are_equally_high_in_the_picture() -> None:
    heights = [child_or_adult.image_height(height, far) for height, far, _ in child_or_adult.PEOPLE]
    assert heights[0] == pytest.approx(heights[1])


def test_paint_times_light_is_the_same_along_a_curve() -> None:
    products = [light * paint_or_light.albedo(149, light) for light in (0.4, 1.0, 3.0)]
    encoded = 1.055 * np.array(products) ** (1 / 2.4) - 0.055  # IEC 61966-2-1
    assert 255 * encoded == pytest.approx([149] * 3)


@pytest.mark.parametrize(
    ("index", "keeps_length", "keeps_angle", "keeps_parallels"),
    [(0, 1, 1, 1), (1, 1, 1, 1), (2, 0, 1, 1), (3, 0, 0, 1), (4, 0, 0, 0)],
)
def test_a_card_keeps_what_its_family_keeps(
    index: int, keeps_length: bool, keeps_angle: bool, keeps_parallels: bool
) -> None:
    square = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)
    a, b, c, d = five_families.mapped(five_families.FAMILIES[index][2], square)
    below, above, side = b - a, c - d, d - a
    lengths = np.hypot(*below), np.hypot(*above)
    assert bool(lengths[0] == pytest.approx(five_families.UNITS)) is bool(keeps_length)
    cosine = below @ side / np.hypot(*below) / np.hypot(*side)
    assert bool(abs(cosine) < 1e-9) is bool(keeps_angle)
    assert bool(abs(below[0] * above[1] - below[1] * above[0]) < 1e-6) is bool(keeps_parallels)


def test_images_of_parallels_meet_on_the_drawn_line() -> None:
    for _, direction in line_at_infinity.WAYS[:2]:
        (p, q), (r, s) = (line_at_infinity.image(e) for e in line_at_infinity.lines(direction)[:2])
        share = np.linalg.solve(np.stack([q - p, r - s], axis=1), r - p)[0]
        x, y = p + share * (q - p)
        assert line_at_infinity.vanishing(direction) == pytest.approx([x, y])
        assert line_at_infinity.horizon(x)[1] == pytest.approx(y)


def test_a_vector_is_turned_as_scipy_turns_it() -> None:
    turn = Rotation.from_rotvec([0, 0, axis_and_angle.ANGLE_RAD])
    expected = turn.apply(axis_and_angle.VECTOR)
    assert axis_and_angle.turned(axis_and_angle.ANGLE_RAD) == pytest.approx(expected)


def test_the_order_of_pan_and_tilt_decides_where_the_camera_looks() -> None:
    pan, tilt = (
        Rotation.from_euler("y", 30, degrees=True),
        Rotation.from_euler("x", 20, degrees=True),
    )
    for (_, _, axes), turn in zip(order_of_turns.ORDERS, (pan * tilt, tilt * pan), strict=True):
        right, _, forward = turn.as_matrix().T
        assert order_of_turns.elevation_deg(axes) == pytest.approx(
            math.degrees(math.asin(-forward[1]))
        )
        level = np.cross([0, 1, 0], forward)  # to the right, in the plane of the horizon
        slant = math.degrees(math.atan2(np.linalg.norm(np.cross(right, level)), right @ level))
        assert abs(order_of_turns.slant_deg(axes)) == pytest.approx(slant, abs=1e-6)


def test_the_lens_brings_all_rays_of_a_point_to_one_place() -> None:
    lens = sheet_pinhole_lens
    for _, height in lens.POINTS:
        through_middle = height * (lens.SHEET - lens.OPENING) / (lens.SOURCE - lens.OPENING)
        for y in (-40.0, 0.0, 25.0):
            assert lens.behind(height, y, lens.FOCAL) == pytest.approx(through_middle)


def test_the_ray_crosses_the_image_plane_where_the_triangles_say() -> None:
    x, z = similar_triangles.POINT
    image = similar_triangles.image_of(x, z)
    assert image / similar_triangles.FOCAL == pytest.approx(x / z)


def test_images_along_the_rail_approach_the_vanishing_point() -> None:
    assert vanishing_point.end() == pytest.approx(
        vanishing_point.FOCAL * math.tan(vanishing_point.ANGLE_RAD)
    )
    gaps = [vanishing_point.end() - vanishing_point.image(metres) for metres in (1, 10, 100, 1000)]
    assert [far / near < 0.4 for near, far in pairwise(gaps)] == [True] * 3


def test_newton_s_guesses_run_to_the_root() -> None:
    root = brentq(lambda r: r - 0.3 * r**3 - newton_steps.SEEN, 0.5, 1.0)
    errors = [abs(guess - root) for guess in newton_steps.guesses()]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 1e-4


def test_a_table_at_sixty_degrees_gets_half_the_light() -> None:
    assert [tilted_surface.share(tilt) for tilt in (0, 60)] == pytest.approx([1, 0.5])


def test_light_falls_with_the_square_of_the_distance() -> None:
    assert [inverse_square.light_at(d) for d in (1, 2, 3)] == pytest.approx([1, 1 / 4, 1 / 9])


def test_highlights_are_brightest_in_the_mirror_s_direction() -> None:
    angles = np.radians(np.linspace(-89, 89, 357))
    for _, _, albedo, specular, shininess in reflection_lobes.SURFACES:
        seen = reflection_lobes.brightness(angles, albedo, specular, shininess)
        if specular:
            assert angles[np.argmax(seen)] == pytest.approx(reflection_lobes.LIGHT_RAD)
        else:
            assert seen == pytest.approx(np.full_like(seen, seen[0]))


def test_the_page_sends_into_all_directions_what_its_albedo_says() -> None:
    watts = (
        page_in_the_sun.radiance()
        * 2
        * math.pi
        * quad(lambda a: np.sin(a) * np.cos(a), 0, math.pi / 2)[0]
    )
    assert watts == pytest.approx(0.8 * 1000 * 0.5)


def test_the_cone_of_the_page_is_so_narrow_that_one_direction_stands_for_all() -> None:
    """Exactly, it takes π sin² of its half-angle, times the cosine of its axis."""
    half, slant = math.radians(12), math.radians(30)
    exactly = page_in_the_sun.radiance() * math.pi * math.sin(half) ** 2 * math.cos(slant)
    assert page_in_the_sun.power() == pytest.approx(exactly, rel=0.015)


def test_the_four_neighbours_of_the_red_cell_are_green() -> None:
    row, column = bayer_cell.RED_CELL
    colours = bayer_cell.colours()
    assert colours[row, column] == 0
    assert [colours[row + r, column + c] for r, c in bayer_cell.NEIGHBOURS] == [1] * 4


def test_a_cell_takes_the_mean_of_the_wave_over_its_width() -> None:
    means = [
        quad(lambda x: math.cos(2 * math.pi * pixel_footprint.FREQUENCY * x), n - 0.5, n + 0.5)[0]
        for n in range(pixel_footprint.CELLS)
    ]
    assert pixel_footprint.cell_means() == pytest.approx(means, abs=1e-4)


def test_the_disc_of_confusion_is_where_the_sensor_cuts_the_cone() -> None:
    lens = circle_of_confusion
    opening, tip, sensor = lens.FOCAL / lens.F_NUMBER, lens.tip(), lens.sensor()
    assert 1 / lens.NEAR + 1 / tip == pytest.approx(1 / lens.FOCAL)
    assert 1 / lens.FOCUS + 1 / sensor == pytest.approx(1 / lens.FOCAL)
    assert lens.disc() == pytest.approx(opening * (tip - sensor) / tip)


def test_each_opening_has_half_the_area_of_the_one_before() -> None:
    areas = [f_numbers.diameter_mm(stop) ** 2 for stop in f_numbers.STOPS]
    assert np.diff(np.log2(areas)) == pytest.approx([-1] * 5)


def test_engraved_stops_are_the_true_ones_rounded() -> None:
    engraved = [float(name) for name in f_numbers.NAMES]
    assert engraved == pytest.approx(f_numbers.STOPS, rel=0.015)


def test_corners_of_a_diamond_have_disparities_up_to_a_pixel_off() -> None:
    scale = depth_error.FOCAL_PX * depth_error.BASELINE
    for depth in depth_error.DEPTHS:
        near, far = depth_error.stretch(depth)
        assert [scale / near - scale / depth, scale / far - scale / depth] == pytest.approx([1, -1])


def test_the_front_holds_what_nothing_else_beats() -> None:
    front = steps_and_error.front()
    errors = [error for _, error, _ in front]
    assert errors == sorted(errors, reverse=True)
    for cost, error, _ in steps_and_error.points():
        assert any(c <= cost and e <= error for c, e, _ in front)


def test_newton_s_method_has_the_front_from_three_polynomials_on() -> None:
    assert [(cost, name) for cost, _, name in steps_and_error.front()] == [
        *((1, "fixed point"), (2, "fixed point"), (3, "Newton")),
        *((5, "Newton"), (7, "Newton"), (9, "Newton")),
    ]


def test_gaps_of_the_toy_format_double_with_each_power_of_two() -> None:
    numbers = float_spacing.numbers()
    gaps = np.diff(numbers)
    starts = np.array(numbers[:-1])
    for power in (0.25, 0.5, 1.0, 2.0, 4.0):
        within = gaps[(starts >= power) & (starts < 2 * power)]
        assert within == pytest.approx(np.full(8, power / 8))
    assert gaps[starts < 0.25] == pytest.approx(np.full(8, 1 / 32))


def test_a_step_of_the_cosine_hides_larger_angles_than_one_of_the_sine() -> None:
    cosine, sine = flat_cosine.angles("cosine")[1], flat_cosine.angles("sine")[1]
    assert math.cos(cosine) == pytest.approx(1 - flat_cosine.STEP)
    assert math.sin(sine) == pytest.approx(flat_cosine.STEP)


def test_two_ideal_radii_are_seen_at_one_below_the_fold_and_none_above() -> None:
    for radius in folding_radius.ideal_radii(folding_radius.SEEN):
        assert radius - 0.3 * radius**3 == pytest.approx(folding_radius.SEEN)
    assert len(folding_radius.ideal_radii(folding_radius.SEEN)) == 2
    assert folding_radius.ideal_radii(folding_radius.NOWHERE) == []


def test_the_drawn_ray_ends_in_the_drawn_point() -> None:
    overlay = similar_triangles.draw().panels[0].overlay
    drawing = ElementTree.fromstring(f"<svg>{overlay}</svg>")
    ray = next(line for line in drawing.iter("line") if line.get("class") == "ray bold")
    end = next(dot for dot in drawing.iter("circle") if dot.get("class") == "world solid")
    assert (ray.get("x2"), ray.get("y2")) == (end.get("cx"), end.get("cy"))


def test_the_image_of_a_circle_is_an_ellipse_about_another_point_than_its_centre() -> None:
    x, y = circle_and_ellipse.image(circle_and_ellipse.CIRCLE).T
    assert 0.75 * x**2 + x + y**2 - 1 == pytest.approx(np.zeros_like(x), abs=1e-12)
    assert circle_and_ellipse.middle(np.stack([x, y], axis=-1)) == pytest.approx([-2 / 3, 0])
    assert circle_and_ellipse.image(np.zeros(2)) == pytest.approx([0, 0])


def test_the_beam_meets_the_desk_where_its_plane_says() -> None:
    x, y, z = 0.0, 0.0, beam_on_desk.spot()
    p, q, r = beam_on_desk.CORNERS
    assert np.linalg.det(np.stack([q - p, r - p, np.array([x, y, z]) - p])) == pytest.approx(0)
    foot = beam_on_desk.foot()
    assert np.linalg.norm(foot) == pytest.approx(math.sqrt(8))  # the distance to y + z = 4
    assert foot[1] + foot[2] == pytest.approx(4)


def test_a_pixel_slides_by_focal_length_times_step_over_depth() -> None:
    for depth in parallax.DEPTHS_M:
        assert parallax.PIXEL - parallax.column(depth) == pytest.approx(800 * 0.1 / depth)


def test_the_eye_cannot_tell_the_two_surfaces_apart() -> None:
    paint, inks = one_colour_two_spectra.seen()
    assert paint == pytest.approx(inks, abs=1e-12)
    assert np.abs(np.subtract(*one_colour_two_spectra.twins())).max() > 0.1


def test_the_bus_leans_by_what_it_moves_while_the_rows_are_read() -> None:
    assert rolling_shutter.shift_px(1080) == pytest.approx(9600 * 0.020)
    assert math.tan(math.radians(rolling_shutter.lean_deg())) == pytest.approx(192 / 1080)
