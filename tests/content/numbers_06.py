"""Chapter 6: the sensor, its noise and its colours."""

import io
import warnings
from math import erf, sqrt

import numpy as np
from PIL import Image
from scipy.stats import norm
from support.worked_numbers import Phrases

from simulations.engine.stages import StageCache
from simulations.models.arrays import Floats
from simulations.models.color.chromatic_adaptation import adapt
from simulations.models.color.chromaticity import ILLUMINANT_A_XY, lab_distance
from simulations.models.color.cie import D65_XY, rgb_to_xyz_matrix, xyz_to_lab, xyz_to_linear_rgb
from simulations.models.sensor.photon_counting import ShotModel, shot_noise
from simulations.scenes.jpeg import SCENE as JPEG
from simulations.scenes.sensor_noise.sensor import PATCH_PX, patch_means_e, saturation_e, sensor_of

CHAPTER = "06-digital-sensor"


WELL = 20_000.0


def patches_burnt_out_at_iso_800() -> Phrases:
    burnt = patch_means_e(0.0) > saturation_e(sensor_of(12, "800", 10))
    assert burnt.sum() == 8
    yield "eight patches are burnt out"


def gaussian_for_less_than_one_electron() -> Phrases:
    mean = float(patch_means_e(-6.0)[-1])
    yield f"light frees {mean:.2f} electrons in a cell on average"
    below_zero = (1 - erf(sqrt(mean / 2))) / 2
    assert 0.3 < below_zero < 0.36
    yield "has a third of its area below zero"
    one_e_dn = 1 / sensor_of(14, "6400", 0).gain_e_per_dn
    z = norm.ppf((np.arange(400_000) + 0.5) / 400_000)
    models: tuple[tuple[ShotModel, Floats, str], ...] = (
        ("gaussian", 0 * z, "and over many takes {:.1f} DN"),
        ("skewed", (z * z - 1) / 6, "lowers the mean to {:.1f} DN over many takes"),
    )
    for model, lean, words in models:
        expected = np.maximum(np.rint(mean + sqrt(mean) * z + lean), 0).mean()
        drawn = shot_noise(np.full(z.shape, mean), np.random.default_rng(0), WELL, model)
        assert np.isclose(drawn.mean(), expected, atol=0.004)
        yield words.format(expected * one_e_dn)
    yield f"where {mean:.2f} electrons are {mean * one_e_dn:.1f} DN"
    scatter = sqrt(mean / 2) / PATCH_PX * one_e_dn  # the mean is of two frames
    yield f"The mean of a patch scatters by {scatter:.1f} DN"


def patches_by_lamplight_and_by_daylight() -> Phrases:
    """From the measured spectra of the chart, by another library."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it interpolates, and misses packages for plotting
        import colour

        observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
        chart = colour.SDS_COLOURCHECKERS["ColorChecker N Ohta"]
        lamp, day = (
            np.array(
                [
                    colour.sd_to_XYZ(patch, observer, colour.SDS_ILLUMINANTS[light])
                    for patch in chart.values()
                ]
            )
            / 100
            for light in ("A", "D65")
        )
    assert len(lamp) == 24
    rows: dict[str, Floats] = {"nothing": lamp}
    for words, method in (
        ("red, green and blue of linear sRGB", "rgb"),
        ("the cones, after von Kries", "von-kries"),
        ("Bradford's responses", "bradford"),
    ):
        rows[words] = adapt(lamp, ILLUMINANT_A_XY, D65_XY, method)
    negative = xyz_to_linear_rgb(lamp)[:, 2] < 0
    names = [str(name) for name in np.array(list(chart))[negative]]
    assert names == ["orange", "yellow green", "orange yellow", "yellow"]
    yield "Factors in linear sRGB do well for greys and fail for yellows and oranges."
    for words, xyz in rows.items():
        yield f"| {words} | {lab_distance(xyz_to_lab(xyz), xyz_to_lab(day)).mean():.1f} |"


def the_matrix_of_srgb() -> Phrases:
    for row in np.linalg.inv(rgb_to_xyz_matrix()):
        yield " & ".join(f"{entry:.3f}" for entry in row)


def excess_of_a_file(picture: str, subsampling: str, quality: int, *, fitted: bool) -> float:
    """By how much Pillow's entropy-coded data exceed the size that the figure states, as a share;
    with codes fitted to the picture or ready-made."""
    chosen = {"quality": quality, "picture": picture, "subsampling": subsampling}
    outputs = JPEG.run(JPEG.check(chosen), "", StageCache()).outputs
    pixels = Image.fromarray(np.rint(255 * outputs["original"]).astype(np.uint8))
    file, coarse = io.BytesIO(), {"4:4:4": 0, "4:2:0": 2}[subsampling]
    pixels.save(file, "JPEG", quality=quality, subsampling=coarse, optimize=fitted)
    data = file.getvalue()
    scan = data.index(b"\xff\xda")
    start = scan + 2 + int.from_bytes(data[scan + 2 : scan + 4])
    bits = 8 * len(data[start:-2].replace(b"\xff\x00", b"\xff"))
    return float(bits / outputs["size"].bits - 1)


def sizes_of_files() -> Phrases:
    kinds = [(p, s) for p in ("cat", "balloon") for s in ("4:2:0", "4:4:4")]
    usual = [(*kind, quality) for kind in kinds for quality in (30, 50, 75, 90)]
    fitted = [excess_of_a_file(*each, fitted=True) for each in usual]
    assert 0.005 < min(fitted) < max(fitted) < 0.035
    yield "one to three per cent larger when their codes are fitted to the picture"
    ready = [excess_of_a_file(*each, fitted=False) for each in usual]
    assert 0.025 < min(ready) < max(ready) < 0.145
    yield "and three to fourteen when they are the ready-made ones"
    assert excess_of_a_file("cat", "4:4:4", 5, fitted=False) > 1
    yield "at quality 5 they can more than double the file"
