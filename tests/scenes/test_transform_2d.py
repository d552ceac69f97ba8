"""The transform explorer: properties kept, the pulled corner, and the lines at infinity."""

import re
from typing import Any

import numpy as np
import pytest
from support.frames import frame_of, texts_at
from support.label_boxes import in_figures, labels

from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import apply_homography
from simulations.scenes._mapped_square.family import SQUARE, transformation
from simulations.scenes._mapped_square.plane import (
    HEIGHT,
    WIDTH,
    from_view,
    lines_at_infinity,
    to_view,
)
from simulations.scenes.transform_2d import RUNGS, SCENE, matrix

PROPERTIES = ("orientation", "lengths", "angles", "parallels", "lines")


def homography(**given: object) -> Floats:
    return matrix(SCENE.check({"transform": "projective", "amount": 0, **given}))


def corners(transform: str, amount: float, **given: Any) -> Floats:
    """Images (4, 2) of the square's corners, from the lower left round to the upper left."""
    H = homography(transform=transform, amount=amount, **given)
    return apply_homography(H, SQUARE)[0]


def lines_of(drawn: str) -> dict[str, list[float]]:
    """Ends x, y, x, y of the dashed lines, by role."""
    found = re.findall(r'"(\w+) dashed" x1="(\S+)" y1="(\S+)" x2="(\S+)" y2="(\S+)"', drawn)
    return {role: [float(end) for end in ends] for role, *ends in found}


@pytest.mark.parametrize(
    ("transform", "freedoms", "fixed"),
    [*zip(RUNGS, ("2", "3", "4", "6", "8"), (0, 1, 1, 2, 3), strict=True)],
)
def test_each_family_keeps_one_property_fewer_and_fixes_more_corners(
    transform: str, freedoms: str, fixed: int
) -> None:
    kept = 5 - list(RUNGS).index(transform)
    for amount in (1, 30, 100):
        shown = texts_at(SCENE, transform=transform, amount=amount)
        verdicts = [shown[name] == "kept" for name in PROPERTIES]
        assert verdicts == [False] * (5 - kept) + [True] * kept
        assert shown["freedoms"] == freedoms
        if transform != "projective":
            H = transformation(transform, amount)
            assert shown["area"] == f"{np.linalg.det(H[:2, :2]):.3f}"
    for amount in (0, 30, 50):
        before = corners(transform, amount)
        after = corners(transform, amount, pull_x=-13, pull_y=9)
        assert np.isclose(before, after, atol=1e-9).all(axis=1).sum() == fixed
        if transform != "rigid":
            assert after[3] == pytest.approx(before[3] + (-13, 9))


@pytest.mark.parametrize("transform", RUNGS)
@pytest.mark.parametrize("pull", [(-150, 150), (150, -150), (80, -80), (0, -80), (-40, -110)])
def test_far_pull_stays_in_the_family(transform: str, pull: tuple[float, float]) -> None:
    """Also where the corner would come to lie on another one, or on the side between two."""
    shown = texts_at(SCENE, transform=transform, amount=30, pull_x=pull[0], pull_y=pull[1])
    kept = 5 - list(RUNGS).index(transform)
    assert [shown[name] for name in PROPERTIES[5 - kept :]] == ["kept"] * kept
    turned = corners(transform, 30, pull_x=pull[0], pull_y=pull[1])
    sides = np.roll(turned, -1, axis=0) - turned
    following = np.roll(sides, -1, axis=0)
    assert np.all(sides[:, 0] * following[:, 1] > sides[:, 1] * following[:, 0]), "convex"


@pytest.mark.parametrize("amount", [0, 30, 57, 58, 99, 100])
def test_drawing_shows_the_image_and_stays_near_the_view(amount: float) -> None:
    given = {"transform": "projective", "amount": amount, "point_x": -40}
    overlay = frame_of(SCENE, **given).panels[0].overlay
    points = np.array(re.findall(r"(-?[\d.]+),(-?[\d.]+)", overlay), float)
    assert (points >= -5).all()
    assert (points <= [WIDTH + 5, HEIGHT + 5]).all()
    drawn = re.findall(r'class="image solid" cx="([\d.]+)" cy="([\d.]+)"', overlay)
    image = to_view(apply_homography(transformation("projective", amount), (-40.0, 40.0))[0])
    inside = (image >= 0).all() and (image <= [WIDTH, HEIGHT]).all()
    expected = [pytest.approx(image.tolist(), abs=0.006)] if inside else []
    assert [tuple(map(float, spot)) for spot in drawn] == expected


@pytest.mark.parametrize("given", [{"amount": 24}, {"amount": 80}, {"amount": 90}, {"pull_x": 60}])
def test_lines_at_infinity_are_labelled_and_lie_where_w_is_zero(given: dict[str, int]) -> None:
    H = homography(**given)
    drawn = lines_at_infinity(H)
    lines = lines_of(drawn)
    for x, y in np.reshape(lines.get("error", []), (-1, 2)):
        assert H[2] @ [*from_view((x, y)), 1.0] == pytest.approx(0, abs=1e-3)
    x1, y1, x2, y2 = lines["image"]
    (box,) = (name.box for name in labels(drawn, in_figures) if name.text == "horizon")
    middle = (box.left + box.right) / 2.0
    assert box.top < y1 + (y2 - y1) * (middle - x1) / (x2 - x1) < box.bottom
