"""The transform explorer: its numbers are those of the picture, at every setting."""

import re
from functools import partial
from itertools import product
from typing import Any

import numpy as np
import pytest
from support.frames import frame_of, texts_at

from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import apply_homography
from simulations.scenes._mapped_square.family import transformation
from simulations.scenes._mapped_square.plane import HEIGHT, WIDTH, from_view, to_view
from simulations.scenes._mapped_square.square import SQUARE
from simulations.scenes.transform_2d.handles import matrix
from simulations.scenes.transform_2d.hierarchy import RUNGS
from simulations.scenes.transform_2d.scene import SCENE

AMOUNTS = (0, 1, 30, 57, 58, 70, 99, 100)
PROPERTIES = ("orientation", "lengths", "angles", "parallels", "lines")


frame = partial(frame_of, SCENE)


texts = partial(texts_at, SCENE)


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
def test_each_rung_keeps_one_property_less(
    transform: str, kept: int, freedoms: str, amount: float
) -> None:
    shown = texts(transform=transform, amount=amount)
    assert [shown[name] == "kept" for name in PROPERTIES] == [False] * (5 - kept) + [True] * kept
    assert shown["freedoms"] == freedoms


@pytest.mark.parametrize("transform", ["translation", "rigid", "similarity", "affine"])
def test_the_area_ratio_is_the_determinant(transform: str) -> None:
    H = transformation(transform, 70.0)
    assert texts(transform=transform, amount=70)["area"] == f"{np.linalg.det(H[:2, :2]):.3f}"


@pytest.mark.parametrize(("transform", "amount"), [*product(RUNGS, (10, 50, 90))])
def test_the_drawn_corner_is_the_image_of_the_corner(transform: str, amount: float) -> None:
    image, valid = apply_homography(transformation(transform, amount), (40.0, 40.0))
    x, y = to_view(image)
    assert valid
    drawn = re.findall(r'class="image solid" cx="([\d.]+)" cy="([\d.]+)"', plane(transform, amount))
    assert [tuple(map(float, spot)) for spot in drawn] == [pytest.approx((x, y), abs=0.006)]


def plane(transform: str, amount: float) -> str:
    return frame(transform=transform, amount=amount).panels[0].overlay


@pytest.mark.parametrize("amount", AMOUNTS)
def test_nothing_is_drawn_far_outside_the_view(amount: float) -> None:
    overlay = plane("projective", amount)
    points = re.findall(r"(-?[\d.]+),(-?[\d.]+)", overlay)
    assert len(points) > 20
    assert all(-5 <= float(x) <= WIDTH + 5 and -5 <= float(y) <= HEIGHT + 5 for x, y in points)


def test_the_line_sent_to_infinity_is_drawn_where_it_crosses_the_view() -> None:
    assert "error dashed" not in plane("affine", 100)
    assert "error dashed" not in plane("projective", 0)
    overlay = plane("projective", 80)
    ends = re.search(
        r'"error dashed" x1="([\d.-]+)" y1="([\d.-]+)" x2="([\d.-]+)" y2="([\d.-]+)"', overlay
    )
    assert ends
    x1, y1, x2, y2 = map(float, ends.groups())
    for x, y in ((x1, y1), (x2, y2)):
        X, Y = from_view((x, y))
        assert pytest.approx(0, abs=1e-3) == 1 - 80 / 10000 * X + 80 / 3000 * Y


def corners(transform: str, amount: float, **given: Any) -> Floats:
    """Images (4, 2) of the square's corners, from the lower left round to the upper left."""
    settings = SCENE.check({"transform": transform, "amount": amount, **given})
    return apply_homography(matrix(settings), SQUARE)[0]


@pytest.mark.parametrize(("transform", "held"), [*zip(RUNGS, (0, 1, 1, 2, 3), strict=True)])
@pytest.mark.parametrize("amount", [0, 30, 50])
def test_a_pulled_corner_leaves_as_many_others_in_place_as_freedoms_are_left(
    transform: str, held: int, amount: float
) -> None:
    before = corners(transform, amount)
    after = corners(transform, amount, pull_x=-13, pull_y=9)
    stays = np.isclose(before, after, atol=1e-9).all(axis=1)
    assert stays.sum() == held
    if transform != "rigid":
        assert after[3] == pytest.approx(before[3] + (-13, 9))


@pytest.mark.parametrize("transform", RUNGS)
@pytest.mark.parametrize("pull", [(-150, 150), (150, -150), (80, -80), (0, -80), (-40, -110)])
def test_a_pull_as_far_as_it_goes_stays_in_the_family(
    transform: str, pull: tuple[float, float]
) -> None:
    """Also where the corner would come to lie on another one, or on the side between two."""
    shown = texts(transform=transform, amount=30, pull_x=pull[0], pull_y=pull[1])
    kept = 5 - list(RUNGS).index(transform)
    assert [shown[name] == "kept" for name in PROPERTIES[5 - kept :]] == [True] * kept


def test_a_pulled_homography_keeps_its_image_convex() -> None:
    for pull in product((-150, -60, 0, 60, 150), repeat=2):
        turned = corners("projective", 30, pull_x=pull[0], pull_y=pull[1])
        sides = np.roll(turned, -1, axis=0) - turned
        following = np.roll(sides, -1, axis=0)
        assert np.all(sides[:, 0] * following[:, 1] > sides[:, 1] * following[:, 0]), pull


def test_a_point_on_the_line_has_no_image_to_grab() -> None:
    given = {"transform": "projective", "amount": 100, "point_x": 60, "point_y": -12}
    assert "image" not in {place.name for place in frame(**given).handles}
