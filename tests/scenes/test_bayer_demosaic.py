"""The Bayer figure: the mosaic, its reconstruction up to a line, and the error."""

import numpy as np
import pytest
from support.frames import pixels_of, texts_of

from simulations.engine.controls import Choice
from simulations.engine.frame import Frame, Readout
from simulations.engine.photograph import Photograph
from simulations.engine.stages import StageCache
from simulations.models.color.srgb import decode_srgb
from simulations.models.sensor.bayer import mosaic
from simulations.models.sensor.demosaicing import METHODS
from simulations.pictures.balloon import WHOLE
from simulations.pictures.mosaic_subjects import SUBJECTS
from simulations.registry import load_ladder
from simulations.scenes.bayer_demosaic.scene import SCENE
from simulations.scenes.bayer_demosaic.settings import METHOD_LABELS


@pytest.fixture(scope="module")
def cache() -> StageCache:
    return StageCache(depth=8)


def frame(cache: StageCache, **values: object) -> Frame:
    return SCENE.render(SCENE.check(values), "", cache)


def test_each_pixel_of_the_mosaic_shows_one_colour(cache: StageCache) -> None:
    cells = pixels_of(frame(cache, split=0))[::2, ::2]
    assert np.count_nonzero(cells[..., :3], axis=2).max() == 1
    assert not cells[::2, ::2, 1:3].any()  # RGGB: red stands first


def test_the_whole_mosaic_has_two_samples_a_cell_and_is_smoothed(cache: StageCache) -> None:
    """Any other scale than a whole number would beat with the pattern, seen on a screen."""
    shown = frame(cache, split=0)
    cells = pixels_of(shown)[::2, ::2]
    np.testing.assert_array_equal(cells.repeat(2, axis=0).repeat(2, axis=1), pixels_of(shown))
    assert [panel.pixelated for panel in shown.panels] == [False, True, False]


@pytest.mark.parametrize("picture", SUBJECTS)
def test_the_mosaic_is_of_linear_light(cache: StageCache, picture: str) -> None:
    """Decoded, what is shown of each cell is the light of the picture there."""
    shown = pixels_of(frame(cache, picture=picture, split=0))[::2, ::2, :3].max(axis=2)
    light = mosaic(SUBJECTS[picture].draw(WHOLE))
    # Half a code, where the curve is steepest for light: near white.
    np.testing.assert_allclose(decode_srgb(shown / 255), light, atol=0.5 / 255 * 2.3)


@pytest.mark.parametrize("picture", SUBJECTS)
@pytest.mark.parametrize("split", [0, 0.5, 1])
@pytest.mark.parametrize(("column", "row"), [(0, 0), (104, 56), (220, 176)])
def test_the_loupe_enlarges_what_it_lies_on(
    cache: StageCache, picture: str, split: float, column: int, row: int
) -> None:
    shown = frame(cache, picture=picture, split=split, column=column, row=row)
    whole = pixels_of(shown) if split == 1 else pixels_of(shown)[::2, ::2]
    np.testing.assert_array_equal(
        whole[row : row + 16, column : column + 20], pixels_of(shown, 1), strict=True
    )


def test_the_line_divides_the_reconstruction_from_the_mosaic(cache: StageCache) -> None:
    mosaic_alone, half, whole = (pixels_of(frame(cache, split=split)) for split in (0, 0.25, 1))
    np.testing.assert_array_equal(half[::2, :120:2], whole[:, :60])
    np.testing.assert_array_equal(half[:, 120:], mosaic_alone[:, 120:])


def test_a_grey_picture_of_the_reader_s_has_nothing_to_get_wrong() -> None:
    own = Photograph(1, np.full((192, 240, 3), 90, np.uint8))
    shown = SCENE.render(SCENE.check({}), "", StageCache(), own)
    assert texts_of(shown)["worst"] == "0"
    assert texts_of(shown)["shared"] == "undefined / undefined"
    assert "your own picture" in shown.description
    assert "balloon" not in shown.description


def told_psnr(cache: StageCache, name: str, **given: object) -> dict[str, float]:
    return {m: float(texts_of(frame(cache, method=m, **given))[name]) for m in METHODS}


def test_the_figure_and_the_ladder_say_the_same() -> None:
    """Same pictures, same methods, same figure of merit, same default."""
    ladder = load_ladder(SCENE.ladder)
    work = ladder.prepare()
    truth = ladder.reference(work)
    results = {tier.id: tier.run(work) for tier in ladder.tiers}
    cache = StageCache(depth=8)
    for metric in ladder.metrics:
        picture = metric.id.removeprefix("psnr-") if metric.id != "light" else "balloon"
        shown = told_psnr(cache, "light" if metric.id == "light" else "psnr", picture=picture)
        for method, result in results.items():
            assert shown[method] == pytest.approx(metric.measure(result, truth, work), abs=0.051)
    (choice,) = (control for control in SCENE.controls if control.name == "method")
    assert isinstance(choice, Choice)
    assert choice.default == ladder.default_tier


def test_the_more_detail_the_colours_share_the_more_the_clever_methods_gain(
    cache: StageCache,
) -> None:
    """The chapter's conclusion: the gain over bilinear follows what the pictures have in common."""
    shared, gain = [], []
    for picture in ("soft", "balloon", "room"):
        text = texts_of(frame(cache, picture=picture))["shared"]
        shared.append(min(float(part.replace("\u2212", "-")) for part in text.split(" / ")))
        psnr = told_psnr(cache, "psnr", picture=picture)
        gain.append(psnr["menon-unrefined"] - psnr["bilinear"])
    assert np.all(np.diff(shared) > 0.1)
    assert np.all(np.diff(gain) > 5)


def told(cache: StageCache, **given: object) -> Readout:
    (estimate,) = SCENE.estimates(SCENE.check(given), "", cache)
    return estimate


def test_the_method_is_the_rung_of_the_ladder_and_so_no_second_menu_is_offered() -> None:
    assert list(METHOD_LABELS) == [tier.id for tier in load_ladder(SCENE.ladder).tiers]
    assert SCENE.tiers == ()


@pytest.mark.parametrize("method", METHODS)
def test_the_error_by_colour_adds_up_to_the_psnr_read_out(cache: StageCache, method: str) -> None:
    """PSNR is 10 log₁₀ of 255² over the mean of the three squared errors."""
    estimate = told(cache, method=method)
    red, green, blue = (float(part) for part in estimate.text.split(", "))
    mean_square = (red**2 + green**2 + blue**2) / 3
    psnr = float(texts_of(frame(cache, method=method))["psnr"])
    assert 10 * np.log10(255**2 / mean_square) == pytest.approx(psnr, abs=0.15)


def test_the_error_of_a_colour_is_that_of_the_bytes_shown(cache: StageCache) -> None:
    """The error picture shows four times the error. Here none is so large that it is cut off."""
    given: dict[str, object] = {"method": "bilinear", "picture": "soft"}
    errors = pixels_of(frame(cache, **given), 2)[8:-8, 8:-8, :3] / 4.0
    seen = np.sqrt(np.mean(errors**2, axis=(0, 1)))
    parts = [float(part) for part in told(cache, **given).text.split(", ")]
    assert seen == pytest.approx(parts, abs=0.1)
