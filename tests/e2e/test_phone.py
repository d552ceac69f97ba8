"""Figures on a phone: folded parts, panels, and touch gestures."""

from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, expect
from support.reader import PHONE, Place, Reader, chapter_of, visit
from support.static_server import StaticServer

pytestmark = pytest.mark.browser


def test_controls_tools_and_panels_are_folded_on_a_phone_until_needed(
    quiet_phone: Reader, book: Any
) -> None:
    phone, page = quiet_phone, quiet_phone.page
    chapter = chapter_of(book, "camera")
    phone.open(chapter, live=False)
    figure = phone.figure("camera")
    folded, fold = figure.locator("[name=shot_noise]"), figure.locator(".more-controls > summary")
    for shown in (True, False):
        fold.tap()
        expect(folded).to_be_visible(visible=shown)
    link = page.locator("a.set[data-values*='\"shot_noise\": false']").first
    link.evaluate("link => link.click()")  # it may be in a hidden answer
    expect(folded).to_be_visible()
    page.goto("about:blank")
    phone.open(f"{chapter}?figure-camera.shot_noise=false", live=False)
    expect(folded).to_be_visible()

    phone.open(chapter_of(book, "jpeg"), live=False)
    figure = phone.figure("jpeg")
    dots, folded = figure.locator("[data-further]"), figure.locator(".open-python, [data-reset]")
    more = figure.locator(".more-controls > summary")
    assert more.evaluate(IN_ONE_ROW, dots.element_handle())
    expect(figure.locator("[data-copy-link]")).to_be_visible()
    for shown in (True, False):
        dots.tap()
        expect(folded).to_have_count(2)
        for each in folded.all():
            expect(each).to_be_visible(visible=shown)

    phone.open(chapter_of(book, "two-views"), live=False)
    figure = phone.page.locator(OF_THREE_PANELS)
    title = figure.locator(".other-panels > :last-child > .panel-title")
    expect(title).to_have_css("opacity", "0")  # hidden while only its panel's edge is visible
    figure.locator(".panel-dots > button").nth(1).tap()
    expect(title).to_have_css("opacity", "1")
    phone.wait_for(figure.locator(".other-panels"), SECOND_IS_SHOWN)
    dot = figure.locator(".panel-dots > button:nth-child(2)")
    expect(dot).to_have_attribute("aria-current", "true")

    page.emulate_media(forced_colors="active")
    phone.open(chapter_of(book, "aliasing"), live=False)
    menu = phone.figure("aliasing").locator("select").first
    drawn = menu.evaluate("menu => getComputedStyle(menu).backgroundImage !== 'none'")
    own = menu.evaluate("menu => getComputedStyle(menu).appearance !== 'none'")
    assert drawn or own, "a menu has an arrow in forced colours too"


OF_THREE_PANELS = "#figure-two-views simulation-figure"
IN_ONE_ROW = """(one, other) => {
  const [a, b] = [one.getBoundingClientRect(), other.getBoundingClientRect()];
  return a.top < b.bottom && b.top < a.bottom;
}"""
SECOND_IS_SHOWN = """(strip) => {
  const { left, right } = strip.children[1].getBoundingClientRect();
  return left >= 0 && right <= innerWidth;
}"""


def test_panels_stay_where_they_were_scrolled_and_leave_room_for_controls(
    visitor: Reader, book: Any
) -> None:
    page = visitor.page
    page.set_viewport_size(PHONE)
    visitor.turn_to(chapter_of(book, "two-views"))
    figure = page.locator(OF_THREE_PANELS)
    strip = figure.locator(".other-panels")
    strip.press("ArrowRight")
    visitor.wait_for(strip, SECOND_IS_SHOWN)
    with visitor.next_frame(figure):
        figure.locator("input[type=range]").first.press("ArrowRight")
    assert strip.evaluate(SECOND_IS_SHOWN)
    page.set_viewport_size({"width": 1280, "height": 900})
    figure = visitor.turn_to_figure(book, "tiled-floor")
    slider = figure.locator(".figure-side input[type=range]").first
    slider.click(trial=True)  # the box of the panels does not cover it
    place = visitor.scroll_to(slider)
    first = visitor.scroll_to(figure.locator(".panel").first)
    assert place["x"] > first["x"] + first["width"], "beside the first panel"
    second = figure.locator(".panel").last.element_handle()
    below = "(low, high) => low.getBoundingClientRect().top >= high.getBoundingClientRect().bottom"
    assert slider.evaluate(below, second), "below the second panel, which is low"


def test_first_handle_of_a_page_moves_once_and_hints_at_mouse_and_keys(
    baseline_chromium: Browser, server: StaticServer
) -> None:
    """After a drag it keeps the focus, but not its hint."""
    with visit(baseline_chromium, server) as reader:
        page = reader.page
        reader.open("lens-distortion/")
        handle = page.locator(FIRST_HANDLE).first
        values = page.evaluate("location.search")
        handle.evaluate("handle => handle.scrollIntoView({block: 'center'})")
        expect(handle).to_contain_class("nudged")
        assert page.evaluate("location.search") == values
        handle.hover()
        assert hint_is_visible(handle)
        page.mouse.down()
        assert not hint_is_visible(handle)
        page.mouse.up()
        page.mouse.move(0, 0)
        expect(handle).to_be_focused()
        assert not hint_is_visible(handle)
        page.keyboard.press("ArrowRight")
        assert hint_is_visible(handle)
        shown = handle.evaluate("handle => getComputedStyle(handle, '::after').content")
        assert "← →" in shown
        page.emulate_media(reduced_motion="reduce")
        reader.open("lens-distortion/")
        handle.evaluate("handle => handle.scrollIntoView({block: 'center'})")
        reader.settle(reader.figure("lens-distortion"))
        expect(handle).not_to_contain_class("nudged")


FIRST_HANDLE = ".handle:not(.drag, .aim, [hidden])"


def hint_is_visible(handle: Locator) -> bool:
    seen: bool = handle.evaluate("""async handle => {
      await Promise.all(handle.getAnimations({subtree: true}).map((one) => one.finished));
      return getComputedStyle(handle, '::after').opacity === '1';
    }""")
    return seen


@pytest.fixture(scope="module")
def live_phone(baseline_chromium: Browser, site_server: StaticServer) -> Iterator[Reader]:
    still: dict[str, Any] = {
        "reduced_motion": "reduce"
    }  # a playing figure would move away from the finger
    with visit(baseline_chromium, site_server, viewport=PHONE, has_touch=True, **still) as reader:
        yield reader
    reader.assert_no_errors()


def test_finger_on_a_handle_moves_it_and_elsewhere_scrolls_the_page(
    live_phone: Reader, book: Any
) -> None:
    phone = live_phone
    figure = phone.turn_to_figure(book, "lambertian-shading")
    grip = figure.locator('[data-handle="lamp"]')
    phone.scroll_to(grip)
    before, scrolled = value(figure, "light_angle"), scroll(phone)
    for way in [(0, -60), (-40, 0)]:
        swipe(phone, phone.middle(grip), way)
        phone.settle(figure)
    assert value(figure, "light_angle") != before
    assert scroll(phone) == scrolled
    box = phone.scroll_to(figure.locator(".panel-title").first)
    scrolled = scroll(phone)
    swipe(phone, (box["x"] + 20, box["y"] + 5), (0, -120))
    phone.page.wait_for_function("before => scrollY !== before", arg=scrolled)


def test_resting_finger_drags_a_view_and_a_quick_one_scrolls_the_page(
    live_phone: Reader, book: Any
) -> None:
    phone, page = live_phone, live_phone.page
    figure = phone.turn_to_figure(book, "rotation-3d")
    view = figure.locator('[data-handle="view"]')
    phone.scroll_to(figure.locator(".panels"))
    x, y = phone.middle(view)
    before, scrolled = value(figure, "elevation"), scroll(phone)
    swipe(phone, (x - 60, y - 90), (0, 80), taken=figure.locator(".handles.taken"))
    phone.settle(figure)
    assert value(figure, "elevation") != before
    assert scroll(phone) == scrolled
    before = value(figure, "elevation")
    page.evaluate(SLOW_CLOCK)
    swipe(phone, (x - 60, y - 90), (0, -120))
    page.wait_for_function("before => scrollY !== before", arg=scrolled)
    page.evaluate("() => { setTimeout = usualTimeout; }")
    assert value(figure, "elevation") == before


SLOW_CLOCK = """() => {
  globalThis.usualTimeout = setTimeout;
  setTimeout = (then, ms, ...rest) => usualTimeout(then, 100 * ms, ...rest);
}"""
"""Makes the finger quick for the page even on the busiest machine."""


def test_finger_sketches_a_falling_curve(live_phone: Reader) -> None:
    phone = live_phone
    phone.turn_to("lighting-and-reflectance/")
    form = phone.page.locator("form[data-predict]", has=phone.page.locator(".sketch"))
    box = phone.scroll_to(form.locator(".sketch > svg"))
    x, y, width, height = box["x"], box["y"], box["width"], box["height"]
    scrolled = scroll(phone)
    swipe(phone, (x + 0.2 * width, y + 15), (0, 0.4 * height))
    swipe(phone, (x + 0.15 * width, y + 20), (0.8 * width, 0.6 * height))
    drawn = [float(point.input_value()) for point in form.locator("input[name=guess]").all()]
    assert drawn[1:-1] == sorted(drawn[1:-1], reverse=True)
    assert drawn[1] > drawn[-2]
    assert scroll(phone) == scrolled


def value(figure: Locator, setting: str) -> str:
    return figure.locator(f'.control [name="{setting}"]').input_value()


def scroll(phone: Reader) -> float:
    top: float = phone.page.evaluate("scrollY")
    return top


def swipe(phone: Reader, start: Place, way: Place, taken: Locator | None = None) -> None:
    """Put a finger down, rest until ``taken`` appears, move in steps, and lift it."""
    client = phone.page.context.new_cdp_session(phone.page)

    def touch(kind: str, *places: Place) -> None:
        points = [{"x": x, "y": y} for x, y in places]
        client.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    touch("touchStart", start)
    if taken:
        taken.wait_for()
    for step in range(1, 9):
        touch("touchMove", (start[0] + way[0] * step / 8, start[1] + way[1] * step / 8))
    touch("touchEnd")
    client.detach()
