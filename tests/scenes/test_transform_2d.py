"""The transform explorer: its numbers are those of the picture, at every setting."""

import math
import re
from itertools import product

import numpy as np
import pytest

from simulations.engine.frame import to_json
from simulations.engine.stages import StageCache
from simulations.models.geometry.transforms import apply_homography
from simulations.scenes.transform_2d.family import transformation
from simulations.scenes.transform_2d.hierarchy import RUNGS
from simulations.scenes.transform_2d.plane import to_view
from simulations.scenes.transform_2d.scene import SCENE

AMOUNTS = (0, 1, 30, 57, 58, 70, 99, 100)
PROPERTIES = ("orientation", "lengths", "angles", "parallels", "lines")
READOUTS = ["matrix", "freedoms", "area", *PROPERTIES, "x", "y", "w"]


def frame(**given):
    return SCENE.render(SCENE.check(given), "", StageCache())


def texts(**given):
    return {item.name: item.text for item in frame(**given).readouts}


def test_it_starts_with_a_translation_by_30_and_15():
    shown = texts()
    assert [row.split() for row in shown["matrix"].splitlines()] == [
        ["1.00", "0.00", "30.00"],
        ["0.00", "1.00", "15.00"],
        ["0", "0", "1"],
    ]
    assert shown["freedoms"] == "2"
    assert shown["area"] == "1.000"
    assert "P′ (70.0, 55.0)" in frame().panels[0].overlay


@pytest.mark.parametrize(("transform", "amount"), [*product(RUNGS, AMOUNTS)])
def test_every_setting_draws_finite_numbers_in_the_same_layout(transform, amount):
    shown = frame(transform=transform, amount=amount)
    assert [(p.name, p.width, p.height) for p in shown.panels] == [
        ("plane", 400, 330),
        ("hierarchy", 400, 330),
    ]
    assert [item.name for item in shown.readouts] == READOUTS
    assert not re.search("nan|inf[^i]|undefined", to_json(shown))


@pytest.mark.parametrize(
    ("transform", "kept", "freedoms"),
    [
        ("translation", 5, "2"),
        ("rigid", 4, "3"),
        ("similarity", 3, "4"),
        ("affine", 2, "6"),
        ("projective", 1, "8"),
    ],
)
@pytest.mark.parametrize("amount", [1, 30, 100])
def test_each_rung_keeps_one_property_less(transform, kept, freedoms, amount):
    shown = texts(transform=transform, amount=amount)
    assert [shown[name] == "kept" for name in PROPERTIES] == [False] * (5 - kept) + [True] * kept
    assert shown["freedoms"] == freedoms


@pytest.mark.parametrize("transform", RUNGS)
def test_amount_zero_is_the_identity(transform):
    assert transformation(transform, 0.0) == pytest.approx(np.eye(3))
    assert all(texts(transform=transform, amount=0)[name] == "kept" for name in PROPERTIES)


@pytest.mark.parametrize("transform", ["translation", "rigid", "similarity", "affine"])
def test_the_area_ratio_is_the_determinant(transform):
    H = transformation(transform, 70.0)
    assert texts(transform=transform, amount=70)["area"] == f"{np.linalg.det(H[:2, :2]):.3f}"


def test_a_similarity_by_half_as_much_again_has_two_and_a_quarter_times_the_area():
    shown = texts(transform="similarity", amount=100)
    assert shown["area"] == "2.250"
    assert shown["lengths"] == "changed by up to 50.0\u00a0%"
    assert shown["orientation"] == "changed by up to 50.0°"


def test_the_square_meets_infinity_between_57_and_58():
    # w = 1 − 0.01733 a at the corner (40, −40).
    assert texts(transform="projective", amount=57)["area"] != "∞"
    assert texts(transform="projective", amount=58)["area"] == "∞"
    assert texts(transform="projective", amount=58)["lengths"] == "changed without bound"


@pytest.mark.parametrize(("transform", "amount"), [*product(RUNGS, (10, 50, 90))])
def test_the_drawn_corner_is_the_image_of_the_corner(transform, amount):
    image, valid = apply_homography(transformation(transform, amount), (40.0, 40.0))
    x, y = to_view(image)
    assert valid
    drawn = re.findall(r'class="image solid" cx="([\d.]+)" cy="([\d.]+)"', plane(transform, amount))
    assert [tuple(map(float, spot)) for spot in drawn] == [pytest.approx((x, y), abs=0.006)]


def plane(transform, amount):
    return frame(transform=transform, amount=amount).panels[0].overlay


@pytest.mark.parametrize("amount", AMOUNTS)
def test_nothing_is_drawn_far_outside_the_view(amount):
    overlay = plane("projective", amount)
    points = re.findall(r"(-?[\d.]+),(-?[\d.]+)", overlay)
    assert len(points) > 20
    assert all(-5 <= float(x) <= 405 and -5 <= float(y) <= 335 for x, y in points)


def test_the_line_sent_to_infinity_is_drawn_where_it_crosses_the_view():
    assert "error dashed" not in plane("affine", 100)
    assert "error dashed" not in plane("projective", 0)
    overlay = plane("projective", 80)
    x1, y1, x2, y2 = map(
        float,
        re.search(
            r'"error dashed" x1="([\d.-]+)" y1="([\d.-]+)" x2="([\d.-]+)" y2="([\d.-]+)"', overlay
        ).groups(),
    )
    origin = to_view((0, 0))
    for x, y in ((x1, y1), (x2, y2)):
        X, Y = (x - origin[0]) / 1.46, -(y - origin[1]) / 1.46
        assert pytest.approx(0, abs=1e-3) == 1 - 80 / 10000 * X + 80 / 3000 * Y


def test_the_description_says_what_is_kept():
    assert frame(transform="affine").description.startswith(
        "The square under an affine transformation has an image of "
        f"{math.prod((1.15**2, 1.06, 0.9)):.2f} times its area; kept: parallel lines, "
        "straight lines."
    )
    assert "infinity" in frame(transform="projective", amount=100).description
