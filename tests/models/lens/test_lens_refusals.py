"""What models of lenses refuse, by the name of the parameter."""

from typing import Any

import numpy as np
import pytest
from support.refusals import Call, assert_refused, each_of

from simulations.models.arrays import Floats
from simulations.models.lens import aperture, diffraction, singlet, thin_lens
from simulations.models.lens.aperture_grid import aperture_grid
from simulations.models.lens.bessel import bessel_j0
from simulations.models.lens.chromatic_aberration import (
    LINE_D_UM,
    Glass,
    axial_chromatic_mm,
    focal_length_mm,
    lateral_chromatic_scale,
    refractive_index,
)
from simulations.models.lens.depth_of_field import Layer, blur_by_depth, blur_layer
from simulations.models.lens.disc_blur import disc_blur, disc_kernel
from simulations.models.lens.disc_pyramid import pyramid_blur
from simulations.models.lens.pinhole import pinhole_transfer
from simulations.models.lens.screen_blur import binned_gaussian, gather_discs
from simulations.models.lens.singlet import Singlet
from simulations.models.lens.spectral_bands import chosen_wavelengths, even_wavelengths
from simulations.models.lens.stop_position import chief_rays
from simulations.models.lens.vignetting import disc_overlap_area, mechanical_vignetting

NAN, INF = np.nan, np.inf
BK7, BICONVEX = Glass(), Singlet(1 / 40, -1 / 40, 10.0, 1.5)
PLANES, RADII = np.ones((4, 8, 8), np.float32), np.ones((8, 8))
NO_SIZE = [0.0, -1.0, INF, NAN]
NO_F_NUMBER = [0.0, -2.0, NAN]
NO_DISC = [-1.0, -0.1, 1025.0, INF, NAN]
NO_WIDTH = [0.99e-9, -1.0, INF]
NO_PEAK = [NAN, INF, 1.001e9, -1.001e9]
NO_LENGTH = [0.0, 0.9e-9, 1.1e12]
NO_OVERLAP = [(0.99e-70, 1.0), (1.0, 1.01e70), (1.0, INF), (NAN, 1.0), (1.0, -1.0)]
DISC, WHOLE = "radius_px .*; legal: 0 to 1024", "; legal: whole numbers, 1 or more"


def rng() -> np.random.Generator:
    return np.random.default_rng(0)


def here_and(radius: float) -> Floats:
    """Radii (8, 8), one of them that."""
    radii = RADII.copy()
    radii[3, 4] = radius
    return radii


def rim(**other: float) -> Any:
    usual = {"pupil_radius_mm": 1.0, "rim_radius_mm": 1.0, "separation_mm": 1.0}
    return mechanical_vignetting(0.1, **(usual | other))


@each_of(
    (f"count 0{WHOLE}", aperture.fibonacci_disc, [0]),
    (f"count 0{WHOLE}", lambda n: aperture.random_disc(n, (), rng()), [0]),
    (f"rings 0{WHOLE}", lambda n: aperture.jittered_disc(n, 5, (), rng()), [0]),
    (f"parts 0{WHOLE}", lambda n: aperture.jittered_disc(5, n, (), rng()), [0]),
    (f"across 0{WHOLE}", aperture_grid, [0]),
    ("index_d", Glass, [1.0, 10.5, NAN]),
    ("abbe_number", lambda abbe: Glass(abbe_number=abbe), [0.0, 0.99, NAN]),
    ("wavelength_um", lambda w: refractive_index(BK7, [0.5, w]), [0.0, 0.099]),
    ("focal_d_mm", lambda f: focal_length_mm(BK7, f, 0.5), NO_LENGTH),
    ("f_number", lambda n: axial_chromatic_mm(BK7, 50, n, 0.5), NO_F_NUMBER),
    (
        "stop_distance_mm",
        lambda stop: lateral_chromatic_scale(BK7, 50, stop, 0.5),
        [1.1e12, -1.1e12, NAN],
    ),
    (DISC, lambda r: blur_layer(Layer(PLANES, 0, 0, r)), NO_DISC),
    ("radius_px", lambda r: blur_by_depth(PLANES, here_and(r)), NO_DISC),
    (DISC, disc_kernel, NO_DISC),
    (DISC, lambda r: disc_blur(PLANES, r), NO_DISC),
    (DISC, lambda r: pyramid_blur(PLANES, r), NO_DISC),
    (
        "^radius_px from .*; legal: 0 to 1024",
        lambda r: binned_gaussian(PLANES, here_and(r)),
        NO_DISC,
    ),
    ("^radius_px from", lambda r: gather_discs(PLANES, here_and(r), RADII), NO_DISC),
    ("bins .*; legal: whole numbers, 2", lambda n: binned_gaussian(PLANES, RADII, n), [0, 1]),
    ("f_number 0", lambda n: diffraction.cutoff_per_mm(0.55, n), [0]),
    ("defocus in waves", lambda d: diffraction.lens_transfer(100, 0.4, 1.4, d), [1000]),
    ("frequency_per_mm", lambda f: diffraction.lens_transfer(f, 0.4, 1.4), [NAN]),
    ("radius_um", lambda r: diffraction.spot(r, 0.4, 1.4), [1000]),
    ("^defocus_um inf; legal: finite", lambda d: diffraction.defocus_waves(d, 0.5, 2), [INF]),
    ("^wavelength_um 0", lambda w: diffraction.spot_diameter_um(w, 2), [0]),
    ("^x .*at most 1e6", bessel_j0, [[1.0, -2e6]]),
    ("mm", lambda hole: pinhole_transfer(1.0, hole, 100.0, 0.55), [0.0, NAN]),
    ("mm", lambda distance: pinhole_transfer(1.0, 0.3, distance, 0.55), [-1.0]),
    ("waves", lambda hole: pinhole_transfer(1.0, hole, 100.0, 0.55), [2.6]),
    ("thickness_mm 0", lambda mm: Singlet(0.0, 0.0, mm, 1.5), [0.0]),
    (r"index 0\.9", lambda index: Singlet(0.0, 0.0, 1.0, index), [0.9]),
    ("distance_mm", lambda mm: singlet.through_thin(BICONVEX, mm, [1.0]), [5.0]),
    ("heights_mm", lambda h: singlet.through_exact(BICONVEX, 50.0, [h], 22.0), [INF]),
    ("height_mm", lambda h: singlet.sag_mm(0.1, [1.0, h]), [11.0]),
    (f"count 0{WHOLE}", lambda n: chosen_wavelengths(0.5, 0.03, n), [0]),
    ("count 101; legal: whole numbers, 1 to", lambda n: chosen_wavelengths(0.5, 0.03, n), [101]),
    (f"count 0{WHOLE}", lambda n: even_wavelengths((0.5,), 0.03, 0.4, 0.7, n), [0]),
    ("width_um .*1e-9", lambda w: chosen_wavelengths(0.5, w, 3), NO_WIDTH),
    ("width_um .*1e-9", lambda w: even_wavelengths((0.5,), w, 0.4, 0.7, 3), NO_WIDTH),
    ("legal: finite, at most 1e9", lambda p: chosen_wavelengths(p, 0.03, 3), NO_PEAK),
    ("legal: finite, at", lambda p: even_wavelengths((0.5, p), 0.03, 0.4, 0.7, 3), NO_PEAK),
    ("stop_mm", lambda stop: chief_rays(BICONVEX, stop, [0.1]), [0.0, 4.9, NAN]),
    ("converging", lambda c: chief_rays(Singlet(-c, c, 6.0, 1.5), -10.0, [0.1]), [1 / 50]),
    ("focal_mm", lambda f: thin_lens.thin_lens_image_distance(f, 1e3), NO_SIZE),
    ("distance_mm", lambda z: thin_lens.thin_lens_image_distance(50, [1e3, z]), [49.9, NAN]),
    ("focal_mm", lambda f: thin_lens.hyperfocal(f, 2, 0.03), NO_SIZE),
    ("f_number", lambda n: thin_lens.hyperfocal(50, n, 0.03), NO_F_NUMBER),
    ("coc_mm", lambda coc: thin_lens.hyperfocal(50, 2, coc), [0.0]),
    ("focal_mm", lambda f: thin_lens.depth_of_field(f, 2, 1e3, 0.03), NO_SIZE),
    ("f_number", lambda n: thin_lens.depth_of_field(50, n, 1e3, 0.03), NO_F_NUMBER),
    ("coc_mm", lambda coc: thin_lens.depth_of_field(50, 2, 1e3, coc), [0.0]),
    ("focal_mm", lambda f: thin_lens.circle_of_confusion_mm(f, 2, 2000, 1), [0]),
    ("f_number", lambda n: thin_lens.circle_of_confusion_mm(50, n, 2000, 1), NO_F_NUMBER),
    ("focus_mm", lambda z: thin_lens.circle_of_confusion_mm(50, 2, z, 1), [50]),
    ("depth_mm", lambda z: thin_lens.circle_of_confusion_mm(50, 2, 2000, [10.0, z]), [-1.0, NAN]),
    ("focal_mm", lambda f: thin_lens.principal_distance_mm(f, 1000.0), [0.0]),
    ("focus_mm", lambda z: thin_lens.principal_distance_mm(50.0, z), [50.0, NAN]),
    ("focus_mm", lambda z: thin_lens.working_f_number(50.0, 2.0, z), [50.0, NAN]),
    ("f_number", lambda n: thin_lens.working_f_number(50, n, 1000.0), NO_F_NUMBER),
    ("pupil_radius_mm", lambda r: rim(pupil_radius_mm=r), NO_SIZE),
    ("rim_radius_mm", lambda r: rim(rim_radius_mm=r), NO_SIZE),
    ("separation_mm", lambda mm: rim(separation_mm=mm), [-1.0, INF]),
    ("legal: 1e-70 to 1e70", lambda pair: disc_overlap_area(0.5, *pair), NO_OVERLAP),
)
def test_models_of_lenses_refuse(message: str, call: Call, values: Any) -> None:
    assert_refused(message, call, values)


def test_the_ends_of_the_ranges_are_legal() -> None:
    assert aperture.random_disc(1, (), rng()).shape == (1, 2)
    assert disc_blur(PLANES, 1024.0) == pytest.approx(1.0, abs=1e-5)
    assert chosen_wavelengths(0.5, 0.03, 100).shares.sum() == pytest.approx(1)
    band = chosen_wavelengths(1.0, 1e-9, 3)
    np.testing.assert_allclose((band.wavelengths_um - 1) * 1e9, np.sqrt(3) * np.arange(-1, 2), 1e-6)
    assert chosen_wavelengths(-1e9, 0.03, 1).wavelengths_um == [-1e9]
    assert refractive_index(Glass(10.0, 1.0), LINE_D_UM) == 10.0
    for focal in (1e-9, 1e12):
        assert focal_length_mm(BK7, focal, LINE_D_UM) == pytest.approx(focal)
        assert lateral_chromatic_scale(BK7, 50, focal, LINE_D_UM) == pytest.approx(1)
