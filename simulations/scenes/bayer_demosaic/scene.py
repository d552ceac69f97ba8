"""A picture through a Bayer mosaic, its reconstruction and the error of the reconstruction.

The sensor counts light, so the mosaic and its reconstruction are linear; the display and the errors
are of encoded values. The computation is in `simulations.scenes.bayer_demosaic.stages`.
"""

from collections.abc import Iterator

import numpy as np

from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.pictures.mosaic_subjects import SUBJECTS
from simulations.scenes.bayer_demosaic import drawing
from simulations.scenes.bayer_demosaic.handles import HANDLES
from simulations.scenes.bayer_demosaic.settings import COLUMNS, METHOD_LABELS, ROWS, Settings
from simulations.scenes.bayer_demosaic.stages import (
    AMPLIFY,
    PATTERN,
    PHOTOGRAPH_PX,
    STAGES,
    Errors,
    rms_codes,
)

NO_MERITS = ("—",) * 4
"""The texts of `_merits` while there is only a mosaic."""


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The mosaic or its reconstruction by the chosen method, with its error."""
    words = "your own picture" if outputs["photograph"] else SUBJECTS[settings.picture].words
    if not settings.demosaic:
        return Frame(
            _mosaic(settings, outputs),
            (_shares(), *_merits(*NO_MERITS)),
            describe_mosaic(words),
        )
    return Frame(
        _reconstruction(settings, outputs),
        (_shares(), *_merits(*_measured(outputs))),
        describe(words, settings.method, outputs["error"]),
    )


def _mosaic(settings: Settings, outputs: Outputs) -> tuple[Panel, ...]:
    """The mosaic, a part of it enlarged, and the original picture."""
    cells, truth = outputs["bytes of the picture"], outputs["bytes of the error"]
    loupe = drawing.loupe(settings.row, settings.column)
    # Two samples per cell, as the fine pattern would beat with the screen's pixels.
    twice = cells.repeat(2, axis=0).repeat(2, axis=1)
    letters = drawing.filter_letters(PATTERN)
    return (
        _panel("picture", "The mosaic", twice, loupe),
        _enlarged("Enlarged: one filter per cell", cells, settings, letters),
        _panel("error", "The truth, which no cell saw", truth, loupe),
    )


def _reconstruction(settings: Settings, outputs: Outputs) -> tuple[Panel, ...]:
    """The demosaiced picture, a part of it enlarged, and its amplified error."""
    errors: Errors = outputs["error"]
    shown = outputs["bytes of the picture"]
    over = drawing.worst_pixel(*errors.worst_at) + drawing.loupe(settings.row, settings.column)
    return (
        _panel("picture", "The reconstruction", shown, over),
        _enlarged("Enlarged", shown, settings, ""),
        _panel("error", f"Error × {AMPLIFY}", outputs["bytes of the error"], over),
    )


def _panel(name: str, title: str, raster: Raster, overlay: str) -> Panel:
    return Panel(name, title, drawing.WIDTH, drawing.HEIGHT, raster, overlay)


def _enlarged(title: str, picture: Raster, settings: Settings, overlay: str) -> Panel:
    """The part under the loupe, with pixels as squares."""
    rows = slice(settings.row, settings.row + ROWS)
    part = np.ascontiguousarray(picture[rows, settings.column : settings.column + COLUMNS])
    width, height = drawing.WIDTH, drawing.HEIGHT
    return Panel("loupe", title, width, height, part, overlay, pixelated=True)


def _shares() -> Readout:
    """Share of the cells that measure each colour, as in every quad."""
    red, green, blue = (round(100 * PATTERN.count(letter) / len(PATTERN)) for letter in "RGB")
    return Readout("samples", "Measured R / G / B", f"{red} / {green} / {blue}", "%")


def _merits(shared: str, psnr: str, light: str, worst: str) -> tuple[Readout, ...]:
    return (
        Readout("shared", "Fine detail shared with green, R / B", shared),
        Readout("psnr", "PSNR as displayed", psnr, "dB", "error"),
        Readout("light", "PSNR in light", light, "dB"),
        Readout("worst", "Worst error", worst, "of 255", "error"),
    )


def _measured(outputs: Outputs) -> tuple[str, str, str, str]:
    """The texts of `_merits` for a reconstruction."""
    errors: Errors = outputs["error"]
    return (
        " / ".join(format_number(each, 2) for each in outputs["shared detail"]),
        format_number(errors.psnr_db, 1),
        format_number(errors.light_psnr_db, 1),
        format_number(errors.worst_codes, 0),
    )


def describe_mosaic(words: str) -> str:
    """The mosaic of a picture in one sentence."""
    return (
        f"The sensor's view of {words}: every cell has measured only one of red, green "
        "and blue, green at half of them."
    )


def describe(words: str, method: str, errors: Errors) -> str:
    """The reconstruction of a picture in one sentence."""
    where = " where detail is sharp or fine" if errors.worst_codes > 1 else ""
    return (
        f"The picture of {words}, demosaiced by the method {METHOD_LABELS[method]}: "
        f"{format_number(errors.psnr_db, 1)} dB as displayed, with errors of up to "
        f"{errors.worst_codes} codes{where}."
    )


def estimate(settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """Error of each colour of the reconstruction. The method, a control of this figure, is the
    tier.
    """
    if not settings.demosaic:
        yield Readout("error", "Error", "none yet: nothing is demosaiced")
        return
    text = ", ".join(format_number(codes, 1) for codes in rms_codes(outputs["error"]))
    yield Readout("error", "RMS error of red, green, blue", text, "codes of 255", "error")


SCENE = Scene(
    id="bayer-demosaic",
    title="Bayer Pattern",
    settings=Settings,
    draw=draw,
    stages=STAGES,
    handles=HANDLES,
    photograph=PHOTOGRAPH_PX,
    ladder="demosaicing",
    estimate=estimate,
)
