"""A hand on the handles of a figure, and on one that is asked much."""

from typing import Any

import pytest
from support.hands import PULLS, drag, middle
from support.page_scripts import GRASP
from support.reader import Reader
from support.reading_order import SAMPLED

from simulations.registry import load_scene

pytestmark = pytest.mark.browser

KEYS = ("ArrowLeft", "ArrowUp", "ArrowRight", "ArrowDown")


@pytest.mark.parametrize("scene", SAMPLED)
def test_every_handle_moves_its_settings_and_goes_along(
    guest: Reader, book: Any, scene: str
) -> None:
    """By a hand, and by the arrow keys."""
    figure = guest.stay_at_figure(book, scene)
    guest.put_back(figure)
    for handle in load_scene(scene).handles:
        grip = figure.locator(f'[data-handle="{handle.name}"]')
        start = grip.evaluate(GRASP)
        if not start["shown"]:
            continue
        for right, down in PULLS:
            x, y = start["x"], start["y"]
            drag(guest, (x, y), (x + right, y + down))
            pulled = grip.evaluate(GRASP)
            if pulled["values"] != start["values"]:
                break
            start = pulled
        assert pulled["values"] != start["values"], handle.name
        assert pulled["frames"] > start["frames"], handle.name
        grip.focus()
        for key in KEYS:
            guest.page.keyboard.press(key)
            led = grip.evaluate(GRASP)
            if led["values"] != pulled["values"]:
                break
        assert led["values"] != pulled["values"], f"{handle.name} by keyboard"
        assert led["told"] == led["words"], handle.name


def test_a_handle_stays_under_the_pointer_and_ends_at_the_last_of_many_moves(
    visitor: Reader, book: Any
) -> None:
    figure = visitor.turn_to_figure(book, "lambertian-shading")
    grip = figure.locator('[data-handle="probe"]')
    visitor.bring(grip)
    start = middle(grip)
    end = (start[0] + 60, start[1])
    mouse = visitor.page.mouse
    mouse.move(*start)
    mouse.down()
    grip.evaluate(SWAY, [80, *start])
    mouse.move(*end)
    mouse.up()
    visitor.settle(figure)
    assert middle(grip)[0] == pytest.approx(end[0], abs=2)


SWAY = """async (grip, [count, x, y]) => {
  for (let step = 0; step < count; step += 1) {
    const at = {clientX: x + 90 * Math.sin(step / 9), clientY: y};
    grip.dispatchEvent(new PointerEvent('pointermove', {bubbles: true, isPrimary: true, ...at}));
    await new Promise((resolve) => setTimeout(resolve, 4));
  }
}"""
"""Faster than a test could send them from outside."""
