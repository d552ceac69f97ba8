"""What the browser's worker asks of scenes and ladders, asked of the book's."""

import json
from types import SimpleNamespace

import pytest

from simulations import browser
from simulations.registry import load_scene


def test_the_worker_judges_a_figure_at_the_reader_s_values() -> None:
    conditions = json.dumps(["k1 > 0", "-20.5 <= corner <= -19.5"])
    for values, met in (({"k1": -0.1}, 1), ({"k1": 0.1}, 0), ({"k1": -0.3}, None)):
        place = browser.judge(
            "test", "lens-distortion", json.dumps(values), "checked-table", conditions
        )
        assert place == met


def test_the_browser_asks_for_a_pull_by_names_and_numbers() -> None:
    scene_id, values = "lambertian-shading", '{"light_angle": 30}'
    assert json.loads(browser.pull("f", scene_id, values, "", "lamp", 200, 0)) == {
        "light_angle": 180
    }


def test_the_browser_measures_a_tier_of_a_real_ladder() -> None:
    result = json.loads(browser.measure("rotation-interpolation", "nlerp", budget_s=0.01))
    assert result["tier"] == "nlerp"
    assert 0.0 < result["low_ms"] <= result["milliseconds"] <= result["high_ms"]
    assert result["errors"]["worst"] == pytest.approx(7.98, abs=0.01)


def black(width: int, height: int) -> SimpleNamespace:
    """A picture as JavaScript hands it over."""
    return SimpleNamespace(
        number=1, name="", width=width, height=height, full_width=width, full_height=height,
        draw=lambda codes: codes.fill(0),
        head=SimpleNamespace(to_bytes=lambda: b""),
    )  # fmt: skip


def test_each_figure_keeps_a_picture_of_its_own_until_it_is_taken_away() -> None:
    scene = load_scene("lens-distortion")
    assert isinstance(scene.photograph, tuple)
    width, height = scene.photograph

    def picture(figure: str) -> bytes:
        return b"".join(
            raster.tobytes() for raster in browser.render(figure, scene.id, "{}", "").rasters
        )

    try:
        before = picture("one")
        browser.photograph("one", black(width, height))
        assert picture("one") != before
        assert picture("two") == before
        browser.photograph("one", None)
        assert picture("one") == before
    finally:
        browser.forget("one")
        browser.forget("two")
