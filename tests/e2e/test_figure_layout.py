"""Where a figure's panels, controls and labels stand, on a phone and on a desk."""

from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser
from support.page_scripts import SILENT_WORKER
from support.reader import PHONE, Reader, visit
from support.static_server import StaticServer

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def telephone(chromium: Browser, site_server: StaticServer) -> Iterator[Reader]:
    options = {"viewport": PHONE, "has_touch": True, "is_mobile": True}
    with visit(chromium, site_server, SILENT_WORKER, **options) as someone:
        yield someone


@pytest.fixture
def phone(telephone: Reader) -> Iterator[Reader]:
    """A reader with a telephone, before Python has answered; each test loads its pages anew."""
    telephone.begin_anew(PHONE)
    yield telephone
    telephone.assert_no_complaints()


def open_page(reader: Reader, address: str) -> None:
    reader.open(address, live=False)
    reader.page.evaluate("document.fonts.ready")


def test_other_controls_wait_behind_a_line_on_a_phone_until_words_or_an_address_move_them(
    phone: Reader, book: Any
) -> None:
    camera = next(c["url"] for c in book["chapters"] if "camera" in c["simulations"])
    open_page(phone, camera)
    figure = phone.figure("camera")
    folded = figure.locator("[name=shot_noise]")
    assert not folded.is_visible()
    figure.locator(".more-controls > summary").tap()
    assert folded.is_visible()
    figure.locator(".more-controls > summary").tap()
    assert not folded.is_visible()
    link = phone.page.locator("a.set[data-values*='\"shot_noise\": false']").first
    link.evaluate("link => link.click()")  # it may stand in an answer that waits
    folded.wait_for(state="visible")
    phone.page.goto("about:blank")
    open_page(phone, f"{camera}?figure-camera.shot_noise=false")
    folded.wait_for(state="visible")


def test_other_tools_wait_behind_dots_on_a_phone(phone: Reader, book: Any) -> None:
    open_page(phone, next(c["url"] for c in book["chapters"] if "jpeg" in c["simulations"]))
    figure = phone.figure("jpeg")
    dots, edit = figure.locator("[data-further]"), figure.locator(".open-python")
    more = figure.locator(".more-controls > summary")
    assert more.evaluate(IN_ONE_ROW, dots.element_handle())
    assert not edit.is_visible()
    dots.tap()
    edit.wait_for(state="visible")
    dots.tap()
    edit.wait_for(state="hidden")


IN_ONE_ROW = """(one, other) => {
  const [a, b] = [one.getBoundingClientRect(), other.getBoundingClientRect()];
  return a.top < b.bottom && b.top < a.bottom;
}"""


def test_a_panel_that_was_pushed_into_view_stays_while_a_slider_moves(
    visitor: Reader, book: Any
) -> None:
    visitor.page.set_viewport_size(PHONE)
    figure = visitor.turn_to_figure(book, "lens-distortion")
    strip = figure.locator(".other-panels")
    strip.focus()
    visitor.page.keyboard.press("ArrowRight")
    visitor.page.wait_for_function(SECOND_IS_SHOWN, arg=strip.element_handle())
    frames = visitor.frames(figure)
    figure.locator("input[name=k1]").focus()
    visitor.page.keyboard.press("ArrowRight")
    visitor.wait_frame(figure, frames)
    assert strip.evaluate(SECOND_IS_SHOWN)


def test_a_dot_brings_its_panel_into_view_and_tells_of_it(phone: Reader, book: Any) -> None:
    """Whose title waits while only its edge is shown."""
    address = next(c["url"] for c in book["chapters"] if "lens-distortion" in c["simulations"])
    open_page(phone, address)
    figure = phone.figure("lens-distortion")
    title = figure.locator(".other-panels > :last-child > .panel-title").element_handle()
    assert title.evaluate("title => getComputedStyle(title).opacity") == "0"
    dots = figure.locator(".panel-dots > button")
    dots.nth(1).tap()
    phone.page.wait_for_function("title => getComputedStyle(title).opacity === '1'", arg=title)
    strip = figure.locator(".other-panels").element_handle()
    phone.page.wait_for_function(SECOND_IS_SHOWN, arg=strip)
    figure.locator('.panel-dots > button:nth-child(2)[aria-current="true"]').wait_for()


SECOND_IS_SHOWN = """(strip) => {
  const { left, right } = strip.children[1].getBoundingClientRect();
  return left >= 0 && right <= innerWidth;
}"""


def test_controls_stand_beneath_a_low_second_panel_and_beside_the_first(
    visitor: Reader, book: Any
) -> None:
    figure = visitor.turn_to_figure(book, "tiled-floor")
    slider = figure.locator(".figure-side input[type=range]").first
    slider.click(trial=True)  # the box of the panels does not cover it
    place = visitor.bring(slider)
    first = visitor.bring(figure.locator(".panel").first)
    assert place["x"] > first["x"] + first["width"]
    assert slider.evaluate(FOLLOWS, figure.locator(".panel").last.element_handle())


FOLLOWS = """(low, high) =>
  low.getBoundingClientRect().top >= high.getBoundingClientRect().bottom"""


def test_menus_keep_their_arrow_in_forced_colours(phone: Reader, book: Any) -> None:
    phone.page.emulate_media(forced_colors="active")
    open_page(phone, next(c["url"] for c in book["chapters"] if "aliasing" in c["simulations"]))
    menu = phone.figure("aliasing").locator("select").first
    drawn = menu.evaluate("menu => getComputedStyle(menu).backgroundImage !== 'none'")
    own = menu.evaluate("menu => getComputedStyle(menu).appearance !== 'none'")
    assert drawn or own
