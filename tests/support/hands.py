"""What a hand does with a handle of a figure, and what the page's controls say of it."""

from typing import Any

from playwright.sync_api import Locator
from support.reader import Reader

from simulations.engine.handles import Handle


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
