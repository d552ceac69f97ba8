"""The JPEG figure against Pillow's files and SciPy's transform."""

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

from simulations.engine.photograph import Photograph
from simulations.engine.stages import StageCache
from simulations.models.arrays import Floats
from simulations.models.compression.blocks import round_outwards, to_blocks
from simulations.models.compression.chroma_subsampling import SUBSAMPLING, coarsen
from simulations.models.compression.cosine_transforms import TRANSFORMS
from simulations.models.compression.jpeg import tables
from simulations.scenes.jpeg import PATTERNS, SCENE, close_up, pattern_table

frame, outputs = partial(frame_of, SCENE), partial(outputs_of, SCENE)


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
def test_picture_or_size_differs_from_pillows(
    quality: int, subsampling: str, most: float | None
) -> None:
    """Huffman's code spends whole bits on each symbol: a little more than its entropy. With the
    triangle, libjpeg's own, coarse differences are rounded to whole codes."""
    done = outputs(quality=quality, subsampling=subsampling)
    theirs, bits = pillow(done["original"], quality, subsampling)
    assert 0.96 * bits < done["size"].bits < 1.005 * bits
    if most is not None:
        assert np.abs(255 * (done["decoded"] - theirs)).mean() < most


@pytest.mark.parametrize("subsampling", ["4:4:4", "4:2:0"])
def test_a_readout_differs_from_the_coded_picture(subsampling: str) -> None:
    given = {"quality": 40, "subsampling": subsampling, "first": 20}
    done, shown = outputs(**given), texts_at(SCENE, **given)
    error = np.rint(255 * done["decoded"]) - 255 * done["original"]
    rate = done["size"].bits / (240 * 192)
    kept = sum(np.count_nonzero(codes) for codes in done["used"].planes) / (240 * 192 * 3)
    assert shown["psnr"] == f"{10 * np.log10(255**2 / np.mean(error**2)):.1f}"
    assert (shown["rate"], shown["ratio"]) == (f"{rate:.2f}", f"{24 / rate:.1f} : 1")
    assert shown["kept"] == f"{100 * kept:.1f}"
    assert shown["block_kept"] == str(np.count_nonzero(done["used"].luma[7, 24]))


@pytest.mark.parametrize("row", [0, 23])
@pytest.mark.parametrize("column", [0, 29])
def test_the_close_up_misses_a_block_at_the_border(row: int, column: int) -> None:
    picture = np.arange(240 * 192 * 4, dtype=np.uint8).reshape(192, 240, 4)
    window, (top, left) = close_up(picture, row, column)
    assert window.shape == (24, 30, 4)
    block = picture[8 * row : 8 * row + 8, 8 * column : 8 * column + 8]
    assert np.array_equal(window[top : top + 8, left : left + 8], block)


def test_blocks_of_the_mean_alone_are_uneven() -> None:
    luma, *_ = outputs(first=1, subsampling="4:4:4")["restored"]
    assert np.ptp(to_blocks(luma), axis=(-2, -1)).max() < 1e-9


def test_an_even_picture_of_the_readers_changes_or_costs_bits() -> None:
    own = Photograph(1, np.full((192, 240, 3), 128, np.uint8))
    shown = SCENE.render(SCENE.check({"quality": 100}), "separable", StageCache(), own)
    assert (texts_of(shown)["psnr"], texts_of(shown)["ratio"]) == ("∞", "∞")
    assert shown.description.startswith("Your own picture at JPEG quality 100")


def last_estimate(tier: str, **given: object) -> tuple[float, int, int]:
    """Error in codes, count of coefficients that round otherwise, and of blocks."""
    last = estimates_of(SCENE, tier, **given)[-1]
    found = re.search(r"in (\d+) of (\d+) blocks \((\d+) round otherwise\)", last.label)
    assert found is not None
    compared, blocks, changed = map(int, found.groups())
    assert compared == blocks
    return number_of(last.text), changed, blocks


@pytest.mark.parametrize(
    ("tier", "subsampling"),
    [*zip(TRANSFORMS, ["4:2:0"] * 6, strict=True), ("fixed-point", "4:2:2")],
)
def test_the_error_differs_from_that_against_scipys_transform(tier: str, subsampling: str) -> None:
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


def test_integers_change_as_many_codes_at_low_quality() -> None:
    """The chapter's comparison: of steps of 1 and of 16."""
    (_, fine, _), (_, coarse, _) = (last_estimate("fixed-point", quality=q) for q in (100, 30))
    assert fine > 1000
    assert coarse < fine / 50


def test_a_pattern_differs_from_the_block_of_its_coefficient() -> None:
    for (u, v), pattern in zip(np.ndindex(8, 8), PATTERNS.reshape(64, 8, 8), strict=True):
        alone = np.zeros((8, 8))
        alone[u, v] = 1.0
        block = idctn(alone, type=2, norm="ortho")
        np.testing.assert_allclose(pattern, block / np.abs(block).max(), atol=1e-12)


def test_a_negative_code_leaves_its_pattern_as_it_is() -> None:
    codes = np.zeros((8, 8), int)
    codes[0, 1] = 3
    up, down = (pattern_table(sign * codes, 64)[..., 0].astype(int) for sign in (1, -1))
    cell = (slice(1, 1 + 8 * 4), slice(42, 42 + 8 * 5))
    assert up[cell].max() == 255
    np.testing.assert_allclose(up[cell] + down[cell], 255, atol=1)


def test_the_line_divides_the_pictures_elsewhere() -> None:
    before, half, after = (pixels_of(frame(original=share)) for share in (1, 0.5, 0))
    np.testing.assert_array_equal(half[:, :120], before[:, :120])
    np.testing.assert_array_equal(half[:, 120:], after[:, 120:])
