"""A picture compressed by JPEG, one of its blocks enlarged, and the numbers stored for it."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.compression.blocks import BLOCK, quantise_plane
from simulations.models.compression.chroma_subsampling import subsampling_factor
from simulations.models.compression.cosine_transforms import TRANSFORMS
from simulations.models.compression.entropy import Size
from simulations.models.compression.jpeg import Coded
from simulations.models.compression.zigzag import first_in_order
from simulations.pictures.balloon import HEIGHT as ROWS_PX
from simulations.pictures.balloon import WIDTH as COLUMNS_PX
from simulations.scenes._wipe.wipe import over_wipe
from simulations.scenes.jpeg import drawing
from simulations.scenes.jpeg.error import estimates
from simulations.scenes.jpeg.handles import HANDLES
from simulations.scenes.jpeg.patterns import pattern_table
from simulations.scenes.jpeg.settings import ALL, Settings
from simulations.scenes.jpeg.stages import PHOTOGRAPH_PX, STAGES

PIXELS = ROWS_PX * COLUMNS_PX
NAMES = ("original", "JPEG")


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The decoded picture, a block of it, and the numbers stored for it."""
    coded: Coded = outputs["coded"]
    codes = coded.luma[settings.row - 1, settings.column - 1]
    size: Size = outputs["size"]
    psnr: float = outputs["psnr"]
    block_kept = int(np.count_nonzero(first_in_order(codes, settings.first)))
    words = describe_own if outputs["photograph"] else describe
    return Frame(
        panels=_panels(settings, outputs["wipe"], codes),
        readouts=_readouts(psnr, size, block_kept),
        description=words(settings, psnr, size.bits / PIXELS, block_kept),
    )


def _panels(settings: Settings, shown: Raster, codes: NDArray[np.integer]) -> tuple[Panel, ...]:
    """The whole picture, the surroundings of a block, and the ``codes`` (8, 8) of that block."""
    row, column = settings.row - 1, settings.column - 1
    close, place = cut(shown, row, column)
    width, height = drawing.WIDTH, drawing.HEIGHT
    wipe = over_wipe(settings.original, width, height, NAMES)
    frame, grid = drawing.block_in_picture(row, column), drawing.block_grid(*place)
    patterns = pattern_table(codes, settings.first)
    table = drawing.code_table(codes, settings.first)
    return (
        Panel(
            "picture", "The picture before and after", width, height, shown, wipe + frame, lead=True
        ),
        Panel(
            "codes",
            "The patterns the block is made of",
            width,
            height,
            patterns,
            table,
            pixelated=True,
        ),
        Panel("block", "The framed block, enlarged", width, height, close, grid, pixelated=True),
    )


def _readouts(psnr: float, size: Size, block_kept: int) -> tuple[Readout, ...]:
    kept_percent = 100 * size.nonzero / (3 * PIXELS)
    # An ideal coder needs no bits for one flat tone.
    ratio = f"{format_number(24 * PIXELS / size.bits, 1)} : 1" if size.bits else "∞"
    return (
        readout("psnr", "Fidelity (PSNR)", psnr, "dB", digits=1, role="error"),
        readout("kept", "Coefficients kept", kept_percent, "%", digits=1),
        readout("rate", "Size", size.bits / PIXELS, "bits a pixel", role="image"),
        Readout("ratio", "Compression ratio", ratio),
        readout(
            "block_kept",
            "Coefficients kept in the block",
            block_kept,
            "of 64",
            digits=0,
            role="image",
        ),
    )


def cut[T: np.generic](
    picture: NDArray[T], row: int, column: int
) -> tuple[NDArray[T], tuple[int, int]]:
    """Some 30 × 24 pixels around a block, and where in them it starts (row, column)."""
    top = min(max(BLOCK * row - BLOCK, 0), ROWS_PX - drawing.CLOSE_ROWS)
    left = min(max(BLOCK * column - 11, 0), COLUMNS_PX - drawing.CLOSE_COLUMNS)
    window = picture[top : top + drawing.CLOSE_ROWS, left : left + drawing.CLOSE_COLUMNS]
    return np.ascontiguousarray(window), (BLOCK * row - top, BLOCK * column - left)


def describe(settings: Settings, psnr: float, rate: float, block_kept: int) -> str:
    """The book's picture in one sentence."""
    subsampled = settings.subsampling != "4:4:4"
    if psnr >= 33:
        visible = "few traces show"
    elif settings.first == ALL and settings.quality >= 75 and subsampled:
        visible = "colours run over the edges"
    else:
        visible = "edges are surrounded by ripples" if psnr >= 27 else "blocks and fringes show"
    return (
        f"A striped balloon over tulips {_compressed(settings, psnr, rate)}, and {visible}; "
        f"{_kept(settings, block_kept)}"
    )


def describe_own(settings: Settings, psnr: float, rate: float, block_kept: int) -> str:
    """The reader's picture in one sentence."""
    return f"Your own picture {_compressed(settings, psnr, rate)}; {_kept(settings, block_kept)}"


def _compressed(settings: Settings, psnr: float, rate: float) -> str:
    rows, columns = subsampling_factor(settings.subsampling)
    colour = (
        f"one colour value for {rows * columns} pixels" if rows * columns > 1 else "full colour"
    )
    used = (
        ""
        if settings.first == ALL
        else f", of each block only the first {settings.first} coefficients in the order of "
        "fineness"
    )
    return (
        f"at JPEG quality {settings.quality} with {colour}{used}: "
        f"{format_number(rate)} bits a pixel, {format_number(psnr, 1)} dB"
    )


def _kept(settings: Settings, block_kept: int) -> str:
    share = format_number(100 * settings.original, 0)
    return (
        f"{block_kept} of the 64 luma coefficients of the framed block are kept. The left "
        f"{share} % of the picture are the original."
    )


def estimate(_settings: Settings, outputs: Outputs, tier: str) -> Iterator[Readout]:
    """Errors of this picture's coefficients against the standard's sums."""
    return estimates(outputs["planes"], outputs["coded"], TRANSFORMS[tier])


SCENE = Scene(
    id="jpeg",
    title="JPEG Compression",
    settings=Settings,
    draw=draw,
    formula=quantise_plane,
    stages=STAGES,
    handles=HANDLES,
    photograph=PHOTOGRAPH_PX,
    tiers=tuple(TRANSFORMS),
    default_tier="separable",
    ladder="block-dct",
    estimate=estimate,
)
