"""The Phong figure shows what the two models say."""

import math
from functools import partial

import numpy as np
import pytest
from numpy.typing import NDArray
from support.frames import frame_of, pixels_of, texts_of

from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.scenes._ball.ball import PIXELS_PER_UNIT, RADIUS_PX, build_ball, light_direction
from simulations.scenes.phong import width
from simulations.scenes.phong.gloss import (
    ALBEDO,
    angles_at,
    fading,
    half_width_rad,
    highlight,
    lobe,
)
from simulations.scenes.phong.scene import SCENE

BALL = build_ball()
MIDDLE, COLUMN = round(170 * PIXELS_PER_UNIT), round(200 * PIXELS_PER_UNIT)
"""The pixel at the ball's centre."""


frame = partial(frame_of, SCENE)


def unit(angle_deg: float) -> NDArray[np.float64]:
    return np.array([math.sin(math.radians(angle_deg)), 0, math.cos(math.radians(angle_deg))])


@pytest.mark.parametrize(("light", "probe"), [(60, 20), (-130, 45), (179, -90), (0, 0)])
def test_cosines_are_those_of_the_vectors(light: float, probe: float) -> None:
    n, to_light, v = unit(probe), unit(light), unit(0)
    mirrored = 2 * (n @ to_light) * n - to_light
    halfway = (to_light + v) / np.linalg.norm(to_light + v)
    at = angles_at(light, probe)
    assert at.n_dot_l == pytest.approx(n @ to_light, abs=1e-12)
    assert at.r_dot_v == pytest.approx(mirrored @ v, abs=1e-12)
    assert at.n_dot_h == pytest.approx(n @ halfway, abs=1e-9)


@pytest.mark.parametrize("model", ["phong", "blinn_phong"])
@pytest.mark.parametrize("shininess", [5, 50, 500])
def test_the_half_width_read_out_is_where_the_drawn_lobe_has_half_its_height(
    model: str, shininess: float
) -> None:
    """Normal and lamp in line, so that both models have the lobe's peak at the normal."""
    highlight = lobe(0, model, shininess, specular=1) - ALBEDO[0]
    width_deg = np.interp(0.5, highlight[:89:-1], np.arange(0.0, 91.0)[::-1])
    assert math.degrees(half_width_rad(model, shininess)) == pytest.approx(width_deg, abs=0.3)


@pytest.mark.parametrize("model", ["phong", "blinn_phong"])
def test_the_plot_of_the_width_is_the_drawn_lobe_and_its_handle_sets_the_shininess(
    model: str,
) -> None:
    """Normal and lamp in line, so that the camera's turn is its angle from the normal."""
    drawn = lobe(0, model, 30, specular=1) - ALBEDO[0]
    turns = np.radians(np.arange(0.0, 61.0))
    np.testing.assert_allclose(fading(model, 30, turns), drawn[90:151], atol=1e-9)
    place = width.at(model, 30)
    assert place is not None
    assert SCENE.pull(SCENE.check({"model": model}), "width", place) == {"shininess": 30}


def test_blinn_needs_a_fourfold_exponent() -> None:
    assert half_width_rad("blinn_phong", 80) == pytest.approx(half_width_rad("phong", 20), rel=0.02)


@pytest.mark.parametrize("model", ["phong", "blinn_phong"])
def test_the_highlight_peaks_halfway_between_lamp_and_camera(model: str) -> None:
    given: dict[str, float | str] = {"light_angle": 60, "model": model, "shininess": 300}
    shiny = pixels_of(frame(specular=1, **given))[MIDDLE, :, 1].astype(int)
    matte = pixels_of(frame(specular=0, **given))[MIDDLE, :, 1].astype(int)
    columns = np.flatnonzero(shiny - matte == (shiny - matte).max())
    assert columns.mean() == pytest.approx(COLUMN + RADIUS_PX * math.sin(math.radians(30)), abs=3)


def test_the_pixel_at_the_probed_point_has_the_brightness_read_out() -> None:
    shown = frame(probe=0)
    red = pixels_of(shown)[MIDDLE, COLUMN, 0]
    assert red == pytest.approx(
        255 * float(encode_srgb(float(texts_of(shown)["brightness"]))), abs=1
    )


def test_the_highlight_adds_the_same_light_to_every_channel() -> None:
    with_spot, without = (
        decode_srgb(
            pixels_of(frame(light_angle=0, probe=0, specular=strength))[MIDDLE, COLUMN] / 255
        )
        for strength in (0.3, 0)
    )
    assert (with_spot - without)[:3] == pytest.approx([0.3] * 3, abs=0.006)
    assert without[:3] == pytest.approx(ALBEDO, abs=0.004)


@pytest.mark.parametrize(("model", "stretched"), [("phong", True), ("blinn_phong", False)])
def test_grazing_light_stretches_phongs_highlight_and_not_blinns(
    model: str, stretched: bool
) -> None:
    """Normals are scanned across and along the plane of light and camera, around their middle."""
    turns = np.radians(np.arange(-80, 80.5, 0.5))
    middle = math.radians(75)
    along = np.stack([np.sin(middle + turns), 0 * turns, np.cos(middle + turns)], axis=-1)
    across = np.stack(
        [np.cos(turns) * math.sin(middle), np.sin(turns), np.cos(turns) * math.cos(middle)], axis=-1
    )
    counts = [
        np.count_nonzero(highlight(n, 150, np.array([0, 0, 1.0]), model, 80) > 0.9)
        for n in (along, across)
    ]
    assert (counts[1] > 1.5 * counts[0]) == stretched


@pytest.mark.parametrize("model", ["phong", "blinn_phong"])
@pytest.mark.parametrize("angle", [180, -180])
def test_light_from_exactly_behind_leaves_ball_and_rim_black(model: str, angle: float) -> None:
    """As `lobe`, readouts and description say, and as the models answer for these directions."""
    behind = light_direction(angle)
    assert not highlight(BALL.normals, angle, np.array([0, 0, 1.0]), model, 1).any()
    assert behind.tolist() == [0, 0, -1]
    shown = frame(light_angle=angle, model=model, specular=1, shininess=1)
    assert not pixels_of(shown)[BALL.square][BALL.inner][:, :3].any()
    matte = frame(light_angle=angle, model=model, specular=0)
    np.testing.assert_array_equal(pixels_of(shown), pixels_of(matte))


@pytest.mark.parametrize("model", ["phong", "blinn_phong"])
@pytest.mark.parametrize(("light_angle", "probe"), [(60, 20), (100, 5), (150, 50), (-170, 40)])
def test_plot_readouts_and_chapter_have_one_formula(
    model: str, light_angle: float, probe: int
) -> None:
    """The chapter's, by angles: the highlight only where the light is above the horizon."""
    turn = math.radians(light_angle - probe)
    view = math.radians(-probe)
    lobe_cosine = math.cos(-turn - view if model == "phong" else (turn + view) / 2)
    matte = ALBEDO[0] * max(0, math.cos(turn))
    shine = max(0, lobe_cosine) ** 3 if math.cos(turn) > 0 else 0
    shown = texts_of(
        frame(light_angle=light_angle, probe=probe, model=model, shininess=3, specular=0.5)
    )
    assert float(shown["brightness"]) == pytest.approx(matte + 0.5 * shine, abs=6e-4)
    seen = lobe(light_angle - probe, model, 3, specular=0.5)[90 - probe]
    assert seen == pytest.approx(matte + 0.5 * shine, abs=1e-6)


def test_the_highlight_led_to_a_normal_turns_the_lamp_twice_as_far() -> None:
    x = 200 + 122 * math.sin(math.radians(40))
    assert SCENE.pull(SCENE.check({}), "highlight", (x, 170)) == {"light_angle": 80}
