"""The figure of a real lens: its numbers against formulas, its tiers against the true ray."""

import math
import re

import pytest
from support.frames import texts_of

from simulations.engine.frame import Frame
from simulations.engine.stages import StageCache
from simulations.scenes.real_lens.scene import SCENE
from simulations.scenes.real_lens.settings import Settings


def frame(tier: str = "exact", **given: object) -> Frame:
    return SCENE.render(SCENE.check(given), tier, StageCache())


def texts(**given: object) -> dict[str, str]:
    return texts_of(frame("exact", **given))


def number(name: str, **given: object) -> float:
    return float(texts(**given)[name].replace("\u2212", "-"))


def off(tier: str, **given: object) -> float:
    """The estimate under the figure, in mm."""
    last = list(SCENE.estimates(SCENE.check(given), tier, StageCache()))[-1].text
    return 0.0 if last.startswith("under") else float(last)


def test_reciprocals_of_object_and_image_add_up_to_the_thin_lens_s() -> None:
    for vergence in (0, 5, 12.5, 20):
        image = number("thin_at", vergence=vergence)
        assert vergence / 1000 + 1 / image == pytest.approx(25 / 1000, abs=1e-5)


def test_aberration_is_the_crossing_less_the_thick_lens_s_image() -> None:
    shown = texts()
    difference = float(shown["true_at"]) - float(shown["thick_at"])
    assert number("aberration") == pytest.approx(difference, abs=0.011)


def test_aberration_grows_with_the_square_of_the_height() -> None:
    assert number("aberration", height=4) == pytest.approx(
        4 * number("aberration", height=2), rel=0.05
    )


def test_the_front_s_angles_obey_snell_for_near_objects_too() -> None:
    for vergence in (0, 20):
        shown = texts(vergence=vergence, index=1.7)
        sines = [math.sin(math.radians(float(shown[name]))) for name in ("incidence", "refracted")]
        assert sines[0] == pytest.approx(1.7 * sines[1], abs=0.003)


def test_near_the_axis_thickness_counts_and_the_sine_does_not() -> None:
    assert off("thin", height=1) > 50 * off("paraxial", height=1)
    assert off("exact", height=1) == 0


def test_errors_of_the_thin_lens_may_cancel() -> None:
    """Why the better model may be the worse answer for one ray."""
    assert off("thin", height=10) < off("paraxial", height=10)


@pytest.mark.parametrize(
    ("given", "word"),
    [
        (
            {"front": 40, "back": 40, "index": 2, "thickness": 20, "height": 15, "opening": 20},
            "totally reflected",
        ),
        ({"thickness": 2, "height": 20}, "misses the glass"),
    ],
)
def test_a_ray_that_ends_says_why(given: dict[str, object], word: str) -> None:
    shown = frame("exact", **given)
    assert word in texts_of(shown)["true_at"]
    assert word in shown.description
    assert word in shown.panels[0].overlay
    assert word not in frame("thin", **given).panels[0].overlay


def test_a_ray_higher_than_the_opening_ends_there() -> None:
    shown = frame(height=15, opening=14)
    assert {texts_of(shown)[name] for name in ("true_at", "aberration")} == {
        "stopped by the opening"
    }
    assert "stopped by the opening" in shown.panels[0].overlay
    (ray,) = re.findall(r'<path class="ray bold" d="([^"]+)"', shown.panels[0].overlay)
    assert ray.rpartition("L")[2].startswith("130,")  # the middle of the lens
    assert "ray bold" not in shown.panels[1].overlay
    assert "ray bold" in frame(height=14, opening=14).panels[1].overlay


@pytest.mark.parametrize("name", ["front", "back"])
def test_a_surface_is_bent_by_its_rim(name: str) -> None:
    """The handle lies on the glass, and forty pixels of the lead panel do not exhaust it."""
    handle = next(each for each in SCENE.handles if each.name == name)
    settings = Settings(front=10, back=10)
    at = handle.at(settings, {})
    assert at is not None
    assert handle.pull(settings, at)[name] == pytest.approx(10)
    inwards = at[0] + (11 if name == "front" else -11), at[1]
    assert 10 < float(handle.pull(settings, inwards)[name]) < 40


def test_the_drawing_says_that_a_lens_that_spreads_light_has_no_image() -> None:
    shown = frame(front=-20, back=-20)
    assert all("no image" in panel.overlay for panel in shown.panels[1:])


def test_turning_the_lens_round_costs_four_times_the_aberration() -> None:
    one = number("aberration", front=40, back=0, thickness=6)
    other = number("aberration", front=0, back=40, thickness=6)
    assert 3.5 < other / one < 4.5
