"""Chapter 10: speed and accuracy. Its results are measured; a few are worked out."""

import numpy as np
import skimage.data
from support.worked_numbers import Phrases

from simulations.ladders import depth_of_field, inverse_strong, resampling, wide_discs
from simulations.ladders.depth_of_field import radius_px
from simulations.ladders.inverse_distortion import LADDER
from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.distortion import radial_profile, radial_table
from simulations.models.distortion.lens_model import largest_distorted_radius, undistort
from simulations.models.error_measures import psnr_db
from simulations.models.light.raycasting import Sphere
from simulations.models.sensor.demosaicing import demosaic, mosaic
from simulations.scenes.camera import scene as camera
from simulations.world.still_life import OBJECTS, object_depth
from simulations.world.still_life_camera import PITCH_MM

CHAPTER = "10-speed-and-accuracy"


def slope_of_the_fixed_point_map() -> Phrases:
    """The factor by which one step reduces an error, |r g'(r) / g(r)|, at worst in the workload."""
    work = LADDER.prepare()
    profile = work.lens.radial
    ideal = np.hypot(*np.moveaxis(undistort(work.distorted, work.lens)[0], -1, 0))
    scale, slope = radial_profile.scale_and_slope(profile, ideal**2)
    worst = float(np.abs(2 * ideal**2 * slope / scale).max())
    yield f"which for this lens is {worst:.2f} at worst"


def the_places_of_a_checked_table() -> Phrases:
    work = LADDER.prepare()
    table = radial_table.inverse_table(work.lens.radial, 1.0)
    yield f"lays short polynomials through {table.coefficients.size} places"


def nearness_of_the_barrel_to_its_fold() -> Phrases:
    work = inverse_strong.prepare()[inverse_strong.BARREL]
    share = np.hypot(*work.distorted.T).max() / largest_distorted_radius(work.lens)
    yield f"to {100 * share:.1f} % of the largest distorted radius there is"


def smallest_radius_of_outlines_in_the_book() -> Phrases:
    """The smallest ball, through the widest lens, focused at infinity."""
    balls = [(it.solid, object_depth(it)) for it in OBJECTS if isinstance(it.solid, Sphere)]
    widest = camera.SCENE.clamp({"focal_length": 0}).focal_length
    focal_px = widest / PITCH_MM
    smallest = min(focal_px * ball.radius / depth for ball, depth in balls)
    yield f"with radii of {int(smallest)} pixels or more"


PHOTOGRAPHS = ("astronaut", "coffee", "chelsea", "rocket")
"""Of scikit-image."""
METHODS = ("bilinear", "malvar", "menon", "menon-unrefined", "menon-encoded")


def fidelities_of_demosaicing(name: str) -> Floats:
    """PSNR (16, 5, 2) of 16 parts by each method, in light and as displayed. At half size, since
    the photographs' own cameras demosaiced them."""
    linear = decode_srgb(getattr(skimage.data, name)() / 255)
    rows, columns = (side // 2 for side in linear.shape[:2])
    whole = linear[: 2 * rows, : 2 * columns].reshape(rows, 2, columns, 2, 3).mean(axis=(1, 3))
    rng, found = np.random.default_rng(0), []
    for _ in range(16):
        top, left = rng.integers(0, rows - 127), rng.integers(0, columns - 127)
        truth = whole[top : top + 128, left : left + 128]
        guesses = (np.clip(demosaic(mosaic(truth), method=method), 0, 1) for method in METHODS)
        found.append(
            [[psnr_db(f(g), f(truth), crop=8) for f in (np.asarray, encode_srgb)] for g in guesses]
        )
    return np.array(found)


def demosaicing_of_photographs() -> Phrases:
    parts = np.stack([fidelities_of_demosaicing(name) for name in PHOTOGRAPHS])
    bilinear, malvar, menon, default, encoded = np.moveaxis(parts, 2, 0)
    over, beyond = (
        np.median(gain, axis=1).round(1) + 0.0 for gain in (default - bilinear, encoded - default)
    )

    def row(words: str, values: Floats) -> str:
        cells = (f"{value:.1f}".replace("-", "−") for value in values)
        return f"| {words} | {' | '.join(cells)} |"

    for other in (bilinear, malvar, menon):
        assert (np.median(other - default, axis=1) <= 0.1).all()
    yield "none is better on any of four photographs, by more than 0.1 dB"
    yield row("default over bilinear, on a screen", over[:, 1])
    yield row("the same, in light", over[:, 0])
    yield row("last tier over default, on a screen", beyond[:, 1])
    yield row("the same, in light", beyond[:, 0])


def lanczos_on_single_pictures() -> Phrases:
    """In decibels above the spline after one turn, at 16 angles: waves, rings and discs."""
    gains = []
    for index in range(0, 64, 4):
        work = resampling.draw(index)
        truth = resampling.reference(work)
        lanczos, spline = (
            resampling.psnr_each(resampling.LADDER.tier(kernel).run(work).once, truth.once)
            for kernel in ("lanczos3", "spline")
        )
        gains.append(np.subtract(lanczos, spline))
    waves, rings, discs = np.quantile(gains, (0.05, 0.95), axis=0).round().T
    assert set(waves) == {3}
    assert {*rings, *discs} == {-2}
    yield "It is better by 3 dB on the picture that is made of waves alone, and 2 dB worse on"


def size_of_wide_discs() -> Phrases:
    near, wall = (2 * float(radius_px(wide_discs.prepare(), z)) for z in (1.6, 8.0))
    assert near > wall
    narrow = 2 * float(radius_px(depth_of_field.prepare(), 1.6))
    yield f"until they are {near:.0f} pixels wide"
    yield f"Such a disc covers {round(np.pi * near**2 / 4, -2):.0f} pixels"
    assert round(near / narrow) == 6
    wide, before = wide_discs.prepare(), depth_of_field.prepare()
    assert round(wide.lens_radius / before.lens_radius) == 3
    assert wide.pixels.shape == (2 * before.pixels.shape[0], 2 * before.pixels.shape[1])
    yield "a lens three times as wide, on twice as many pixels each way"
