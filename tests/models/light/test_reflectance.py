"""Lambert, Phong, Blinn-Phong and lamps against numbers worked by hand."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.models.arrays import Floats
from simulations.models.light.reflectance import (
    DirectionalLight,
    Light,
    PointLight,
    attenuation,
    blinn_phong,
    irradiance,
    lambert,
    normalise,
    phong,
)

FRONT = np.array([0.0, 0.0, 1.0])


@given(st.floats(-math.pi, math.pi))
def test_lambert_is_the_cosine_until_the_horizon_then_dark(theta: float) -> None:
    light = [math.sin(theta), 0, math.cos(theta)]
    assert lambert(FRONT, light, 0.8) == pytest.approx(0.8 * max(0, math.cos(theta)))


@pytest.mark.parametrize("shininess", [0, 0.5, 128, 1e6])
@pytest.mark.parametrize("slant_deg", [0, 45, 89, 90])
def test_light_opposite_to_the_eye_gives_no_highlight(shininess: float, slant_deg: float) -> None:
    """Whatever faces the light turns its back on the eye; no power of a missing cosine is 1."""
    slant = math.radians(slant_deg)
    normal = [math.sin(slant), 0, math.cos(slant)]
    for light in (
        [0, 0, 1.0],
        [0, 0, 1 + 9e-5],
        [9e-5, 0, 1.0],
    ):  # as far off as a direction may be
        shade = blinn_phong(normal, light, -FRONT, 0.0, shininess=shininess)
        assert shade == 0
    fields = blinn_phong(np.array([normal] * 2), [FRONT, FRONT], [FRONT, -FRONT], 0.0, shininess=0)
    assert fields.tolist() == [0.5 if math.cos(slant) > 0 else 0, 0]


NONE, ALONG = np.zeros(3), np.array([1.0, 0, 0])
ABOVE_ONE = np.array([1 + np.finfo(np.float32).eps, 0, 0], np.float32)
SIDE, SLANTED = np.array([0, 1.0, 0]), np.array([math.sin(1), 0, math.cos(1)])


@pytest.mark.parametrize("model", [phong, blinn_phong])
@pytest.mark.parametrize(
    ("normal", "light", "view", "shininess", "shade"),
    [
        *((FRONT, -FRONT, FRONT, shininess, 0) for shininess in (0, 1, 1e6)),  # from below
        *((NONE, FRONT, FRONT, shininess, 0) for shininess in (0, 1, 64)),
        (ABOVE_ONE, ALONG, ALONG, 1e7, 0.25),  # an ulp above one is not blown up
        (FRONT, SLANTED, SIDE, 0, 0.25),  # all over the lit side
    ],
)
def test_highlights_at_the_edge_of_what_there_is(
    model: Callable[..., Floats],
    normal: Floats,
    light: Floats,
    view: Floats,
    shininess: float,
    shade: float,
) -> None:
    found = model(normal, light, view, 0.0, specular=0.25, shininess=shininess)
    assert found == pytest.approx(shade, abs=1e-15)


@pytest.mark.parametrize("model", [phong, blinn_phong])
def test_of_a_field_what_has_no_direction_adds_no_highlight(model: Callable[..., Floats]) -> None:
    lights, views = np.array([NONE, FRONT]), np.array([FRONT, NONE])
    for shininess in (0, 1, 64):
        assert model(FRONT, lights, views, 0.0, shininess=shininess).tolist() == [0, 0]


def test_fields_are_shaded_one_by_one() -> None:
    normals, lights, views = normalise(np.random.default_rng(2).normal(size=(3, 4, 5, 3)))
    for model in (phong, blinn_phong):
        field = model(normals, lights, views, 0.5, ambient=0.1)
        each = model(normals[2, 3], lights[2, 3], views[2, 3], 0.5, ambient=0.1)
        assert field.shape == (4, 5)
        assert field[2, 3] == pytest.approx(each)
    found = irradiance([0, 0, 0], normals, [DirectionalLight((0.6, 0, 0.8), (0.5, 1, 2))])
    cosines = np.maximum(normals @ [0.6, 0, 0.8], 0)
    np.testing.assert_allclose(found, cosines[..., None] * [0.5, 1, 2], atol=1e-15)


@given(
    st.tuples(*[st.floats(-1, 1)] * 9).map(lambda v: np.reshape(v, (3, 3))),
    st.floats(1, 200),
)
def test_phong_is_its_formula_with_the_mirrored_ray_made(vectors: Floats, shininess: float) -> None:
    n, l, v = normalise(vectors)  # noqa: E741
    if min(np.linalg.norm((n, l, v), axis=-1)) < 0.5:
        return
    mirrored = 2 * (n @ l) * n - l
    expected = max(0.0, mirrored @ v) ** shininess if n @ l > 0 else 0.0
    assert phong(n, l, v, 0.0, specular=1.0, shininess=shininess) == pytest.approx(
        expected, abs=1e-12
    )


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("shininess", [1, 32, 1000])
def test_a_power_multiplies_the_rounding_of_the_cosine(dtype: type, shininess: int) -> None:
    """Near the mirror's direction, against the same in long double."""
    rng = np.random.default_rng(5)
    n = normalise(rng.normal(size=(20_000, 3)))
    along = normalise(np.cross(n, rng.normal(size=n.shape)))
    slant = rng.uniform(0, 1.5, (len(n), 1))
    l = np.cos(slant) * n + np.sin(slant) * along  # noqa: E741
    v = np.cos(slant) * n - np.sin(slant) * along + rng.normal(size=n.shape) / shininess**0.5
    n, l, v = (normalise(each).astype(dtype) for each in (n, l, v))  # noqa: E741
    found = phong(n, l, v, 0.0, specular=1.0, shininess=shininess)
    exactly = np.array([n, l, v], np.longdouble)
    exactly /= np.sqrt((exactly**2).sum(-1, keepdims=True))
    n_l, n_v, l_v = ((exactly[a] * exactly[b]).sum(-1) for a, b in ((0, 1), (0, 2), (1, 2)))
    truth = np.where(n_l > 0, np.maximum(2 * n_l * n_v - l_v, 0) ** shininess, 0)
    assert np.abs(found - truth).max() < 10 * shininess * np.finfo(dtype).eps


def test_twice_the_distance_a_quarter_of_the_light() -> None:
    np.testing.assert_allclose(attenuation([1, 2, np.inf]), [1, 0.25, 0])
    assert attenuation(0, radius=0.1) == pytest.approx(100)


def test_lights_add_up() -> None:
    lamps: list[Light] = [DirectionalLight((0, 0, 1), (1, 0, 0)), PointLight((0, 0, 2), (0, 8, 0))]
    np.testing.assert_allclose(irradiance([0, 0, 0], FRONT, lamps), [1, 2, 0])


def test_lamps_are_white_and_a_centimetre_wide_unless_told_otherwise() -> None:
    sun, lamp = DirectionalLight((0, 0, 1)), PointLight((0, 0, 1))
    assert irradiance([0, 0, 0], FRONT, [sun]).tolist() == [1, 1, 1]
    assert irradiance([0, 0, 0], FRONT, [lamp]).tolist() == [1, 1, 1]
    assert irradiance([0, 0, 0.999], FRONT, [lamp]) == pytest.approx([1e4] * 3)
    assert attenuation(0.0) == pytest.approx(1e4)


def test_light_of_a_lamp_comes_from_its_place_with_the_cosine_and_the_square() -> None:
    """At (3, 0, 0) below a lamp at (0, 0, 4): distance 5, cosine 4/5."""
    lamp = PointLight((0, 0, 4), (1.0, 2.0, 3.0))
    points = np.array([[3.0, 0, 0], [0, 0, 0], [0, 0, 8.0]])
    found = irradiance(points, np.broadcast_to(FRONT, (3, 3)), [lamp])
    expected = np.outer([0.8 / 25, 1 / 16, 0], [1, 2, 3])
    np.testing.assert_allclose(found, expected, atol=1e-15)


def test_phong_is_the_sum_of_its_three_parts_by_hand() -> None:
    """Light at 30° to the normal; the eye 10° beside its mirror image."""
    light = [math.sin(math.radians(30)), 0, math.cos(math.radians(30))]
    view = [-math.sin(math.radians(40)), 0, math.cos(math.radians(40))]
    matte = 0.6 * (0.1 + math.cos(math.radians(30)))
    shade = phong(FRONT, light, view, 0.6, specular=0.7, shininess=20, ambient=0.1)
    assert shade == pytest.approx(matte + 0.7 * math.cos(math.radians(10)) ** 20)
    halfway = blinn_phong(FRONT, light, view, 0.6, specular=0.7, shininess=20, ambient=0.1)
    assert halfway == pytest.approx(matte + 0.7 * math.cos(math.radians(5)) ** 20)


def test_the_usual_highlights_are_half_as_bright_as_white_and_fourfold_for_blinn() -> None:
    view = [math.sin(0.2), 0, math.cos(0.2)]
    assert phong(FRONT, FRONT, view) == pytest.approx(1 + 0.5 * math.cos(0.2) ** 32)
    assert blinn_phong(FRONT, FRONT, view) == pytest.approx(1 + 0.5 * math.cos(0.1) ** 128)


def test_the_brightest_lights_still_have_a_number_for_every_pixel() -> None:
    lights: list[Light] = [
        DirectionalLight((0, 0, 1), (1e30, 0.0, 1.0)),
        PointLight((0, 0, 1), (1e30, 1e30, 1e30)),
    ]
    for kind in (np.float32, np.float64):
        light = irradiance(np.zeros((2, 3), kind), np.tile(FRONT.astype(kind), (2, 1)), lights)
        assert light[0] == pytest.approx([2e30, 1e30, 1e30])
