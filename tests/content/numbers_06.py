"""Chapter 6: the sensor, its noise and its colours."""

import io
import warnings

import numpy as np
from PIL import Image
from support.worked_numbers import Phrases

from simulations.engine.stages import StageCache
from simulations.models.arrays import Floats
from simulations.models.color.chromatic_adaptation import adapt
from simulations.models.color.chromaticity import ILLUMINANT_A_XY, lab_distance
from simulations.models.color.cie import D65_XY, rgb_to_xyz_matrix, xyz_to_lab, xyz_to_linear_rgb
from simulations.scenes.jpeg import SCENE as JPEG
from simulations.scenes.sensor_noise.sensor import patch_means_e, saturation_e, sensor_of

CHAPTER = "06-digital-sensor"


def patches_burnt_out_at_iso_800() -> Phrases:
    burnt = patch_means_e(0.0) > saturation_e(sensor_of(12, 800, 10))
    assert burnt.sum() == 8
    yield "eight patches are burnt out"


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
