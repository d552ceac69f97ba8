"""Space on a panel: the orbiting camera, hidden lines, and shading."""

import math
import re
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.engine.space.solids import Face, Wire, draw_solids, shaded
from simulations.engine.space.view import axes_towards, orbit, orbit_axes, runs

ANGLES = st.tuples(st.floats(-180, 180), st.floats(-89, 89))
SQUARE = np.array([[0.0, -1, -1], [0, 1, -1], [0, 1, 1], [0, -1, 1]])
"""Across the x axis."""
AHEAD = np.array([1.0, 0.0, 0.0])
NAN = math.nan


@given(ANGLES, st.booleans())
def test_orbit_axes_belong_to_a_camera_that_looks_at_the_origin(
    angles: tuple[float, float], z_down: bool
) -> None:
    turn, rise = np.radians(angles)
    forward = -np.array([np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)])
    right = np.cross(forward, (0, 0, 1))
    right /= np.linalg.norm(right)
    expected = (right, np.cross(forward, right), forward)
    np.testing.assert_allclose(orbit_axes(*angles), expected, atol=1e-9)
    np.testing.assert_allclose(axes_towards(-forward), expected, atol=1e-9)
    axes = orbit_axes(*angles, z_down=z_down)
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(np.cross(axes[0], axes[1]), axes[2], atol=1e-12)


@pytest.mark.parametrize("direction", [(0, 0, 1), (0, 0, 0), (NAN, 0, 0)])
def test_direction_without_an_upright_is_refused(direction: tuple[float, float, float]) -> None:
    with pytest.raises(ValueError, match="legal"):
        axes_towards(direction)


def test_orbit_keeps_parallels_and_perspective_shrinks_with_distance() -> None:
    ends = orbit(40, 20, unit=80).all([[(0, 0, 0), (1, 0, 0)], [(0, 2, 1), (1, 2, 1)]])
    np.testing.assert_allclose(ends[0, 1] - ends[0, 0], ends[1, 1] - ends[1, 0])
    view = orbit(0, 0, unit=10, distance=5)  # the eye on the x axis, at 5
    near, far = (view.at(x, 1, 0)[0] for x in (2.5, -5))
    assert near / far == pytest.approx(10 / 2.5)
    places = view.place([(4.9, 1, 0), (6, 1, 0), (0, 1, 0)])
    assert np.isnan(places[:2, :2]).all(), "too near or behind"
    assert np.isfinite(places[2]).all()


@pytest.mark.parametrize(("azimuth", "nearer"), [(0, "ray"), (180, "image")])
def test_nearer_of_two_faces_is_drawn_last(azimuth: float, nearer: str) -> None:
    solids = [Face(SQUARE + AHEAD, "ray"), Face(SQUARE - AHEAD, "image")]
    markup = draw_solids(solids, orbit(azimuth, 0, unit=10))
    assert re.findall(r'class="(ray|image) thin', markup)[-1] == nearer


def test_wire_is_hidden_behind_a_face() -> None:
    wire = Wire(np.linspace([-2.0, 0, 0], [2, 0, 0], 9), "ray")
    markup = draw_solids([wire, Face(SQUARE, "image")], orbit(30, 10, unit=10))
    assert markup.index("<path") < markup.index("<polygon") < markup.rindex("<path")
    turns = np.linspace(0, 2 * math.pi, 25)
    ring = np.stack([np.cos(turns), np.sin(turns), 0 * turns], axis=-1)
    assert draw_solids([Wire(ring, "ray")], orbit(30, 30, unit=50)).count("M") <= 2


@pytest.mark.parametrize(("light", "washes"), [((1, 0, 0), 1), ((0, 0, 1), 3), ((-1, 0, 0), 4)])
def test_face_is_darker_the_more_it_turns_from_the_light(
    light: tuple[float, float, float], washes: int
) -> None:
    view = orbit(0, 0)
    assert shaded(SQUARE, view, light) == shaded(SQUARE[::-1], view, light) == washes


@pytest.mark.parametrize(
    ("z", "front", "expected"),
    [
        ([-1, -1, 1, 1, -1, -2], True, [[0, 1, 2], [3, 4, 5]]),
        ([-1, -1, 1, 1, -1, -2], False, [[2, 3]]),
        ([-1, -1, NAN, -1, -1], True, [[0, 1], [3, 4]]),
    ],
)
def test_curve_is_cut_where_it_passes_behind_or_has_no_place(
    z: list[float], front: bool, expected: Any
) -> None:
    x = np.where(np.isnan(z), NAN, np.arange(len(z)))
    curve = np.stack([x, 0 * x, z], axis=-1)
    assert runs(curve, front=front) == [[[n, 0] for n in run] for run in expected]
