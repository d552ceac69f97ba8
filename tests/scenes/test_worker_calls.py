"""The reader's photograph in one figure of several, as the browser's worker draws them."""

from types import SimpleNamespace

from simulations import browser
from simulations.registry import load_scene


def test_each_figure_keeps_its_photograph_until_it_is_removed() -> None:
    scene = load_scene("lens-distortion")
    assert isinstance(scene.instrument.photograph, tuple)
    width, height = scene.instrument.photograph
    black = SimpleNamespace(  # as JavaScript hands it over
        number=1, name="", width=width, height=height, full_width=width, full_height=height,
        draw=lambda codes: codes.fill(0), head=SimpleNamespace(to_bytes=lambda: b""),
    )  # fmt: skip

    def picture(figure: str) -> bytes:
        rasters = browser.render(figure, scene.id, "{}", "").rasters
        return b"".join(raster.tobytes() for raster in rasters)

    try:
        before = picture("one")
        browser.photograph("one", black)
        assert picture("one") != before
        assert picture("two") == before
        browser.photograph("one", None)
        assert picture("one") == before
    finally:
        browser.forget("one")
        browser.forget("two")
