"""Every chapter opens, every figure comes alive in place, every control does something."""

from collections.abc import Callable
from contextlib import suppress
from typing import Any

import pytest
from playwright.sync_api import Locator
from playwright.sync_api import TimeoutError as PlaywrightTimeoutError
from support.reader import Reader

pytestmark = pytest.mark.browser

type Gesture = Callable[[Reader, Locator, Any, int], None]


def test_every_figure_comes_alive_in_place(reader: Reader, book: Any) -> None:
    for address in ["", *(chapter["url"] for chapter in book["chapters"])]:
        reader.open(address, live=False)
        still = reader.page.evaluate(STILLS)
        reader.wait_live()
        where = address or "landing page"
        assert reader.page.evaluate(STILLS) == still, where
        shifts = reader.page.evaluate("window.shifts")
        total = sum(shift["value"] for shift in shifts)
        assert total < 0.01, f"{where} moved by {total:.3f}: {shifts}"


def test_every_chapter_shows_the_figures_and_questions_that_the_catalogue_names(
    plain_reader: Reader, book: Any
) -> None:
    for chapter in book["chapters"]:
        plain_reader.open(chapter["url"], live=False)
        assert plain_reader.page.locator("h1").inner_text().strip() == chapter["title"]
        found = plain_reader.page.evaluate(
            "[...document.querySelectorAll('simulation-figure')].map(f => f.dataset.simulation)"
        )
        assert set(found) == set(chapter["simulations"])
        quizzes = plain_reader.page.evaluate(
            "[...document.querySelectorAll('form.quiz')].map(form => form.dataset.quiz)"
        )
        assert quizzes == chapter["quizzes"]


STILLS = """async () => {
  const figures = [];
  for (const figure of document.querySelectorAll('simulation-figure')) {
    figures.push({
      drawings: [...figure.querySelectorAll('svg.overlay')].map((svg) => svg.innerHTML),
      readouts: [...figure.querySelectorAll('output')].map((output) => output.textContent),
      values: [...figure.querySelectorAll('.control-value')].map((text) => text.textContent),
      description: figure.querySelector('.description').textContent,
      boxes: [...figure.querySelectorAll('.panel-view')].map((box) => box.offsetHeight),
    });
  }
  return figures;
}"""


def test_every_control_changes_the_figure_by_keyboard(reader: Reader, book: Any) -> None:
    for scene, url in _places(book):
        reader.turn_to(url)
        figure = reader.figure(scene["id"])
        for control in scene["controls"]:
            _assert_changes(reader, figure, control, _press)


def test_every_control_changes_the_figure_by_mouse(reader: Reader, book: Any) -> None:
    for scene, url in _places(book):
        reader.turn_to(url)
        figure = reader.figure(scene["id"])
        for control in scene["controls"]:
            _assert_changes(reader, figure, control, _click)


def test_every_tier_draws_a_frame(reader: Reader, book: Any) -> None:
    for scene, url in _places(book):
        if not scene["tiers"]:
            continue
        reader.turn_to(url)
        figure = reader.figure(scene["id"])
        menu = figure.locator('select[name="tier"]')
        chosen = menu.input_value()
        for tier in [*(tier for tier in scene["tiers"] if tier != chosen), chosen]:
            before = reader.frames(figure)
            menu.select_option(tier)
            reader.wait_frame(figure, before)


def _places(book: Any) -> list[tuple[Any, str]]:
    """Each scene that some chapter shows, with the first such chapter."""
    return [
        (scene, next(c["url"] for c in book["chapters"] if scene["id"] in c["simulations"]))
        for scene in book["simulations"]
        if any(scene["id"] in chapter["simulations"] for chapter in book["chapters"])
    ]


def _assert_changes(reader: Reader, figure: Locator, control: Any, act: Gesture) -> None:
    """Some gesture on the control changes what is shown; later frames are let through first."""
    reader.settle(figure)
    before = reader.shown(figure)
    element = figure.locator(f'.controls [name="{control["name"]}"]')
    for attempt in range(4):
        frames = reader.frames(figure)
        act(reader, element, control, attempt)
        with suppress(PlaywrightTimeoutError):  # a gesture at the end of a slider asks for nothing
            reader.wait_frame(figure, frames, within_ms=3000)
        reader.settle(figure)
        if reader.shown(figure) != before:
            return
    pytest.fail(f"{control['name']} ({control['kind']}) changes nothing in the figure")


def _press(reader: Reader, element: Locator, control: Any, _attempt: int) -> None:
    element.focus()
    match control["kind"]:
        case "slider":
            at_end = element.evaluate("input => input.valueAsNumber >= Number(input.max)")
            reader.page.keyboard.press("Home" if at_end else "PageUp")
        case "choice":
            down = element.evaluate("menu => menu.selectedIndex < menu.options.length - 1")
            reader.page.keyboard.press("ArrowDown" if down else "ArrowUp")
        case _:
            reader.page.keyboard.press("Space")


def _click(reader: Reader, element: Locator, control: Any, attempt: int) -> None:
    element.evaluate("element => element.scrollIntoView({block: 'center', behavior: 'instant'})")
    match control["kind"]:
        case "slider":
            box = element.bounding_box()
            assert box
            share = (0.2, 0.8, 0.4, 0.6)[attempt]
            x, y = box["x"] + share * box["width"], box["y"] + box["height"] / 2
            reader.page.mouse.click(x, y)
        case "choice":
            options = control["options"]
            now = options.index(element.input_value())
            element.select_option(options[now + 1 if now + 1 < len(options) else now - 1])
        case _:
            element.click()


@pytest.mark.parametrize(
    ("scene", "slider", "places"),
    [
        ("formation-pipeline", "station", ["1", "2"]),
        ("rotation-3d", "t", ["0.25", "0.5"]),
        ("lambertian-shading", "light_angle", ["-165", "-150"]),
    ],
)
def test_a_reader_who_asked_for_less_motion_sees_one_picture_after_another(
    reader: Reader, book: Any, scene: str, slider: str, places: list[str]
) -> None:
    reader.page.emulate_media(reduced_motion="reduce")
    reader.open(next(c["url"] for c in book["chapters"] if scene in c["simulations"]))
    figure = reader.figure(scene)
    figure.evaluate(NOTE_PLACES, slider)
    figure.locator("button[name=play]").click()
    reader.page.wait_for_function("count => window.places.length >= count", arg=len(places))
    assert reader.page.evaluate("window.places")[: len(places)] == places


NOTE_PLACES = """(figure, slider) => {
  const input = figure.querySelector(`input[name="${slider}"]`);
  input.value = input.min;
  window.places = [];
  new MutationObserver(() => window.places.push(input.value))
    .observe(figure, {attributeFilter: ['data-frames']});
}"""
