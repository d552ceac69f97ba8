"""Chapter 6: the sensor."""

import io
import re
import warnings
from functools import cache
from math import erf, sqrt

import numpy as np
import skimage.data
from PIL import Image
from scipy.stats import norm
from support.worked_numbers import Says

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
from simulations.models.color.illuminants import planck
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.compression import jpeg
from simulations.models.compression.chroma_upsampling import METHODS as UPSAMPLING
from simulations.models.error_measures import psnr_db
from simulations.models.sensor.demosaicing import METHODS, demosaic, mosaic
from simulations.models.sensor.photon_counting import (
    ShotModel,
    shot_noise,
)
from simulations.models.sensor.shared_detail import shared_detail
from simulations.pictures.balloon import WHOLE
from simulations.pictures.mosaic_subjects import SUBJECTS
from simulations.scenes.jpeg.scene import SCENE as JPEG
from simulations.scenes.sensor_noise.stages import PATCH_PX, patch_means_e, saturation_e, sensor_of

CHAPTER = "06-digital-sensor"
WELL = 20_000.0


def patches_burnt_out_at_iso_800() -> Says:
    burnt = patch_means_e(0.0) > saturation_e(sensor_of(12, "800", 10))
    assert burnt.sum() == 8
    yield "eight patches are burnt out"


def a_gaussian_of_hardly_an_electron() -> Says:
    mean = float(patch_means_e(-6.0)[-1])
    yield f"Light frees {mean:.2f} electrons in a cell there"
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


PHOTOGRAPHS = {"coffee": "coffee", "cat": "chelsea", "astronaut": "astronaut"}


@cache
def photograph(name: str) -> Floats:
    """Of scikit-image, in linear light, at half size: its own camera has demosaiced it."""
    linear = decode_srgb(getattr(skimage.data, PHOTOGRAPHS[name])() / 255)
    rows, columns = (side // 2 for side in linear.shape[:2])
    halves = linear[: 2 * rows, : 2 * columns].reshape(rows, 2, columns, 2, 3)
    return np.asarray(halves.mean(axis=(1, 3)))


def photographs_through_the_mosaic() -> Says:
    shared: list[float] = []
    on_screen, in_light = [], []
    for name in PHOTOGRAPHS:
        truth = photograph(name)
        shared.extend(shared_detail(truth))
        guessed = [
            np.clip(demosaic(mosaic(truth), method=method), 0, 1)
            for method in ("bilinear", "menon-unrefined")
        ]
        shown = [psnr_db(encode_srgb(g), encode_srgb(truth), crop=8) for g in guessed]
        light = [psnr_db(g, truth, crop=8) for g in guessed]
        on_screen.append(shown[1] - shown[0])
        in_light.append(light[1] - light[0])
        cells = (f"{bilinear:.1f}, {menon:.1f}" for bilinear, menon in (shown, light))
        yield f"| {name} | {' | '.join(cells)} |"
    yield f"the correlations lie between {min(shared):.2f} and {max(shared):.2f}"
    yield "it wins by 4 to 6 dB in light, and on the screen by as little as 0.4 dB"
    assert round(min(in_light)) == 4
    assert round(max(in_light)) == 6
    assert round(min(on_screen), 1) == 0.4


def photographs_with_coarser_colour() -> Says:
    def psnr(name: str, subsampling: str, upsampling: str = "triangle") -> float:
        picture = np.rint(255 * encode_srgb(photograph(name))) / 255
        coded = jpeg.encode(jpeg.to_planes(picture), 100, subsampling)
        return psnr_db(np.rint(255 * jpeg.decode(coded, upsampling)) / 255, picture)

    coarse = {name: psnr(name, "4:2:0") for name in PHOTOGRAPHS}
    lost = {name: psnr(name, "4:4:4") - coarse[name] for name in PHOTOGRAPHS}
    yield (
        "lose "
        + ", ".join(f"{lost[n]:.0f} dB ({n})" for n in ("coffee", "cat"))
        + (f" and {lost['astronaut']:.0f} dB (astronaut)")
    )
    yield f"end between {min(coarse.values()):.0f} and {max(coarse.values()):.0f} dB"
    gains = [psnr(name, "4:2:0", "guided") - coarse[name] for name in PHOTOGRAPHS]
    best = {m: jpeg_psnr(quality=100, upsampling=m) for m in ("triangle", "guided")}
    yield (
        f"following luma gains {min(gains):.1f} to {max(gains):.1f} dB over the triangle, "
        f"and not {best['guided'] - best['triangle']:.1f} dB as here"
    )
    full = jpeg_psnr(quality=100, subsampling="4:4:4")
    yield f"4:2:0 costs {full - best['triangle']:.0f} dB at quality 100"


def jpeg_psnr(**given: object) -> float:
    """What the figure shows."""
    return float(JPEG.run(JPEG.check(given), "", StageCache()).outputs["psnr"])


def transforms_that_round_otherwise() -> Says:
    def changed(tier: str, **given: object) -> tuple[float, int]:
        *_, last = JPEG.estimates(JPEG.check(given), tier, StageCache())
        found = re.search(r"\((\d+) round otherwise\)", last.label)
        assert found is not None
        return float(last.text) if tier == "fixed-point" else 0.0, int(found[1])

    best = {"quality": 100, "subsampling": "4:4:4"}
    error, at_low = changed("fixed-point", quality=30)
    assert 1 / 3 < error < 0.5
    yield "may be more than a third of a code off"
    assert 12 <= at_low <= 28
    yield "At quality 30 that moves some twenty of the numbers kept."
    assert changed("fixed-point", **best)[1] > 2000
    yield "it moves thousands of them"
    for tier in ("separable-32", "direct-32"):
        assert 25 <= changed(tier, **best)[1] <= 35
    yield "moves some thirty"


def stripes_finer_than_a_cell() -> Says:
    """Five periods to four cells, summed by cells of full width."""
    left = float(np.sinc(5 / 4))
    yield f"which leaves {100 * abs(left):.0f} % of the contrast"
    fine = (np.arange(4 * 1000) + 0.5) / 1000
    cells = np.cos(2 * np.pi * 5 / 4 * fine).reshape(4, 1000).mean(axis=1)
    broad = -left * np.cos(2 * np.pi * (np.arange(4) + 0.5) / 4)
    np.testing.assert_allclose(cells, broad, atol=1e-6)
    yield "rise and fall once in four cells"


def threads_of_red_and_cyan() -> Says:
    red, green, blue = rgb_to_xyz_matrix()[1]
    threads = np.zeros((96, 96, 3))
    on = np.arange(96) // 3 % 2 == 0
    threads[:, on, 0], threads[:, ~on, 1:] = 0.6, 0.6 * red / (green + blue)
    blurred = (threads + np.roll(threads, 1, axis=1) + np.roll(threads, -1, axis=1)) / 3
    psnr = {
        method: psnr_db(
            encode_srgb(np.clip(demosaic(mosaic(blurred), method=method), 0, 1)),
            encode_srgb(blurred),
            crop=8,
        )
        for method in ("bilinear", "malvar")
    }
    yield f"Bilinear interpolation gives about {psnr['bilinear']:.0f} dB"
    assert psnr["malvar"] < psnr["bilinear"] - 5
    yield "the result is worse by several decibels"
    yield "There Malvar's method does much worse than plain bilinear interpolation."


@cache
def scores(picture: str) -> dict[str, tuple[float, float]]:
    """Of each method on a picture: PSNR as displayed, and in light."""
    truth = SUBJECTS[picture].draw(WHOLE)
    guessed = {m: np.clip(demosaic(mosaic(truth), method=m), 0, 1) for m in METHODS}
    return {
        m: (psnr_db(encode_srgb(guess), encode_srgb(truth), crop=8), psnr_db(guess, truth, crop=8))
        for m, guess in guessed.items()
    }


def what_the_methods_gain() -> Says:
    room, balloon, soft = (
        {method: shown for method, (shown, _) in scores(name).items()}
        for name in ("room", "balloon", "soft")
    )
    default = "menon-unrefined"
    assert room[default] > room["bilinear"] + 7
    yield "which share none, it is the other way round"
    assert soft[default] < soft["bilinear"] - 7
    yield "which shares some, the two are level"
    assert abs(balloon[default] - balloon["bilinear"]) < 0.5
    yield "it gains two tenths of a decibel in the room, and loses on the other two pictures"
    assert round(room["menon"] - room[default], 1) == 0.2
    for other in (balloon, soft):
        assert other["menon"] < other[default] - 0.3
    yield "on the screen it is slightly behind"
    assert -1 < balloon["malvar"] - balloon["bilinear"] < -0.2
    yield "and lost in light, by sending the mosaic through the curve first"
    light = {method: light for method, (_, light) in scores("balloon").items()}
    assert light["menon-encoded"] < light[default] - 1
    assert balloon["menon-encoded"] > balloon[default] + 1
    assert light["malvar"] > light["bilinear"] + 2


def errors_in_the_dark() -> Says:
    truth = SUBJECTS["balloon"].draw(WHOLE)
    guess = np.clip(demosaic(mosaic(truth), method="malvar"), 0, 1)
    squared = np.square(encode_srgb(guess) - encode_srgb(truth), dtype=np.float64)
    inner = (slice(8, -8), slice(8, -8))
    dark = truth[inner] < 1 / 20
    assert 0.47 < squared[inner][dark].sum() / squared[inner].sum() < 0.55
    assert 1 / 10 < dark.mean() < 1 / 8
    yield "Half of Malvar's squared error on the screen lies in the darkest ninth of the values"
    yield "those below a twentieth of white"


def colour_filled_in_at_quality_30() -> Says:
    coarse = {method: jpeg_psnr(upsampling=method) for method in UPSAMPLING}
    best = max(coarse.values())
    yield "all but repetition lie within a quarter of a decibel"
    assert all(best - coarse[m] < 0.25 for m in UPSAMPLING if m != "repeated")
    assert best - coarse["repeated"] > 0.4
    assert coarse["triangle"] > best - 0.02
    fine = {method: jpeg_psnr(upsampling=method, quality=100) for method in UPSAMPLING}
    yield "The parabola and *following luma* gain much at quality 100"
    assert fine["parabola"] > fine["triangle"] + 1
    assert fine["guided"] > fine["parabola"] + 2


def files_of_the_picture() -> Says:
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
    assert all(0.04 < share < 0.06 for share in excess[False])
    yield "one or two per cent larger when their codes are fitted to the picture"
    yield "about five when they are the ready-made ones"


def patches_by_lamplight_and_by_daylight() -> Says:
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


def paint_at_three_wavelengths() -> Says:
    lamp = np.interp([450, 550, 650], WAVELENGTHS_NM, planck(2850.0))
    lamp /= lamp[1]
    yield f"$0.35 : 1 : {lamp[2]:.2f}$"
    assert np.isclose(lamp[0], 0.35, atol=0.005)
    paint = np.array([0.05, 0.70, 0.78])
    yield "0.02, {1:.2f} and {2:.2f} leave it".format(*(lamp * paint))
    even = []
    for cell in ([0.05, 0.04, 0.34], [0.20, 0.89, 0.03]):
        first, second, third = lamp * paint * cell
        total = first + second + third
        yield f"${first:.3f} + {second:.3f} + {third:.3f} = {total:.2f}$"
        even.append((float(paint @ cell), total))
    (red, by_lamp), (green, _) = even
    yield f"green would be {green:.2f} and red {red:.2f}"
    assert np.isclose(by_lamp / red, 5 / 3, atol=0.05)


def the_matrix_of_srgb() -> Says:
    for row in np.linalg.inv(rgb_to_xyz_matrix()):
        yield " & ".join(f"{entry:.3f}" for entry in row)


WORKED = (
    paint_at_three_wavelengths,
    the_matrix_of_srgb,
    stripes_finer_than_a_cell,
    photographs_through_the_mosaic,
    photographs_with_coarser_colour,
    threads_of_red_and_cyan,
    what_the_methods_gain,
    errors_in_the_dark,
    colour_filled_in_at_quality_30,
    files_of_the_picture,
    patches_burnt_out_at_iso_800,
    a_gaussian_of_hardly_an_electron,
    transforms_that_round_otherwise,
    patches_by_lamplight_and_by_daylight,
)
