"""Names in a chart: every point named, near its dot, covering no other."""

from itertools import combinations, product

from hypothesis import given
from hypothesis import strategies as st

from site_builder.charts.boxes import Box
from site_builder.charts.label_placement import Label, place_labels

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
