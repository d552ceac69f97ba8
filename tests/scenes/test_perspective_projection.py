"""The projection figure: the equation, the drawing and the words say the same."""

import re
from functools import partial
from itertools import product

import pytest
from support.frames import frame_of, texts_at

from simulations.scenes.perspective_projection.scene import SCENE

CAMERAS = ("perspective", "scaled-orthographic", "orthographic")


frame = partial(frame_of, SCENE)


texts = partial(texts_at, SCENE)


def picture(**given: object) -> str:
    return frame(**given).panels[1].overlay


def solid_dots(overlay: str, role: str) -> list[tuple[float, float]]:
    dots = re.findall(rf'class="{role} solid" cx="([-\d.]+)" cy="([-\d.]+)"', overlay)
    return [(float(x), float(y)) for x, y in dots]


def test_the_drawing_has_the_sum_of_the_book_s_example() -> None:
    assert "= 80 · 1.0 / 5.0 = 16.0 px" in frame().panels[0].overlay


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
    overlay = frame(depth=depth, focal_length=focal_length).panels[0].overlay
    (centre,), (hit,) = solid_dots(overlay, "camera"), solid_dots(overlay, "image")
    (point,) = solid_dots(overlay, "world")
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


def test_the_picture_says_where_perspective_has_the_point() -> None:
    assert "in perspective at the same place" in picture(camera="scaled-orthographic")
    assert "in perspective at (8.0, 4.0) px" in picture(camera="scaled-orthographic", depth=10)


@pytest.mark.parametrize(("camera", "metres"), [(CAMERAS[1], 12.5), (CAMERAS[2], 6.0)])
@pytest.mark.parametrize("depth", [-2.0, 5.0, 20.0])
def test_parallel_rays_see_a_strip_of_the_same_width_at_every_depth(
    camera: str, metres: float, depth: float
) -> None:
    """At its edge, 100 px from the middle, half of it is to one side."""
    shown = texts(camera=camera, depth=depth, point_x=2.5)
    assert float(shown["view"]) == metres
    assert float(shown["x"]) == pytest.approx(100 * 2.5 / (metres / 2), abs=0.05)


def test_the_ray_of_orthography_is_parallel_to_the_axis() -> None:
    overlay = frame(camera="orthographic", depth=12).panels[0].overlay
    (hit,), (point,) = solid_dots(overlay, "image"), solid_dots(overlay, "world")
    assert hit[1] == point[1]
    assert solid_dots(overlay, "camera") == []


@pytest.mark.parametrize("depth", [1.0, 12.0])
def test_the_ray_of_scaled_orthography_bends_at_the_reference_plane(depth: float) -> None:
    overlay = frame(camera="scaled-orthographic", depth=depth).panels[0].overlay
    (centre,), (hit,) = solid_dots(overlay, "camera"), solid_dots(overlay, "image")
    (point,) = solid_dots(overlay, "world")
    bend = re.search(r'<circle class="ray" cx="([-\d.]+)" cy="([-\d.]+)"', overlay)
    assert bend is not None
    x, y = map(float, bend.groups())
    assert (x, y) == (centre[0] + 16 * 5, point[1])
    assert (hit[1] - centre[1]) / (hit[0] - centre[0]) == pytest.approx(
        (y - centre[1]) / (x - centre[0]), rel=1e-3
    )


def house_front(**given: object) -> list[tuple[float, float]]:
    """Pixels of the front wall's outline, as drawn."""
    found = re.search(r'<polygon class="world thin fill" points="([^"]+)"', picture(**given))
    assert found is not None
    places = [spot.split(",") for spot in found.group(1).split()]
    return [((float(x) - 200) / 2, (float(y) - 150) / 2) for x, y in places]


def test_the_house_is_divided_by_its_own_depths() -> None:
    """2.4 m wide, its front 4 m and its back 7 m away: 48 px and 27.4 px."""
    front = house_front(depth=4, focal_length=80)
    assert front[1][0] - front[0][0] == pytest.approx(80 * 2.4 / 4, abs=0.02)
    back = re.search(r'<polygon class="world thin faint" points="([^"]+)"', picture(depth=4))
    assert back is not None
    left, right = (float(spot.split(",")[0]) / 2 for spot in back.group(1).split()[:2])
    assert right - left == pytest.approx(80 * 2.4 / 7, abs=0.02)


def test_the_point_is_the_lower_left_corner_of_the_house() -> None:
    for given in ({}, {"depth": 12, "point_x": -2.5}, {"camera": "orthographic", "depth": 9}):
        (dot,) = solid_dots(picture(**given), "image")
        assert house_front(**given)[0] == pytest.approx(((dot[0] - 200) / 2, (dot[1] - 150) / 2))


@pytest.mark.parametrize("depth", [-2.0, 0.0])
def test_of_a_house_that_the_camera_stands_in_only_what_is_in_front_is_drawn(depth: float) -> None:
    shown = picture(depth=depth)
    assert 'class="world thin fill"' not in shown
    assert '<polygon class="world thin faint"' in shown


def test_a_point_without_an_image_offers_none_to_the_hand() -> None:
    for given in ({"depth": 0}, {"depth": -1}):
        assert "image" not in {place.name for place in frame(**given).handles}
    parallel = frame(depth=-1, camera="orthographic")
    assert "image" in {place.name for place in parallel.handles}
