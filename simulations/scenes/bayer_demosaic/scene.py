"""A picture through a Bayer mosaic, its reconstruction and the error of the reconstruction.

The sensor counts light, so the mosaic and its reconstruction are linear; the display and the errors
are of encoded values. The computation is in `simulations.scenes.bayer_demosaic.stages`.
"""

from collections.abc import Iterator

import numpy as np

from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.sensor.demosaicing import bilinear
from simulations.pictures.mosaic_subjects import SUBJECTS
from simulations.scenes._wipe.wipe import over_wipe
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

NAMES = ("reconstruction", "mosaic")


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The reconstruction beside the mosaic, a part of both enlarged, and the error."""
    words = "your own picture" if outputs["photograph"] else SUBJECTS[settings.picture].words
    errors: Errors = outputs["error"]
    loupe = drawing.loupe(settings.row, settings.column)
    wipe = over_wipe(settings.split, drawing.WIDTH, drawing.HEIGHT, NAMES)
    return Frame(
        (
            _panel("picture", "What the sensor saw, filled in", outputs["doubled"], wipe + loupe),
            _enlarged(outputs["wipe"], settings),
            _panel(
                "error",
                f"Error of the reconstruction, × {AMPLIFY}",
                outputs["bytes of the error"],
                drawing.worst_pixel(*errors.worst_at),
            ),
        ),
        _readouts(errors, outputs["shared detail"]),
        describe(words, settings, errors),
    )


def _panel(name: str, title: str, raster: Raster, overlay: str) -> Panel:
    width, height = drawing.WIDTH, drawing.HEIGHT
    return Panel(name, title, width, height, raster, overlay, lead=name == "picture")


def _enlarged(picture: Raster, settings: Settings) -> Panel:
    """The part under the loupe, with pixels as squares; of the mosaic, one quad is framed."""
    rows = slice(settings.row, settings.row + ROWS)
    part = np.ascontiguousarray(picture[rows, settings.column : settings.column + COLUMNS])
    border = round(settings.split * picture.shape[1])
    is_mosaic = border <= settings.column + drawing.QUAD_COLUMN
    overlay = drawing.quad(PATTERN) if is_mosaic else ""
    width, height = drawing.WIDTH, drawing.HEIGHT
    return Panel("loupe", "Under the loupe", width, height, part, overlay, pixelated=True)


def _readouts(errors: Errors, shared: tuple[float, float]) -> tuple[Readout, ...]:
    """``shared``: see `simulations.models.sensor.shared_detail`."""
    correlation = " / ".join(format_number(each, 2) for each in shared)
    psnr, light = (format_number(each, 1) for each in (errors.psnr_db, errors.light_psnr_db))
    return (
        Readout("psnr", "Fidelity (PSNR)", psnr, "dB", "error"),
        Readout("shared", "Correlation with green, R / B", correlation),
        Readout("light", "Fidelity in light", light, "dB"),
        Readout("worst", "Worst error", format_number(errors.worst_codes, 0), "of 255", "error"),
    )


def describe(words: str, settings: Settings, errors: Errors) -> str:
    """The mosaic of a picture and its reconstruction in words."""
    where = ", most where detail is sharp or fine" if errors.worst_codes > 1 else ""
    share = format_number(100 * settings.split, 0)
    return (
        f"The mosaic of {words}, where every cell shows red, green or blue alone, green at half of "
        f"them. The left {share} % are demosaiced by the method {METHOD_LABELS[settings.method]}: "
        f"{format_number(errors.psnr_db, 1)} dB on the screen, with errors of up to "
        f"{errors.worst_codes} codes{where}."
    )


def estimate(_settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """Error of each colour of the reconstruction. The method, a control of this figure, is the
    tier.
    """
    text = ", ".join(format_number(codes, 1) for codes in rms_codes(outputs["error"]))
    yield Readout("error", "RMS error of red, green, blue", text, "codes of 255", "error")


SCENE = Scene(
    id="bayer-demosaic",
    title="Bayer Pattern",
    settings=Settings,
    draw=draw,
    formula=bilinear,
    stages=STAGES,
    handles=HANDLES,
    photograph=PHOTOGRAPH_PX,
    ladder="demosaicing",
    estimate=estimate,
)
