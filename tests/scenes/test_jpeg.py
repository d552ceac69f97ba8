"""The JPEG figure against Pillow's JPEG files, and its parts against what they promise."""

import io
import re
from functools import partial

import numpy as np
import pytest
from PIL import Image
from scipy.fft import dctn, idctn
from support.frames import estimates_of, frame_of, number_of, pixels_of, texts_at

from simulations.engine.photograph import Photograph
from simulations.engine.stages import Outputs, StageCache
from simulations.models.arrays import Floats
from simulations.models.compression.blocks import round_outwards, to_blocks
from simulations.models.compression.chroma_subsampling import SUBSAMPLING, coarsen
from simulations.models.compression.cosine_transforms import TRANSFORMS
from simulations.models.compression.jpeg import compress, tables
from simulations.scenes.jpeg.patterns import PATTERNS, pattern_table
from simulations.scenes.jpeg.scene import SCENE, cut
from simulations.scenes.jpeg.settings import BLOCK_COLUMNS, BLOCK_ROWS

PIXELS = 240 * 192
PILLOW_SUBSAMPLING = {"4:4:4": 0, "4:2:2": 1, "4:2:0": 2}


frame = partial(frame_of, SCENE)


texts = partial(texts_at, SCENE)


def outputs(tier: str = "separable", **given: object) -> Outputs:
    return SCENE.run(SCENE.check(given), tier, StageCache()).outputs


def pillow(picture: Floats, quality: int, subsampling: str) -> tuple[Floats, int]:
    """Decoded picture in [0, 1], and bits of entropy-coded data: the file without its headers."""
    file = io.BytesIO()
    Image.fromarray(np.rint(255 * picture).astype(np.uint8)).save(
        file,
        "JPEG",
        quality=quality,
        subsampling=PILLOW_SUBSAMPLING[subsampling],
        optimize=True,
    )
    data = file.getvalue()
    scan = data.index(b"\xff\xda")
    header = 2 + int.from_bytes(data[scan + 2 : scan + 4])
    coded = data[scan + header : -2].replace(b"\xff\x00", b"\xff")
    return np.asarray(Image.open(file)) / 255, 8 * len(coded)


@pytest.mark.parametrize("quality", [10, 50, 90])
@pytest.mark.parametrize("subsampling", PILLOW_SUBSAMPLING)
def test_the_estimated_size_is_that_of_pillows_file(quality: int, subsampling: str) -> None:
    """Huffman's code spends whole bits on each symbol: a little more than its entropy."""
    done = outputs(quality=quality, subsampling=subsampling)
    _, bits = pillow(done["original"], quality, subsampling)
    assert 0.96 * bits < done["size"].bits < 1.005 * bits


@pytest.mark.parametrize(
    ("quality", "subsampling", "most"),
    [(10, "4:4:4", 0.6), (50, "4:4:4", 0.6), (90, "4:4:4", 0.6), (75, "4:2:0", 0.9)],
)
def test_the_decoded_picture_is_pillows_up_to_rounding(
    quality: int, subsampling: str, most: float
) -> None:
    """With the triangle, libjpeg's own; its coarse differences are rounded to whole codes."""
    done = outputs(quality=quality, subsampling=subsampling)
    theirs, _ = pillow(done["original"], quality, subsampling)
    assert np.abs(255 * (done["decoded"] - theirs)).mean() < most


@pytest.mark.parametrize("subsampling", PILLOW_SUBSAMPLING)
def test_the_stages_are_the_models_compression(subsampling: str) -> None:
    done = outputs(quality=40, subsampling=subsampling)
    picture, _ = compress(done["original"], 40, subsampling)
    assert np.array_equal(done["decoded"], picture)


def test_size_and_psnr_rise_with_quality() -> None:
    shown = [texts(quality=q, subsampling="4:4:4") for q in (1, 10, 50, 100)]
    for name in ("psnr", "rate", "kept"):
        numbers = [float(text[name]) for text in shown]
        assert numbers == sorted(numbers)
        assert numbers[0] < numbers[-1]


def test_subsampled_colour_costs_less_and_loses_colour_even_at_quality_100() -> None:
    full, coarse = (texts(quality=100, subsampling=s) for s in ("4:4:4", "4:2:0"))
    assert float(coarse["rate"]) < 0.8 * float(full["rate"])
    assert float(coarse["psnr"]) < float(full["psnr"]) - 10


@pytest.mark.parametrize("row", [0, BLOCK_ROWS - 1])
@pytest.mark.parametrize("column", [0, BLOCK_COLUMNS - 1])
def test_the_close_up_holds_its_block_at_every_border(row: int, column: int) -> None:
    picture = np.arange(PIXELS * 4, dtype=np.uint32).reshape(192, 240, 4)
    window, (top, left) = cut(picture, row, column)
    assert window.shape == (24, 30, 4)
    block = picture[8 * row : 8 * row + 8, 8 * column : 8 * column + 8]
    assert np.array_equal(window[top : top + 8, left : left + 8], block)


def test_where_colour_was_kept_nothing_is_filled_in() -> None:
    cache = StageCache()
    first = frame("", cache, subsampling="4:4:4")
    after = frame("", cache, subsampling="4:4:4", upsampling="guided")
    assert {stage.status for stage in after.stages} == {"reused", "skipped"}
    np.testing.assert_array_equal(first.panels[0].raster, after.panels[0].raster)


def test_with_the_mean_alone_every_block_of_luma_is_even() -> None:
    done = outputs(first=1, subsampling="4:4:4")
    luma, *_ = done["restored"]
    assert np.ptp(to_blocks(luma), axis=(-2, -1)).max() < 1e-9


def own(level: int) -> Photograph:
    """A picture of one grey."""
    return Photograph(1, np.full((192, 240, 3), level, np.uint8))


def test_a_flat_picture_of_the_reader_s_comes_back_as_it_was_and_costs_nothing() -> None:
    shown = SCENE.render(SCENE.check({"quality": 100}), "separable", StageCache(), own(128))
    told = {item.name: item.text for item in shown.readouts}
    assert (told["psnr"], told["ratio"]) == ("∞", "∞")
    assert shown.description.startswith("Your own picture at JPEG quality 100")
    assert "balloon" not in shown.description


def judged(tier: str, **given: object) -> tuple[float, int, int]:
    """The last estimate: error in codes, and how many coefficients it has rounded otherwise."""
    last = estimates_of(SCENE, tier, **given)[-1]
    found = re.search(r"in (\d+) of (\d+) blocks \((\d+) round otherwise\)", last.label)
    assert found is not None
    judged_blocks, blocks, changed = map(int, found.groups())
    assert judged_blocks == blocks
    return number_of(last.text), changed, blocks


@pytest.mark.parametrize(
    ("tier", "subsampling"),
    [*zip(TRANSFORMS, ["4:2:0"] * 6, strict=True), ("fixed-point", "4:2:2")],
)
def test_the_error_told_is_that_against_scipys_transform(tier: str, subsampling: str) -> None:
    given: dict[str, object] = {"quality": 95, "subsampling": subsampling}
    done = outputs(tier, **given)
    coded, worst, changed = done["coded"], 0.0, 0
    factor = SUBSAMPLING[subsampling]
    planes = [done["planes"][0], *(coarsen(p, factor) for p in done["planes"][1:])]
    for plane, steps, codes in zip(planes, (0, 1, 1), coded.planes, strict=True):
        blocks = to_blocks(plane)
        truth = dctn(blocks, type=2, norm="ortho", axes=(-2, -1))
        worst = max(worst, float(np.abs(TRANSFORMS[tier](blocks) - truth).max()))
        changed += int(np.count_nonzero(round_outwards(truth / tables(95)[steps]) != codes))
    error, otherwise, count = judged(tier, **given)
    # Float64 against float64: both are wrong in the thirteenth digit.
    assert error == pytest.approx(worst, rel=0.06, abs=3e-12)
    assert otherwise == changed
    assert count == sum(codes.size for codes in coded.planes) // 64


def test_integers_change_thousands_of_codes_at_the_highest_quality_and_hardly_any_at_low() -> None:
    """The chapter's comparison: steps of 1 feel what steps of 16 do not."""
    _, fine, _ = judged("fixed-point", quality=100)
    _, coarse, _ = judged("fixed-point", quality=30)
    assert fine > 1000
    assert coarse < fine / 50


def test_the_block_is_the_sum_of_the_patterns_shown() -> None:
    """Each pattern of the table is, but for its scale, the block of that one coefficient."""
    for (u, v), pattern in zip(np.ndindex(8, 8), PATTERNS.reshape(64, 8, 8), strict=True):
        alone = np.zeros((8, 8))
        alone[u, v] = 1.0
        block = idctn(alone, type=2, norm="ortho")
        np.testing.assert_allclose(pattern, block / np.abs(block).max(), atol=1e-12)


def test_a_negative_code_turns_its_pattern_dark_for_light() -> None:
    codes = np.zeros((8, 8), int)
    codes[0, 1] = 3
    up, down = (pattern_table(sign * codes, 64)[..., 0].astype(int) for sign in (1, -1))
    cell = (slice(1, 1 + 8 * 4), slice(42, 42 + 8 * 5))
    assert up[cell].max() == 255
    np.testing.assert_allclose(up[cell] + down[cell], 255, atol=1)


def test_the_line_divides_the_original_from_the_decoded() -> None:
    before, half, after = (pixels_of(frame(original=share)) for share in (1, 0.5, 0))
    np.testing.assert_array_equal(half[:, :120], before[:, :120])
    np.testing.assert_array_equal(half[:, 120:], after[:, 120:])
