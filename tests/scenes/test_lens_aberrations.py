"""Chromatic aberration and vignetting of the figure against their formulas, and in its pixels."""

import numpy as np
import pytest
from support.frames import estimates_of, frame_of, outputs_of, pixels_of

from simulations.models.arrays import Floats
from simulations.pictures.resolution_chart import resolution_chart
from simulations.scenes.lens_aberrations.scene import SCENE, passing
from simulations.scenes.lens_aberrations.stages import (
    FOCAL_MM,
    FOCAL_PX,
    LINES_UM,
    WIDTH_UM,
    bands,
    discs_px,
    light,
    scales,
)

LINES = np.array(LINES_UM)


@pytest.mark.parametrize(("glass", "abbe"), [("crown", 64.2), ("flint", 36.4)])
def test_blue_and_red_differ_in_size_by_t_over_f_v_and_discs_by_the_f_number(
    glass: str, abbe: float
) -> None:
    before, behind = (scales(glass, stop, LINES) - 1 for stop in (12, -12))
    assert before[0] - before[2] == pytest.approx(12 / (FOCAL_MM * abbe))
    assert behind == pytest.approx(-before)
    wide, narrow = (discs_px(glass, f_number, LINES) for f_number in (2, 8))
    assert wide == pytest.approx(4 * narrow)
    assert before[1] == wide[1] == 0  # the d line is the measure


def test_red_and_blue_edges_lie_apart_in_the_picture_by_the_difference_in_size() -> None:
    """An edge of the chart's border, 150 px right of the centre: where its area puts it."""
    planes = outputs_of(SCENE, "gauss-1", glass="flint", stop=15, aperture=16)["channels"]
    edges = []
    for channel in (0, 2):
        row = planes[channel, 116:124, 302:316].mean(axis=0)
        bright, dark = row[:2].mean(), row[-2:].mean()
        edges.append(302 + ((row - dark) / (bright - dark)).sum())  # as if the edge were hard
    radius = np.mean(edges) - 159.5
    assert edges[1] - edges[0] == pytest.approx(-15 / (24 * 36.4) * radius, abs=0.1)


def test_an_ideal_lens_at_small_aperture_shows_the_chart_itself() -> None:
    given = {"glass": "ideal", "aperture": 16, "rim": 0, "natural": "false"}
    planes = outputs_of(SCENE, "gauss-1", **given)
    chart = resolution_chart(336, 256, FOCAL_PX).transpose(2, 0, 1)[:, 8:-8, 8:-8]
    np.testing.assert_array_equal(planes["channels"], chart)
    assert (planes["vignetting"] == 1).all()


def test_even_wavelengths_leave_out_nothing_that_a_channel_sees() -> None:
    for band, line in zip(bands("even-31", "flint"), LINES_UM, strict=True):
        off = (band.wavelengths_um - line) / WIDTH_UM
        assert off.min() < -3.5 < 3.5 < off.max()
        assert [band.shares @ off, band.shares @ off**2] == pytest.approx([0, 1], abs=0.03)


@pytest.mark.parametrize("tier", SCENE.tiers)
def test_glass_without_dispersion_needs_one_wavelength_in_every_tier(tier: str) -> None:
    one, same = (pixels_of(frame_of(SCENE, each, glass="ideal"), 2) for each in ("gauss-1", tier))
    np.testing.assert_array_equal(one, same)
    assert estimates_of(SCENE, tier, glass="ideal")[-1].text == "under 10⁻³"


def test_no_light_is_lost_among_the_wavelengths() -> None:
    """A white wall has no edges: every tier gives the same light everywhere."""
    one, many = (outputs_of(SCENE, t, aperture=16)["channels"] for t in ("gauss-1", "even-16"))
    assert many.mean() == pytest.approx(one.mean(), rel=1e-3)
    middle = (slice(None), slice(112, 128), slice(188, 194))  # paper, far from any edge
    np.testing.assert_allclose(many[middle], one[middle], rtol=1e-4)


def test_the_edge_of_a_band_is_smeared_by_the_spread_of_its_sizes() -> None:
    """The vertical edge 150 px from the centre: the variance of its place is that of the scales."""

    def spread(**given: object) -> tuple[float, float]:
        channels: Floats = outputs_of(SCENE, "even-31", aperture=16, **given)["channels"]
        steps = -np.diff(channels[2, 116:124, 302:314].mean(axis=0).astype(float))
        steps /= steps.sum()
        at = np.arange(steps.size) + 302.5 - 159.5
        return float(steps @ (at - steps @ at) ** 2), float(steps @ at)

    (wide, radius), (sharp, _) = spread(glass="flint", stop=15), spread(glass="ideal")
    band = bands("even-31", "flint")[2]
    sizes = 15 / 24 * (1 / 36.4) / (0.4861**-2 - 0.6563**-2) * band.wavelengths_um**-2
    expected = radius**2 * float(band.shares @ (sizes - band.shares @ sizes) ** 2)
    assert wide - sharp == pytest.approx(expected, rel=0.15)


def test_more_wavelengths_come_nearer_to_the_whole_spectrum() -> None:
    one, three, sixteen = (
        float(estimates_of(SCENE, tier, glass="flint")[-1].text)
        for tier in ("gauss-1", "gauss-3", "even-16")
    )
    assert one > 3 * three > 9 * sixteen


@pytest.mark.parametrize("aperture", [1.4, 2.8, 16])
@pytest.mark.parametrize("rim", [0, 3, 6, 10])
def test_the_bundle_as_drawn_is_cut_where_the_corner_loses_light(aperture: float, rim: int) -> None:
    (share,) = light(np.array([1.0]), aperture, rim, False)[1]
    drawn = passing(aperture, rim)
    assert (drawn is None) == (share == 0)
    assert (drawn is not None and drawn[1] == -drawn[0]) == (share == 1)
