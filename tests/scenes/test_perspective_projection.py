"""The projection figure: the equation, the drawing and the words say the same."""

import math
import re
from functools import partial
from itertools import product

import pytest
from support.frames import frame_of, texts_at

from simulations.scenes.perspective_projection.scene import SCENE
from simulations.scenes.perspective_projection.settings import Settings
from simulations.scenes.perspective_projection.top_view import FLOOR

frame = partial(frame_of, SCENE)


texts = partial(texts_at, SCENE)


def overlay(panel: str, **given: object) -> str:
    return next(each.overlay for each in frame(**given).panels if each.name == panel)


def picture(**given: object) -> str:
    return overlay("image", **given)


def solid_dots(markup: str, role: str) -> list[tuple[float, float]]:
    dots = re.findall(rf'class="{role} solid" cx="([-\d.]+)" cy="([-\d.]+)"', markup)
    return [(float(x), float(y)) for x, y in dots]


def test_the_drawing_has_the_sum_of_the_book_s_example() -> None:
    assert "= 80 · 1.0 / 5.0 = 16.0 px" in overlay("top")


@pytest.mark.parametrize(("depth", "focal_length"), [*product((2.0, 5.0, 20.0), (20, 80, 200))])
@pytest.mark.parametrize("point_x", [-1.0, 0.4])
def test_the_dot_lies_where_the_readouts_say(
    depth: float, focal_length: float, point_x: float
) -> None:
    given = {"depth": depth, "focal_length": focal_length, "point_x": point_x}
    x, y = focal_length * point_x / depth, focal_length * 0.5 / depth
    (dot,) = solid_dots(picture(**given), "image")
    assert dot == pytest.approx((200 + 2 * x, 150 + 2 * y), abs=0.006)
    shown = texts(**given)
    assert float(shown["x"].replace("−", "-")) == pytest.approx(x, abs=0.0501)
    assert float(shown["y"]) == pytest.approx(y, abs=0.0501)


@pytest.mark.parametrize(("depth", "focal_length"), [*product((3.0, 5.0, 20.0), (40, 80, 200))])
def test_centre_image_and_point_are_on_one_line_in_the_top_view(
    depth: float, focal_length: float
) -> None:
    top = overlay("top", depth=depth, focal_length=focal_length)
    (centre,), (hit,) = solid_dots(top, "camera"), solid_dots(top, "image")
    (point,) = solid_dots(top, "world")
    cross = (hit[0] - centre[0]) * (point[1] - centre[1]) - (hit[1] - centre[1]) * (
        point[0] - centre[0]
    )
    assert abs(cross) < 0.02 * max(point[0] - centre[0], 100)


def test_behind_the_camera_there_is_no_image_but_what_the_bare_formula_would_claim() -> None:
    shown = picture(depth=-2)
    assert "behind the camera: no image" in shown
    assert solid_dots(shown, "image") == []
    assert "the formula alone would say (−40.0, −20.0)" in shown
    assert 'class="error" cx="120" cy="110"' in shown


@pytest.mark.parametrize("perspective", [0.0, 1.0, 30.0, 99.0, 100.0])
@pytest.mark.parametrize("point_x", [-2.0, 1.0])
def test_the_plane_at_5_m_keeps_its_size_from_perspective_to_orthography(
    perspective: float, point_x: float
) -> None:
    shown = texts(perspective=perspective, point_x=point_x)
    assert float(shown["x"].replace("−", "-")) == 16.0 * point_x
    assert shown["off"] == "0.0"


@pytest.mark.parametrize("perspective", [10.0, 50.0, 80.0])
@pytest.mark.parametrize("depth", [2.0, 12.0])
def test_in_between_the_camera_is_object_centred_projection(
    perspective: float, depth: float
) -> None:
    """The book's formula: a X / (1 + η (Z − Z₀)) with a = f / Z₀ and η = p / Z₀."""
    x = (80 / 5) / (1 + perspective / 100 / 5 * (depth - 5))
    (dot,) = solid_dots(picture(perspective=perspective, depth=depth), "image")
    assert dot[0] == pytest.approx(200 + 2 * x, abs=0.006)
    assert float(texts(perspective=perspective, depth=depth)["off"]) == pytest.approx(
        abs(x - 80 / depth) * math.hypot(1, 0.5), abs=0.0501
    )


def test_the_picture_marks_where_perspective_has_the_point() -> None:
    mark = 'class="error solid" cx="216" cy="158"'
    assert mark in picture(perspective=0, depth=10)
    assert mark not in picture(depth=10)


@pytest.mark.parametrize("depth", [-2.0, 5.0, 20.0])
def test_orthography_has_the_same_picture_at_every_depth(depth: float) -> None:
    shown = texts(perspective=0, depth=depth, point_x=2.5)
    assert (shown["x"], shown["y"]) == ("40.0", "8.0")


def test_the_ray_of_orthography_is_parallel_to_the_axis() -> None:
    top = overlay("top", perspective=0, depth=12)
    (hit,), (point,) = solid_dots(top, "image"), solid_dots(top, "world")
    assert hit[1] == point[1]
    assert solid_dots(top, "camera") == []


@pytest.mark.parametrize("perspective", [70.0, 90.0])
def test_rays_in_between_run_to_the_centre_that_moved_back(perspective: float) -> None:
    top = overlay("top", perspective=perspective, depth=12)
    (centre,), (hit,) = solid_dots(top, "camera"), solid_dots(top, "image")
    (point,) = solid_dots(top, "world")
    assert centre[0] == pytest.approx(58 + 16 * (5 - 500 / perspective), abs=0.006)
    assert (hit[1] - centre[1]) / (hit[0] - centre[0]) == pytest.approx(
        (point[1] - centre[1]) / (point[0] - centre[0]), rel=1e-3
    )


@pytest.mark.parametrize("perspective", [60.0, 100.0])
def test_the_image_plane_can_be_pulled_where_it_is(perspective: float) -> None:
    settings = Settings(perspective=perspective, focal_length=120)
    plane = next(handle for handle in SCENE.handles if handle.name == "plane")
    at = plane.at(settings, {})
    assert at is not None
    assert plane.pull(settings, at)["focal_length"] == pytest.approx(120)


def walls(markup: str) -> list[list[tuple[float, float]]]:
    """Pixels of the outlines of the walls and roofs, as drawn, back to front."""
    found = re.findall(r'<polygon class="casing solid" points="([^"]+)"', markup)
    rings = [[tuple(map(float, spot.split(","))) for spot in each.split()] for each in found]
    return [[((x - 200) / 2, (y - 150) / 2) for x, y in ring] for ring in rings]


def gables(**given: object) -> list[list[tuple[float, float]]]:
    """The end walls, which have five corners, back to front."""
    return [wall for wall in walls(picture(**given)) if len(wall) == 5]


def test_the_house_is_divided_by_its_own_depths() -> None:
    """3 m wide, its front 4 m and its back 8 m away: 60 px and 30 px."""
    back, front = gables(depth=4)
    assert front[4][0] - front[0][0] == pytest.approx(80 * 3 / 4, abs=0.02)
    assert back[0][0] - back[4][0] == pytest.approx(80 * 3 / 8, abs=0.02)


def test_the_point_is_the_lower_left_corner_of_the_house() -> None:
    for given in ({}, {"depth": 12, "point_x": -2.5}, {"perspective": 0, "depth": 9}):
        (dot,) = solid_dots(picture(**given), "image")
        corner = gables(**given)[-1][0]
        assert corner == pytest.approx(((dot[0] - 200) / 2, (dot[1] - 150) / 2))


@pytest.mark.parametrize("depth", [-2.0, 0.0])
def test_of_a_house_that_the_camera_stands_in_only_what_is_in_front_is_drawn(depth: float) -> None:
    (back,) = gables(depth=depth)
    assert back[0][0] - back[4][0] == pytest.approx(80 * 3 / (depth + 4), abs=0.02)


def test_a_point_without_an_image_offers_none_to_the_hand() -> None:
    for given in ({"depth": 0}, {"depth": -1}):
        assert "image" not in {place.name for place in frame(**given).handles}
    parallel = frame(depth=-1, perspective=0)
    assert "image" in {place.name for place in parallel.handles}


@pytest.mark.parametrize("point_x", [1.0, 1.9, 3.0])
def test_the_equation_covers_nothing_of_the_view_from_above(point_x: float) -> None:
    top = overlay("top", point_x=point_x)
    outlines = re.findall(r'<polygon class="world[^"]*" points="([^"]+)"', top)
    lowest = max(float(spot.split(",")[1]) for each in outlines for spot in each.split())
    assert lowest <= FLOOR
