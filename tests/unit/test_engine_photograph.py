"""The reader's own picture on its way into the stages of a scene."""

import numpy as np
import pytest

from simulations import browser
from simulations.engine.photograph import Photograph
from simulations.engine.stages import StageCache
from simulations.registry import SCENE_MODULES, load_scene

TAKING = [id_ for id_ in SCENE_MODULES if load_scene(id_).photograph]


def test_what_is_transparent_shows_a_white_ground() -> None:
    rgba = bytes((10, 20, 30, 255, 200, 100, 0, 0, 0, 0, 0, 128))
    picture = Photograph.from_canvas(1, rgba, 3, 1)
    np.testing.assert_array_equal(picture.codes, [[[10, 20, 30], [255] * 3, [127] * 3]])


@pytest.mark.parametrize("size", [(2, 2), (0, 0), (1, 3)])
def test_each_pixel_has_four_bytes(size: tuple[int, int]) -> None:
    with pytest.raises(ValueError, match="legal: four a pixel"):
        Photograph.from_canvas(1, bytes(8), *size)


def test_pictures_are_told_apart_by_their_number() -> None:
    black, white = (Photograph.from_canvas(1, bytes([level]) * 4, 1, 1) for level in (0, 255))
    assert black == white
    assert black != Photograph.from_canvas(2, bytes(4), 1, 1)


@pytest.mark.parametrize("scene_id", TAKING)
def test_a_scene_shows_the_reader_s_picture_and_then_the_book_s_again(scene_id: str) -> None:
    scene = load_scene(scene_id)
    assert scene.photograph
    width, height = scene.photograph
    rng = np.random.default_rng(0)
    codes = rng.integers(0, 256, (height, width, 4), np.uint8)
    own = Photograph.from_canvas(1, codes.tobytes(), width, height)
    settings, cache = scene.check({}), StageCache()
    book_s = scene.render(settings, scene.default_tier, cache)
    reader_s = scene.render(settings, scene.default_tier, cache, own)
    again = scene.render(settings, scene.default_tier, cache)
    pictures = [
        [panel.raster for panel in frame.panels if panel.raster is not None]
        for frame in (book_s, reader_s, again)
    ]
    assert any((a != b).any() for a, b in zip(pictures[0], pictures[1], strict=True))
    assert all((a == b).all() for a, b in zip(pictures[0], pictures[2], strict=True))


class Pixels:
    """What JavaScript hands over."""

    def __init__(self, data: bytes) -> None:
        self.data = data

    def to_bytes(self) -> bytes:
        return self.data


def test_each_figure_keeps_a_picture_of_its_own_until_it_is_taken_away() -> None:
    scene = load_scene("lens-distortion")
    assert scene.photograph
    width, height = scene.photograph

    def picture(figure: str) -> bytes:
        return b"".join(
            raster.tobytes() for raster in browser.render(figure, scene.id, "{}", "").rasters
        )

    try:
        before = picture("one")
        browser.photograph("one", 1, Pixels(bytes(4 * width * height)), width, height)
        assert picture("one") != before
        assert picture("two") == before
        browser.photograph("one", 0, None, 0, 0)
        assert picture("one") == before
    finally:
        browser.forget("one")
        browser.forget("two")
