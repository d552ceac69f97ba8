"""Reflectance, colour, sensor, mosaic, sampling and compression for any floats at all.

No warning (pytest turns them into errors) and no exception but a `ValueError` with a reason.
Pictures have no masks: there, NaN may come out only where NaN or infinity went in.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.float_range import any_float, arrays, ask, finite_float

from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats
from simulations.models.color import (
    chromatic_adaptation,
    chromaticity,
    cie,
    srgb,
    white_balance,
    ycbcr,
)
from simulations.models.compression import blocks, chroma_upsampling, jpeg
from simulations.models.compression.chroma_subsampling import SUBSAMPLING
from simulations.models.light import reflectance
from simulations.models.sampling import aliasing
from simulations.models.sensor import demosaicing, photon_counting, shared_detail


@given(arrays(4, 3))
def test_normalised_vectors_have_length_one_or_zero(vectors: Floats) -> None:
    length = np.linalg.norm(reflectance.normalise(vectors), axis=-1)
    assert (np.isclose(length, 1.0) | (length == 0.0)).all()


@given(arrays(3), arrays(3), arrays(3), any_float, any_float)
def test_shades_are_finite_or_refused(
    normal: Floats, to_light: Floats, to_eye: Floats, albedo: float, shininess: float
) -> None:
    n, l, v = (reflectance.normalise(vector) for vector in (normal, to_light, to_eye))  # noqa: E741
    shade = ask(reflectance.lambert, n, l, albedo)
    assert shade is None or 0.0 <= shade <= 1.0
    for model in (reflectance.phong, reflectance.blinn_phong):
        shade = ask(model, n, l, v, albedo, shininess=shininess)
        assert shade is None or 0.0 <= shade <= 1.5


@given(any_float, any_float)
def test_light_thins_out_to_a_finite_share_or_is_refused(distance: float, radius: float) -> None:
    falloff = ask(reflectance.attenuation, distance, radius)
    assert falloff is None or falloff >= 0.0


@given(arrays(3), arrays(3), arrays(3))
def test_lamps_anywhere_light_points_anywhere(
    point: Floats, normal: Floats, position: Floats
) -> None:
    lamp = reflectance.PointLight(tuple(position))
    lit = ask(reflectance.irradiance, point, reflectance.normalise(normal), [lamp])
    assert lit is None or (np.isfinite(lit).all() and (lit >= 0.0).all())


@given(arrays(4, 3))
def test_the_srgb_curve_undefines_nothing(colours: Floats) -> None:
    for curve in (srgb.encode_srgb, srgb.decode_srgb):
        assert np.array_equal(np.isnan(curve(colours)), np.isnan(colours))
    assert np.isfinite(srgb.encode_srgb_table(colours)).all()


@given(arrays(4, 3, of=finite_float.map(lambda value: value / 10)))
def test_srgb_there_and_back_is_where_it_was(colours: Floats) -> None:
    assert np.allclose(srgb.decode_srgb(srgb.encode_srgb(colours)), colours, rtol=1e-9)


@given(arrays(2, 3))
def test_colour_spaces_take_any_number(colours: Floats) -> None:
    cie.xyz_to_lab(cie.linear_rgb_to_xyz(colours))
    ycbcr.ycbcr_to_rgb(ycbcr.rgb_to_ycbcr(colours))
    cie.luminance(colours)
    srgb.decode_srgb(srgb.encode_srgb(colours))
    ask(white_balance.white_balance, colours, colours[0])


@given(arrays(2, 3), arrays(2, 3))
def test_a_canvas_takes_any_number(picture: Floats, alpha: Floats) -> None:
    assert to_rgba8(picture, alpha).dtype == np.uint8


@given(arrays(4), any_float)
def test_exposures_are_finite_or_refused(photons: Floats, exposure_s: float) -> None:
    mean_e = ask(photon_counting.expose, photons, exposure_s, photon_counting.Sensor())
    assert mean_e is None or not np.isnan(mean_e).any()


@pytest.mark.parametrize("model", photon_counting.SHOT_MODELS)
@given(mean_e=arrays(4), full_well=any_float)
def test_electrons_are_whole_and_fit_the_well_or_are_refused(
    model: str, mean_e: Floats, full_well: float
) -> None:
    rng = np.random.default_rng(0)
    counted = ask(photon_counting.shot_noise, mean_e, rng, full_well, model)
    if counted is not None:
        assert (counted >= 0.0).all()
        assert (counted <= full_well).all()


@given(arrays(6), any_float, any_float, any_float, st.integers(-2, 40))
def test_codes_fit_the_converter_or_the_sensor_is_refused(
    signal: Floats, well: float, noise: float, gain: float, bits: int
) -> None:
    made = ask(
        photon_counting.Sensor, full_well_e=well, read_noise_e=noise, gain_e_per_dn=gain, bits=bits,
        black_level_dn=0.0,
    )  # fmt: skip
    if made is not None:
        dn = photon_counting.read_out(signal, made, np.random.default_rng(0))
        assert photon_counting.quantise(dn, bits).max() <= made.highest_dn
    codes = ask(photon_counting.quantise, signal, bits)
    assert codes is None or codes.max() <= 2**bits - 1


@given(arrays(4))
def test_signal_to_noise_is_no_less_than_zero_or_refused(mean_e: Floats) -> None:
    ratio = ask(photon_counting.signal_to_noise, mean_e, photon_counting.Sensor())
    assert ratio is None or (ratio >= 0.0).all()


@pytest.mark.parametrize("method", demosaicing.METHODS)
@given(values=arrays(6, 6))
def test_mosaics_of_any_numbers_become_pictures(method: str, values: Floats) -> None:
    picture = ask(demosaicing.demosaic, values, "RGGB", method)
    if picture is not None:
        assert picture.shape == (6, 6, 3)
        assert np.isfinite(picture).all() or not (np.abs(values) < 1e300).all()


@given(arrays(3, 3, 3))
def test_detail_is_shared_between_minus_all_and_all_or_refused(picture: Floats) -> None:
    shared = ask(shared_detail.shared_detail, picture)
    for part in shared or ():
        assert np.isnan(part) or abs(part) <= 1 + 1e-9


@pytest.mark.parametrize("method", chroma_upsampling.METHODS)
@given(plane=arrays(2, 3), luma=arrays(4, 6))
def test_colours_are_filled_in_with_finite_values_or_refused(
    method: str, plane: Floats, luma: Floats
) -> None:
    full = ask(chroma_upsampling.refine, plane, (2, 2), luma, method)
    assert full is None or np.isfinite(full).all()


@given(arrays(3), any_float)
def test_aliases_lie_between_the_nyquist_frequencies_or_are_refused(
    frequency: Floats, rate: float
) -> None:
    alias = ask(aliasing.alias_frequency, frequency, rate)
    assert alias is None or ((alias >= -rate / 2) & (alias <= rate / 2)).all()
    if alias is not None:
        ask(aliasing.apparent_wheel_speed, frequency, 3, rate)


@given(arrays(2, 4), any_float)
def test_zone_plates_are_between_dark_and_light(xy: Floats, scale: float) -> None:
    rings = ask(aliasing.zone_plate, xy[0], xy[1], scale)
    assert rings is None or ((rings >= 0.0) & (rings <= 1.0)).all()


@given(st.one_of(any_float.filter(lambda s: not 100 < s <= 1e6), st.floats(0.0, 50.0)))
def test_gaussian_kernels_sum_to_one_or_are_refused(sigma: float) -> None:
    kernel = ask(aliasing.gaussian_kernel, sigma)
    assert kernel is None or np.isclose(kernel.sum(), 1.0)


@given(arrays(4))
def test_contrast_is_a_share_or_refused(values: Floats) -> None:
    share = ask(aliasing.contrast, values)
    assert share is None or 0.0 <= share <= 1.0


@given(any_float, any_float)
def test_the_contrast_that_a_pixel_leaves_is_a_share_or_refused(
    frequency: float, width: float
) -> None:
    share = ask(aliasing.box_mtf, frequency, width)
    assert share is None or 0.0 <= share <= 1.0


@given(arrays(2, 3), arrays(2), st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)))
def test_colours_are_adapted_without_a_warning_or_refused(
    colours: Floats, any_xy: Floats, some_xy: tuple[float, float]
) -> None:
    for method in chromatic_adaptation.RESPONSES:
        ask(chromatic_adaptation.adapt, colours, any_xy, cie.D65_XY, method)
        ask(chromatic_adaptation.adapt, colours, cie.D65_XY, some_xy, method)
        matrix = ask(chromatic_adaptation.adaptation_matrix, some_xy, cie.D65_XY, method)
        assert matrix is None or np.isfinite(matrix).all()
    assert not np.isnan(chromaticity.xyz_to_xyy(colours)[..., :2]).any()
    chromaticity.lab_distance(*colours)


@given(arrays(3, 5), any_float)
def test_planes_are_compressed_to_finite_values_or_refused(plane: Floats, step: float) -> None:
    answer = ask(blocks.compress_plane, plane, np.full((8, 8), step))
    assert answer is None or np.isfinite(answer[0]).all()
    for subsampling in SUBSAMPLING:
        picture = ask(jpeg.compress, np.repeat(plane[..., None], 3, axis=2), 75, subsampling)
        assert picture is None or ((picture[0] >= 0.0) & (picture[0] <= 1.0)).all()
