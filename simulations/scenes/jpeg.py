"""A picture compressed by JPEG, one of its blocks enlarged, and the numbers stored for it."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from simulations.engine.accuracy import Accuracy, tiers
from simulations.engine.drawing import cased, dot, path, rectangle, text
from simulations.engine.frame import (
    Frame,
    Panel,
    Raster,
    Readout,
    format_magnitude,
    format_number,
    readout,
)
from simulations.engine.handles import Handle, Point
from simulations.engine.instrument import Instrument
from simulations.engine.photograph import Photograph
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.compression import jpeg
from simulations.models.compression.blocks import (
    BLOCK,
    DCT,
    RANK,
    ZIGZAG,
    first_in_order,
    quantise_plane,
    round_outwards,
    to_blocks,
)
from simulations.models.compression.chroma_subsampling import coarsen, subsampling_factor
from simulations.models.compression.cosine_transforms import TRANSFORMS, exact_block_dct
from simulations.models.compression.entropy import Size, size
from simulations.models.error_measures import psnr_db
from simulations.pictures.balloon import HEIGHT as ROWS_PX
from simulations.pictures.balloon import WIDTH as COLUMNS_PX
from simulations.pictures.balloon import balloon
from simulations.pictures.photographs import cat
from simulations.scenes._wipe import over_wipe, wipe_handle, wiped

type Codes = NDArray[np.integer]

ALL = BLOCK * BLOCK
PIXELS = ROWS_PX * COLUMNS_PX
SUBSAMPLING_LABELS = {
    "4:2:0": "4:2:0, once in 2 × 2 pixels",
    "4:2:2": "4:2:2, in every second column",
    "4:4:4": "4:4:4, in every pixel",
}
UPSAMPLING_LABELS = {
    "repeated": "Repetition",
    "triangle": "Triangle",
    "parabola": "Parabola",
    "cubic": "Cubic",
    "guided": "Following luma",
}
BLOCKS_A_STEP = 120  # blocks per step of the estimate, as extended precision is slow in a browser

SIZE = WIDTH, HEIGHT = 400.0, 320.0
CLOSE_ROWS, CLOSE_COLUMNS = 24, 30  # pixels of the close-up
SIDE, CLOSE_SIDE = BLOCK * WIDTH / COLUMNS_PX, BLOCK * WIDTH / CLOSE_COLUMNS  # width of a block
CELL_WIDTH, CELL_HEIGHT = WIDTH / BLOCK, HEIGHT / BLOCK  # sides of a cell of the table of codes
KNOB_INSIDE = 14.0  # least distance of the handle from the lower edge, which would cut its ring
ACROSS, DOWN = 5, 4  # pixels for a sample of a pattern; a line between the cells is one
ZERO = 0.15  # contrast of the patterns without a coefficient
UNUSED = 0.3  # opacity of the patterns whose coefficients are not used

WAVES = DCT / np.abs(DCT).max(axis=1, keepdims=True)
PATTERNS = np.einsum("uy,vx->uvyx", WAVES, WAVES)
"""(8, 8, 8, 8) patterns from −1 to 1: vertical and horizontal frequency, row, column."""


@dataclass(frozen=True, slots=True)
class Settings:
    quality: int = slider("Quality", 30, 1, 100, 1)
    subsampling: str = choice("Chroma subsampling", SUBSAMPLING_LABELS)
    upsampling: str = choice("Chroma upsampling", UPSAMPLING_LABELS, "triangle")
    picture: str = choice("Picture", {"cat": "Cat, a photograph", "balloon": "Balloon, drawn"})
    column: int = slider("Block, column", 20, 1, COLUMNS_PX // BLOCK, 1)
    row: int = slider("Block, row", 11, 1, ROWS_PX // BLOCK, 1)
    original: float = slider("Original shown", 0.5, 0, 1, 0.01, unit="of the picture")
    first: int = slider("Coefficients used", ALL, 1, ALL, 1, unit="of each block")


def rounded_codes(picture: str, photograph: Photograph | None) -> Floats:
    """(H, W, 3) sRGB of a picture, the book's or the reader's own, in whole codes of 255.

    Encoded in float64: powers of float32 differ between machines by enough to move a code.
    """
    if photograph or picture == "cat":
        return (photograph.codes if photograph else cat.codes()) / 255
    return np.asarray(np.rint(255 * encode_srgb(balloon().astype(np.float64))) / 255)


def coded(planes: Floats, quality: int, subsampling: str, tier: str) -> jpeg.Coded:
    return jpeg.encode(planes, quality, subsampling, TRANSFORMS[tier])


def with_first_coefficients(coded: jpeg.Coded, first: int) -> jpeg.Coded:
    luma, blue, red = (first_in_order(codes, first) for codes in coded.planes)
    return replace(coded, luma=luma, differences=(blue, red))


def all_coefficients_used(first: int) -> str:
    return "all coefficients are used" if first == ALL else ""


def no_subsampling(subsampling: str) -> str:
    return "every pixel has kept its own colour" if subsampling == "4:4:4" else ""


def picture_bytes(picture: Floats) -> Raster:
    return to_rgba8(picture)


def wipe(before: Raster, after: Raster, original: float) -> Raster:
    return wiped(before, after, original)


def fidelity(decoded: Floats, original: Floats) -> float:
    return psnr_db(np.rint(255 * decoded) / 255, original)


STAGES = (
    Stage("original", rounded_codes),
    Stage("planes", jpeg.to_planes, ("original",)),
    Stage("coded", coded, ("planes",)),
    Stage("used", with_first_coefficients, ("coded",), neutral=all_coefficients_used),
    Stage("restored", jpeg.restore, ("used",)),
    Stage("full colour", jpeg.fill_in_colour, ("restored",), neutral=no_subsampling),
    Stage("decoded", jpeg.from_planes, ("full colour",)),
    Stage("bytes of the original", picture_bytes, ("original",)),
    Stage("bytes of the decoded", picture_bytes, ("decoded",)),
    Stage("wipe", wipe, ("bytes of the original", "bytes of the decoded")),
    Stage("size", size, ("used",)),
    Stage("psnr", fidelity, ("decoded", "original")),
)


def framed(corner: Point, side: float) -> str:
    return cased(rectangle, corner, side, side, style="image bold")


def close_up(picture: Raster, row: int, column: int) -> tuple[Raster, tuple[int, int]]:
    """30 × 24 pixels around a block, and where in them it starts (row, column)."""
    top = min(max(BLOCK * row - BLOCK, 0), ROWS_PX - CLOSE_ROWS)
    left = min(max(BLOCK * column - 11, 0), COLUMNS_PX - CLOSE_COLUMNS)
    window = picture[top : top + CLOSE_ROWS, left : left + CLOSE_COLUMNS]
    return np.ascontiguousarray(window), (BLOCK * row - top, BLOCK * column - left)


def block_grid(top: int, left: int) -> str:
    """Borders of the blocks in the close-up; the block itself starts at (``top``, ``left``)."""
    unit = WIDTH / CLOSE_COLUMNS
    columns = range(left % BLOCK, CLOSE_COLUMNS + 1, BLOCK)
    rows = range(top % BLOCK, CLOSE_ROWS + 1, BLOCK)
    grid = [[(c * unit, 0.0), (c * unit, HEIGHT)] for c in columns]
    grid += [[(0.0, r * unit), (WIDTH, r * unit)] for r in rows]
    return path(grid, "camera thin faint") + framed((left * unit, top * unit), CLOSE_SIDE)


def pattern_table(codes: Codes, first: int) -> Raster:
    """Each pattern with the sign of its code (8, 8); faint where that is zero or not used."""
    used = first > RANK
    contrast = np.where((codes != 0) & used, np.sign(codes), ZERO)
    shades = 0.5 + 0.5 * contrast[..., None, None] * PATTERNS
    opacity = np.broadcast_to(np.where(used, 1.0, UNUSED)[..., None, None], shades.shape)
    return to_rgba8(table(shades), table(opacity))


def table(cells: NDArray[np.floating]) -> NDArray[np.floating]:
    """(8, 8, 8, 8) cells as a picture, with an empty line above and to the left of each."""
    large = cells.repeat(DOWN, axis=2).repeat(ACROSS, axis=3)
    framed = np.pad(large, ((0, 0), (0, 0), (1, 0), (1, 0)))
    height, width = framed.shape[2:]
    return framed.swapaxes(1, 2).reshape(BLOCK * height, BLOCK * width)


def code_table(codes: Codes, first: int) -> Iterator[str]:
    """The codes (8, 8) that are not zero and among the ``first``; the last cell in use, its
    handle."""
    for (row, column), code in np.ndenumerate(codes):
        if code and RANK[row, column] < first:
            place = ((column + 0.5) * CELL_WIDTH, (row + 0.5) * CELL_HEIGHT + 5)
            yield text(place, format_number(float(code), 0), "image strong ground", "middle")
    row, column = divmod(int(ZIGZAG[first - 1]), BLOCK)
    corner = (column * CELL_WIDTH + 1, row * CELL_HEIGHT + 1)
    for style in ("casing", "ray bold"):
        yield rectangle(corner, CELL_WIDTH - 2, CELL_HEIGHT - 2, style)
    yield dot(coefficient_handle_place(first), "ray", 5)


def coefficient_handle_place(first: int) -> Point:
    """Handle in the middle of the lower edge of the last coefficient's cell, below its number."""
    row, column = divmod(int(ZIGZAG[first - 1]), BLOCK)
    lower = (row + 1) * CELL_HEIGHT - 1
    return (column + 0.5) * CELL_WIDTH, min(lower, HEIGHT - KNOB_INSIDE)


def kilobytes(bits: float) -> str:
    return format_number(bits / 8000, 1)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The decoded picture, a block of it, and the numbers stored for it."""
    row, column, first = settings.row - 1, settings.column - 1, settings.first
    displayed, codes = outputs["wipe"], outputs["coded"].luma[row, column]
    stored: Size = outputs["size"]
    block_kept = int(np.count_nonzero(first_in_order(codes, first)))
    close, place = close_up(displayed, row, column)
    over = over_wipe(settings.original, WIDTH, HEIGHT, ("original", "JPEG"))
    over += framed((column * SIDE, row * SIDE), SIDE)
    over += text((12, 36), f"{kilobytes(stored.bits)} kB", "large strong ground")
    patterns, numbers = pattern_table(codes, first), "".join(code_table(codes, first))
    kept_percent = 100 * stored.nonzero / (3 * PIXELS)
    rate, psnr = stored.bits / PIXELS, outputs["psnr"]
    in_block = "Coefficients kept in the block"
    return Frame(
        (
            Panel("picture", "The picture before and after", *SIZE, displayed, over, lead=True),
            Panel(
                "codes",
                "The patterns the block is made of",
                *SIZE,
                patterns,
                overlay=numbers,
                pixelated=True,
            ),
            Panel(
                "block",
                "The framed block, enlarged",
                *SIZE,
                close,
                overlay=block_grid(*place),
                pixelated=True,
            ),
        ),
        (
            readout("psnr", "Fidelity (PSNR)", psnr, "dB", digits=1, role="error"),
            readout("kept", "Coefficients kept", kept_percent, "%", digits=1),
            readout("rate", "Size", rate, "bits a pixel", role="image"),
            Readout("kilobytes", f"Of {kilobytes(24 * PIXELS)} kB", kilobytes(stored.bits), "kB"),
            readout("block_kept", in_block, block_kept, "of 64", digits=0, role="image"),
        ),
        describe(settings, psnr, stored, block_kept, bool(outputs["photograph"])),
    )


def describe(
    settings: Settings, psnr: float, stored: Size, block_kept: int, is_photograph: bool
) -> str:
    """The book's or the reader's picture in one sentence."""
    rows, columns = subsampling_factor(settings.subsampling)
    each = rows * columns
    colour = f"one colour value for {each} pixels" if each > 1 else "full colour"
    if psnr >= 33:
        visible = "few traces show"
    elif settings.first == ALL and settings.quality >= 75 and each > 1:
        visible = "colours run over the edges"
    else:
        visible = "edges are surrounded by ripples" if psnr >= 27 else "blocks and fringes show"
    limit = (
        ""
        if settings.first == ALL
        else f", of each block only the first {settings.first} coefficients in the order of "
        "fineness"
    )
    book = "A cat's face" if settings.picture == "cat" else "A striped balloon over tulips"
    subject, artefacts = ("Your own picture", "") if is_photograph else (book, visible)
    return (
        f"{subject} at JPEG quality {settings.quality} with {colour}{limit}: "
        f"{kilobytes(stored.bits)} kB, {format_number(psnr, 1)} dB"
        f"{', and ' if artefacts else ''}{artefacts}; {block_kept} of the 64 luma "
        "coefficients of the framed block are kept. The left "
        f"{format_number(100 * settings.original, 0)} % of the picture are the original."
    )


def estimate(_settings: Settings, outputs: Outputs, tier: str) -> Iterator[Readout]:
    """Largest error of a coefficient against the standard's sums, and count of changed codes, over
    more blocks with each step."""
    done: jpeg.Coded = outputs["coded"]
    worst, changed, compared = 0.0, 0, 0
    total = sum(codes.size // ALL for codes in done.planes)
    for blocks, steps, codes in blocks_with_steps(outputs["planes"], done):
        truth = exact_block_dct(blocks)
        worst = max(worst, float(np.abs(TRANSFORMS[tier](blocks) - truth).max()))
        changed += int(np.count_nonzero(round_outwards(truth / steps) != codes))
        compared += len(blocks)
        label = (
            f"Largest error of a coefficient in {compared} of {total} blocks "
            f"({changed} round otherwise)"
        )
        yield Readout("error", label, format_magnitude(worst, 1e-15), "codes", role="error")


def blocks_with_steps(planes: Floats, coded: jpeg.Coded) -> Iterator[tuple[Floats, Floats, Codes]]:
    """Blocks (n, 8, 8) of samples of the planes (3, H, W), the steps of their plane, their
    codes."""
    factor = subsampling_factor(coded.subsampling)
    fine, coarse = jpeg.tables(coded.quality)
    samples = (planes[0], *(coarsen(plane, factor) for plane in planes[1:]))
    for plane, steps, codes in zip(samples, (fine, coarse, coarse), coded.planes, strict=True):
        blocks, coefficients = to_blocks(plane).reshape(-1, 8, 8), codes.reshape(-1, 8, 8)
        for start in range(0, len(blocks), BLOCKS_A_STEP):
            part = slice(start, start + BLOCKS_A_STEP)
            yield blocks[part], steps.astype(float), coefficients[part]


def block_at(settings: Settings, _outputs: Outputs) -> Point:
    return ((settings.column - 0.5) * SIDE, (settings.row - 0.5) * SIDE)


def block_pulled(_settings: Settings, place: Point) -> dict[str, float]:
    return {"column": place[0] / SIDE + 0.5, "row": place[1] / SIDE + 0.5}


def last_at(settings: Settings, _outputs: Outputs) -> Point:
    return coefficient_handle_place(settings.first)


def last_pulled(_settings: Settings, place: Point) -> dict[str, int]:
    """Count of coefficients up to the cell at the place, or the nearest one."""
    row = min(max(int(place[1] // CELL_HEIGHT), 0), BLOCK - 1)
    column = min(max(int(place[0] // CELL_WIDTH), 0), BLOCK - 1)
    return {"first": int(RANK[row, column]) + 1}


PLACE = ("column", "row")
SCENE = Scene(
    "jpeg",
    "JPEG Compression",
    Settings,
    draw,
    STAGES,
    (
        wipe_handle("picture", "original", WIDTH, HEIGHT),
        Handle(
            "block",
            "picture",
            "Block",
            drives=PLACE,
            at=block_at,
            pull=block_pulled,
            reach="press",
            role="image",
            reversed=("row",),
        ),
        Handle(
            "last",
            "codes",
            "Last coefficient used",
            drives=("first",),
            at=last_at,
            pull=last_pulled,
            reach="press",
            role="ray",
        ),
    ),
    instrument=Instrument(photograph=(COLUMNS_PX, ROWS_PX)),
    accuracy=Accuracy(
        levels=tiers(*TRANSFORMS),
        default="separable",
        ladder="block-dct",
        estimate=estimate,
        unit="codes",
    ),
    formula=quantise_plane,
)
