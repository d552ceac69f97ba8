"""What a hand does with a handle of a figure."""

from playwright.sync_api import Locator
from support.reader import Reader

PULLS = ((41.0, 32.0), (-34.0, 26.0), (40.0, -60.0), (120.0, 0.0))
"""CSS pixels by which a handle is pulled until something moves: it may be at an end, or its next
place far."""


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
