"""Figures of holes and lenses: sharpness, colour, and vignetting."""

import math

import numpy as np
import pytest
from support.frames import frame_of, outputs_of, pixels_of, texts_at

from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb
from simulations.pictures.balloon import balloon
from simulations.pictures.resolution_chart import resolution_chart
from simulations.scenes.lens_aberrations.scene import SCENE as ABERRATIONS
from simulations.scenes.lens_aberrations.scene import bundle_limits
from simulations.scenes.lens_aberrations.stages import FOCAL_PX, LINES_UM, WIDTH_UM, bands, light
from simulations.scenes.pinhole import SCENE as PINHOLE
from simulations.scenes.real_lens.scene import SCENE as REAL_LENS
from simulations.scenes.still_life import (
    COLUMNS,
    HEIGHT,
    UNITS_PER_TANGENT,
    WIDTH,
    Settings,
    disc_width,
    floor_row,
)
from simulations.scenes.still_life import SCENE as STILL_LIFE
from simulations.world.still_life import OBJECTS, object_depth


def light_through(**given: object) -> Floats:
    return decode_srgb(pixels_of(frame_of(PINHOLE, **given))[..., :3] / 255.0)


def test_light_scales_with_the_holes_area_unless_exposure_compensates() -> None:
    wide, half = (float(light_through(hole=hole).mean()) for hole in (2.0, 1.0))
    assert half / wide == pytest.approx(1 / 4, rel=0.01)
    means = [float(light_through(hole=hole, longer=True).mean()) for hole in (0.1, 0.5, 2.0)]
    assert means == pytest.approx([means[0]] * 3, rel=0.02)


def test_picture_is_sharpest_with_a_hole_of_about_0_4_mm() -> None:
    pictures = [light_through(hole=hole, longer=True) for hole in (2.0, 1.0, 0.4, 0.2, 0.1)]
    sharp = [float(np.abs(np.diff(picture, axis=1)).mean()) for picture in pictures]
    assert sharp[0] < sharp[1] < sharp[2] > sharp[3] > sharp[4]


def test_picture_is_upside_down_with_left_and_right_exchanged() -> None:
    seen, scene = light_through(hole=0.4, longer=True), balloon()
    assert np.corrcoef(seen.ravel(), scene[::-1, ::-1].ravel())[0, 1] > 0.95
    assert np.corrcoef(seen.ravel(), scene.ravel())[0, 1] < 0.5


def number(name: str, **given: object) -> float:
    return float(texts_at(REAL_LENS, "exact", **given)[name].replace("\u2212", "-"))


@pytest.mark.parametrize("vergence", [0, 5, 12.5, 20])
def test_images_and_angles_obey_the_lens_equation_and_snell(vergence: float) -> None:
    image = number("thin_at", vergence=vergence)
    assert vergence / 1000 + 1 / image == pytest.approx(25 / 1000, abs=1e-5)
    angles = [number(name, vergence=vergence, index=1.7) for name in ("incidence", "refracted")]
    outside, inside = (math.sin(math.radians(angle)) for angle in angles)
    assert outside == pytest.approx(1.7 * inside, abs=0.003)


def test_aberration_grows_with_squared_height_and_with_a_reversed_lens() -> None:
    off = number("true_at") - number("thick_at")
    assert number("aberration") == pytest.approx(off, abs=0.011)
    two, four = (number("aberration", height=height) for height in (2, 4))
    assert four == pytest.approx(4 * two, rel=0.05)
    one, other = (
        number("aberration", front=front, back=40 - front, thickness=6) for front in (40, 0)
    )
    assert 3.5 < other / one < 4.5


CHART: dict[str, object] = {"picture": "chart", "aperture": 16}


def test_red_and_blue_edges_lie_apart_by_their_difference_in_scale() -> None:
    """An edge of the chart's border, 150 px right of the centre, located by the area under it."""
    planes = outputs_of(ABERRATIONS, "gauss-1", **CHART, glass="flint", stop=15)["channels"]
    edges = []
    for channel in (0, 2):
        row = planes[channel, 116:124, 302:316].mean(axis=0)
        bright, dark = row[:2].mean(), row[-2:].mean()
        edges.append(302 + ((row - dark) / (bright - dark)).sum())  # as if the edge were hard
    radius = np.mean(edges) - 159.5
    assert edges[1] - edges[0] == pytest.approx(-15 / (24 * 36.4) * radius, abs=0.1)


def test_ideal_lens_at_small_aperture_shows_the_chart_itself() -> None:
    given = {"glass": "ideal", "rim": 0, "natural": "false"}
    planes = outputs_of(ABERRATIONS, "gauss-1", **CHART, **given)
    chart = resolution_chart(336, 256, FOCAL_PX).transpose(2, 0, 1)[:, 8:-8, 8:-8]
    np.testing.assert_array_equal(planes["channels"], chart)
    assert (planes["vignetting"] == 1).all()


def test_even_wavelengths_span_each_channels_band() -> None:
    for band, line in zip(bands("even-31", "flint"), LINES_UM, strict=True):
        off = (band.wavelengths_um - line) / WIDTH_UM
        assert off.min() < -3.5 < 3.5 < off.max()
        assert [band.shares @ off, band.shares @ off**2] == pytest.approx([0, 1], abs=0.03)


def test_edge_of_a_band_is_blurred_by_the_spread_of_its_scales() -> None:
    """The vertical edge 150 px from the centre; variances of its place and of the scales agree."""

    def spread(**given: object) -> tuple[float, float]:
        channels: Floats = outputs_of(ABERRATIONS, "even-31", **CHART, **given)["channels"]
        steps = -np.diff(channels[2, 116:124, 302:314].mean(axis=0).astype(float))
        steps /= steps.sum()
        at = np.arange(steps.size) + 302.5 - 159.5
        return float(steps @ (at - steps @ at) ** 2), float(steps @ at)

    (wide, radius), (sharp, _) = spread(glass="flint", stop=15), spread(glass="ideal")
    band = bands("even-31", "flint")[2]
    sizes = 15 / 24 * (1 / 36.4) / (0.4861**-2 - 0.6563**-2) * band.wavelengths_um**-2
    expected = radius**2 * float(band.shares @ (sizes - band.shares @ sizes) ** 2)
    assert wide - sharp == pytest.approx(expected, rel=0.15)


@pytest.mark.parametrize("aperture", [1.4, 2.8, 16])
@pytest.mark.parametrize("rim", [0, 3, 6, 10])
def test_drawn_bundle_is_cut_where_the_corner_loses_light(aperture: float, rim: int) -> None:
    (share,) = light(np.array([1.0]), aperture, rim, False)[1]
    drawn = bundle_limits(aperture, rim)
    assert (drawn is None) == (share == 0)
    assert (drawn is not None and drawn[1] == -drawn[0]) == (share == 1)


BY_NAME = {thing.name: thing for thing in OBJECTS}


def test_floor_row_has_the_depth_it_stands_for() -> None:
    depth = outputs_of(STILL_LIFE)["light"].base_depth[:, 3]
    for wanted in (2.0, 3.0, 5.0):
        row = floor_row(wanted) * len(depth) / HEIGHT
        assert np.interp(row - 0.5, np.arange(len(depth)), depth) == pytest.approx(wanted, rel=0.01)


@pytest.mark.parametrize("name", ["red ball", "striped ball", "green ball"])
def test_press_on_an_object_focuses_on_it(name: str) -> None:
    x, _, top = BY_NAME[name].solid.centre
    depth = object_depth(BY_NAME[name])
    across = WIDTH / 2 + UNITS_PER_TANGENT * x / depth
    down = floor_row(depth) - UNITS_PER_TANGENT * top / depth
    focus = STILL_LIFE.pull(Settings(), "aim", (across, down))["focus"]
    assert float(focus) == pytest.approx(depth, abs=0.05)


def test_striped_ball_is_sharpest_in_focus() -> None:
    depth = object_depth(BY_NAME["striped ball"])

    def contrast(focus: float) -> float:
        picture = pixels_of(frame_of(STILL_LIFE, focus=focus)).astype(float)
        x = int((0.5 - 0.1 * UNITS_PER_TANGENT / depth / WIDTH) * COLUMNS)
        y = int((floor_row(depth) - 80.0) / WIDTH * COLUMNS)
        window = picture[y - 60 : y + 60, x - 60 : x + 60, :3]
        return float((np.diff(window, axis=0) ** 2).mean())

    assert contrast(depth) > 1.2 * max(contrast(2.0), contrast(7.0))
    assert disc_width(2.0, 3.2, 3.2) == 0.0
    assert disc_width(4.0, 3.2, 8.0) == pytest.approx(disc_width(2.0, 3.2, 8.0) / 2)
