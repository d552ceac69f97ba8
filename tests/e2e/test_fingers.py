"""What a finger does on a phone: it moves what can be grabbed, and scrolls the page elsewhere."""

from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator
from support.reader import PHONE, Reader, visit
from support.static_server import StaticServer

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def long_visit_by_phone(brisk_chromium: Browser, site_server: StaticServer) -> Iterator[Reader]:
    with visit(brisk_chromium, site_server, viewport=PHONE, has_touch=True) as someone:
        yield someone


@pytest.fixture
def phone(long_visit_by_phone: Reader) -> Iterator[Reader]:
    yield long_visit_by_phone
    long_visit_by_phone.assert_no_complaints()


def in_view(phone: Reader, book: Any, scene: str) -> Locator:
    """A figure of the scene, its panels in the middle of the screen."""
    figure = phone.turn_to_figure(book, scene)
    phone.bring(figure.locator(".panels"))
    return figure


@pytest.mark.parametrize(
    ("name", "setting"),
    [("probe", "probe"), pytest.param("lamp", "light_angle", marks=pytest.mark.deep)],
    ids=["probe", "lamp"],
)
def test_a_finger_moves_a_mark_and_scrolls_the_page_elsewhere(
    phone: Reader, book: Any, name: str, setting: str
) -> None:
    figure = in_view(phone, book, "lambertian-shading")
    grip = figure.locator(f'[data-handle="{name}"]')
    phone.bring(grip)
    before, scrolled = value(figure, setting), scroll(phone)
    for way in [(0, -60), (-40, 0)]:
        swipe(phone, centre(grip), way)
        phone.settle(figure)
    assert value(figure, setting) != before
    assert scroll(phone) == scrolled
    box = figure.locator(".panel-title").first.bounding_box()
    assert box
    swipe(phone, (box["x"] + 20, box["y"] + 5), (0, -120))
    phone.page.wait_for_function("before => scrollY !== before", arg=scrolled)


def test_a_finger_that_rests_on_the_ground_drags_it_up_and_down(phone: Reader, book: Any) -> None:
    figure = in_view(phone, book, "rotation-3d")
    ground = centre(figure.locator('[data-handle="view"]'))
    start = (ground[0] - 60, ground[1] - 90)
    before, scrolled = value(figure, "elevation"), scroll(phone)
    swipe(phone, start, (0, 80), taken=figure.locator(".handles.taken"))
    phone.settle(figure)
    assert value(figure, "elevation") != before
    assert scroll(phone) == scrolled


def test_a_finger_that_goes_up_the_ground_at_once_scrolls_the_page(
    phone: Reader, book: Any
) -> None:
    figure = in_view(phone, book, "rotation-3d")
    ground = centre(figure.locator('[data-handle="view"]'))
    before, scrolled = value(figure, "elevation"), scroll(phone)
    phone.page.evaluate(SLOW_CLOCK)
    swipe(phone, (ground[0] - 60, ground[1] - 90), (0, -120))
    phone.page.wait_for_function("before => scrollY !== before", arg=scrolled)
    phone.page.evaluate("() => { setTimeout = usualTimeout; }")
    assert value(figure, "elevation") == before


SLOW_CLOCK = """() => {
  globalThis.usualTimeout = setTimeout;
  setTimeout = (then, ms, ...rest) => usualTimeout(then, 100 * ms, ...rest);
}"""
"""To the page, a finger is quick on the busiest machine."""


def test_a_finger_sketches_a_curve_that_falls(phone: Reader) -> None:
    phone.turn_to("lighting-and-reflectance/")
    form = phone.page.locator("form[data-predict]", has=phone.page.locator(".sketch"))
    svg = form.locator(".sketch > svg")
    box, scrolled = phone.bring(svg), scroll(phone)
    swipe(phone, (box["x"] + 0.2 * box["width"], box["y"] + 15), (0, 0.4 * box["height"]))
    swipe(
        phone,
        (box["x"] + 0.15 * box["width"], box["y"] + 20),
        (0.8 * box["width"], 0.6 * box["height"]),
    )
    drawn = [float(point.input_value()) for point in form.locator("input[name=guess]").all()]
    assert drawn[1:-1] == sorted(drawn[1:-1], reverse=True)
    assert drawn[1] > drawn[-2]
    assert scroll(phone) == scrolled


def value(figure: Locator, setting: str) -> str:
    return figure.locator(f'.control [name="{setting}"]').input_value()


def centre(grip: Locator) -> tuple[float, float]:
    box = grip.bounding_box()
    assert box
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def scroll(phone: Reader) -> float:
    top: float = phone.page.evaluate("scrollY")
    return top


def swipe(
    phone: Reader,
    start: tuple[float, float],
    way: tuple[float, float],
    taken: Locator | None = None,
) -> None:
    """A finger that goes down, rests until something is taken, moves in steps and goes up."""
    client = phone.page.context.new_cdp_session(phone.page)
    place = start
    client.send("Input.dispatchTouchEvent", touch("touchStart", [place]))
    if taken:
        taken.wait_for()
    for step in range(1, 9):
        place = (start[0] + way[0] * step / 8, start[1] + way[1] * step / 8)
        client.send("Input.dispatchTouchEvent", touch("touchMove", [place]))
    client.send("Input.dispatchTouchEvent", touch("touchEnd", []))
    client.detach()


def touch(kind: str, places: list[tuple[float, float]]) -> dict[str, Any]:
    return {"type": kind, "touchPoints": [{"x": x, "y": y} for x, y in places]}
