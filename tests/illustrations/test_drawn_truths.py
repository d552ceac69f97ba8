"""Illustrations agree with theory, computed here independently."""

import math
import tomllib
from importlib import import_module
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation


def module(name: str) -> Any:
    return import_module(f"simulations.illustrations.{name}")


ROWS = tomllib.loads(Path(__file__).with_name("truths.toml").read_text("utf-8"))


@pytest.mark.parametrize(("name", "row"), ROWS.items())
def test_drawing_agrees_with_theory(name: str, row: tuple[str, str]) -> None:
    names = {"quad": quad, "Rotation": Rotation, "math": math, "np": np, **vars(module(name))}
    drawn, theory = (eval(expression, names) for expression in row)
    np.testing.assert_allclose(drawn, np.broadcast_to(theory, np.shape(drawn)), 1e-6, 1e-6)


@pytest.mark.parametrize(
    ("index", "length", "angle", "parallels"),
    [(0, 1, 1, 1), (1, 1, 1, 1), (2, 0, 1, 1), (3, 0, 0, 1), (4, 0, 0, 0)],
)
def test_card_preserves_the_properties_of_its_family(
    index: int, length: int, angle: int, parallels: int
) -> None:
    m = module("five_families")
    square = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)
    a, b, c, d = m.mapped(m.FAMILIES[index][2], square)
    below, above, side = b - a, c - d, d - a
    off = np.hypot(*below) - m.UNITS, below @ side, below[0] * above[1] - below[1] * above[0]
    assert [abs(each) < 1e-6 for each in off] == [length, angle, parallels]


def test_images_of_parallel_lines_meet_on_the_drawn_horizon() -> None:
    m = module("line_at_infinity")
    for _, direction in m.WAYS[:2]:
        (p, q), (r, s) = (m.image(e) for e in m.lines(direction)[:2])
        share = np.linalg.solve(np.stack([q - p, r - s], axis=1), r - p)[0]
        x, y = p + share * (q - p)
        assert m.vanishing(direction) == pytest.approx([x, y])
        assert m.horizon(x)[1] == pytest.approx(y)


def test_view_direction_depends_on_the_order_of_pan_and_tilt() -> None:
    m = module("order_of_turns")
    pan, tilt = Rotation.from_euler("yx", [[30, 0], [0, 20]], degrees=True)
    for (_, _, axes), turn in zip(m.ORDERS, (pan * tilt, tilt * pan), strict=True):
        right, _, forward = turn.as_matrix().T
        assert m.elevation_deg(axes) == pytest.approx(math.degrees(math.asin(-forward[1])))
        level = np.cross([0, 1, 0], forward)  # to the right, in the plane of the horizon
        slant = math.degrees(math.atan2(np.linalg.norm(np.cross(right, level)), right @ level))
        assert abs(m.slant_deg(axes)) == pytest.approx(slant, abs=1e-6)


def test_newton_guesses_converge_and_no_tier_beats_the_front() -> None:
    m = module("newton_steps")
    root = brentq(lambda r: r - 0.3 * r**3 - m.DISTORTED, 0.5, 1.0)
    errors = [abs(guess - root) for guess in m.guesses()]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 1e-4
    steps = module("steps_and_error")
    front = [error for _, error, _ in steps.front()]
    assert front == sorted(front, reverse=True)
    for cost, error, _ in steps.points():
        assert any(c <= cost and e <= error for c, e, _ in steps.front())


def test_cell_value_is_the_mean_of_the_wave_over_its_width() -> None:
    m = module("pixel_footprint")
    wave = lambda x: math.cos(2 * math.pi * m.FREQUENCY * x)  # noqa: E731
    means = [quad(wave, n - 0.5, n + 0.5)[0] for n in range(m.CELLS)]
    assert m.cell_means() == pytest.approx(means, abs=1e-4)


def test_gaps_of_the_toy_format_double_with_each_power_of_two() -> None:
    numbers = np.array(module("float_spacing").numbers())
    starts, gaps = numbers[:-1], np.diff(numbers)
    expected = np.maximum(2.0 ** np.floor(np.log2(np.maximum(starts, 0.25))) / 8, 1 / 32)
    np.testing.assert_allclose(gaps[starts < 8], expected[starts < 8])


def test_drawn_ray_ends_in_the_drawn_point() -> None:
    overlay = module("similar_triangles").draw().panels[0].overlay
    drawing = ElementTree.fromstring(f"<svg>{overlay}</svg>")
    ray = next(line for line in drawing.iter("line") if line.get("class") == "ray bold")
    end = next(dot for dot in drawing.iter("circle") if dot.get("class") == "world solid")
    assert (ray.get("x2"), ray.get("y2")) == (end.get("cx"), end.get("cy"))
