"""A picture through a Bayer mosaic, its reconstruction, and what the reconstruction got wrong.

The mosaic is taken from sRGB-encoded values, so that errors count in codes that a screen
shows. Each stage is in `simulations.models`: picture -> mosaic -> demosaic -> error.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.controls import Action, Choice, Values
from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.pipeline import Run, Stage, StageCache, run
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.models.bayer import filter_colours, through_filters
from simulations.models.color import encode_srgb
from simulations.models.demosaicing import demosaic, mosaic, psnr_db
from simulations.pictures.balloon import WIDTH as PICTURE_WIDTH
from simulations.pictures.balloon import balloon
from simulations.scenes import bayer_drawing as drawing

type Picture = NDArray[np.floating]

PATTERN = "RGGB"
AMPLIFY = 4
"""Factor of the error picture: a quarter of the range off is shown in full."""
CROP = 8
"""Border, in pixels, that the figures of merit leave out."""
CLOSE_TOP, CLOSE_LEFT = 56, 130
"""Where the close-up lies: on the balloon's band. Both even, so that it starts with red."""
UNITS_PER_PIXEL = drawing.WIDTH / PICTURE_WIDTH

METHOD_LABELS = {
    "nearest": "Nearest",
    "bilinear": "Bilinear",
    "malvar": "Malvar–He–Cutler 2004",
    "menon": "Menon 2007",
}
CONTROLS = (
    Action(name="demosaic", labels=("Demosaic", "Show the mosaic")),
    Choice(name="method", label="Method", default="bilinear", options=METHOD_LABELS),
    Choice(
        name="view",
        label="View",
        default="whole",
        options={"whole": "Whole picture", "close": "Close-up"},
    ),
)


@dataclass(frozen=True, slots=True)
class Errors:
    """How far a reconstruction is from the truth."""

    absolute: Picture
    """(H, W, 3) in [0, 1]."""
    psnr_db: float
    worst_codes: int
    """Largest error in codes of 255, the border left out."""
    worst_at: tuple[int, int]
    """Row and column of it."""


def compare(truth: Picture, guess: Picture) -> Errors:
    """Absolute error, and its figures of merit inside the border."""
    absolute = np.abs(guess - truth)
    inner = absolute[CROP:-CROP, CROP:-CROP].max(axis=2)
    row, column = divmod(int(inner.argmax()), inner.shape[1])
    worst = round(255 * float(inner.max()))
    return Errors(absolute, psnr_db(guess, truth, crop=CROP), worst, (row + CROP, column + CROP))


def reconstruct(cfa: Picture, method: str) -> Picture:
    """The full picture, held to the range that a screen shows."""
    picture: Picture = np.clip(demosaic(cfa, PATTERN, method), 0, 1)
    return picture


STAGES = (
    Stage("picture", (), lambda: encode_srgb(balloon())),
    Stage("mosaic", (), lambda picture: mosaic(picture, PATTERN), ("picture",)),
    Stage("demosaic", ("method",), reconstruct, ("mosaic",)),
    Stage("error", (), compare, ("picture", "demosaic")),
)


def render(values: Values, _tier: str, cache: StageCache) -> Frame:
    """The mosaic or its reconstruction by the chosen method, and what is wrong with it."""
    demosaiced = values.state("demosaic") == 1
    done = run(STAGES if demosaiced else STAGES[:2], values, cache)
    close = values.choice("view") == "close"
    shown = _reconstruction(done, close) if demosaiced else _mosaic(done, close)
    readouts = (*_shares(done.outputs["mosaic"]), *_merits(done, values, demosaiced))
    return Frame(shown, readouts, describe(done, values, demosaiced), done.reports)


def error(values: Values, _tier: str, cache: StageCache) -> Iterator[Readout]:
    """How far each colour of the reconstruction is from the picture that the mosaic was taken from.

    The method is a control of this figure: it stands for the tier.
    """
    if values.state("demosaic") == 0:
        yield Readout("error", "Error", "none yet: nothing is demosaiced")
        return
    outputs = run(STAGES, values, cache).outputs
    text = ", ".join(format_number(codes, 1) for codes in rms_codes(outputs["error"]))
    yield Readout("error", "RMS error of red, green, blue", text, "codes of 255", "error")


def rms_codes(errors: Errors) -> Picture:
    """Of each colour (3,), inside the border."""
    inner = errors.absolute[CROP:-CROP, CROP:-CROP].astype(np.float64)
    rms: Picture = 255.0 * np.sqrt(np.mean(inner * inner, axis=(0, 1)))
    return rms


def _mosaic(done: Run, close: bool) -> tuple[Panel, Panel]:
    """What the sensor measured, beside the same few pixels enlarged."""
    seen = through_filters(done.outputs["mosaic"], PATTERN)
    frame = drawing.close_up_frame(CLOSE_TOP, CLOSE_LEFT, UNITS_PER_PIXEL)
    truth = done.outputs["picture"]
    if close:
        return (
            _panel("picture", "The mosaic", _cut(seen, True), "", close=True),
            _panel("error", "The truth, which no cell saw", _cut(truth, True), "", close=True),
        )
    # The finest pattern there is would beat with the screen's own pixels: two samples a cell.
    seen_twice = seen.repeat(2, axis=0).repeat(2, axis=1)
    letters = drawing.filter_letters(PATTERN)
    return (
        _panel("picture", "The mosaic", seen_twice, frame, close=False),
        _panel("error", "Enlarged: one filter per cell", _cut(seen, True), letters, close=True),
    )


def _reconstruction(done: Run, close: bool) -> tuple[Panel, Panel]:
    """The demosaiced picture, beside its amplified error."""
    errors: Errors = done.outputs["error"]
    mark = "" if close else drawing.worst_pixel(*errors.worst_at, UNITS_PER_PIXEL)
    return (
        _panel("picture", "The reconstruction", _cut(done.outputs["demosaic"], close), mark, close),
        _panel("error", f"Error × {AMPLIFY}", _cut(AMPLIFY * errors.absolute, close), mark, close),
    )


def _panel(name: str, title: str, picture: Picture, overlay: str, close: bool) -> Panel:
    """A close-up shows its pixels as squares; a whole picture is smoothed to the screen's."""
    raster = to_rgba8(picture)
    return Panel(name, title, drawing.WIDTH, drawing.HEIGHT, raster, overlay, pixelated=close)


def _cut(picture: Picture, close: bool) -> Picture:
    rows = slice(CLOSE_TOP, CLOSE_TOP + drawing.CLOSE_ROWS)
    columns = slice(CLOSE_LEFT, CLOSE_LEFT + drawing.CLOSE_COLUMNS)
    return picture[rows, columns] if close else picture


def _shares(cfa: Picture) -> tuple[Readout, ...]:
    """Share of the pixels that measure each colour."""
    counts = np.bincount(filter_colours(cfa.shape[0], cfa.shape[1], PATTERN).reshape(-1)) / cfa.size
    red, green, blue = (round(100 * float(share)) for share in counts)
    return (
        Readout("samples", "Measured R / G / B", f"{red} / {green} / {blue}", "%"),
        Readout("guessed", "Interpolated", "2 of 3 values"),
    )


def _merits(done: Run, values: Values, demosaiced: bool) -> tuple[Readout, ...]:
    """Method and quality; a dash while there is nothing to judge."""
    if not demosaiced:
        return (
            Readout("method", "Method", "—"),
            Readout("psnr", "PSNR", "—", "dB"),
            Readout("worst", "Worst error", "—", "of 255", "error"),
        )
    errors: Errors = done.outputs["error"]
    return (
        Readout("method", "Method", METHOD_LABELS[values.choice("method")]),
        readout("psnr", "PSNR", errors.psnr_db, "dB", digits=1),
        readout("worst", "Worst error", errors.worst_codes, "of 255", digits=0, role="error"),
    )


def describe(done: Run, values: Values, demosaiced: bool) -> str:
    """The picture in one sentence."""
    scene = "a striped balloon over rows of tulips"
    if not demosaiced:
        return (
            f"The sensor's view of {scene}: every pixel has measured only one of red, green "
            "and blue, green at half of them."
        )
    errors: Errors = done.outputs["error"]
    method = METHOD_LABELS[values.choice("method")]
    return (
        f"The picture of {scene}, demosaiced by the method {method}: "
        f"{errors.psnr_db:.1f} dB, with errors of up to {errors.worst_codes} codes along "
        "sharp edges and fine stripes and almost none in the sky."
    )


SCENE = Scene(
    id="bayer-demosaic",
    title="Bayer Pattern",
    controls=CONTROLS,
    render=render,
    ladder="demosaicing",
    error=error,
)
