"""Vignetting: cosines, the area that two discs share, and cat's eyes."""

from fractions import Fraction
from math import factorial

import numpy as np
import pytest

from simulations.models.lens.vignetting import (
    disc_overlap_area,
    mechanical_vignetting,
)


@pytest.mark.parametrize(
    ("tangent", "pupil", "rim", "separation", "share"),
    [
        ([0.0, 0.1, -0.1, 5.0, np.inf], 5.0, 6.0, 10.0, [1, 1, 1, 0, 0]),
        ([0.0], 5.0, 2.5, 10.0, [0.25]),  # a narrower rim stops the lens down
        ([0.0, 0.5], 5.0, 6.0, 0.5, [1, 1]),
        ([0.0, 1e300, np.inf, -np.inf, np.nan], 5.0, 4.0, 0.0, [0.64] * 4 + [np.nan]),
        ([0.1], 1e-40, 1.0, 1.0, [1]),
        ([0.1], 1e40, 1.0, 1.0, [0]),
    ],
)
def test_a_rim_hides_as_much_of_the_pupil_as_it_overlaps(
    tangent: list[float], pupil: float, rim: float, separation: float, share: list[float]
) -> None:
    found = mechanical_vignetting(tangent, pupil, rim, separation)
    np.testing.assert_allclose(found, share, atol=1e-15)


def test_the_cats_eye_has_the_area_counted_on_a_fine_grid() -> None:
    axis = np.linspace(-5, 5, 1001)
    x, y = np.meshgrid(axis, axis)
    pupil = np.hypot(x, y) <= 5
    counted = (pupil & (np.hypot(x - 4, y) <= 6)).sum() / pupil.sum()
    left, right = mechanical_vignetting([-0.4, 0.4], 5.0, 6.0, 10.0)
    assert left == right == pytest.approx(counted, abs=1e-3)


@pytest.mark.parametrize(("a", "b"), [(1.0, 1.0), (3.0, 2.0), (2.0, 3.0), (5.0, 0.5)])
def test_two_discs_share_all_of_the_smaller_nothing_or_a_lens(a: float, b: float) -> None:
    """The lens by the integral of the chords that both discs have."""
    apart = np.array([0.0, 0.9 * abs(a - b), abs(a - b), a + b, 2 * (a + b)])
    smaller = np.pi * min(a, b) ** 2
    np.testing.assert_allclose(
        disc_overlap_area(apart, a, b), [smaller, smaller, smaller, 0, 0], atol=1e-9
    )
    for d in (abs(a - b) + 0.1, 0.5 * (abs(a - b) + a + b), a + b - 0.1):
        x = np.linspace(-a - b, a + 2 * b, 400_001)
        half = [np.sqrt(np.maximum(r * r - (x - at) ** 2, 0)) for r, at in ((a, 0.0), (b, d))]
        area = 2 * np.minimum(*half).sum() * (x[1] - x[0])
        assert disc_overlap_area(d, a, b) == pytest.approx(area, rel=1e-5)


def test_discs_that_just_touch_from_within_or_without_share_a_finite_area() -> None:
    """Where rounding can take a cosine or a share beyond 1."""
    for a, b in np.random.default_rng(0).uniform(0.1, 3, (500, 2)):
        ends = np.array([np.nextafter(abs(a - b), 9), a + b, np.nextafter(a + b, 0)])
        area = disc_overlap_area(ends, a, b) / (np.pi * min(a, b) ** 2)
        np.testing.assert_allclose(area, [1, 0, 0], atol=1e-12)
        assert (area >= 0).all()
        assert (area <= 1).all()


def segment(sine_of_half: float) -> float:
    """x − sin x cos x, the area of a unit disc beyond a chord, from sin x/2; as a series."""
    turn = 4 * np.arcsin(sine_of_half)
    return sum(
        (-1) ** (k + 1) * turn ** (2 * k + 1) / (2 * factorial(2 * k + 1)) for k in range(1, 9)
    )


@pytest.mark.parametrize("overlap", [1e-3, 1e-5, 1e-8])
@pytest.mark.parametrize(("a", "b"), [(1.0, 1.0), (1.0, 1.3), (1.0, 0.2)])
def test_a_sliver_that_discs_share_keeps_its_digits(a: float, b: float, overlap: float) -> None:
    d = a + b - overlap
    exact_overlap = float(Fraction(a) + Fraction(b) - Fraction(d))
    halves = [
        np.sqrt(exact_overlap * (other - mine + d) / (4 * d * mine))
        for mine, other in ((a, b), (b, a))
    ]
    exact = a * a * segment(halves[0]) + b * b * segment(halves[1])
    assert disc_overlap_area(d, a, b) == pytest.approx(exact, rel=1e-14 / overlap, abs=1e-16)


@pytest.mark.parametrize("out", [1e-3, 1e-6])
def test_a_disc_that_hardly_sticks_out_of_another_loses_a_sliver(out: float) -> None:
    """The crescent: what the small disc has beyond the chord, less what the large one has."""
    d = 0.8 + out
    exact_out = float(Fraction(d) + Fraction(0.2) - 1)
    of_small = np.sqrt(exact_out * (d + 1.2) / (4 * d * 0.2))
    of_large = np.sqrt(exact_out * (1.2 - d) / (4 * d))
    crescent = 0.04 * segment(of_small) - segment(of_large)
    lost = np.pi * 0.04 - disc_overlap_area(d, 1.0, 0.2)
    assert lost == pytest.approx(crescent, abs=1e-15)


def beside_an_edge(cut: float) -> float:
    """What of a unit disc lies to the left of x = −cut."""
    return float(np.arccos(cut) - cut * np.sqrt(1 - cut * cut))


@pytest.mark.parametrize(
    ("apart", "a", "b", "area", "off"),
    [
        (0.0, 1e6, 1e-6, np.pi * 1e-12, 1e-18),
        (0.0, 1e-70, 1e70, np.pi * 1e-140, 1e-146),
        (2e70, 1e-70, 1e70, 0.0, 0.0),
        (-1.0, 1.0, 1.0, 2 * np.pi / 3 - np.sqrt(3) / 2, 1e-15),  # to either side alike
        (1e-6, 1e-6, 1e-6, (2 * np.pi / 3 - np.sqrt(3) / 2) * 1e-12, 1e-26),
        (1e6, 1e6, 1e6, (2 * np.pi / 3 - np.sqrt(3) / 2) * 1e12, 1e-2),
        # All but a strip of discs of one size.
        (1e-5, 1.0, 1.0, np.pi - 2e-5, 1e-13),
        (1e-10, 1.0, 1.0, np.pi - 2e-10, 1e-13),
        # On the rim of a large one, which bends away by a strip of area 1/(3 R).
        *((R, 1.0, R, np.pi / 2 - 1 / (3 * R), 1e-15) for R in (1e6, 1e12, 1e20, 1e60)),
        # A very large disc cuts another as a straight edge does.
        *(
            (2.0**46 + cut, 1.0, 2.0**46, beside_an_edge(cut), 1e-14)
            for cut in (-0.96875, -0.5, 0.25, 0.9375)
        ),
    ],
)
def test_discs_of_any_size_share_what_they_should(
    apart: float, a: float, b: float, area: float, off: float
) -> None:
    assert disc_overlap_area(apart, a, b) == pytest.approx(area, abs=off, rel=0)
