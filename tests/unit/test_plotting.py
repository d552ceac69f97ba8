"""Plots: places of values, round ticks, clipping, and labels that do not overlap."""

import math
import re
from itertools import combinations
from types import SimpleNamespace
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.label_boxes import in_figures, labels

from simulations.engine.letters import width_of
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.clipping import clipped
from simulations.engine.plotting.labels import Label, Rectangle, name_curves, place_labels
from simulations.engine.plotting.matplotlib import plots_of
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.engine.plotting.ticks import log_ticks, round_ticks

PLOT = Plot(Axis(0, 10, 40, 390), Axis(1e-3, 10, 240, 20, log=True))
UNIT = Plot(Axis(0, 1, 0, 100), Axis(0, 1, 50, 0))
WHOLE = Rectangle(0, 0, 400, 300)
WORDS = (
    "Nyquist", "cut-off 1/λN", "shot noise: mean / g", "WWW", "illicit", "0.001", "variance, DN²",
    "angle of the light from the normal, °", "f = 0.30", "10⁻⁵", "MTF50", "ÅÉÖ",
    "radius in the image",
)  # fmt: skip


def points(markup: str) -> list[tuple[float, float]]:
    """All points of a polyline, a polygon or a path."""
    element = ElementTree.fromstring(markup)
    data = element.get("points") or element.get("d") or ""
    values = [float(value) for value in re.findall(r"-?[\d.]+", data)]
    return list(zip(values[::2], values[1::2], strict=True))


def boxes(wanted: list[Label], **more: Any) -> list[Rectangle]:
    markup = place_labels(wanted, WHOLE, **more)
    return [label.box for label in labels(markup, in_figures)]


@pytest.mark.parametrize(
    ("axis", "value", "place"),
    [
        (Axis(0, 10, 100, 200), 2.5, 125),
        (Axis(0, 10, 200, 100), 2.5, 175),
        (Axis(1, 1e4, 0, 100, log=True), 100, 50),
    ],
)
def test_axis_places_a_value(axis: Axis, value: float, place: float) -> None:
    assert axis.place(value) == pytest.approx(place)
    assert float(axis.position(value)) == pytest.approx(place)


@given(st.floats(-20, 20), st.booleans())
def test_position_on_an_axis_maps_back_to_its_value(exponent: float, log: bool) -> None:
    axis = Axis(0.01, 1000, 380, 20, log)
    value = 10.0 ** (exponent / 4) if log else exponent
    assert axis.value(axis.place(value)) == pytest.approx(value, rel=1e-9, abs=1e-9)
    assert PLOT.values(PLOT.at(3.0, 0.2)) == pytest.approx((3.0, 0.2))


@given(st.floats(-1e6, 1e6), st.floats(1e-6, 1e6), st.integers(2, 9))
def test_ticks_are_round_evenly_spaced_inside_and_few(low: float, span: float, most: int) -> None:
    ticks = [value for value, _ in round_ticks(low, low + span, most)]
    assert len(ticks) <= most
    assert all(low - 1e-6 * span <= value <= low + span + 1e-6 * span for value in ticks)
    steps, rounding = np.diff(ticks), np.spacing(max(abs(low), abs(low + span)))
    round_steps = [float(f"{step:.0e}") for step in steps]
    assert len(set(round_steps)) <= 1
    assert {f"{step:.0e}"[0] for step in round_steps} <= set("125")
    assert steps == pytest.approx(round_steps, rel=1e-9, abs=2 * rounding)


@pytest.mark.parametrize(
    ("ticks", "ends", "words"),
    [
        (round_ticks, (0, 1.5), "0 0.5 1 1.5"),
        (round_ticks, (-3, 3), "−2 0 2"),
        (round_ticks, (0, 90), "0 20 40 60 80"),
        (log_ticks, (0.8, 24), "1 2 5 10 20"),
        (log_ticks, (0.02, 4), "0.03 0.1 0.3 1 3"),
        (log_ticks, (0.0005, 0.05), "0.001 0.003 0.01 0.03"),
        (log_ticks, (1, 1e4), "1 10 100 1000 10000"),
        (log_ticks, (1e-17, 0.1), "10⁻¹⁵ 10⁻¹² 10⁻⁹ 10⁻⁶ 10⁻³"),
    ],
)
def test_tick_labels_are_short(ticks: Any, ends: tuple[float, float], words: str) -> None:
    assert " ".join(name for _, name in ticks(*ends)) == words


def test_each_tick_label_is_below_its_value() -> None:
    frame = PLOT.frame(Scale("time", "s", ticks=(2, 5, 8)), Scale("light"))
    names = {label.text: label.box for label in labels(frame, in_figures)}
    for value in (2, 5, 8):
        box = names[f"{value}"]
        assert (box.left + box.right) / 2 == pytest.approx(PLOT.x.place(value), abs=0.1)
    assert {"time, s", "light"} <= set(names)
    marks = PLOT.x_axis(Scale(ticks=[(2, "two"), (3, "")]))
    assert marks.count("M") == 2
    assert re.findall(">([^<]*)</text>", marks) == ["two"]


@given(*(st.floats(-30, 130).map(lambda place: round(place, 4)) for _ in range(4)))
def test_clipped_segment_is_the_part_inside(x0: float, y0: float, x1: float, y1: float) -> None:
    left = clipped((x0, y0), (x1, y1), (0.0, 100.0), (0.0, 50.0))
    shares = np.linspace(0, 1, 401)
    x, y = x0 + shares * (x1 - x0), y0 + shares * (y1 - y0)
    depth = np.minimum(np.minimum(x, 100 - x), np.minimum(y, 50 - y))
    if left is None:
        assert not (depth > 1e-6).any()
        return
    length, inside = math.dist((x0, y0), (x1, y1)), depth > -1e-6
    assert math.dist(*left) == pytest.approx(length * inside.mean(), abs=length / 100 + 1e-6)


def test_curves_areas_regions_and_rules_end_at_the_plot() -> None:
    plot = Plot(Axis(0, 8, 0, 80), Axis(0, 1, 10, 0))
    heights = [0.5, 0.5, 1.5, 0.5, 0.5, np.nan, 0.5, 0.5, 0.5]
    runs = plot.pieces(range(9), heights)
    assert [[x for x, _ in run] for run in runs] == [[0, 10, 15], [25, 30, 40], [60, 70, 80]]
    assert points(UNIT.area([0.2, 0.6], [1.0, 0.5])) == [(20, 50), (20, 0), (60, 25), (60, 50)]
    corners = points(UNIT.region(x=(0.5, 7.0)))
    assert sorted(corners) == [(50, 0), (50, 50), (100, 0), (100, 50)]
    assert PLOT.upright(11) == PLOT.level(1e-4) == ""


@pytest.mark.parametrize("style", ["", "small", "strong"])
def test_estimated_width_of_text_covers_its_drawn_width(style: str) -> None:
    for words in WORDS:
        (shown,) = labels(f'<text class="{style}" x="0" y="0">{words}</text>', in_figures)
        measured = shown.box.right - shown.box.left
        assert measured <= width_of(words, style) <= 1.5 * measured, words


@given(
    st.lists(st.tuples(st.floats(60, 340), st.floats(40, 260)), min_size=1, max_size=5),
    st.lists(st.sampled_from(WORDS[:6]), min_size=5, max_size=5),
)
def test_labels_lie_inside_and_do_not_overlap(
    where: list[tuple[float, float]], words: list[str]
) -> None:
    placed = boxes([Label(point, name) for point, name in zip(where, words, strict=False)])
    assert len(placed) == len(where)
    assert all(box.sticks_out_of(WHOLE) < 1e-6 for box in placed)
    assert all(a.shared(b) < 1e-6 for a, b in combinations(placed, 2))


def test_label_avoids_curves_and_other_labels() -> None:
    curve = [(0.0, 138.0), (400.0, 138.0)]  # through the words right above the point
    (box,) = boxes([Label((200, 150), "peak")], curves=[curve])
    assert not box.top < 138 < box.bottom
    others = Label((200, 150), "peak", others=[(50, 150)])
    (box,) = boxes([others], taken=[Rectangle(100, 0, 400, 300)])
    assert box.right < 100
    (box,) = boxes([Label((396, 150), "radius in the image", prefer="above")])
    assert box.left < 396 < box.right <= 400


def test_label_far_from_its_point_has_a_leader() -> None:
    crowd = [Label((200, 150 + n), "a long name", leader="muted thin") for n in range(12)]
    assert "<line" not in place_labels(crowd[:1], WHOLE)
    assert 'class="muted thin"' in place_labels(crowd, WHOLE)


def test_curves_are_named_beside_themselves_and_off_all_curves() -> None:
    x = np.linspace(0, 10, 61)
    curves = {"low": 0.01 + 0 * x, "middle": 0.3 + 0 * x, "rising": 0.5 * 10 ** (x / 10)}
    drawn = name_curves(PLOT, x, [(name, "ray bold", y) for name, y in curves.items()])
    for label in labels(f"<svg>{drawn}</svg>", in_figures):
        middle, box = (label.box.top + label.box.bottom) / 2, label.box
        under = (PLOT.x.position(x) > box.left) & (PLOT.x.position(x) < box.right)
        rows = {name: PLOT.y.position(y)[under] for name, y in curves.items()}
        assert not any(((row > box.top) & (row < box.bottom)).any() for row in rows.values())
        assert label.text == min(rows, key=lambda name: np.abs(rows[name] - middle).min())


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Axis(1.0, 1.0, 0, 100), "two finite ends"),
        (lambda: Axis(0.0, math.inf, 0, 100), "two finite ends"),
        (lambda: Axis(math.nan, 1.0, 0, 100), "two finite ends"),
        (lambda: Axis(0, 10, 0, 100, log=True), "not above 0"),
        (lambda: Axis(1, 10, 0, 100, log=True).place(0.0), "no place"),
        (lambda: Label((0, 0), "peak", prefer="over"), "legal: 'above right'"),
    ],
)
def test_invalid_axis_or_label_is_refused(make: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()


class Line2D(SimpleNamespace):
    """The part of matplotlib's Line2D that is read; its transform halves coordinates."""

    def get_transform(self) -> float:
        return 0.5

    def __getattr__(self, name: str) -> Any:
        return lambda: vars(self)[name.removeprefix("get_")]


class Halved(float):
    def __rsub__(self, other: float) -> Any:
        return SimpleNamespace(transform=lambda points: other * points)


def test_matplotlib_figure_becomes_a_plot_with_its_lines_and_colours() -> None:
    look = {"zorder": 1, "visible": True, "marker": "None", "linestyle": "--"}
    xy = np.array([[0.0, 0.0], [8.0, 4.0]])
    lines = [Line2D(xydata=xy, color=c, label=c, **look) for c in ("C0", "C1", "C0")]
    given = {"xscale": "linear", "yscale": "linear", "xlim": (0, 4), "ylim": (0, 2), "legend": 1}
    named = {"xlabel": "time, s", "ylabel": "speed", "title": "Two"}
    axes = Line2D(children=lines, **given, **named)
    for name in ("patch", "_left_title", "_right_title"):
        setattr(axes, name, None)
    axes.transData = Halved()
    ((title, plot),) = plots_of(SimpleNamespace(axes=[axes]))
    found = re.findall(r'class="(\w+) dashed bold" d="([^"]+)"', plot.markup)
    assert [role for role, _ in found] == ["world", "camera", "world"]
    assert {data for _, data in found} == {"M50,240L388,30"}
    assert (title, plot.names) == ("Two", ("time, s", "speed"))
