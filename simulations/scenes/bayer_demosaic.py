"""A picture through a Bayer mosaic, its reconstruction and the error of the reconstruction.

Picture, mosaic and reconstruction are in linear light, which a sensor counts. The display and the
errors are of encoded values. The method is the tier.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from simulations.engine.accuracy import Accuracy
from simulations.engine.drawing import cased, line, polygon, rectangle, text
from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.instrument import Instrument
from simulations.engine.photograph import Codes, Photograph
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.engine.settings import action, choice, slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.error_measures import psnr_db
from simulations.models.sensor import demosaicing
from simulations.models.sensor.bayer import mosaic, through_filters
from simulations.models.sensor.shared_detail import shared_detail
from simulations.pictures import balloon
from simulations.pictures.mosaic_subjects import SUBJECTS, Subject
from simulations.pictures.photographs import cat
from simulations.scenes._wipe import over_wipe, wipe_handle, wiped

PATTERN = "RGGB"
METHOD_LABELS = {
    "nearest": "Nearest",
    "bilinear": "Bilinear",
    "malvar": "Malvar–He–Cutler 2004",
    "menon-unrefined": "Menon 2007, unrefined",
    "menon": "Menon 2007",
    "menon-encoded": "Menon, unrefined, on encoded values",
}
CAT = Subject("Cat, a photograph", "a cat's face", lambda _whole: decoded(cat.codes()))
PICTURES = {"cat": CAT, **SUBJECTS}
CROP = 8  # border in pixels, left out of the error measures
AMPLIFY = 4  # of the error picture: a quarter of the range is shown as full

ROWS, COLUMNS = 16, 20  # pixels under the loupe
QUAD = 2  # the loupe moves by whole quads, so that its mosaic starts with the same colour
WIDTH, HEIGHT = 400, 320
PIXEL, CELL = WIDTH / balloon.WIDTH, WIDTH / COLUMNS  # sides in the pictures, under the loupe
QUAD_COLUMN, QUAD_ROW = 16, 6  # place of the quad that is framed, in pixels under the loupe


@dataclass(frozen=True, slots=True)
class Settings:
    demosaic: int = action("Demosaic", drives="split", effect="play", seconds=4.0)
    method: str = choice("Method", METHOD_LABELS, "menon-unrefined")
    picture: str = choice("Picture", {name: each.label for name, each in PICTURES.items()})
    split: float = slider("Demosaiced part", 0.5, 0, 1, 0.01, unit="of the picture")
    column: int = slider("Loupe, column", 110, 0, balloon.WIDTH - COLUMNS, QUAD, unit="px")
    row: int = slider("Loupe, row", 24, 0, balloon.HEIGHT - ROWS, QUAD, unit="px")


@dataclass(frozen=True, slots=True)
class Errors:
    """The errors of a reconstruction."""

    absolute: Floats
    """(H, W, 3) in [0, 1], of encoded values."""
    psnr_db: float
    """PSNR as displayed."""
    light_psnr_db: float
    """PSNR before the display's curve."""
    worst_codes: int
    """Largest error in codes of 255, without the border."""
    worst_at: tuple[int, int]
    """Row and column of it."""


def light(picture: str, photograph: Photograph | None) -> Floats:
    """The picture in linear light, float32."""
    return decoded(photograph.codes) if photograph else PICTURES[picture].draw(balloon.WHOLE)


def decoded(codes: Codes) -> Floats:
    """(H, W, 3) sRGB as linear light, float32."""
    return decode_srgb(np.float32(1 / 255) * codes)


def through_mosaic(picture: Floats) -> Floats:
    """The mosaic (H, W), one colour per cell."""
    return mosaic(picture, PATTERN)


def reconstruct(cfa: Floats, method: str) -> Floats:
    """The full picture in linear light, clipped to [0, 1]."""
    return np.clip(demosaicing.demosaic(cfa, PATTERN, method), 0, 1)


def compare(truth: Floats, guess: Floats, displayed_truth: Floats, displayed: Floats) -> Errors:
    """Errors of a picture in linear light (H, W, 3), and of the same picture encoded."""
    absolute = np.abs(displayed - displayed_truth)
    inner = absolute[CROP:-CROP, CROP:-CROP].max(axis=2)
    row, column = divmod(int(inner.argmax()), inner.shape[1])
    return Errors(
        absolute,
        psnr_db(displayed, displayed_truth, crop=CROP),
        psnr_db(guess, truth, crop=CROP),
        round(255 * float(inner.max())),
        (row + CROP, column + CROP),
    )


def cells(cfa: Floats) -> Raster:
    """Each cell in the colour of its filter."""
    return to_rgba8(encode_srgb(through_filters(cfa, PATTERN)))


def picture_bytes(picture: Floats) -> Raster:
    return to_rgba8(picture)


def amplified(errors: Errors) -> Raster:
    return to_rgba8(AMPLIFY * errors.absolute)


def wipe(reconstruction: Raster, cells: Raster, split: float) -> Raster:
    return wiped(reconstruction, cells, split)


def doubled(raster: Raster) -> Raster:
    """Two samples per cell, as the fine pattern would beat with the screen's pixels."""
    return raster.repeat(2, axis=0).repeat(2, axis=1)


def no_mosaic(split: float) -> str:
    return "the whole picture is demosaiced" if split == 1 else ""


STAGES = (
    Stage("picture", light),
    Stage("mosaic", through_mosaic, ("picture",)),
    Stage("shown picture", encode_srgb, ("picture",)),
    Stage("shared detail", shared_detail, ("picture",)),
    Stage("demosaic", reconstruct, ("mosaic",)),
    Stage("display", encode_srgb, ("demosaic",)),
    Stage("error", compare, ("picture", "demosaic", "shown picture", "display")),
    # As bytes for the page, which stay cached while the loupe moves.
    Stage("bytes of the mosaic", cells, ("mosaic",)),
    Stage("bytes of the reconstruction", picture_bytes, ("display",)),
    Stage("wipe", wipe, ("bytes of the reconstruction", "bytes of the mosaic")),
    Stage("doubled", doubled, ("wipe",), neutral=no_mosaic),
    Stage("bytes of the error", amplified, ("error",)),
)


def loupe(row: int, column: int) -> str:
    """The enlarged part of the picture."""
    corner, size = (column * PIXEL, row * PIXEL), (COLUMNS * PIXEL, ROWS * PIXEL)
    return cased(rectangle, corner, *size, style="camera bold")


def quad() -> str:
    """A frame around one quad of the enlarged mosaic, with the letter of each filter."""
    x, y = corner = (QUAD_COLUMN * CELL, QUAD_ROW * CELL)
    frame = [cased(rectangle, corner, 2 * CELL, 2 * CELL, style="camera bold")]
    letters = [
        text((x + (k % 2 + 0.5) * CELL, y + (k // 2 + 0.5) * CELL + 4), letter, "ground", "middle")
        for k, letter in enumerate(PATTERN)
    ]
    return "".join((*frame, *letters))


def worst_pixel(row: int, column: int) -> str:
    """A cross-hair at the pixel of the largest error, with its name on the side with more room."""
    x, y = (column + 0.5) * PIXEL, (row + 0.5) * PIXEL
    right = x < WIDTH / 2
    name = (x + (20 if right else -20), min(max(y + 5, 20), HEIGHT - 8))
    parts = [text(name, "largest error", "error small ground", "start" if right else "end")]
    turns = [turn * math.pi / 2 for turn in range(4)]
    corners = [(x + 9 * math.cos(turn), y + 9 * math.sin(turn)) for turn in turns]
    for style in ("casing", "error"):
        parts.append(polygon(corners, style))
        parts.append(line((x - 15, y), (x - 9, y), style) + line((x + 9, y), (x + 15, y), style))
    return "".join(parts)


def enlarged(picture: Raster, settings: Settings) -> Panel:
    """The part under the loupe, with pixels as squares; of the mosaic, one quad is framed."""
    rows = slice(settings.row, settings.row + ROWS)
    part = np.ascontiguousarray(picture[rows, settings.column : settings.column + COLUMNS])
    is_mosaic = round(settings.split * picture.shape[1]) <= settings.column + QUAD_COLUMN
    overlay = quad() if is_mosaic else ""
    return Panel("loupe", "Under the loupe", WIDTH, HEIGHT, part, overlay, pixelated=True)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The reconstruction beside the mosaic, a part of both enlarged, and the error."""
    errors: Errors = outputs["error"]
    worst = errors.worst_codes
    over = over_wipe(settings.split, WIDTH, HEIGHT, ("reconstruction", "mosaic"))
    over += loupe(settings.row, settings.column)
    title, of_error = f"Error of the reconstruction, × {AMPLIFY}", outputs["bytes of the error"]
    words = "your own picture" if outputs["photograph"] else PICTURES[settings.picture].words
    where = ", most where detail is sharp or fine" if worst > 1 else ""
    correlation = " / ".join(format_number(each, 2) for each in outputs["shared detail"])
    return Frame(
        (
            Panel(
                "picture",
                "What the sensor saw, filled in",
                WIDTH,
                HEIGHT,
                outputs["doubled"],
                overlay=over,
                lead=True,
            ),
            enlarged(outputs["wipe"], settings),
            Panel("error", title, WIDTH, HEIGHT, of_error, worst_pixel(*errors.worst_at)),
        ),
        (
            readout("psnr", "Fidelity (PSNR)", errors.psnr_db, "dB", digits=1, role="error"),
            Readout("shared", "Correlation with green, R / B", correlation),
            readout("light", "Fidelity in light", errors.light_psnr_db, "dB", digits=1),
            readout("worst", "Worst error", worst, "of 255", digits=0, role="error"),
        ),
        f"The mosaic of {words}, where every cell shows red, green or blue alone, green at half of "
        f"them. The left {format_number(100 * settings.split, 0)} % are demosaiced by the method "
        f"{METHOD_LABELS[settings.method]}: {format_number(errors.psnr_db, 1)} dB on the screen, "
        f"with errors of up to {worst} codes{where}.",
    )


def rms_codes(errors: Errors) -> Floats:
    """RMS error of each colour (3,) in codes of 255, inside the border."""
    inner = errors.absolute[CROP:-CROP, CROP:-CROP].astype(np.float64)
    return 255.0 * np.sqrt(np.mean(inner * inner, axis=(0, 1)))


def estimate(_settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    text = ", ".join(format_number(codes, 1) for codes in rms_codes(outputs["error"]))
    yield Readout("error", "RMS error of red, green, blue", text, "codes of 255", role="error")


def loupe_at(settings: Settings, _outputs: Outputs) -> Point:
    return (settings.column + COLUMNS / 2) * PIXEL, (settings.row + ROWS / 2) * PIXEL


def loupe_pulled(_settings: Settings, place: Point) -> dict[str, float]:
    return {"column": place[0] / PIXEL - COLUMNS / 2, "row": place[1] / PIXEL - ROWS / 2}


def enlarged_at(settings: Settings, _outputs: Outputs) -> Point:
    """Place of the picture's first pixel in the enlargement."""
    return (-settings.column * CELL, -settings.row * CELL)


def enlarged_pulled(_settings: Settings, place: Point) -> dict[str, float]:
    return {"column": -place[0] / CELL, "row": -place[1] / CELL}


PLACE = ("column", "row")
HANDLES: tuple[Handle[Settings], ...] = (
    wipe_handle("picture", "split", WIDTH, HEIGHT),
    Handle(
        "loupe-picture",
        "picture",
        "Loupe",
        drives=PLACE,
        at=loupe_at,
        pull=loupe_pulled,
        reach="press",
        role="camera",
        reversed=("row",),
    ),
    Handle(
        "enlarged",
        "loupe",
        "Picture under the loupe",
        drives=PLACE,
        at=enlarged_at,
        pull=enlarged_pulled,
        reach="drag",
        reversed=("column",),
    ),
)
SCENE = Scene(
    "bayer-demosaic",
    "Bayer Pattern",
    Settings,
    draw,
    STAGES,
    HANDLES,
    instrument=Instrument(photograph=(balloon.WIDTH, balloon.HEIGHT)),
    accuracy=Accuracy(ladder="demosaicing", estimate=estimate),
    formula=demosaicing.bilinear,
)
