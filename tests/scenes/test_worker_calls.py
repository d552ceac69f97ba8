"""The calls that the browser's worker makes, on scenes and ladders of the book."""

import json
from types import SimpleNamespace

import pytest

from simulations import browser
from simulations.registry import load_scene


def test_judge_returns_the_condition_met_at_the_readers_values() -> None:
    conditions = json.dumps(["k1 > 0", "-20.5 <= corner <= -19.5"])
    for values, expected in (({"k1": -0.1}, 1), ({"k1": 0.1}, 0), ({"k1": -0.3}, None)):
        place = browser.judge(
            "test", "lens-distortion", json.dumps(values), "checked-table", conditions
        )
        assert place == expected


def test_pull_by_names_and_numbers_returns_new_values() -> None:
    scene_id, values = "lambertian-shading", '{"light_angle": 30}'
    assert json.loads(browser.pull("f", scene_id, values, "", "lamp", 200, 0)) == {
        "light_angle": 180
    }


def test_measure_times_a_ladders_tier_and_gives_its_errors() -> None:
    result = json.loads(browser.measure("rotation-interpolation", "nlerp", budget_s=0.01))
    assert result["tier"] == "nlerp"
    assert 0.0 < result["low_ms"] <= result["milliseconds"] <= result["high_ms"]
    assert result["errors"]["worst"] == pytest.approx(7.98, abs=0.01)


def black_image(width: int, height: int) -> SimpleNamespace:
    """A picture as JavaScript hands it over."""
    return SimpleNamespace(
        number=1, name="", width=width, height=height, full_width=width, full_height=height,
        draw=lambda codes: codes.fill(0),
        head=SimpleNamespace(to_bytes=lambda: b""),
    )  # fmt: skip


def test_each_figure_keeps_its_photograph_until_it_is_removed() -> None:
    scene = load_scene("lens-distortion")
    assert isinstance(scene.instrument.photograph, tuple)
    width, height = scene.instrument.photograph

    def picture(figure: str) -> bytes:
        return b"".join(
            raster.tobytes() for raster in browser.render(figure, scene.id, "{}", "").rasters
        )

    try:
        before = picture("one")
        browser.photograph("one", black_image(width, height))
        assert picture("one") != before
        assert picture("two") == before
        browser.photograph("one", None)
        assert picture("one") == before
    finally:
        browser.forget("one")
        browser.forget("two")
