"""Chapter 8: the whole camera."""

from dataclasses import replace
from functools import cache
from math import ceil, inf, isclose, pi

from numbers_10_measured import error
from numpy import arange, interp
from scipy.special import j1
from support.worked_numbers import Says

from simulations.engine.stages import StageCache
from simulations.models.distortion.lens_model import Distortion, distort
from simulations.models.lens.aperture_grid import aperture_grid
from simulations.models.lens.thin_lens import circle_of_confusion_mm, principal_distance_mm
from simulations.pictures.still_life.things import THINGS, WALL_DISTANCE, thing_depth
from simulations.scenes._still_life_camera.picture import SHARP_PX
from simulations.scenes._still_life_camera.rays import COLUMNS, ROWS, largest_blur_px, sensor_rays
from simulations.scenes.camera import scene as camera
from simulations.scenes.camera.lens import bend_rays
from simulations.scenes.camera.stages import TIERS
from simulations.scenes.depth_of_field.stages import sharpness

CHAPTER = "08-full-camera-model"
PIXEL_MM = 36 / 264


ASIDE = 0.30 / 1.90
"""Of the point whose way is told: its tangent to the optical axis."""
LENS = Distortion(k1=-0.2)


def the_same_place_in_the_simulator() -> Says:
    """Its rays say the same: the one that the lens bends onto that pixel points at the point."""
    sensor = principal_distance_mm(50, 3200)
    column = (COLUMNS - 1) / 2 + sensor / PIXEL_MM * float(distort([ASIDE, 0], LENS)[0])
    rays = bend_rays(sensor_rays(50.0, 3.2), LENS.k1).directions
    row = (rays[ROWS // 2 - 1] + rays[ROWS // 2]) / 2
    assert isclose(float(interp(column, arange(COLUMNS), row[:, 0])), ASIDE, rel_tol=1e-4)
    yield "This is the principal distance"


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
    yield f"so is every disc: {wall:.2f} and {near:.2f} pixels"
    nyquist = pi * near * 0.5
    taken = 100 * (1 - 2 * j1(nyquist) / nyquist)
    yield f"a disc of {near:.2f} pixels takes away {taken:.0f} %"
    yield f"an error of {without_blur(50, 3.2, 5.6):.1f} codes of 255"


def without_blur(focal_length: float, focus: float, aperture: float) -> float:
    """Codes by which a picture that is not blurred differs from rays through the lens."""
    settings = camera.SCENE.check({"focal_length": focal_length, "focus": focus})
    *_, truth = camera.references(replace(settings, aperture=aperture))
    sharp = camera.SCENE.run(replace(settings, aperture=1e6), "layers", StageCache())
    return camera.rms_codes(sharp.outputs["noiseless picture"], truth)


def what_leaving_out_the_blur_costs() -> Says:
    lens = 24, 1.0  # of focal lengths from 24 to 50 mm and foci up to 3.2 m, where it costs most
    errors = {width: without_blur(*lens, f_number_of(*lens, width)) for width in (SHARP_PX, 1.0)}
    assert 0.45 < errors[SHARP_PX] < 0.52
    yield f"If its widest disc is {SHARP_PX:g} pixels wide, the error is half a code of 255"
    yield f"At one pixel it can be {errors[1.0]:.1f} codes"
    from_here_on = ceil(10 * f_number_of(50, 3.2, SHARP_PX)) / 10
    yield f"at 50 mm and a focus of 3.2 m from f/{from_here_on} on"


def f_number_of(focal_length: float, focus: float, widest_px: float) -> float:
    """At which the widest disc in the picture is so wide: discs go as one over the f-number."""
    return largest_blur_px(focal_length, 1.0, focus, 0.0) / widest_px


def how_far_the_lens_must_be_stopped_down() -> Says:
    def sharp_from_2_m_on(aperture: float) -> bool:
        at = (sharpness(50, aperture, focus) for focus in arange(3, 6, 0.05))
        return any(one.near_limit_m <= 2 and one.far_limit_m == inf for one in at)

    assert not sharp_from_2_m_on(4.6)
    assert sharp_from_2_m_on(4.7)
    yield "stopped down to f/4.7 at least"


def the_still_life() -> Says:
    depths = [thing_depth(thing) for thing in THINGS]
    assert len(depths) == 6
    assert 1.8 < min(depths) < 2
    assert round(max(depths), 1) == 6.5
    yield "Six things stand on a chequered floor, from under two metres to six and a half"
    yield f"a test chart hangs on the wall at {'eight' if WALL_DISTANCE == 8 else WALL_DISTANCE}"


def a_quarter_as_deep() -> Says:
    limits = [
        camera.depth_of_field_m(camera.SCENE.check({"aperture": 1.4, "focal_length": focal}))
        for focal in (50, 100)
    ]
    (near, far), (near_long, far_long) = limits
    assert 0.23 < (far_long - near_long) / (far - near) < 0.27
    assert all(behind - 3.2 > 3.2 - before for before, behind in limits)
    yield "about a quarter as deep"
    yield "At both focal lengths the band reaches farther behind the focus than in front of it."


def what_bending_the_picture_costs() -> Says:
    picture, rays = errors_in_codes(aperture=16, k1=-0.1)
    yield f"through the lens by {picture:.1f} codes of 255"
    yield f"With bent rays it is {rays:.1f} codes."
    picture, rays = errors_in_codes(focal_length=135, aperture=1.4, k1=0.4)
    assert 2 < picture < 0.98 * rays
    assert rays < 3
    yield "both pictures are between two and three codes from the truth, and the bent one"


def a_lens_that_hardly_bends() -> Says:
    picture, rays = errors_in_codes(k1=0.01)
    yield f"the bent picture is {picture:.1f} codes from the truth, the one of bent rays {rays:.1f}"
    picture, rays = errors_in_codes(k1=0.4)
    yield f"At 0.40 they are {picture:.1f} and {rays:.1f} codes off."


@cache
def errors_in_codes(**setting: float) -> tuple[float, float]:
    """Of the bent picture and of that of bent rays, against rays through the whole lens."""
    settings = camera.SCENE.check(setting)
    *_, truth = camera.references(settings)
    bent_picture, bent_rays = (
        camera.SCENE.run(settings, tier, StageCache()).outputs["noiseless picture"]
        for tier in ("layers", "bent-rays")
    )
    return camera.rms_codes(bent_picture, truth), camera.rms_codes(bent_rays, truth)


def what_a_step_of_the_focus_leaves() -> Says:
    cache = StageCache()
    for focus in (3.2, 3.3):
        settings = camera.SCENE.check({"aperture": 2.0, "focus": focus})
        reports = camera.SCENE.run(settings, "", cache).reports
    reused = [report.name for report in reports if report.status == "reused"]
    again = {report.name for report in reports if report.status == "computed"}
    assert reused == ["grain"]
    assert {"surfaces", "defocus", "vignetting"} <= again
    yield "- [x] How the grain of noise is drawn"


def what_the_truth_is() -> Says:
    yield f"sends {len(aperture_grid(camera.REFERENCE_GRID))} rays per pixel through the whole"
    yield f"differs from one that sends {len(aperture_grid(camera.REFERENCE_GRID))} rays per pixel"
    rays = TIERS["aperture-rays"].lens_rays
    yield f"*{rays} bent rays a pixel*"
    assert rays == 12
    yield "twelve rays per pixel come nearer to the truth"
    settings = camera.SCENE.check({"aperture": 1.4})
    *_, truth = camera.references(settings)
    layers, through_the_lens = (
        camera.rms_codes(
            camera.SCENE.run(settings, tier, StageCache()).outputs["noiseless picture"], truth
        )
        for tier in ("layers", "aperture-rays")
    )
    assert through_the_lens < 0.7 * layers


def where_the_points_of_a_lens_lie() -> Says:
    filters = [error("depth-of-field", tier, "psnr") for tier in ("discs", "binned", "gather")]
    assert max(filters) == filters[2] < error("depth-of-field", "layered", "psnr")
    yield "the best of them reaches a PSNR"
    independent, cells, spiral, turned = (
        error("depth-of-field", f"{tier}-16", "psnr")
        for tier in ("random", "jittered", "fibonacci", "turned")
    )
    yield f"the cells are {10 ** ((cells - independent) / 10):.1f} times as efficient"
    yield f"the spiral is {10 ** ((spiral - independent) / 10):.0f} times as efficient"
    assert abs(turned - spiral) < 0.3
    yield "the error hardly changes"


def the_ball_that_gets_softer() -> Says:
    ball = thing_depth(next(thing for thing in THINGS if thing.name == "striped ball"))
    yield f"The striped ball, {ball:.1f} m away, gets softer"
    near, far = (
        float(circle_of_confusion_mm(135, 22, focus, 1000 * ball)) / PIXEL_MM
        for focus in (1000, 10_000)
    )
    assert near > 3 * far
