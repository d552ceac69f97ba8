"""The photograph with its corners and their errors, and the plots: the error of each model of the
lens, and the focal length by the photographs."""

import math

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import circle, line, path, polygon, text
from simulations.engine.frame import format_number
from simulations.engine.letters import width_of
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale, small_scale
from simulations.engine.space.view import View
from simulations.models.arrays import Floats
from simulations.models.calibration.camera import LENSES, Poses
from simulations.models.calibration.left_out import Growth
from simulations.models.calibration.model_choice import FISHEYE, Trial
from simulations.models.calibration.views import Views
from simulations.scenes._turned_camera import draw_body, view_from
from simulations.scenes.calibration.boards import LEAST, MOST

WIDTH, HEIGHT = 400.0, 300.0  # of the plots; a photograph is as wide
ARROW, STROKE = 13.0, 7.0
"""Lengths that the RMS error is enlarged to, about: of one photograph, and of many."""
HEAD = 4.0
NAMES = ("photograph", "without distortion")
MARGIN = 10.0
LINE_AT = 0.9
"""Place of the handle on the dividing line, as a share of the height from the top."""

SIDEWAYS, AROUND, CAMERA = view_from(132.0, 20.0), 26.0, 40.0
"""View of the boards in space, their least distance from the border, and size of the camera."""
RIM = (0, 0), (1, 0), (1, 1), (0, 1)
LEFT, RIGHT, TOP, FOOT = 46.0, 388.0, 40.0, 220.0
TOP_GROWN, FOOT_GROWN = 84.0, 222.0
NUMBER = (16.0, 34.0)  # place of the one large number
ACROSS = Axis(0.0, float(len(LENSES)), LEFT, RIGHT)
COUNTS = Axis(LEAST, MOST, 58.0, RIGHT, log=True)  # of photographs
COUNTED = (3, 5, 10, 20, 40)
TERMS = ("none", "1", "2", "2 + 2", "3 + 2", "6 + 2", "fisheye")
TICKS = [(place + 0.5, terms) for place, terms in enumerate(TERMS)]
"""Each model has the terms of those before it, but the fisheye, which has its own four."""
SETTLED_FROM = 5
"""Count from which errors must fit into the plot; with fewer they may be huge."""
LEAST_REACH = 0.01
"""Pixels on both sides of the last focal length that the plot always shows."""
ROUND = tuple(step * 10.0**power for power in range(-7, 8) for step in (1.0, 2.0, 5.0))
"""Values at which an axis of errors may end."""
LINE, WORDS_PER_LINE = 18.0, 46
"""Distance between lines of text, and letters of a line across a panel."""


def view_box(size: tuple[int, int]) -> tuple[float, float]:
    """Width and height of the panel of a photograph of this size."""
    return WIDTH, size[1] * WIDTH / size[0]


def enlargement(rms_px: float, size: tuple[int, int], length: float = ARROW) -> float:
    """1, 2 or 5 times a power of ten, by which errors of this size become visible arrows."""
    wanted = length / max(rms_px * WIDTH / size[0], 1e-9)
    power = 10.0 ** math.floor(math.log10(wanted))
    return max(step * power for step in (1.0, 2.0, 5.0) if step * power <= wanted)


def error_arrows(
    found: Floats, off: Floats, size: tuple[int, int], times: float, *, many: bool
) -> str:
    """The found corners (N, 2) of one photograph, each with its error, ``times`` enlarged, as an
    arrow; of many photographs, strokes that start at their corners."""
    scale = WIDTH / size[0]
    start = (found + 0.5) * scale
    shaft = off * (times * scale)
    end = start + shaft
    strokes = [*np.stack((start, end), axis=1)]
    marks = ""
    if not many:
        length = np.maximum(np.hypot(*shaft.T), 1e-9)[:, None]
        along = (end - start) / length * np.minimum(HEAD, 0.6 * length)
        across = along[:, ::-1] * (0.45, -0.45)
        strokes += [*np.stack((end - along + across, end, end - along - across), axis=1)]
        marks = "".join(circle(place, 2.2, "image thin") for place in start)
    return marks + path(strokes, "casing") + path(strokes, "error")


def enlarged(times: float, used: bool) -> str:
    """The scale of the arrows."""
    words = f"errors × {format_number(times, 0 if times >= 1 else 1)}"
    if not used:
        words += ", photograph not used"
    return text((MARGIN, 20.0), words, "error small ground")


def boards_in_space(views: Views, poses: Poses, shown: int) -> str:
    """The boards where the fit finds them, before the camera; the one that is shown in squares."""
    ends = views.board.min(axis=1) - 1.0, views.board.max(axis=1) + 1.0  # with the outer squares
    rims = np.stack([[ends[i][:, 0], ends[j][:, 1]] for i, j in RIM])  # (4, 2, P)
    boards = poses.place(np.moveaxis(rims, 2, 0))
    seen = View(SIDEWAYS).all(np.concatenate([boards.reshape(-1, 3), np.zeros((1, 3))]))
    low, high, size = seen.min(axis=0), seen.max(axis=0), np.array([WIDTH, HEIGHT])
    unit = float(min((size - 2.0 * AROUND) / np.maximum(high - low, 1.0)))
    x, y = (size / 2.0 - unit * (low + high) / 2.0).tolist()
    look = View(SIDEWAYS, (x, y), unit)
    parts = [polygon(look.all(board), "world thin fill") for board in boards]
    if 0 <= shown < len(boards):
        first, last = (end[shown].astype(int) for end in ends)
        columns, rows = np.mgrid[first[0] : last[0], first[1] : last[1]].reshape(2, -1)
        dark = np.stack([columns, rows], axis=-1)[(columns + rows) % 2 == 0]
        squares = (dark[:, None] + RIM).reshape(1, -1, 2)
        places = look.all(poses.take([shown]).place(squares)[0]).reshape(-1, 4, 2)
        parts.append(polygon(look.all(boards[shown]), "casing solid"))
        parts.append(polygon(look.all(boards[shown]), "image"))
        parts += [polygon(square, "image solid") for square in places]
    return "".join(parts) + draw_body(np.eye(3), SIDEWAYS, (x, y), CAMERA)


def dividing_line(share: float, size: tuple[int, int]) -> str:
    """The line between the photograph and the undistorted one, and their names where there is
    room."""
    width, height = view_box(size)
    x, foot = share * width, height - MARGIN
    if share == 1.0:
        return text((width - 30.0, LINE_AT * height + 4.0), NAMES[1], "small ground", "end")
    parts = [line((x, 0), (x, height), style) for style in ("casing", "image bold")]
    if x > width_of(NAMES[0], "small") + 2 * MARGIN:
        parts.append(text((MARGIN, foot), NAMES[0], "small ground"))
    if width - x > width_of(NAMES[1], "small") + 2 * MARGIN:
        parts.append(text((width - MARGIN, foot), NAMES[1], "small ground", "end"))
    return "".join(parts)


def place_of(lens: str) -> float:
    """The middle of a model's column."""
    return list(LENSES).index(lens) + 0.5


def error_plot(trials: tuple[Trial, ...]) -> Plot:
    """Errors on a logarithmic axis between round values."""
    values = [t.rms_px for t in trials] + [t.left_out_px for t in trials]
    usable = [value for value in values if 1e-6 < value < 1e6] or [1.0]
    low = max(value for value in ROUND if value <= 0.9 * min(usable))
    high = min(value for value in ROUND if value >= 1.1 * max(usable))
    return Plot(ACROSS, Axis(low, high, FOOT, TOP, log=True))


def model_errors(trials: tuple[Trial, ...], chosen: Trial) -> str:
    """The error of each model on the photographs used and left out."""
    plot, middle = error_plot(trials), place_of(chosen.lens)
    x = [place_of(trial.lens) for trial in trials]
    used, left_out = [t.rms_px for t in trials], [t.left_out_px for t in trials]
    series = sum(trial.lens != FISHEYE for trial in trials)  # what a line may join
    round_errors = _ticks(plot.y)
    entries = (Entry("photographs used", "image", "dot"), Entry("left out", "error", "dot"))
    parts = [
        plot.region(x=(middle - 0.5, middle + 0.5)),
        plot.frame(
            Scale("terms: radial + tangential", ticks=TICKS, style="small"),
            small_scale("RMS error", "px", round_errors, grid=round_errors),
        ),
        plot.curve(x[:series], used[:series], "image"),
        plot.curve(x[:series], left_out[:series], "error bold"),
        *(plot.mark(at, error, "image", 3.0) for at, error in zip(x, used, strict=True)),
        *(
            plot.mark(at, min(error, plot.y.high), "error", 4.0)
            for at, error in zip(x, left_out, strict=True)
        ),
        text((plot.x.place(middle), TOP - 8.0), "supported", "small", "middle"),
        legend((LEFT, 282.0), entries, "small", RIGHT - LEFT),
    ]
    return "".join(parts)


def _ticks(axis: Axis) -> list[float]:
    """Round values between the ends; of more than five, the powers of ten and the ends."""
    inside = [value for value in ROUND if axis.low <= value <= axis.high]
    if len(inside) <= 5:
        return inside
    powers = [v for v in inside if abs(math.log10(v) - round(math.log10(v))) < 1e-9]
    return sorted({axis.low, *powers, axis.high} & {*inside})


def growth_plot(grown: Growth, truth: float | None) -> Plot:
    """The focal length with its errors, from `SETTLED_FROM` photographs on or of all, if these are
    fewer, and the truth."""
    known = np.isfinite(grown.value) & np.isfinite(grown.error)
    known &= np.array(grown.counts) >= min(SETTLED_FROM, grown.counts[-1])
    ends = [grown.value[-1] - LEAST_REACH, grown.value[-1] + LEAST_REACH]
    ends += [*(grown.value - grown.error)[known], *(grown.value + grown.error)[known]]
    if truth is not None:
        ends.append(truth)
    spare = 0.1 * (max(ends) - min(ends))
    return Plot(COUNTS, Axis(min(ends) - spare, max(ends) + spare, FOOT_GROWN, TOP_GROWN))


def growth(grown: Growth, count: int, truth: float | None, focal: str) -> str:
    """The focal length ± its standard error, large, and how it grew with the photographs."""
    plot = growth_plot(grown, truth)
    counts = np.array(grown.counts, float)
    error = np.where(np.isfinite(grown.error), grown.error, 1e6)
    value = np.where(np.isfinite(grown.value), grown.value, grown.value[-1])
    here = grown_at(grown, count)
    entries = [Entry("± one standard error", "image fill faint", "area")]
    if truth is not None:
        entries.append(Entry("the truth", "world dashed"))
    parts = (
        text(NUMBER, f"{focal} px", "large image"),
        plot.between(counts, value + error, value - error, "image fill faint"),
        plot.frame(
            small_scale("photographs", ticks=COUNTED),
            small_scale("f_x", "px"),
        ),
        plot.curve(counts, value, "image bold"),
        "" if truth is None else plot.level(truth, "world dashed"),
        plot.upright(here[0], "muted thin"),
        plot.mark(*here, "image", 4.5),
        legend((58.0, 282.0), entries, "small"),
    )
    return "".join(parts)


def grown_at(grown: Growth, count: int) -> tuple[float, float]:
    """A count of photographs within those known, and its focal length, or the last if that is not
    determined."""
    index = min(max(count - grown.counts[0], 0), len(grown.counts) - 1)
    value = float(grown.value[index])
    determined = math.isfinite(value) and value > 0.0
    return float(grown.counts[index]), value if determined else float(grown.value[-1])


def count_of(place: float) -> float:
    """The count of photographs at a place across its plot."""
    return COUNTS.value(min(max(place, COUNTS.start), COUNTS.end))


def in_words(sentence: str) -> str:
    """A sentence in place of a plot."""
    lines: list[str] = [""]
    for word in sentence.split():
        joined = f"{lines[-1]} {word}".strip()
        if len(joined) > WORDS_PER_LINE:
            lines.append(word)
        else:
            lines[-1] = joined
    top = HEIGHT / 2 - LINE * (len(lines) - 1) / 2
    return "".join(
        label((WIDTH / 2, top + LINE * index), words, "", "middle")
        for index, words in enumerate(lines)
    )
