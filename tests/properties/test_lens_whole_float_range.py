"""Lenses, resampling and ray casting for any floats at all.

No warning (pytest turns them into errors), no exception but a `ValueError` with a reason, and
nothing that is not finite where the mask says that it is valid.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.float_range import any_float, arrays, ask, assert_finite_where_valid, finite_float

from simulations.models.arrays import Floats
from simulations.models.distortion import fisheye, lens_model, radial_profile, radial_table
from simulations.models.distortion.lens_model import Distortion
from simulations.models.lens import chromatic_aberration, thin_lens, vignetting
from simulations.models.light import raycasting
from simulations.models.light.raycasting import Box, Sphere
from simulations.models.sampling import resampling

coefficients = st.lists(finite_float.filter(lambda c: abs(c) <= 1e9), min_size=8, max_size=8)
sensible_coefficients = st.lists(st.floats(-2.0, 2.0), min_size=8, max_size=8)


def lens(k: list[float]) -> Distortion:
    return lens_model.Distortion(k[0], k[1], k[2], k[3], k[4], k[5], k[6], k[7])


@given(st.lists(any_float, min_size=8, max_size=8))
def test_coefficients_of_no_lens_are_refused(k: list[float]) -> None:
    if not np.all(np.abs(k) <= radial_profile.LARGEST_COEFFICIENT):
        assert ask(lens, k) is None
        assert ask(radial_profile.RadialProfile, tuple(k)) is None


@given(coefficients | sensible_coefficients)
def test_every_lens_has_a_fold_radius_or_none(k: list[float]) -> None:
    fold = lens_model.fold_radius(lens(k))
    assert fold > 0.0
    assert lens_model.largest_distorted_radius(lens(k)) > 0.0


@given(coefficients | sensible_coefficients, arrays(5, 2))
def test_undistorted_points_are_finite_and_return_where_valid(
    k: list[float], points: Floats
) -> None:
    d = lens(k)
    ideal, valid = lens_model.undistort(points, d)
    assert_finite_where_valid((ideal, valid))
    border, _ = lens_model.undistort_clamped(points, d)
    assert np.isfinite(border).all()
    np.testing.assert_array_equal(border[valid], ideal[valid])
    seen = lens_model.distort(ideal[valid], d)
    off = np.abs(seen - points[valid]).max(axis=-1)
    assert (off <= 1e-9 * (1.0 + np.abs(points[valid]).max(axis=-1))).all()


@given(coefficients | sensible_coefficients, arrays(5, 2, of=finite_float))
def test_distorting_finite_points_gives_numbers(k: list[float], points: Floats) -> None:
    assert not np.isnan(lens_model.distort(points, lens(k))).any()


@given(st.lists(any_float, min_size=4, max_size=4), arrays(5, 3), arrays(5, 2))
def test_fisheyes_are_finite_where_valid(
    k: list[float], directions: Floats, points: Floats
) -> None:
    fish = ask(fisheye.Fisheye, *k)
    if fish is None:
        return
    assert_finite_where_valid(fisheye.project_fisheye(directions, fish))
    assert_finite_where_valid(fisheye.unproject_fisheye(points, fish))


@pytest.mark.parametrize("model", fisheye.IDEAL_MODELS)
@given(directions=arrays(5, 3), points=arrays(5, 2))
def test_ideal_fisheyes_are_finite_where_valid(
    model: str, directions: Floats, points: Floats
) -> None:
    assert_finite_where_valid(fisheye.project_ideal(directions, model))
    assert_finite_where_valid(fisheye.unproject_ideal(points, model))


@given(any_float, arrays(3))
def test_image_distances_are_beyond_the_focal_length_or_refused(
    focal_mm: float, distance_mm: Floats
) -> None:
    image = ask(thin_lens.thin_lens_image_distance, focal_mm, distance_mm)
    assert image is None or (image >= focal_mm * (1 - 1e-15)).all()


@given(any_float, any_float, any_float, arrays(3))
def test_circles_of_confusion_are_no_less_than_zero_or_refused(
    focal: float, f_number: float, focus: float, depth: Floats
) -> None:
    diameter = ask(thin_lens.circle_of_confusion_mm, focal, f_number, focus, depth)
    assert diameter is None or (diameter >= 0.0).all()


@given(any_float, any_float, any_float, any_float)
def test_depth_of_field_holds_the_focus_or_is_refused(
    focal: float, f_number: float, focus: float, coc: float
) -> None:
    limits = ask(thin_lens.depth_of_field, focal, f_number, focus, coc)
    assert limits is None or 0.0 <= limits[0] <= focus * (1 + 1e-12) <= limits[1] * (1 + 1e-9)
    nearest = ask(thin_lens.hyperfocal, focal, f_number, coc)
    assert nearest is None or nearest >= focal


@given(any_float, any_float, any_float)
def test_sensors_stand_at_the_focal_length_or_beyond_or_are_refused(
    focal_mm: float, f_number: float, focus_mm: float
) -> None:
    sensor_mm = ask(thin_lens.principal_distance_mm, focal_mm, focus_mm)
    assert sensor_mm is None or sensor_mm >= focal_mm * (1 - 1e-15)
    working = ask(thin_lens.working_f_number, focal_mm, f_number, focus_mm)
    assert working is None or working >= f_number


@given(any_float.filter(lambda r: not np.isnan(r)))
def test_vignetting_is_a_share(r_over_f: float) -> None:
    assert 0.0 <= vignetting.vignetting_cos4(r_over_f) <= 1.0


@given(finite_float, any_float, any_float, any_float)
def test_mechanical_vignetting_is_a_share_or_refused(
    tangent: float, pupil: float, rim: float, separation: float
) -> None:
    share = ask(vignetting.mechanical_vignetting, tangent, pupil, rim, separation)
    assert share is None or 0.0 <= share <= 1.0


@given(any_float, any_float, any_float, any_float, any_float)
def test_glass_is_refused_or_bends_light(
    index: float, abbe: float, focal: float, stop: float, wavelength: float
) -> None:
    glass = ask(chromatic_aberration.Glass, index, abbe)
    if glass is not None:
        for answer in (
            ask(chromatic_aberration.refractive_index, glass, wavelength),
            ask(chromatic_aberration.focal_length_mm, glass, focal, wavelength),
            ask(chromatic_aberration.axial_chromatic_mm, glass, focal, 2.0, wavelength),
            ask(chromatic_aberration.lateral_chromatic_scale, glass, focal, stop, wavelength),
        ):
            assert answer is None or not np.isnan(answer)


@pytest.mark.parametrize("kernel", resampling.KERNELS)
@given(positions=arrays(6, 2))
def test_samples_of_a_finite_picture_are_finite_wherever_they_are_taken(
    kernel: str, positions: Floats
) -> None:
    picture = np.linspace(0.0, 1.0, 12).reshape(3, 4)
    assert np.isfinite(resampling.sample(picture, positions, kernel)).all()
    assert np.isfinite(resampling.sample(picture, positions, kernel, fill=None)).all()


def unit(vector: Floats) -> Floats:
    return vector / np.linalg.norm(vector)


solids = st.sampled_from(
    [
        raycasting.Sphere((0.3, 5.0, 0.2), 1.0),
        raycasting.Sphere((0.0, 0.0, 0.0), 1e-9),
        raycasting.Box((0.0, 5.0, 0.0), (2.0, 1.0, 3.0), 0.7),
        raycasting.Box((0.0, 0.0, 0.0), (1e-6, 1e6, 1.0)),
    ]
)
metres = st.sampled_from([0.0, 1e-12, 1.0, 5.0, 1e6, -1e-12, -1.0]) | st.floats(-1e6, 1e6)
directions = arrays(
    3, of=st.sampled_from([0.0, 1e-300, 1e-12, 1.0, -1.0]) | st.floats(-1, 1)
).filter(lambda v: np.linalg.norm(v) > 1e-6)


@given(solids, arrays(3, of=metres), directions)
def test_every_entry_of_a_hit_is_finite_also_where_rays_miss(
    solid: Box | Sphere, origin: Floats, direction: Floats
) -> None:
    hit = raycasting.intersect(solid, origin, unit(direction))
    for part in (hit.distance, hit.points, hit.normals, hit.margin):
        assert np.isfinite(part).all()


@given(st.sampled_from(["Sphere", "Box"]), arrays(3), arrays(3), any_float)
def test_solids_are_finite_or_refused(
    kind: str, centre: Floats, size: Floats, number: float
) -> None:
    if kind == "Sphere":
        solid = ask(raycasting.Sphere, tuple(centre), number)
    else:
        solid = ask(raycasting.Box, tuple(centre), tuple(size), number)
    if solid is not None:
        assert np.isfinite(solid.centre).all()


@given(arrays(3), arrays(3), arrays(3), arrays(4, 3))
def test_distances_to_planes_are_finite_where_valid(
    point: Floats, normal: Floats, origin: Floats, rays: Floats
) -> None:
    assert_finite_where_valid(raycasting.intersect_plane(point, normal, origin, rays))


@given(arrays(3, 4, of=finite_float))
def test_coverage_is_a_share(margin: Floats) -> None:
    coverage = raycasting.edge_coverage(margin)
    assert ((coverage >= 0.0) & (coverage <= 1.0)).all()


@given(coefficients, arrays(6))
def test_profiles_invert_to_finite_radii(a: list[float], images: Floats) -> None:
    radius, valid = radial_table.invert(radial_profile.RadialProfile(tuple(a)), images)
    assert np.isfinite(radius).all()
    assert (radius[valid] >= 0.0).all()


@given(coefficients | sensible_coefficients, arrays(7, 2))
def test_pictures_are_undistorted_as_points_are(k: list[float], points: Floats) -> None:
    """By the table where it holds: enough points for one to be made, however wild they are.

    The image is right to nine digits or, close to a pole, as right as its slope allows.
    """
    d = lens([*k[:3], 0.0, 0.0, *k[5:]])
    few_valid = lens_model.undistort(points, d)[1]
    ideal, valid = lens_model.undistort(np.tile(points, (300, 1)), d)
    assert_finite_where_valid((ideal, valid))
    np.testing.assert_array_equal(valid, np.tile(valid[:7], 300))
    assert not (few_valid & ~valid[:7]).any()
    radius, seen_radius = (np.hypot(*xy[:7][valid[:7]].T) for xy in (ideal, points))
    image = radial_profile.evaluate(d.radial, radius)
    steep = radius * radial_profile.slope(d.radial, radius)
    allowed = 1e-9 * np.fmax(seen_radius, np.where(np.isfinite(steep), steep, 0.0))
    assert (np.abs(image - seen_radius) <= allowed + 1e-300).all()
