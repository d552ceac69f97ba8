"""The Bayer figure: the mosaic, its reconstruction up to a line, and the error."""

import numpy as np
import pytest
from support.frames import pixels_of, texts_of

from simulations.engine.frame import Frame
from simulations.engine.photograph import Photograph
from simulations.engine.stages import StageCache
from simulations.models.color.srgb import decode_srgb
from simulations.models.sensor.bayer import mosaic
from simulations.models.sensor.demosaicing import METHODS
from simulations.pictures.balloon import WHOLE
from simulations.pictures.mosaic_subjects import SUBJECTS
from simulations.registry import load_ladder
from simulations.scenes.bayer_demosaic import METHOD_LABELS, SCENE

CACHE = StageCache(depth=8)


def frame(**values: object) -> Frame:
    return SCENE.render(SCENE.check(values), "", CACHE)


@pytest.mark.parametrize("picture", SUBJECTS)
def test_a_cell_differs_from_the_light_of_its_colour(picture: str) -> None:
    """Each cell, two samples wide, shows one colour; red is first."""
    shown = pixels_of(frame(picture=picture, split=0))
    cells = shown[::2, ::2, :3]
    np.testing.assert_array_equal(cells.repeat(2, axis=0).repeat(2, axis=1), shown[..., :3])
    assert np.count_nonzero(cells, axis=2).max() == 1
    assert not cells[::2, ::2, 1:].any()
    # Half a code, where the curve is steepest for light: near white.
    light = mosaic(SUBJECTS[picture].draw(WHOLE))
    np.testing.assert_allclose(decode_srgb(cells.max(axis=2) / 255), light, atol=0.5 / 255 * 2.3)


@pytest.mark.parametrize("split", [0, 0.5, 1])
@pytest.mark.parametrize(("column", "row"), [(0, 0), (104, 56), (220, 176)])
def test_the_loupe_shows_another_part(split: float, column: int, row: int) -> None:
    shown = frame(split=split, column=column, row=row)
    whole = pixels_of(shown) if split == 1 else pixels_of(shown)[::2, ::2]
    part = whole[row : row + 16, column : column + 20]
    np.testing.assert_array_equal(part, pixels_of(shown, 1), strict=True)


def test_the_line_divides_the_pictures_elsewhere() -> None:
    cells, part, whole = (pixels_of(frame(split=split)) for split in (0, 0.25, 1))
    np.testing.assert_array_equal(part[::2, :120:2], whole[:, :60])
    np.testing.assert_array_equal(part[:, 120:], cells[:, 120:])


def test_an_even_picture_of_the_readers_has_errors() -> None:
    own = Photograph(1, np.full((192, 240, 3), 90, np.uint8))
    shown = SCENE.render(SCENE.check({}), "", StageCache(), own)
    assert texts_of(shown)["worst"] == "0"
    assert texts_of(shown)["shared"] == "undefined / undefined"
    assert "your own picture" in shown.description


def test_figure_and_ladder_disagree() -> None:
    ladder = load_ladder(SCENE.ladder)
    work = ladder.prepare()
    truth = ladder.reference(work)
    for metric in ladder.metrics:
        picture = metric.id.removeprefix("psnr-") if metric.id != "light" else "balloon"
        name = "light" if metric.id == "light" else "psnr"
        for tier in ladder.tiers:
            shown = float(texts_of(frame(method=tier.id, picture=picture))[name])
            assert shown == pytest.approx(metric.measure(tier.run(work), truth, work), abs=0.051)
    assert list(METHOD_LABELS) == [tier.id for tier in ladder.tiers]
    assert SCENE.check({}).method == ladder.default_tier


def test_shared_detail_does_not_raise_the_gain_over_bilinear() -> None:
    """The chapter's conclusion."""
    shared, gain = [], []
    for picture in ("soft", "balloon", "room"):
        clever, plain = (
            texts_of(frame(picture=picture, method=method))
            for method in ("menon-unrefined", "bilinear")
        )
        shared.append(min(float(part.replace("−", "-")) for part in clever["shared"].split(" / ")))
        gain.append(float(clever["psnr"]) - float(plain["psnr"]))
    assert np.all(np.diff(shared) > 0.1)
    assert np.all(np.diff(gain) > 5)


@pytest.mark.parametrize("method", METHODS)
def test_errors_by_colour_disagree_with_psnr_and_pixels(method: str) -> None:
    """PSNR is 10 log₁₀ of 255² over the mean of the three squared errors. The error picture shows
    four times the error; for the soft picture by bilinear, none is cut off."""
    given = {"method": method, "picture": "soft" if method == "bilinear" else "balloon"}
    (estimate,) = SCENE.estimates(SCENE.check(given), "", CACHE)
    shown, parts = frame(**given), [float(part) for part in estimate.text.split(", ")]
    psnr = 10 * np.log10(255**2 / np.mean(np.square(parts)))
    assert psnr == pytest.approx(float(texts_of(shown)["psnr"]), abs=0.15)
    if method == "bilinear":
        errors = pixels_of(shown, 2)[8:-8, 8:-8, :3] / 4.0
        assert np.sqrt(np.mean(errors**2, axis=(0, 1))) == pytest.approx(parts, abs=0.1)
