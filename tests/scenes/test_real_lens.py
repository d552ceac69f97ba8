"""The figure of a real lens: its numbers against formulas, its tiers against the true ray."""

import math
import re

import pytest
from support.frames import estimates_of, frame_of, texts_at

from simulations.scenes.real_lens.scene import SCENE


def number(name: str, **given: object) -> float:
    return float(texts_at(SCENE, "exact", **given)[name].replace("\u2212", "-"))


@pytest.mark.parametrize("vergence", [0, 5, 12.5, 20])
def test_images_and_angles_obey_the_lens_equation_and_snell(vergence: float) -> None:
    image = number("thin_at", vergence=vergence)
    assert vergence / 1000 + 1 / image == pytest.approx(25 / 1000, abs=1e-5)
    angles = [number(name, vergence=vergence, index=1.7) for name in ("incidence", "refracted")]
    outside, inside = (math.sin(math.radians(angle)) for angle in angles)
    assert outside == pytest.approx(1.7 * inside, abs=0.003)


def test_aberration_grows_with_the_square_of_the_height_and_with_the_wrong_way_round() -> None:
    off = number("true_at") - number("thick_at")
    assert number("aberration") == pytest.approx(off, abs=0.011)
    two, four = (number("aberration", height=height) for height in (2, 4))
    assert four == pytest.approx(4 * two, rel=0.05)
    one, other = (
        number("aberration", front=front, back=40 - front, thickness=6) for front in (40, 0)
    )
    assert 3.5 < other / one < 4.5


def test_near_the_axis_thickness_counts_and_the_sine_does_not() -> None:
    """Farther out, the errors of the thin lens may cancel."""

    def off(tier: str, height: float) -> float:
        text = estimates_of(SCENE, tier, height=height)[-1].text
        return 0.0 if text.startswith("under") else float(text)

    assert off("thin", 1) > 50 * off("paraxial", 1)
    assert off("exact", 1) == 0
    assert off("thin", 10) < off("paraxial", 10)


def test_a_stopped_ray_is_drawn_to_the_middle_of_the_lens() -> None:
    stopped, passing = (frame_of(SCENE, height=height, opening=14).panels for height in (15, 14))
    (ray,) = re.findall(r'<path class="ray bold" d="([^"]+)"', stopped[0].overlay)
    assert ray.rpartition("L")[2].startswith("130,")
    assert "ray bold" not in stopped[1].overlay
    assert "ray bold" in passing[1].overlay
    spreading = frame_of(SCENE, front=-20, back=-20).panels[1:]
    assert all("no image" in panel.overlay for panel in spreading)
