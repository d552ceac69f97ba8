"""Space on a panel: the view is a camera's, what is far is hidden by what is near."""

import math
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.engine.space.solids import (
    Arrow,
    Dot,
    Face,
    Solid,
    Wire,
    Words,
    drawn,
    shaded,
)
from simulations.engine.space.view import View, axes_towards, orbit, orbit_axes, runs

ANGLES = st.tuples(st.floats(-180, 180), st.floats(-89, 89))
SQUARE = np.array([[0.0, -1, -1], [0, 1, -1], [0, 1, 1], [0, -1, 1]])
"""Across the x axis."""
AHEAD = np.array([1.0, 0.0, 0.0])


def towards(azimuth: float, elevation: float) -> np.ndarray:
    turn, rise = math.radians(azimuth), math.radians(elevation)
    level = math.cos(rise)
    return np.array([level * math.cos(turn), level * math.sin(turn), math.sin(rise)])


@given(ANGLES)
def test_an_orbit_is_that_of_a_camera_that_looks_at_the_origin(angles: tuple[float, float]) -> None:
    forward = -towards(*angles)
    right = np.cross(forward, (0, 0, 1))
    right /= np.linalg.norm(right)
    expected = (right, np.cross(forward, right), forward)
    np.testing.assert_allclose(orbit_axes(*angles), expected, atol=1e-9)
    np.testing.assert_allclose(axes_towards(towards(*angles)), expected, atol=1e-9)


@given(ANGLES, st.booleans())
def test_the_axes_are_a_right_handed_frame(angles: tuple[float, float], z_down: bool) -> None:
    axes = orbit_axes(*angles, z_down=z_down)
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(np.cross(axes[0], axes[1]), axes[2], atol=1e-12)


@pytest.mark.parametrize("direction", [(0, 0, 1), (0, 0, 0), (math.nan, 0, 0)])
def test_a_direction_without_an_upright_is_refused(direction: tuple[float, float, float]) -> None:
    with pytest.raises(ValueError, match="legal"):
        axes_towards(direction)


def test_the_target_lies_at_the_centre() -> None:
    view = orbit(40, 20, centre=(200, 150), unit=80, target=(1, 2, 3), distance=4)
    np.testing.assert_allclose(view.place((1, 2, 3)), (200, 150, 0), atol=1e-9)


def test_parallels_stay_parallel_from_afar() -> None:
    ends = orbit(40, 20, unit=80).all([[(0, 0, 0), (1, 0, 0)], [(0, 2, 1), (1, 2, 1)]])
    np.testing.assert_allclose(ends[0, 1] - ends[0, 0], ends[1, 1] - ends[1, 0])


def test_sizes_fall_with_the_distance_of_the_eye() -> None:
    view = orbit(0, 0, unit=10, distance=5)  # the eye on the x axis, at 5
    (near, far) = (view.at(x, 1, 0)[0] for x in (2.5, -5))
    assert near / far == pytest.approx(10 / 2.5)


def test_what_is_behind_the_eye_has_no_place() -> None:
    places = orbit(0, 0, distance=5).place([(4.9, 1, 0), (6, 1, 0), (0, 1, 0)])
    assert np.isnan(places[:2, :2]).all()
    assert np.isfinite(places[2]).all()


@pytest.mark.parametrize("azimuth", [0, 180])
def test_the_nearer_of_two_faces_is_drawn_last(azimuth: float) -> None:
    view = orbit(azimuth, 0, unit=10)
    solids = [Face(SQUARE + AHEAD, "ray"), Face(SQUARE - AHEAD, "image")]
    last = re.findall(r'class="(ray|image) thin', drawn(solids, view))[-1]
    assert last == ("ray" if azimuth == 0 else "image")


def test_a_wire_through_a_face_is_hidden_behind_it_and_seen_before_it() -> None:
    wire = Wire(np.linspace([-2.0, 0, 0], [2, 0, 0], 9), "ray")
    markup = drawn([wire, Face(SQUARE, "image")], orbit(30, 10, unit=10))
    behind, face, before = (markup.index(part) for part in ("<path", "<polygon", "<path"))
    assert behind == before < face
    assert markup.rindex("<path") > markup.rindex("<polygon")


def test_the_segments_of_a_wire_that_nothing_parts_are_one_line() -> None:
    turns = np.linspace(0, 2 * math.pi, 25)
    ring = np.stack([np.cos(turns), np.sin(turns), 0 * turns], axis=-1)
    assert drawn([Wire(ring, "ray")], orbit(30, 30, unit=50)).count("M") <= 2


def test_what_the_eye_has_too_near_is_left_out() -> None:
    view = orbit(0, 0, distance=2)
    solids: list[Solid] = [
        Face(SQUARE + 3 * AHEAD, "ray"),
        Arrow((0, 0, 0), (3, 0, 0), "ray"),
        Dot((3, 0, 0), "ray"),
        Words((3, 0, 0), "here"),
    ]
    assert drawn(solids, view) == ""


def test_arrows_points_and_words_are_drawn() -> None:
    solids: list[Solid] = [
        Arrow((0, 0, 0), (0, 20, 0), "ray"),
        Dot((0, 0, 0), "camera"),
        Words((0, 0, 0), "O"),
    ]
    markup = drawn(solids, orbit(0, 0, unit=2))
    assert all(part in markup for part in ("<line", "<polygon", "<circle", ">O</text>"))
    assert drawn([], orbit(0, 0)) == ""


@pytest.mark.parametrize(("light", "washes"), [((1, 0, 0), 1), ((0, 0, 1), 3), ((-1, 0, 0), 4)])
def test_a_face_is_the_darker_the_more_it_looks_away_from_the_light(
    light: tuple[float, float, float], washes: int
) -> None:
    view = orbit(0, 0)
    assert shaded(SQUARE, view, light) == shaded(SQUARE[::-1], view, light) == washes


def test_a_ring_is_cut_where_it_passes_behind() -> None:
    ring = np.array([[0, 0, -1], [1, 0, -1], [2, 0, 1], [3, 0, 1], [4, 0, -1], [5, 0, -2]], float)
    near, far = runs(ring, front=True), runs(ring, front=False)
    assert near == [[[0, 0], [1, 0], [2, 0]], [[3, 0], [4, 0], [5, 0]]]
    assert far == [[[2, 0], [3, 0]]]


def test_a_curve_is_broken_where_it_has_no_place() -> None:
    curve = np.array([[0, 0, -1], [1, 0, -1], [np.nan, np.nan, -1], [3, 0, -1], [4, 0, -1]])
    assert runs(curve, front=True) == [[[0, 0], [1, 0]], [[3, 0], [4, 0]]]


def test_a_view_is_the_same_from_its_axes() -> None:
    assert View(orbit_axes(10, 20), unit=3).at(1, 2, 3) == orbit(10, 20, unit=3).at(1, 2, 3)
