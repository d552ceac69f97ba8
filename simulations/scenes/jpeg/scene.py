"""A picture compressed by JPEG, one of its blocks enlarged, and the numbers kept of that block."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from simulations.engine.controls import Choice, Slider, Toggle, Values
from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.engine.stages import Run, StageCache, run
from simulations.models.compression.blocks import BLOCK
from simulations.models.compression.chroma_subsampling import SUBSAMPLING
from simulations.models.compression.cosine_transforms import TRANSFORMS
from simulations.models.compression.entropy import Size
from simulations.models.compression.jpeg import Coded
from simulations.pictures.balloon import HEIGHT as ROWS_PX
from simulations.pictures.balloon import WIDTH as COLUMNS_PX
from simulations.scenes.jpeg import drawing
from simulations.scenes.jpeg.error import judge
from simulations.scenes.jpeg.stages import STAGES

DEFAULT_TIER = "separable"
BLOCK_COLUMNS, BLOCK_ROWS = COLUMNS_PX // BLOCK, ROWS_PX // BLOCK

CONTROLS = (
    Slider(name="quality", label="Quality", default=30, minimum=1, maximum=100, step=1),
    Choice(
        name="subsampling",
        label="Colour",
        default="4:2:0",
        options={
            "4:2:0": "4:2:0, once in 2 × 2 pixels",
            "4:2:2": "4:2:2, in every second column",
            "4:4:4": "4:4:4, in every pixel",
        },
    ),
    Choice(
        name="upsampling",
        label="Colour filled in by",
        default="triangle",
        options={
            "repeated": "Repetition",
            "triangle": "Triangle",
            "parabola": "Parabola",
            "cubic": "Cubic",
            "guided": "Following luma",
        },
    ),
    Slider(
        name="column", label="Block, column", default=25, minimum=1, maximum=BLOCK_COLUMNS, step=1
    ),
    Slider(name="row", label="Block, row", default=8, minimum=1, maximum=BLOCK_ROWS, step=1),
    Toggle(name="original", label="Show the original"),
)


def run_tier(values: Values, tier: str, cache: StageCache) -> Run:
    """All stages; the tier is the way to the cosine transform."""
    return run(STAGES, values, cache, {"tier": tier or DEFAULT_TIER})


def render(values: Values, tier: str, cache: StageCache) -> Frame:
    """The picture as JPEG gives it back, a block of it, and the numbers kept of that block."""
    done = run_tier(values, tier, cache)
    coded: Coded = done.outputs["coded"]
    kept: Size = done.outputs["size"]
    row, column = int(values.number("row")) - 1, int(values.number("column")) - 1
    codes = coded.luma[row, column]
    shown = to_rgba8(done.outputs["original" if values.toggle("original") else "decoded"])
    close, place = cut(shown, row, column)
    name = "The original" if values.toggle("original") else "As decoded"
    width, height = drawing.WIDTH, drawing.HEIGHT
    panels = (
        Panel(
            "picture",
            name,
            width,
            height,
            shown,
            drawing.block_in_picture(row, column, width / COLUMNS_PX),
        ),
        Panel(
            "block",
            "Around the block",
            width,
            height,
            close,
            drawing.block_grid(*place),
            pixelated=True,
        ),
        Panel(
            "codes", "The block's luma, as kept", width, height, overlay=drawing.code_table(codes)
        ),
    )
    pixels = ROWS_PX * COLUMNS_PX
    block_kept = int(np.count_nonzero(codes))
    readouts = (
        readout("psnr", "PSNR", done.outputs["psnr"], "dB", digits=1, role="error"),
        readout(
            "kept",
            "Coefficients kept, of 3 a pixel",
            100 * kept.nonzero / (3 * pixels),
            "%",
            digits=1,
        ),
        readout("rate", "Size", kept.bits / pixels, "bits a pixel", role="image"),
        Readout(
            "ratio",
            "24 bits a pixel against it",
            f"{format_number(24 * pixels / kept.bits, 1)} : 1",
        ),
        readout("block_kept", "Kept in the block", block_kept, "of 64", digits=0, role="image"),
    )
    return Frame(
        panels,
        readouts,
        describe(values, done.outputs["psnr"], kept.bits / pixels, block_kept),
        done.reports,
    )


def error(values: Values, tier: str, cache: StageCache) -> Iterator[Readout]:
    """How far the coefficients of this picture are from the standard's sums."""
    outputs = run_tier(values, tier, cache).outputs
    yield from judge(outputs["planes"], outputs["coded"], tier or DEFAULT_TIER)


def cut(
    picture: NDArray[np.uint8], row: int, column: int
) -> tuple[NDArray[np.uint8], tuple[int, int]]:
    """Some 30 × 24 pixels around a block, and where in them it starts (row, column)."""
    top = min(max(BLOCK * row - BLOCK, 0), ROWS_PX - drawing.CLOSE_ROWS)
    left = min(max(BLOCK * column - 11, 0), COLUMNS_PX - drawing.CLOSE_COLUMNS)
    window = picture[top : top + drawing.CLOSE_ROWS, left : left + drawing.CLOSE_COLUMNS]
    return np.ascontiguousarray(window), (BLOCK * row - top, BLOCK * column - left)


def describe(values: Values, psnr: float, rate: float, block_kept: int) -> str:
    """The picture in one sentence."""
    if values.toggle("original"):
        return "The picture of a striped balloon over rows of tulips before it is compressed."
    rows, columns = SUBSAMPLING[values.choice("subsampling")]
    colour = (
        f"one colour value for {rows * columns} pixels" if rows * columns > 1 else "full colour"
    )
    quality = values.number("quality")
    if psnr >= 33:
        visible = "few traces show"
    elif quality >= 75 and rows * columns > 1:
        visible = "colours run over the edges"
    else:
        visible = "edges are surrounded by ripples" if psnr >= 27 else "blocks and fringes show"
    return (
        f"A striped balloon over tulips at JPEG quality {quality:.0f} with "
        f"{colour}: {rate:.2f} bits a pixel, {psnr:.1f} dB, and {visible}; {block_kept} of the "
        "chosen block's 64 luma coefficients are kept."
    )


SCENE = Scene(
    id="jpeg",
    title="JPEG Compression",
    controls=CONTROLS,
    render=render,
    tiers=tuple(TRANSFORMS),
    default_tier=DEFAULT_TIER,
    draft_tier=DEFAULT_TIER,
    ladder="block-dct",
    error=error,
)
