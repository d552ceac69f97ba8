"""Charts of ladders: honest axes, every point named, the front joined, the beaten grey."""

import re
from itertools import combinations, pairwise, product

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.toy_ladder import toy_measurements

from site_builder.charts.axes import linear_axis, log_axis
from site_builder.charts.boxes import Box
from site_builder.charts.label_placement import Label, place_labels
from site_builder.charts.pareto import pareto_chart
from site_builder.measured.quantities import error_text, quantity


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"), (1234.0, "1200"), (123456.0, "1.2\u202f×\u202f10⁵"), (9.96, "10"),
        (0.00996, "0.010"), (6.23e-5, "6.2\u202f×\u202f10⁻⁵"), (-3.04, "−3.0"),
    ],
)  # fmt: skip
def test_quantities_have_two_digits(value: float, text: str) -> None:
    assert quantity(value) == text


@given(st.floats(1e-300, 1e300))
def test_a_quantity_is_within_half_a_unit_of_its_second_digit(value: float) -> None:
    text = quantity(value).translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789", "\u202f"))
    shown = float(re.sub(r"×10(?=[-\d])", "e", text))
    assert shown == pytest.approx(value, rel=0.0501)


def test_an_infinite_ratio_is_no_error() -> None:
    assert (error_text(None, "dB"), error_text(None, "px"), error_text(0.0, "px")) == (
        "∞", "none", "none",
    )  # fmt: skip


@given(st.lists(st.floats(1e-15, 1e6), min_size=1, max_size=9))
def test_a_log_axis_holds_every_value_and_keeps_their_order(values: list[float]) -> None:
    axis = log_axis(values, 50.0, 446.0)
    places = [axis.position(value) for value in sorted(values)]
    assert places == sorted(places)
    assert all(50.0 < place < 446.0 for place in places)


@given(st.lists(st.floats(1e-15, 1e6), min_size=1, max_size=9))
def test_a_log_axis_has_a_readable_number_of_ticks_within_it(values: list[float]) -> None:
    axis = log_axis(values, 50.0, 446.0)
    ticks = [axis.position(value) for value, _ in axis.ticks()]
    assert 2 <= len(ticks) <= 10
    assert all(50.0 <= place <= 446.0 for place in ticks)
    assert len({label for _, label in axis.ticks()}) == len(ticks)


@given(st.lists(st.floats(-60.0, 120.0), min_size=1, max_size=9))
def test_a_linear_axis_has_a_readable_number_of_ticks_within_it(values: list[float]) -> None:
    axis = linear_axis(values, 270.0, 34.0)
    assert 2 <= len(axis.ticks()) <= 8
    assert all(34.0 <= axis.position(value) <= 270.0 for value, _ in axis.ticks())


def test_a_decade_is_as_long_anywhere_on_a_log_axis() -> None:
    axis = log_axis([0.01, 100.0], 0.0, 440.0)
    places = [axis.position(10.0**power) for power in (-2, -1, 0, 1, 2)]
    assert [b - a for a, b in pairwise(places)] == pytest.approx([100.0] * 4)


def test_what_has_no_error_stands_in_a_row_of_its_own() -> None:
    chart = pareto_chart(toy_measurements().find("toy"))
    assert chart.error.none is not None
    smallest = chart.error.position(0.02)
    assert chart.error.position(0.0) == chart.error.none > smallest + 10.0


def test_a_chart_joins_the_front_and_greys_what_is_beaten() -> None:
    chart = pareto_chart(toy_measurements().find("toy"))
    native, browser = re.findall(
        r'<polyline class="image faint(?: dashed)?" points="([^"]*)"', chart.marks
    )
    assert len(native.split()) == len(browser.split()) == 3
    assert chart.marks.count('class="muted solid"') == 1
    assert chart.marks.count('class="muted hollow"') == 1
    assert "Clearly beaten: Waste." in chart.description


FRAME = Box(0, 0, 460, 320)


def dot(x: float, y: float) -> Box:
    return Box(x - 5, y - 5, x + 5, y + 5)


def box_of(label: Label, name_width: float) -> Box:
    left = label.x - {"start": 0.0, "middle": 0.5, "end": 1.0}[label.anchor] * name_width
    return Box(left, label.y - 11, left + name_width, label.y + 2)


@given(
    st.lists(
        st.tuples(st.floats(60, 400), st.floats(40, 260), st.integers(4, 22)),
        min_size=1,
        max_size=8,
    )
)
def test_every_point_gets_one_name_inside_the_chart(points: list[tuple[float, float, int]]) -> None:
    items = [("x" * length, [dot(x, y)]) for x, y, length in points]
    labels = place_labels(items, FRAME)
    assert [label.text for label in labels] == [name for name, _ in items]
    for label in labels:
        assert 0 <= label.x <= 460
        assert 0 <= label.y <= 320


def test_names_of_points_apart_do_not_overlap() -> None:
    items = [("a long name", [dot(100, y)]) for y in (50, 54, 90)]
    boxes = [box_of(label, 65.0) for label in place_labels(items, FRAME)]
    assert all(a.overlap(b) == 0.0 for a, b in combinations(boxes, 2))


def test_no_name_covers_a_dot_where_the_chart_has_room() -> None:
    """Three tiers from the same start, nearly equal in error, as for a strong pincushion."""
    pairs = [(150, 60), (230, 61), (260, 66)]
    items = [("Fixed point", [dot(x, y), dot(x + 60, y)]) for x, y in pairs]
    labels = place_labels(items, FRAME)
    for label, other in product(labels, [dot for _, dots in items for dot in dots]):
        assert box_of(label, 62.0).overlap(other) == 0.0


def test_a_lone_name_stands_beside_its_dot_without_a_line() -> None:
    (label,) = place_labels([("name", [dot(200, 100)])], FRAME)
    assert box_of(label, 30.0).gap(dot(200, 100)) < 7.0
    assert label.leader is None


def test_a_name_crowded_away_from_its_dot_is_tied_to_it() -> None:
    crowd = [("y" * 20, [dot(200 + x, 100 + y)]) for x in (-14, 0, 14) for y in (-14, 0, 14)]
    tied = [label.leader for label in place_labels(crowd, FRAME)]
    assert any(tied)
    for leader, (_, (own,)) in zip(tied, crowd, strict=True):
        assert leader is None or own.nearest(leader[1]) == leader[1]


def test_a_name_keeps_off_a_line_where_there_is_room_beside_it() -> None:
    across = [((100.0, 100.0), (460.0, 100.0))]
    (label,) = place_labels([("name", [dot(100, 100)])], FRAME, across)
    assert box_of(label, 30.0).length_inside(across[0]) == 0.0


@pytest.mark.parametrize(
    ("segment", "length"),
    [
        (((-5.0, 5.0), (15.0, 5.0)), 10.0),
        (((2.0, 5.0), (4.0, 5.0)), 2.0),
        (((5.0, -5.0), (5.0, 5.0)), 5.0),
        (((-5.0, 20.0), (15.0, 20.0)), 0.0),
        (((0.0, -10.0), (20.0, 10.0)), 0.0),
        (((-5.0, -5.0), (15.0, 15.0)), 10.0 * 2**0.5),
    ],
)
def test_a_box_tells_how_much_of_a_line_it_hides(
    segment: tuple[tuple[float, float], tuple[float, float]], length: float
) -> None:
    assert Box(0, 0, 10, 10).length_inside(segment) == pytest.approx(length)
