"""The figure of a light on a cloth shows what the eye sees, and which twins it can tell apart."""

from functools import partial

import numpy as np
import pytest
from support.frames import frame_of, pixels_of, texts_of

from simulations.engine.stages import StageCache
from simulations.models.color.chromaticity import ILLUMINANT_A_XY
from simulations.scenes._spectra.axes import FINE, PLOT
from simulations.scenes.light_and_cloth.scene import SCENE
from simulations.scenes.light_and_cloth.stages import Seen

frame = partial(frame_of, SCENE)


def seen(**given: object) -> Seen:
    found: Seen = SCENE.run(SCENE.check(given), "", StageCache()).outputs["seen"]
    return found


def test_twins_match_in_daylight_alone() -> None:
    assert seen(light="daylight", temperature=6500).apart.max() < 0.1
    for other in ("planck", "fluorescent", "diode"):
        assert seen(light=other).apart.min() > 1, other


def test_the_white_of_a_lamp_lies_at_illuminant_a() -> None:
    assert seen(temperature=2850).white_xy == pytest.approx(ILLUMINANT_A_XY, abs=0.002)


def test_the_area_in_colours_ends_at_the_light_sent_back() -> None:
    """White sends back nine tenths of the light; a narrow band, next to nothing away from it."""
    picture = pixels_of(frame(surface="cloth", band=450, width=10, light="daylight"))
    x, y = (round(FINE * each) for each in PLOT.at(650, 0.3))
    assert picture[y, x, 3] == 0
    assert pixels_of(frame(surface="white", light="daylight", temperature=6500))[y, x, 3] == 255


def test_daylight_is_never_redder_than_it_was_measured() -> None:
    red, least = (frame(light="daylight", temperature=kelvin) for kelvin in (2000, 4000))
    assert red.readouts == least.readouts
    assert "4000 K" in red.description


def test_a_narrow_band_moves_along_the_edge_of_all_colours() -> None:
    blue, red = (texts_of(frame(band=nm, width=10)) for nm in (460, 640))
    assert float(red["x"]) > 0.55
    assert float(blue["x"]) < float(red["x"])


def test_by_day_a_surface_and_its_twin_have_one_colour() -> None:
    surfaces, twins = seen(light="fluorescent").by_day
    np.testing.assert_allclose(surfaces, twins, atol=1e-9)


def test_patches_of_this_light_and_of_daylight_touch_and_twins_have_a_space_between() -> None:
    def solid_rows(**given: object) -> int:
        opaque = pixels_of(frame(**given), 1)[..., 3].any(axis=1)
        return int(np.count_nonzero(np.diff(opaque.astype(int)) == 1))

    assert solid_rows() == 1
    assert solid_rows(twin=True) == 2
