"""Chromatic aberration and vignetting of the figure against their formulas, and in its pixels."""

from functools import partial

import numpy as np
import pytest
from support.frames import frame_of

from simulations.engine.frame import Frame, Raster, Readout
from simulations.engine.stages import Outputs, StageCache
from simulations.models.arrays import Floats
from simulations.models.lens.chromatic_aberration import LINE_D_UM
from simulations.pictures.resolution_chart import resolution_chart
from simulations.scenes.lens_aberrations.colours import colours
from simulations.scenes.lens_aberrations.scene import SCENE
from simulations.scenes.lens_aberrations.section import passing
from simulations.scenes.lens_aberrations.spectrum import LINES_UM, WIDTH_UM, bands
from simulations.scenes.lens_aberrations.stages import (
    FOCAL_MM,
    FOCAL_PX,
    light,
)

frame = partial(frame_of, SCENE)


def raster(shown: Frame, panel: str = "picture") -> Raster:
    (pixels,) = (each.raster for each in shown.panels if each.name == panel)
    assert pixels is not None
    return pixels


def judged(tier: str, cache: StageCache | None = None, **given: object) -> list[Readout]:
    """All estimates of the error, as shown."""
    return list(SCENE.estimates(SCENE.check(given), tier, cache or StageCache()))


def final_error(tier: str, cache: StageCache | None = None, **given: object) -> float:
    text = judged(tier, cache, **given)[-1].text
    return 0.0 if text.startswith("under") else float(text)


def outputs(tier: str = "gauss-1", **given: object) -> Outputs:
    return SCENE.run(SCENE.check(given), tier, StageCache()).outputs


@pytest.mark.parametrize(("glass", "abbe"), [("crown", 64.2), ("flint", 36.4)])
def test_blue_and_red_differ_in_size_by_t_over_f_v(glass: str, abbe: float) -> None:
    scale = colours(glass, 12, 2.8).scale
    assert scale[0] - scale[2] == pytest.approx(12 / (FOCAL_MM * abbe))
    assert scale[1] == 1  # the d line is the measure


def test_moving_the_stop_behind_the_lens_swaps_red_and_blue() -> None:
    before, behind = (colours("crown", t, 2.8).scale - 1 for t in (10, -10))
    assert behind == pytest.approx(-before)


def test_axial_discs_are_inverse_to_the_f_number() -> None:
    wide, narrow = (colours("flint", 0, n).disc_px for n in (2, 8))
    assert wide == pytest.approx(4 * narrow)
    assert wide[1] == 0
    assert LINE_D_UM == 0.5876


def test_the_rim_cuts_wide_bundles_and_spares_narrow_ones() -> None:
    shares = [light(np.array([0.0, 1.0]), n, 6, False)[1] for n in (1.4, 2.8, 16)]
    assert all(share[0] == 1 for share in shares)
    assert shares[0][1] < shares[1][1] < shares[2][1] == 1


def test_red_and_blue_edges_lie_apart_in_the_picture_by_the_shift_read_out() -> None:
    """An edge of the chart's border, 150 px right of the centre: where its area puts it."""
    planes = outputs(glass="flint", stop=15, aperture=16)["channels"]
    edges = []
    for channel in (0, 2):
        row = planes[channel, 116:124, 302:316].mean(axis=0)
        bright, dark = row[:2].mean(), row[-2:].mean()
        edges.append(302 + ((row - dark) / (bright - dark)).sum())  # as if the edge were hard
    radius = np.mean(edges) - 159.5
    assert edges[1] - edges[0] == pytest.approx(-15 / (24 * 36.4) * radius, abs=0.1)


def test_an_ideal_lens_at_small_aperture_shows_the_chart_itself() -> None:
    planes = outputs(glass="ideal", aperture=16, rim=0, natural="false")
    chart = resolution_chart(336, 256, FOCAL_PX).transpose(2, 0, 1)[:, 8:-8, 8:-8]
    assert np.array_equal(planes["channels"], chart)
    assert (planes["vignetting"] == 1).all()


def test_even_wavelengths_leave_out_nothing_that_a_channel_sees() -> None:
    for band, line in zip(bands("even-31", "flint"), LINES_UM, strict=True):
        off = (band.wavelengths_um - line) / WIDTH_UM
        assert off.min() < -3.5
        assert off.max() > 3.5
        assert band.shares @ off == pytest.approx(0, abs=0.01)
        assert band.shares @ off**2 == pytest.approx(1, abs=0.03)


@pytest.mark.parametrize("tier", SCENE.tiers)
def test_glass_without_dispersion_needs_one_wavelength_in_every_tier(tier: str) -> None:
    shown = frame(tier, glass="ideal")
    np.testing.assert_array_equal(raster(shown), raster(frame(glass="ideal")))
    assert judged(tier, glass="ideal")[-1].text == "under 10⁻³"


def test_no_light_is_lost_among_the_wavelengths() -> None:
    """A white wall has no edges: every tier gives the same light everywhere."""
    one, many = (outputs(tier, aperture=16)["channels"] for tier in ("gauss-1", "even-16"))
    assert many.mean() == pytest.approx(one.mean(), rel=1e-3)
    middle = (slice(None), slice(112, 128), slice(188, 194))  # paper, far from any edge
    np.testing.assert_allclose(many[middle], one[middle], rtol=1e-4)


def test_the_edge_of_a_band_is_smeared_by_the_spread_of_its_sizes() -> None:
    """The vertical edge 150 px from the centre: the variance of its place is that of the scales."""
    ghosts = outputs("even-31", glass="flint", stop=15, aperture=16)
    row = ghosts["channels"][2, 116:124, 302:314].mean(axis=0).astype(float)
    plain = outputs("even-31", glass="ideal", aperture=16)["channels"][2, 116:124, 302:314]

    def spread(profile: Floats) -> tuple[float, float]:
        steps = -np.diff(profile)
        steps /= steps.sum()
        at = np.arange(steps.size) + 302.5 - 159.5
        return float(steps @ (at - steps @ at) ** 2), float(steps @ at)

    (wide, radius), (sharp, _) = spread(row), spread(plain.mean(axis=0).astype(float))
    band = bands("even-31", "flint")[2]
    sizes = 15 / 24 * (1 / 36.4) / (0.4861**-2 - 0.6563**-2) * band.wavelengths_um**-2
    expected = radius**2 * float(band.shares @ (sizes - band.shares @ sizes) ** 2)
    assert wide - sharp == pytest.approx(expected, rel=0.15)


def test_more_wavelengths_come_nearer_to_the_whole_spectrum() -> None:
    cache = StageCache()
    tiers = ("gauss-1", "gauss-3", "even-16")
    one, three, sixteen = (final_error(tier, cache, glass="flint") for tier in tiers)
    assert one > 3 * three > 9 * sixteen


@pytest.mark.parametrize("aperture", [1.4, 2.8, 16])
@pytest.mark.parametrize("rim", [0, 3, 6, 10])
def test_the_bundle_as_drawn_is_cut_where_the_corner_loses_light(aperture: float, rim: int) -> None:
    (share,) = light(np.array([1.0]), aperture, rim, False)[1]
    drawn = passing(aperture, rim)
    assert (drawn is None) == (share == 0)
    assert (drawn is not None and drawn[1] == -drawn[0]) == (share == 1)
