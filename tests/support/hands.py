"""What a hand does with a handle of a figure."""

from playwright.sync_api import Locator
from support.reader import Reader


def middle(grip: Locator) -> tuple[float, float]:
    place = grip.bounding_box()
    assert place
    return place["x"] + place["width"] / 2, place["y"] + place["height"] / 2


def drag(visitor: Reader, start: tuple[float, float], end: tuple[float, float]) -> None:
    """At one stroke: of many small moves see `test_handles_by_hand.py`."""
    mouse = visitor.page.mouse
    mouse.move(*start)
    mouse.down()
    mouse.move(*end)
    mouse.up()
