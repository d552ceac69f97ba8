"""Each scene with a ladder: its menu changes the picture, its line tells time and error."""

import re
from typing import Any

import pytest
from support.reader import Reader

pytestmark = pytest.mark.browser

COARSE = {
    "lambertian-shading": "gouraud-8",
    "phong": "gouraud-8",
    "sensor-noise": "gaussian",
    "jpeg": "fixed-point",
}
"""Of each scene the tier that is furthest from the truth."""
DIGITS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


@pytest.mark.parametrize("scene", COARSE)
def test_a_coarser_tier_paints_another_picture_and_admits_a_larger_error(
    visitor: Reader, book: Any, scene: str
) -> None:
    figure = visitor.turn_to_figure(book, scene)
    fine, fine_pixels = magnitude(visitor.judged(figure)), visitor.shown(figure)["pixels"]
    assert figure.locator(".accuracy-frame").inner_text() == "first frame"
    visitor.choose(figure, "tier", COARSE[scene])
    assert figure.locator(".accuracy-frame").inner_text() == "frame"
    assert re.fullmatch(r"[\d.]+\sms", figure.locator(".accuracy-ms").inner_text())
    assert magnitude(visitor.judged(figure)) > 1.5 * fine
    if scene != "jpeg":  # at its default quality the few codes that change may leave every pixel
        assert visitor.shown(figure)["pixels"] != fine_pixels


def test_the_method_of_demosaicing_is_judged_without_a_second_menu(
    visitor: Reader, book: Any
) -> None:
    figure = visitor.turn_to_figure(book, "bayer-demosaic")
    assert figure.locator("select[name=tier]").count() == 0
    frames = visitor.frames(figure)
    figure.locator("button[name=demosaic]").click()
    visitor.wait_frame(figure, frames)
    errors = {}
    for method in ("nearest", "malvar"):
        visitor.choose(figure, "method", method)
        errors[method] = visitor.judged(figure)
    greens = {method: float(text.split(", ")[1]) for method, text in errors.items()}
    assert greens["malvar"] < greens["nearest"]
    assert all(text.endswith("codes of 255") for text in errors.values())


def magnitude(text: str) -> float:
    """``1.4 × 10⁻⁷ of white`` as a number."""
    found = re.match(r"([\d.]+)(?:\s×\s10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?", text)
    assert found, text
    return float(found[1]) * 10.0 ** int((found[2] or "0").translate(DIGITS))
