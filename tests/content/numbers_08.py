"""Chapter 8: the whole camera."""

from functools import cache
from itertools import pairwise
from math import hypot, isclose, sqrt, tan

from support.worked_numbers import Says

from simulations.engine.controls import check_values
from simulations.engine.pipeline import StageCache
from simulations.models.color import encode_srgb
from simulations.models.distortion import Distortion, distort, largest_distorted_radius
from simulations.models.optics import circle_of_confusion_mm, field_of_view_rad, hyperfocal
from simulations.models.vignetting import vignetting_cos4
from simulations.scenes import camera
from simulations.scenes.camera_lens import margin_px
from simulations.scenes.camera_sensor import ADC
from simulations.scenes.camera_stages import STAGES

CHAPTER = "08-full-camera-model"
PIXEL_MM = 36 / 264


def the_camera_s_pixels() -> Says:
    yield f"$36/264 = {PIXEL_MM:.3f}$ mm wide"


def where_a_point_lands() -> Says:
    focal = 50 / PIXEL_MM
    yield rf"$50 \cdot 264/36 = {focal:.1f}$ pixels"
    yield rf"$x = {focal:.1f} \times 0.30/1.90 = {focal * 0.30 / 1.90:.1f}$ pixels"
    squared = (0.30 / 1.90) ** 2
    yield f"$r^2 = (0.30/1.90)^2 = {squared:.4f}$"
    yield rf"$1 - 0.2 \times {squared:.4f} = {1 - 0.2 * squared:.4f}$"
    bent = distort([0.30 / 1.90, 0], Distortion(k1=-0.2))[0]
    yield f"The point moves inwards to {focal * bent:.1f} pixels."


def what_the_pixel_counts() -> Says:
    squared = (0.30 / 1.90) ** 2
    corner = float(vignetting_cos4(sqrt(squared)))
    light = 0.6 * 0.8
    yield f"so $I = {light:.2f}$"
    yield f"$1/(1 + r^2)^2 = {corner:.3f}$ here"
    arrives = light * corner
    yield rf"${light:.2f} \times {corner:.3f} = {arrives:.3f}$"
    mean = 10_000 * arrives
    yield f"the mean count is {mean:.0f}. Shot noise is $\\sqrt{{{mean:.0f}}} = {sqrt(mean):.1f}$"
    read = 5 / 255 * 10_000
    yield rf"$5/255 \times 10\,000 = {read:.0f}$ electrons"
    noise = sqrt(mean + read**2)
    yield rf"$\sqrt{{{sqrt(mean):.1f}^2 + {read:.0f}^2}} = {noise:.0f}$ electrons"
    yield f"the signal is {mean / noise:.0f} times the noise"
    codes = 4095 - ADC.black_level_dn
    gain = ADC.full_well_e / codes
    black = ADC.black_level_dn
    yield f"keeps {black:.0f} of its codes for the black level"
    dn = mean / gain + black
    yield f"the other {codes:.0f}: ${mean:.0f} / {gain:.3f} + {black:.0f} = {dn:.0f}$"
    encoded = float(encode_srgb(arrives))
    yield f"${arrives:.3f}$ becomes ${encoded:.3f}$"
    yield rf"${encoded:.3f} \times 255 = {255 * encoded:.0f}$"
    spread = 255 * float(encode_srgb((mean + noise) / 10_000) - encoded)
    yield f"give or take about {spread:.0f} codes of noise"


def when_the_lens_is_a_pinhole() -> Says:
    yield f"At 50 mm and f/4 it is {50 / 4:g} mm wide"
    opening = 50 / 1.4
    yield f"so that $A = {opening:.1f}$ mm"
    front = opening * 50 / (3200 - 50)
    yield rf"${opening:.1f} \times 50 / {3200 - 50} = {front:.3f}$ mm"
    for depth in (8000, 1850):
        disc = float(circle_of_confusion_mm(50, 1.4, 3200, depth))
        yield (
            rf"{front:.3f} \times {abs(depth - 3200)}/{depth} = {disc:.3f}$ mm, "
            rf"or {disc / PIXEL_MM:.1f} pixels"
        )
    wall, near = (
        float(circle_of_confusion_mm(50, 5.6, 3200, depth)) / PIXEL_MM for depth in (8000, 1850)
    )
    yield f"{wall:.2f} and {near:.2f} pixels. No disc is as wide as a pixel"


def the_hyperfocal_distance() -> Says:
    distance = hyperfocal(50, 2.8, PIXEL_MM)
    yield rf"$2500/(2.8 \times {PIXEL_MM:.4f}) + 50 \approx {round(distance, -2):.0f}$ mm"


def half_the_field_of_view() -> Says:
    half = 18 / tan(field_of_view_rad(50, 36) / 4)
    yield f"Half is reached at {half:.0f} mm."
    assert isclose(2 * field_of_view_rad(half, 36), field_of_view_rad(50, 36))


def past_the_fold() -> Says:
    largest = largest_distorted_radius(Distortion(k1=-0.4))
    yield f"past the largest distorted radius, {largest:.2f} for this $k_1$"
    assert hypot(18, 12) / 24 > largest


def wide_lens_distortion() -> Says:
    near, far = (r - distort([r, 0], Distortion(k1=-0.2))[0] for r in (0.2, 0.6))
    yield f"{near:.4f} for A and {far:.4f} for B"
    yield f"- [x] B moves {far / near:.0f} times as far as A."


def a_code_in_electrons() -> Says:
    yield f"a code is about {ADC.full_well_e / 255:.0f} electrons here"


def what_bending_the_picture_costs() -> Says:
    picture, rays = errors_in_codes(aperture=8, k1=-0.1)
    yield f"At f/8 and $k_1 = -0.1$ the picture is {picture:.1f} codes of 255 from one"
    yield f"With bent rays it is {rays:.1f}."
    picture, rays = errors_in_codes(focal_length=135, aperture=1.4, k1=0.4)
    yield f"{picture:.1f} codes from the truth and the one of bent rays {rays:.1f}."
    assert picture < rays


def a_lens_that_hardly_bends() -> Says:
    picture, rays = errors_in_codes(k1=0.01)
    yield f"the bent picture is {picture:.2f} codes from the truth, the one of bent rays {rays:.2f}"
    picture, rays = errors_in_codes(k1=0.4)
    yield f"At 0.40 they are {picture:.2f} and {rays:.2f} codes off."


@cache
def errors_in_codes(**setting: float) -> tuple[float, float]:
    """Of the bent picture and of that of bent rays, against rays through the whole lens."""
    values = check_values(camera.CONTROLS, setting)
    *_, truth = camera.references(values)
    bent_picture, bent_rays = (
        camera.run_tier(values, tier, StageCache()).outputs["noiseless picture"]
        for tier in ("layers", "bent-rays")
    )
    return camera.rms_codes(bent_picture, truth), camera.rms_codes(bent_rays, truth)


def how_seldom_the_straight_picture_is_drawn_again() -> Says:
    again = []
    for lens in range(24, 136, 10):
        sweep = [
            margin_px(check_values(camera.CONTROLS, {"focal_length": lens, "k1": k1 / 100}))
            for k1 in range(-40, 41)
        ]
        again += [before != after for before, after in pairwise(sweep)]
    assert 0.05 < sum(again) / len(again) < 0.15
    yield "only one in ten or so has to draw the straight picture again"


def how_many_stages_there_are() -> Says:
    assert len(STAGES) == 18
    yield "A photograph here takes eighteen stages"


WORKED = (
    the_camera_s_pixels,
    where_a_point_lands,
    what_the_pixel_counts,
    when_the_lens_is_a_pinhole,
    the_hyperfocal_distance,
    half_the_field_of_view,
    past_the_fold,
    wide_lens_distortion,
    a_code_in_electrons,
    what_bending_the_picture_costs,
    a_lens_that_hardly_bends,
    how_seldom_the_straight_picture_is_drawn_again,
    how_many_stages_there_are,
)
