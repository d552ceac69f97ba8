"""Where light is computed on the ball: what each tier of the two scenes on reflection paints."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from support.frames import estimates_of, frame_of, number_of

from simulations.engine.frame import Frame
from simulations.engine.scene import Scene
from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb
from simulations.models.light.reflectance import blinn_phong, lambert, phong
from simulations.scenes._ball import ball as the_ball
from simulations.scenes._ball.ball import LIT, RADIUS_PX, build_ball, light_direction, rms_error
from simulations.scenes.lambertian_shading import scene as lambertian
from simulations.scenes.phong import scene as glossy
from simulations.scenes.phong.gloss import ALBEDO, true_light

BALL = build_ball()
CELLS = {tier: int(tier.rpartition("-")[2]) for tier in LIT if tier.startswith("gouraud")}


def told(scene: Scene[Any], tier: str, **given: float | str) -> float:
    """The error as a number, from the only estimate."""
    (estimate,) = estimates_of(scene, tier, **given)
    assert estimate.unit == "of white"
    return number_of(estimate.text)


def normals_64() -> NDArray[np.float64]:
    """(h, w, 3) unit normals of the ball's own pixels; towards the camera elsewhere."""
    x, y = np.meshgrid(BALL.x.astype(float) / RADIUS_PX, BALL.y.astype(float) / RADIUS_PX)
    z = np.sqrt(np.maximum(1 - x * x - y * y, 0))
    return np.where(BALL.inner[..., None], np.stack([x, y, z], axis=-1), (0, 0, 1.0))


def red(shown: Frame) -> Floats:
    """Linear red light of the ball's pixels, decoded from the bytes of the picture."""
    raster = shown.panels[0].raster
    assert raster is not None
    return decode_srgb(raster[BALL.square][..., 0][BALL.inner] / 255.0)


def test_blended_normals_are_unit_normals_of_every_pixel_near_the_true_ones() -> None:
    blended = the_ball.lit_normals(BALL, "blended-normals-16")
    assert blended.shape == BALL.normals.shape
    np.testing.assert_allclose(np.linalg.norm(blended, axis=-1), 1, atol=1e-6)
    off_rad = np.linalg.norm(blended - normals_64(), axis=-1)[BALL.inner]
    middle = np.hypot(*np.meshgrid(BALL.x, BALL.y))[BALL.inner] < RADIUS_PX / 2
    # As for blended light below, with cells of an eighth of the radius that reach to 0.63.
    assert 1e-4 < off_rad[middle].max() < (2.02 / 16) ** 2 / 8 * 2 * (1 - 0.63**2) ** -1.5
    assert off_rad.max() < math.radians(20)


@pytest.mark.parametrize(("tier", "cells"), CELLS.items())
def test_blended_light_misses_no_more_than_the_curvature_of_the_cosine_allows(
    tier: str, cells: int
) -> None:
    """Lit from the camera, I = z: a cell of width h misses at most h²/8 (|z_xx| + |z_yy|)."""
    x, y = np.meshgrid(BALL.x, BALL.y)
    middle = (np.hypot(x, y) < RADIUS_PX / 2)[BALL.inner]
    shown = frame_of(lambertian.SCENE, tier, light_angle=0, albedo=1)
    wrong = np.abs(red(shown) - normals_64()[BALL.inner][:, 2])[middle]
    width = (BALL.x[-1] - BALL.x[0]) / cells / RADIUS_PX
    # Cells that reach out of the middle see the curvature at a radius of 0.5 + h at most.
    steepest = (1 - min(0.5 + width, 0.8) ** 2) ** -1.5
    code = 0.5 / 255 * 2.4
    assert wrong.max() < width**2 / 8 * 2 * steepest + code
    assert wrong.max() > width**2 / 8


@pytest.mark.parametrize("light_angle", [0, 70, -140])
def test_light_in_every_pixel_errs_by_the_rounding_of_float32(light_angle: float) -> None:
    assert told(lambertian.SCENE, "phong", light_angle=light_angle) < 2**-22
    # A power of 300 multiplies a relative error by 300.
    shiny = told(glossy.SCENE, "phong", light_angle=light_angle, shininess=300)
    assert shiny < 300 * 2**-23


@pytest.mark.parametrize("scene", [lambertian.SCENE, glossy.SCENE])
@pytest.mark.parametrize("light_angle", [0, 60, 150])
def test_finer_cells_are_nearer_to_the_truth(scene: Scene[Any], light_angle: float) -> None:
    errors = [told(scene, tier, light_angle=light_angle) for tier in (*CELLS, "phong")]
    assert errors == sorted(errors, reverse=True)
    assert errors[0] > 4 * errors[3]


@pytest.mark.parametrize("tier", LIT)
@pytest.mark.parametrize("model", ["phong", "blinn_phong"])
def test_the_error_told_is_that_of_the_bytes_shown(tier: str, model: str) -> None:
    """Strength and albedo add up to less than 1, so that no pixel is cut off at white."""
    given: dict[str, float | str] = {
        "light_angle": 75,
        "specular": 0.35,
        "shininess": 9,
        "model": model,
    }
    formula = {"phong": phong, "blinn_phong": blinn_phong}[model]
    truth = formula(
        normals_64(),
        light_direction(75),
        [0, 0, 1],
        albedo=float(ALBEDO[0]),
        specular=0.35,
        shininess=9,
    )[BALL.inner]
    seen = np.sqrt(np.mean((red(frame_of(glossy.SCENE, tier, **given)) - truth) ** 2))
    assert seen == pytest.approx(told(glossy.SCENE, tier, **given), rel=0.05, abs=1.5e-3)


@pytest.mark.parametrize("light_angle", [-180, -179, -91, -30, 0, 30, 91, 180])
def test_the_truth_is_that_of_the_models_in_double_precision(light_angle: float) -> None:
    towards = light_direction(light_angle)
    cosine = np.maximum(the_ball.true_cosine(BALL, light_angle), 0)
    expected = lambert(normals_64(), towards)
    np.testing.assert_allclose(cosine[BALL.inner], expected[BALL.inner], atol=1e-14)
    for model, formula in (("phong", phong), ("blinn_phong", blinn_phong)):
        given = {"shininess": 41, "specular": 0.7}
        expected = formula(normals_64(), towards, [0, 0, 1], albedo=float(ALBEDO[0]), **given)
        truth = true_light(BALL, light_angle, model, **given)
        np.testing.assert_allclose(truth[BALL.inner], expected[BALL.inner], atol=1e-12)


def test_the_error_is_the_root_mean_square_over_the_ball_alone() -> None:
    truth = np.zeros(BALL.inner.shape)
    assert rms_error(BALL, np.where(BALL.inner, 0.25, 9.0), truth).text == "0.25"
    inner = np.flatnonzero(BALL.inner)
    half = np.zeros(truth.size)
    half[inner[::2]] = 0.5
    # Every second pixel off by a half: the mean square is an eighth.
    assert float(rms_error(BALL, half.reshape(truth.shape), truth).text) == pytest.approx(
        math.sqrt(1 / 8), abs=0.005
    )


def test_a_highlight_between_two_corners_is_lost_and_blended_normals_keep_it() -> None:
    """The place of the chapter: light from 45°, shininess 300, cells of an eighth."""
    given = {"light_angle": 45, "shininess": 300, "specular": 1}
    brightest = {
        tier: red(frame_of(glossy.SCENE, tier, **given)).max()
        for tier in ("gouraud-8", "phong", "blended-normals-16")
    }
    assert brightest["phong"] == pytest.approx(1, abs=0.01)
    assert brightest["blended-normals-16"] == pytest.approx(1, abs=0.02)
    assert brightest["gouraud-8"] == pytest.approx(float(ALBEDO[0]), abs=0.03)


@pytest.mark.parametrize(
    ("angle", "expected"),
    [(0, [0, 0, 1]), (90, [1, 0, 0]), (-90, [-1, 0, 0]), (180, [0, 0, -1]), (-180, [0, 0, -1])],
)
def test_quarter_turns_of_the_light_have_exact_zeros(angle: float, expected: list[float]) -> None:
    assert light_direction(angle).tolist() == expected
