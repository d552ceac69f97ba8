"""Figures of colour: spectra, mosaics of filters, and JPEG."""

import io
import re
from functools import partial

import numpy as np
import pytest
from PIL import Image
from scipy.fft import dctn, idctn
from support.frames import (
    estimates_of,
    frame_of,
    number_of,
    outputs_of,
    pixels_of,
    texts_at,
    texts_of,
)

from simulations.engine.frame import Frame
from simulations.engine.photograph import Photograph
from simulations.engine.stages import StageCache
from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.compression.blocks import round_outwards, to_blocks
from simulations.models.compression.chroma_subsampling import SUBSAMPLING, coarsen
from simulations.models.compression.cosine_transforms import TRANSFORMS
from simulations.models.compression.jpeg import tables
from simulations.models.sensor.bayer import mosaic
from simulations.models.sensor.demosaicing import METHODS
from simulations.pictures.balloon import WHOLE
from simulations.pictures.mosaic_subjects import SUBJECTS
from simulations.registry import load_ladder
from simulations.scenes._spectra import CELL, LEFT, LIGHTS, UNIT
from simulations.scenes.bayer_demosaic import METHOD_LABELS
from simulations.scenes.bayer_demosaic import SCENE as BAYER
from simulations.scenes.jpeg import PATTERNS, close_up
from simulations.scenes.jpeg import SCENE as JPEG
from simulations.scenes.light_and_cloth import SCENE as CLOTH
from simulations.scenes.spectrum_to_rgb import CHART
from simulations.scenes.spectrum_to_rgb import SCENE as SENSOR

DAY: dict[str, object] = {"light": "daylight", "temperature": 6500}
OTHERS = [light for light in LIGHTS if light != "daylight"]


def test_metameric_cloths_match_in_daylight_alone() -> None:
    assert outputs_of(CLOTH, **DAY)["seen"].apart.max() < 0.1
    for light in OTHERS:
        seen = outputs_of(CLOTH, light=light)["seen"]
        assert seen.apart.min() > 1, light
        np.testing.assert_allclose(seen.by_day[0], seen.by_day[1], atol=1e-9)


@pytest.mark.parametrize("light", LIGHTS)
@pytest.mark.parametrize("sensor", ["camera", "eye"])
def test_grey_stays_grey_and_a_matrix_for_the_light_has_less_error(light: str, sensor: str) -> None:
    errors = []
    for matrix in ("own", "daylight"):
        colours = outputs_of(SENSOR, light=light, sensor=sensor, matrix=matrix)["colours"]
        white = colours.srgb[0, -1]
        assert np.ptp(white) < 0.05 * white.mean()
        errors.append(colours.error[0, 1:].mean())
    assert errors[0] < 0.7 * errors[1] or light == "daylight"


def test_eyes_curves_make_no_error_in_daylight_and_a_cameras_do() -> None:
    assert outputs_of(SENSOR, **DAY, sensor="eye")["colours"].error[0].max() < 0.05
    day = outputs_of(SENSOR, **DAY)["colours"]
    np.testing.assert_allclose(day.meant[0], day.meant[1], atol=1e-9)
    assert np.abs(day.srgb[0] - day.srgb[1]).max() > 0.02


def test_patches_show_each_step_of_a_surface_above_its_metamer() -> None:
    raster = pixels_of(frame_of(SENSOR, light="fluorescent", twin=True), 1)
    found = outputs_of(SENSOR, light="fluorescent")["colours"]
    for row, step in enumerate((found.raw, found.balanced, found.srgb, found.meant)):
        for half, column in ((0, 1), (1, 1), (0, 8), (1, 8)):
            y = (CHART.top(row) + CHART.row * (0.25 + 0.5 * half)) / UNIT
            x = (LEFT + (column + 0.5) * CELL) / UNIT
            expected = 255 * np.clip(encode_srgb(step[half, column]), 0, 1)
            np.testing.assert_allclose(raster[int(y), int(x), :3], expected, atol=0.51)


def test_eyes_curves_reproduce_the_photograph_in_daylight() -> None:
    pixels = pixels_of(frame_of(SENSOR, light="daylight", temperature=6500, sensor="eye"))
    made, meant = pixels[160:, :200, :3].astype(int), pixels[160:, 200:, :3]
    assert np.abs(made - meant).max() <= 3


CACHE = StageCache(depth=8)


def mosaiced(**values: object) -> Frame:
    return BAYER.render(BAYER.check(values), "", CACHE)


@pytest.mark.parametrize("picture", SUBJECTS)
def test_mosaic_cell_shows_the_light_of_its_colour(picture: str) -> None:
    """Each cell, two samples wide, shows one colour; red is first."""
    shown = pixels_of(mosaiced(picture=picture, split=0))
    cells = shown[::2, ::2, :3]
    np.testing.assert_array_equal(cells.repeat(2, axis=0).repeat(2, axis=1), shown[..., :3])
    assert np.count_nonzero(cells, axis=2).max() == 1
    assert not cells[::2, ::2, 1:].any()
    # Half a code, where the curve is steepest for light: near white.
    light = mosaic(SUBJECTS[picture].draw(WHOLE))
    np.testing.assert_allclose(decode_srgb(cells.max(axis=2) / 255), light, atol=0.5 / 255 * 2.3)


@pytest.mark.parametrize("split", [0, 0.5, 1])
@pytest.mark.parametrize(("column", "row"), [(0, 0), (104, 56), (220, 176)])
def test_loupe_shows_the_chosen_part(split: float, column: int, row: int) -> None:
    shown = mosaiced(split=split, column=column, row=row)
    whole = pixels_of(shown) if split == 1 else pixels_of(shown)[::2, ::2]
    part = whole[row : row + 16, column : column + 20]
    np.testing.assert_array_equal(part, pixels_of(shown, 1), strict=True)


def test_readouts_of_each_method_equal_the_ladders_metrics() -> None:
    ladder = load_ladder(BAYER.accuracy.ladder)
    work = ladder.prepare()
    truth = ladder.reference(work)
    for metric in ladder.metrics:
        picture = metric.id.removeprefix("psnr-") if metric.id != "light" else "balloon"
        name = "light" if metric.id == "light" else "psnr"
        for tier in ladder.tiers:
            shown = float(texts_of(mosaiced(method=tier.id, picture=picture))[name])
            assert shown == pytest.approx(metric.measure(tier.run(work), truth, work), abs=0.051)
    assert list(METHOD_LABELS) == [tier.id for tier in ladder.tiers]
    assert BAYER.check({}).method == ladder.default_tier


@pytest.mark.parametrize("method", METHODS)
def test_errors_by_colour_agree_with_psnr_and_pixels(method: str) -> None:
    """PSNR is 10 log₁₀ of 255² over the mean of the three squared errors. The error picture shows
    four times the error; for the soft picture by bilinear, none is cut off."""
    given = {"method": method, "picture": "soft" if method == "bilinear" else "balloon"}
    (estimate,) = BAYER.estimates(BAYER.check(given), "", CACHE)
    shown, parts = mosaiced(**given), [float(part) for part in estimate.text.split(", ")]
    psnr = 10 * np.log10(255**2 / np.mean(np.square(parts)))
    assert psnr == pytest.approx(float(texts_of(shown)["psnr"]), abs=0.15)
    if method == "bilinear":
        errors = pixels_of(shown, 2)[8:-8, 8:-8, :3] / 4.0
        assert np.sqrt(np.mean(errors**2, axis=(0, 1))) == pytest.approx(parts, abs=0.1)


frame, outputs = partial(frame_of, JPEG), partial(outputs_of, JPEG)


def pillow(picture: Floats, quality: int, subsampling: str) -> tuple[Floats, int]:
    """Decoded picture in [0, 1], and bits of entropy-coded data: the file without its headers."""
    file = io.BytesIO()
    Image.fromarray(np.rint(255 * picture).astype(np.uint8)).save(
        file, "JPEG", quality=quality, subsampling=subsampling, optimize=True
    )
    data = file.getvalue()
    scan = data.index(b"\xff\xda")
    header = 2 + int.from_bytes(data[scan + 2 : scan + 4])
    coded = data[scan + header : -2].replace(b"\xff\x00", b"\xff")
    return np.asarray(Image.open(file)) / 255, 8 * len(coded)


@pytest.mark.parametrize(
    ("quality", "subsampling", "most"),
    [
        (10, "4:4:4", 0.6),
        (50, "4:4:4", 0.6),
        (90, "4:4:4", 0.6),
        (75, "4:2:0", 0.9),
        (10, "4:2:0", None),
        (90, "4:2:2", None),
    ],
)
def test_decoded_picture_and_size_agree_with_pillow(
    quality: int, subsampling: str, most: float | None
) -> None:
    """Huffman's code spends whole bits on each symbol: a little more than its entropy. With the
    triangle, libjpeg's own, coarse differences are rounded to whole codes."""
    done = outputs(picture="balloon", quality=quality, subsampling=subsampling)
    theirs, bits = pillow(done["original"], quality, subsampling)
    assert 0.96 * bits < done["size"].bits < 1.005 * bits
    if most is not None:
        assert np.abs(255 * (done["decoded"] - theirs)).mean() < most


@pytest.mark.parametrize("subsampling", ["4:4:4", "4:2:0"])
def test_readouts_agree_with_the_coded_picture(subsampling: str) -> None:
    given = {"quality": 40, "subsampling": subsampling, "first": 20}
    done, shown = outputs(**given), texts_at(JPEG, **given)
    error = np.rint(255 * done["decoded"]) - 255 * done["original"]
    rate = done["size"].bits / (240 * 192)
    kept = sum(np.count_nonzero(codes) for codes in done["used"].planes) / (240 * 192 * 3)
    assert shown["psnr"] == f"{10 * np.log10(255**2 / np.mean(error**2)):.1f}"
    kilobytes = f"{done['size'].bits / 8000:.1f}"
    assert (shown["rate"], shown["kilobytes"]) == (f"{rate:.2f}", kilobytes)
    assert shown["kept"] == f"{100 * kept:.1f}"
    assert shown["block_kept"] == str(np.count_nonzero(done["used"].luma[10, 19]))


@pytest.mark.parametrize("row", [0, 23])
@pytest.mark.parametrize("column", [0, 29])
def test_close_up_contains_its_block_at_the_border(row: int, column: int) -> None:
    picture = np.arange(240 * 192 * 4, dtype=np.uint8).reshape(192, 240, 4)
    window, (top, left) = close_up(picture, row, column)
    assert window.shape == (24, 30, 4)
    block = picture[8 * row : 8 * row + 8, 8 * column : 8 * column + 8]
    assert np.array_equal(window[top : top + 8, left : left + 8], block)


def test_readers_even_picture_is_unchanged_and_costs_no_bits() -> None:
    own = Photograph(1, np.full((192, 240, 3), 128, np.uint8))
    shown = JPEG.render(JPEG.check({"quality": 100}), "separable", StageCache(), own)
    assert (texts_of(shown)["psnr"], texts_of(shown)["kilobytes"]) == ("∞", "0.0")
    assert shown.description.startswith("Your own picture at JPEG quality 100")


def last_estimate(tier: str, **given: object) -> tuple[float, int, int]:
    """Error in codes, count of coefficients that round otherwise, and of blocks."""
    last = estimates_of(JPEG, tier, **given)[-1]
    found = re.search(r"in (\d+) of (\d+) blocks \((\d+) round otherwise\)", last.label)
    assert found is not None
    compared, blocks, changed = map(int, found.groups())
    assert compared == blocks
    return number_of(last.text), changed, blocks


@pytest.mark.parametrize(
    ("tier", "subsampling"),
    [*zip(TRANSFORMS, ["4:2:0"] * 6, strict=True), ("fixed-point", "4:2:2")],
)
def test_estimated_error_is_the_error_against_scipys_transform(tier: str, subsampling: str) -> None:
    done = outputs(tier, quality=95, subsampling=subsampling)
    coded, worst, changed = done["coded"], 0.0, 0
    factor = SUBSAMPLING[subsampling]
    planes = [done["planes"][0], *(coarsen(p, factor) for p in done["planes"][1:])]
    for plane, steps, codes in zip(planes, (0, 1, 1), coded.planes, strict=True):
        blocks = to_blocks(plane)
        truth = dctn(blocks, type=2, norm="ortho", axes=(-2, -1))
        worst = max(worst, float(np.abs(TRANSFORMS[tier](blocks) - truth).max()))
        changed += int(np.count_nonzero(round_outwards(truth / tables(95)[steps]) != codes))
    error, otherwise, count = last_estimate(tier, quality=95, subsampling=subsampling)
    # Float64 against float64: both are wrong in the thirteenth digit.
    assert error == pytest.approx(worst, rel=0.06, abs=3e-12)
    assert otherwise == changed
    assert count == sum(codes.size for codes in coded.planes) // 64


def test_pattern_is_the_block_of_its_coefficient_alone() -> None:
    for (u, v), pattern in zip(np.ndindex(8, 8), PATTERNS.reshape(64, 8, 8), strict=True):
        alone = np.zeros((8, 8))
        alone[u, v] = 1.0
        block = idctn(alone, type=2, norm="ortho")
        np.testing.assert_allclose(pattern, block / np.abs(block).max(), atol=1e-12)


def test_dividing_line_separates_the_pictures_at_its_place() -> None:
    before, half, after = (pixels_of(frame(original=share)) for share in (1, 0.5, 0))
    np.testing.assert_array_equal(half[:, :120], before[:, :120])
    np.testing.assert_array_equal(half[:, 120:], after[:, 120:])
