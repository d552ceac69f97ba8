"""The projection figure: its drawings, from above and in front, agree with the formulas."""

import math
import re

import pytest
from support.frames import frame_of

from simulations.scenes.perspective_projection.scene import SCENE

type Spots = list[tuple[float, float]]


def overlay(panel: str, **given: object) -> str:
    return next(each.overlay for each in frame_of(SCENE, **given).panels if each.name == panel)


def dots(markup: str, role: str) -> Spots:
    found = re.findall(rf'class="{role} solid" cx="([-\d.]+)" cy="([-\d.]+)"', markup)
    return [(float(x), float(y)) for x, y in found]


def under_the_dot(**given: object) -> list[int]:
    """Codes of the picture's pixel four pixels below the image of the point: on the white ball."""
    panel = next(each for each in frame_of(SCENE, **given).panels if each.name == "image")
    (x, y) = dots(panel.overlay, "image")[0]
    assert panel.raster is not None
    red, green, blue, _ = panel.raster[round(y) + 4, round(x)].tolist()
    return [red, green, blue]


@pytest.mark.parametrize(
    "given",
    [
        {"depth": depth, "focal_length": focal, "point_x": x, "perspective": perspective}
        for depth, focal, x, perspective in (
            (2.0, 20, -1.0, 100),
            (5.0, 200, 0.4, 100),
            (20.0, 80, -1.0, 100),
            (2.0, 80, 0.4, 50),
            (12.0, 80, 1.0, 90),
            (12.0, 80, -2.0, 10),
            (12.0, 120, 2.0, 0),
            (0.5, 40, 0.4, 0),
        )
    ],
)
def test_image_obeys_object_centred_projection_on_the_drawn_ray(given: dict[str, float]) -> None:
    """The book's formula: a X / (1 + η (Z − Z₀)) with a = f / Z₀ and η = p / Z₀, Z₀ = 5 m."""
    share, Z, X = given["perspective"] / 100, given["depth"], given["point_x"]
    size = given["focal_length"] / 5 / (1 + share / 5 * (Z - 5))
    (image,) = dots(overlay("image", **given), "image")
    assert image == pytest.approx((200 + 2 * size * X, 150 + 2 * size * 0.5), abs=0.006)
    codes = under_the_dot(**given)
    assert min(codes) > 140, f"{codes} is not the white ball under its top"
    shown = {item.name: item.text for item in frame_of(SCENE, **given).readouts}
    off = abs(size - given["focal_length"] / Z) * math.hypot(X, 0.5)
    assert float(shown["off"]) == pytest.approx(off, abs=0.0501)
    top = overlay("top", **given)
    (point,), (hit,) = dots(top, "world"), dots(top, "image")
    slope = (point[1] - hit[1]) / (point[0] - hit[0]) if point[0] != hit[0] else None
    for x, y in dots(top, "camera"):
        assert x == pytest.approx(84 + 360 / (max(Z, 5) + 5) * (5 - 5 / share), abs=0.006)
        assert (hit[1] - y) / (hit[0] - x) == pytest.approx(slope, rel=2e-3)
    if share == 0:
        assert slope == 0


@pytest.mark.parametrize(
    ("given", "seen"),
    [({"depth": 0}, False), ({"depth": -1}, False), ({"depth": -1, "perspective": 0}, True)],
)
def test_only_a_point_with_an_image_has_a_handle_there(
    given: dict[str, object], seen: bool
) -> None:
    assert ("image" in {place.name for place in frame_of(SCENE, **given).handles}) is seen
