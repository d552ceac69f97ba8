"""A picture through a Bayer mosaic, its reconstruction, and what the reconstruction got wrong.

The sensor counts light, so the mosaic and its reconstruction are linear; what is shown and judged
is encoded for a display. What is computed stands in `simulations.scenes.bayer_demosaic.stages`.
"""

from collections.abc import Iterator

from simulations.engine.controls import Action, Choice, Values
from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.engine.stages import Run, StageCache, run
from simulations.models.color.srgb import encode_srgb
from simulations.models.sensor.bayer import through_filters
from simulations.pictures.balloon import WIDTH as PICTURE_WIDTH
from simulations.pictures.balloon import Window
from simulations.pictures.mosaic_subjects import SUBJECTS
from simulations.scenes.bayer_demosaic import drawing
from simulations.scenes.bayer_demosaic.stages import (
    CLOSE_STAGES,
    MOSAIC_STAGES,
    PATTERN,
    STAGES,
    Errors,
    Picture,
    rms_codes,
)

AMPLIFY = 4
"""Factor of the error picture: a quarter of the range off is shown in full."""
UNITS_PER_PIXEL = drawing.WIDTH / PICTURE_WIDTH

METHOD_LABELS = {
    "nearest": "Nearest",
    "bilinear": "Bilinear",
    "malvar": "Malvar–He–Cutler 2004",
    "menon-unrefined": "Menon 2007, unrefined",
    "menon": "Menon 2007",
    "menon-encoded": "Menon, unrefined, on encoded values",
}
CONTROLS = (
    Action(name="demosaic", labels=("Demosaic", "Show the mosaic")),
    Choice(name="method", label="Method", default="menon-unrefined", options=METHOD_LABELS),
    Choice(
        name="picture",
        label="Picture",
        default="balloon",
        options={name: subject.label for name, subject in SUBJECTS.items()},
    ),
    Choice(
        name="view",
        label="View",
        default="whole",
        options={"whole": "Whole picture", "close": "Close-up"},
    ),
)


def render(values: Values, _tier: str, cache: StageCache) -> Frame:
    """The mosaic or its reconstruction by the chosen method, and what is wrong with it."""
    window = SUBJECTS[values.choice("picture")].close_up
    close = values.choice("view") == "close"
    if values.state("demosaic") == 1:
        done = run(STAGES, values, cache)
        panels = _reconstruction(done, window if close else None)
        merits = _merits(done)
    elif close:
        done = run(CLOSE_STAGES, values, cache)
        panels, merits = _close_mosaic(done), _no_merits()
    else:
        done = run(MOSAIC_STAGES, values, cache)
        panels, merits = _mosaic(done, window), _no_merits()
    return Frame(panels, (_shares(), *merits), describe(done, values), done.reports)


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


def _mosaic(done: Run, window: Window) -> tuple[Panel, Panel]:
    """What the sensor measured, beside the same few pixels enlarged."""
    seen = encode_srgb(through_filters(done.outputs["mosaic"], PATTERN))
    frame = drawing.close_up_frame(window.top, window.left, UNITS_PER_PIXEL)
    # The finest pattern there is would beat with the screen's own pixels: two samples a cell.
    seen_twice = seen.repeat(2, axis=0).repeat(2, axis=1)
    letters = drawing.filter_letters(PATTERN)
    return (
        _panel("picture", "The mosaic", seen_twice, frame, close=False),
        _panel("error", "Enlarged: one filter per cell", _cut(seen, window), letters, close=True),
    )


def _close_mosaic(done: Run) -> tuple[Panel, Panel]:
    """A few pixels of the mosaic, and of the picture behind it."""
    seen = through_filters(done.outputs["close-up mosaic"], PATTERN)
    truth = done.outputs["close-up"]
    return (
        _panel("picture", "The mosaic", encode_srgb(seen), "", close=True),
        _panel("error", "The truth, which no cell saw", encode_srgb(truth), "", close=True),
    )


def _reconstruction(done: Run, window: Window | None) -> tuple[Panel, Panel]:
    """The demosaiced picture, or a part of it, beside its amplified error."""
    errors: Errors = done.outputs["error"]
    shown, wrong = done.outputs["display"], AMPLIFY * errors.absolute
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


def _merits(done: Run) -> tuple[Readout, ...]:
    errors: Errors = done.outputs["error"]
    shared = " / ".join(format_number(each, 2) for each in done.outputs["shared detail"])
    return (
        Readout("shared", "Fine detail shared with green, R / B", shared),
        readout("psnr", "PSNR as displayed", errors.psnr_db, "dB", digits=1, role="error"),
        readout("light", "PSNR in light", errors.light_psnr_db, "dB", digits=1),
        readout("worst", "Worst error", errors.worst_codes, "of 255", digits=0, role="error"),
    )


def _no_merits() -> tuple[Readout, ...]:
    """Dashes while there is nothing to judge."""
    return (
        Readout("shared", "Fine detail shared with green, R / B", "—"),
        Readout("psnr", "PSNR as displayed", "—", "dB", "error"),
        Readout("light", "PSNR in light", "—", "dB"),
        Readout("worst", "Worst error", "—", "of 255", "error"),
    )


def describe(done: Run, values: Values) -> str:
    """The picture in one sentence."""
    words = SUBJECTS[values.choice("picture")].words
    if values.state("demosaic") == 0:
        return (
            f"The sensor's view of {words}: every cell has measured only one of red, green "
            "and blue, green at half of them."
        )
    errors: Errors = done.outputs["error"]
    method = METHOD_LABELS[values.choice("method")]
    return (
        f"The picture of {words}, demosaiced by the method {method}: {errors.psnr_db:.1f} dB as "
        f"displayed, with errors of up to {errors.worst_codes} codes where detail is sharp or fine."
    )


SCENE = Scene(
    id="bayer-demosaic",
    title="Bayer Pattern",
    controls=CONTROLS,
    render=render,
    ladder="demosaicing",
    error=error,
)
