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
from simulations.models.color.cie import (
    D65_XY,
    rgb_to_xyz_matrix,
    xyz_to_lab,
    xyz_to_linear_rgb,
)
from simulations.models.sensor.photon_counting import (
    ShotModel,
    shot_noise,
)
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


def files_of_the_picture() -> Phrases:
    """Pillow's entropy-coded data, with codes fitted to the picture or ready-made."""
    excess: dict[bool, list[float]] = {True: [], False: []}
    for quality in (30, 50, 75, 90):
        outputs = JPEG.run(JPEG.check({"quality": quality}), "", StageCache()).outputs
        picture = Image.fromarray(np.rint(255 * outputs["original"]).astype(np.uint8))
        for fitted, found in excess.items():
            file = io.BytesIO()
            picture.save(file, "JPEG", quality=quality, subsampling=2, optimize=fitted)
            data = file.getvalue()
            scan = data.index(b"\xff\xda")
            start = scan + 2 + int.from_bytes(data[scan + 2 : scan + 4])
            bits = 8 * len(data[start:-2].replace(b"\xff\x00", b"\xff"))
            found.append(bits / outputs["size"].bits - 1)
    assert all(0.01 < share < 0.025 for share in excess[True])
    assert all(0.025 < share < 0.095 for share in excess[False])
    yield "one or two per cent larger when their codes are fitted to the picture"
    yield "three to nine when they are the ready-made ones"
