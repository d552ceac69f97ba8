"""A picture through a Bayer mosaic, its reconstruction, and what the reconstruction got wrong.

The sensor counts light, so the mosaic and its reconstruction are linear; what is shown and judged
is encoded for a display. What is computed stands in `simulations.scenes.bayer_demosaic.stages`.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from simulations.engine.controls import Value
from simulations.engine.frame import Frame, Panel, Readout, format_number
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.engine.settings import action, choice
from simulations.engine.stages import Outputs
from simulations.models.color.srgb import encode_srgb
from simulations.models.sensor.bayer import through_filters
from simulations.pictures.balloon import WIDTH as PICTURE_WIDTH
from simulations.pictures.balloon import Window
from simulations.pictures.mosaic_subjects import SUBJECTS
from simulations.scenes.bayer_demosaic import drawing
from simulations.scenes.bayer_demosaic.stages import PATTERN, STAGES, Errors, Picture, rms_codes

AMPLIFY = 4
"""Factor of the error picture: a quarter of the range off is shown in full."""
UNITS_PER_PIXEL = drawing.WIDTH / PICTURE_WIDTH
NOTHING_TO_JUDGE = ("—",) * 4
"""The texts of `_merits` while there is only a mosaic."""

METHOD_LABELS = {
    "nearest": "Nearest",
    "bilinear": "Bilinear",
    "malvar": "Malvar–He–Cutler 2004",
    "menon-unrefined": "Menon 2007, unrefined",
    "menon": "Menon 2007",
    "menon-encoded": "Menon, unrefined, on encoded values",
}


@dataclass(frozen=True, slots=True)
class Settings:
    """What the reader may change."""

    demosaic: int = action("Demosaic", "Show the mosaic")
    method: str = choice("Method", METHOD_LABELS, "menon-unrefined")
    picture: str = choice("Picture", {name: each.label for name, each in SUBJECTS.items()})
    view: str = choice("View", {"whole": "Whole picture", "close": "Close-up"})


def parameters(settings: Settings, _tier: str) -> dict[str, Value]:
    """A mosaic seen from close up needs no whole picture; the judge of a reconstruction does."""
    alone = settings.view == "close" and not settings.demosaic
    return {"part": "close-up" if alone else "whole"}


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The mosaic or its reconstruction by the chosen method, and what is wrong with it."""
    window = SUBJECTS[settings.picture].close_up
    close = settings.view == "close"
    if settings.demosaic:
        panels = _reconstruction(outputs, window if close else None)
        merits, words = _merits(*_measured(outputs)), describe(settings, outputs["error"])
    else:
        panels = _close_mosaic(outputs) if close else _mosaic(outputs, window)
        merits, words = _merits(*NOTHING_TO_JUDGE), describe(settings)
    return Frame(panels, (_shares(), *merits), words)


def _mosaic(outputs: Outputs, window: Window) -> tuple[Panel, Panel]:
    """What the sensor measured, beside the same few pixels enlarged."""
    seen = encode_srgb(through_filters(outputs["mosaic"], PATTERN))
    frame = drawing.close_up_frame(window.top, window.left, UNITS_PER_PIXEL)
    # The finest pattern there is would beat with the screen's own pixels: two samples a cell.
    seen_twice = seen.repeat(2, axis=0).repeat(2, axis=1)
    letters = drawing.filter_letters(PATTERN)
    return (
        _panel("picture", "The mosaic", seen_twice, frame, close=False),
        _panel("error", "Enlarged: one filter per cell", _cut(seen, window), letters, close=True),
    )


def _close_mosaic(outputs: Outputs) -> tuple[Panel, Panel]:
    """A few pixels of the mosaic, and of the picture behind it."""
    seen = encode_srgb(through_filters(outputs["mosaic"], PATTERN))
    truth = encode_srgb(outputs["picture"])
    return (
        _panel("picture", "The mosaic", seen, "", close=True),
        _panel("error", "The truth, which no cell saw", truth, "", close=True),
    )


def _reconstruction(outputs: Outputs, window: Window | None) -> tuple[Panel, Panel]:
    """The demosaiced picture, or a part of it, beside its amplified error."""
    errors: Errors = outputs["error"]
    shown, wrong = outputs["display"], AMPLIFY * errors.absolute
    if window:
        shown, wrong = _cut(shown, window), _cut(wrong, window)
    mark = "" if window else drawing.worst_pixel(*errors.worst_at, UNITS_PER_PIXEL)
    close = window is not None
    return (
        _panel("picture", "The reconstruction", shown, mark, close),
        _panel("error", f"Error × {AMPLIFY}", wrong, mark, close),
    )


def _panel(name: str, title: str, picture: Picture, overlay: str, close: bool) -> Panel:
    """A close-up shows its pixels as squares; a whole picture is smoothed to the screen's."""
    raster = to_rgba8(picture)
    return Panel(name, title, drawing.WIDTH, drawing.HEIGHT, raster, overlay, pixelated=close)


def _cut(picture: Picture, window: Window) -> Picture:
    rows = slice(window.top, window.top + window.height)
    return picture[rows, window.left : window.left + window.width]


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


def describe(settings: Settings, errors: Errors | None = None) -> str:
    """The picture in one sentence: the mosaic, or a reconstruction with these errors."""
    words = SUBJECTS[settings.picture].words
    if errors is None:
        return (
            f"The sensor's view of {words}: every cell has measured only one of red, green "
            "and blue, green at half of them."
        )
    method = METHOD_LABELS[settings.method]
    return (
        f"The picture of {words}, demosaiced by the method {method}: {errors.psnr_db:.1f} dB as "
        f"displayed, with errors of up to {errors.worst_codes} codes where detail is sharp or fine."
    )


def estimate(settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """How far each colour of the reconstruction is from the picture that the mosaic was taken from.

    The method is a control of this figure: it stands for the tier.
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
    parameters=parameters,
    ladder="demosaicing",
    estimate=estimate,
)
