"""What a hand or the arrow keys do with the things that figures offer to be grabbed."""

import math
from typing import Any

import pytest
from playwright.sync_api import Locator, expect
from support.reader import Reader

from simulations.engine.handles import Handle
from simulations.registry import SCENE_MODULES, load_scene

pytestmark = pytest.mark.browser

WITH_HANDLES = [id_ for id_ in SCENE_MODULES if load_scene(id_).handles]
PULLS = ((41.0, 32.0), (-34.0, 26.0), (40.0, -60.0), (120.0, 0.0))
"""CSS pixels by which a handle is pulled until something moves: it may be at an end, or its next
place far."""


@pytest.mark.parametrize("scene", WITH_HANDLES)
def test_every_handle_moves_its_settings_and_goes_along(
    guest: Reader, book: Any, scene: str
) -> None:
    figure = guest.stay_at_figure(book, scene)
    guest.bring(figure.locator(".panels"))
    for handle in load_scene(scene).handles:
        grip = figure.locator(f'[data-handle="{handle.name}"]')
        if not grip.is_visible():
            continue
        guest.settle(figure)
        before, start = settings(figure, handle), middle(grip)
        frames = guest.frames(figure)
        for right, down in PULLS:
            drag(guest, start, (start[0] + right, start[1] + down))
            guest.settle(figure)
            if settings(figure, handle) != before:
                break
        guest.wait_frame(figure, frames)
        assert settings(figure, handle) != before, handle.name
        grip.focus()
        for key in ("ArrowLeft", "ArrowUp", "ArrowRight", "ArrowDown"):
            before = settings(figure, handle)
            guest.page.keyboard.press(key)
            if settings(figure, handle) != before:
                break
        assert settings(figure, handle) != before, f"{handle.name} by keyboard"
        expect(grip).to_have_attribute("aria-valuetext", described(figure, handle))


@pytest.mark.long
def test_a_handle_stays_under_the_pointer_and_ends_at_the_last_of_many_moves(
    visitor: Reader, book: Any
) -> None:
    figure = visitor.turn_to_figure(book, "lambertian-shading")
    grip = figure.locator('[data-handle="probe"]')
    visitor.bring(grip)
    start = middle(grip)
    end = (start[0] + 60, start[1])
    page = visitor.page
    page.mouse.move(*start)
    page.mouse.down()
    for step in range(200):
        page.mouse.move(start[0] + 90 * math.sin(step / 9), start[1])
    page.mouse.move(*end)
    page.mouse.up()
    visitor.settle(figure)
    assert middle(grip)[0] == pytest.approx(end[0], abs=2)


def settings(figure: Locator, handle: Handle[Any]) -> list[str]:
    """What the page's controls say of what a handle drives."""
    controls = (figure.locator(f'.control [name="{name}"]') for name in handle.drives)
    return [control.input_value() for control in controls]


def described(figure: Locator, handle: Handle[Any]) -> str:
    """The driven controls in words, as the page shows them."""
    words: str = figure.evaluate(
        """(figure, names) => names.map((name) => {
             const control = figure.querySelector(`.control [name="${name}"]`);
             const box = control.closest(".control");
             const value = control.selectedOptions
               ? control.selectedOptions[0].text.trim()
               : box.querySelector(".control-value").textContent;
             return `${box.querySelector("label").textContent.trim()} ${value}`;
           }).join(", ")""",
        list(handle.drives),
    )
    return words


def middle(grip: Locator) -> tuple[float, float]:
    place = grip.bounding_box()
    assert place
    return place["x"] + place["width"] / 2, place["y"] + place["height"] / 2


def drag(visitor: Reader, start: tuple[float, float], end: tuple[float, float]) -> None:
    mouse = visitor.page.mouse
    mouse.move(*start)
    mouse.down()
    mouse.move(*end, steps=4)
    mouse.up()
