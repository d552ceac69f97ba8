"""Every chapter opens, every figure comes alive in place, every kind of control does something."""

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from playwright.sync_api import Locator
from support.reader import Reader

from simulations.registry import SCENE_MODULES

pytestmark = pytest.mark.browser

type Gesture = Callable[[Reader, Locator, Any, int], None]


@pytest.mark.long
def test_every_figure_comes_alive_in_place(reader: Reader, book: Any) -> None:
    reader.page.add_init_script(HOLD)
    first, *others = (chapter["url"] for chapter in book["chapters"])
    for address in ("", first, *others):
        if address in others:
            reader.page.evaluate("window.hold()")
            reader.turn_to(address, live=False)
        else:
            reader.open(address, live=False)
        still = reader.page.evaluate(STILLS)
        reader.page.evaluate("window.release()")
        reader.wait_live()
        where = address or "landing page"
        assert reader.page.evaluate(STILLS) == still, where
        _assert_unmoved(reader, where)


def test_every_chapter_shows_the_figures_and_questions_that_the_catalogue_names(
    plain_reader: Reader, book: Any
) -> None:
    urls = [chapter["url"] for chapter in book["chapters"]]
    for chapter, url in zip(book["chapters"], plain_reader.leaf_through(urls), strict=True):
        assert plain_reader.page.locator("h1").inner_text().strip() == chapter["title"]
        found = plain_reader.page.evaluate(
            "[...document.querySelectorAll('simulation-figure')].map(f => f.dataset.simulation)"
        )
        assert set(found) == set(chapter["simulations"])
        quizzes = plain_reader.page.evaluate(
            "[...document.querySelectorAll('form.quiz')].map(form => form.dataset.quiz)"
        )
        assert quizzes == chapter["quizzes"]
        _assert_unmoved(plain_reader, url)


def _assert_unmoved(reader: Reader, where: str) -> None:
    """Nothing has moved on this page, nor on those from which the reader turned to it."""
    shifts = reader.page.evaluate("window.shifts")
    total = sum(shift["value"] for shift in shifts)
    assert total < 0.01, f"{where} moved by {total:.3f}: {shifts}"


HOLD = """(() => {
  const send = Worker.prototype.postMessage;
  let held = [];
  window.hold = () => {
    Worker.prototype.postMessage = function (...message) { held.push([this, message]); };
  };
  window.release = () => {
    Worker.prototype.postMessage = send;
    for (const [worker, message] of held) worker.postMessage(...message);
    held = [];
  };
  window.hold();
})()"""
"""What is sent to the interpreter waits, so that the page can be looked at as it was served."""

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


@pytest.fixture(scope="module", params=SCENE_MODULES)
def scene(request: pytest.FixtureRequest, book: Any) -> Any:
    shown = {id_ for chapter in book["chapters"] for id_ in chapter["simulations"]}
    assert request.param in shown, "no chapter shows it"
    return next(scene for scene in book["simulations"] if scene["id"] == request.param)


@pytest.fixture
def figure(guest: Reader, book: Any, scene: Any) -> Locator:
    """As the page has put it, and at rest."""
    figure = guest.stay_at_figure(book, scene["id"])
    figure.locator("[data-reset]").evaluate("button => button.click()")
    guest.settle(figure)
    return figure


def test_each_kind_of_control_changes_the_figure_by_keyboard(
    guest: Reader, scene: Any, figure: Locator
) -> None:
    for control in _one_of_each_kind(scene):
        _assert_changes(guest, figure, control, _press)


def test_each_kind_of_control_changes_the_figure_by_mouse(
    guest: Reader, scene: Any, figure: Locator
) -> None:
    for control in _one_of_each_kind(scene):
        _assert_changes(guest, figure, control, _click)


def test_every_tier_draws_a_frame(guest: Reader, scene: Any, figure: Locator) -> None:
    if not scene["tiers"]:
        return
    menu = figure.locator('select[name="tier"]')
    chosen = menu.input_value()
    for tier in [*(tier for tier in scene["tiers"] if tier != chosen), chosen]:
        guest.choose(figure, "tier", tier)


def _one_of_each_kind(scene: Any) -> Iterator[Any]:
    """The first control of each kind; of the buttons, of each effect.

    What the others do to the picture is Python's affair: `tests/scenes/test_control_sweeps.py`.
    """
    seen: set[Any] = set()
    for control in scene["controls"]:
        kind = (control["kind"], control.get("effect"))
        if kind not in seen:
            yield control
        seen.add(kind)


def _assert_changes(reader: Reader, figure: Locator, control: Any, act: Gesture) -> None:
    """Some gesture on the control changes what is shown; later frames are let through."""
    before = reader.shown(figure)
    element = figure.locator(f'.controls [name="{control["name"]}"]')
    for attempt in range(4):
        frames = reader.frames(figure)
        act(reader, element, control, attempt)
        # A gesture at the end of a slider asks for nothing; what plays begins a little later.
        if control.get("effect") == "play" or figure.evaluate(ASKS, frames):
            reader.wait_frame(figure, frames)
        reader.settle(figure)
        if reader.shown(figure) != before:
            return
    pytest.fail(f"{control['name']} ({control['kind']}) changes nothing in the figure")


ASKS = "(figure, frames) => !figure.rests || Number(figure.dataset.frames) > frames"


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
    box = reader.bring(element)
    match control["kind"]:
        case "slider":
            share = (0.2, 0.8, 0.4, 0.6)[attempt]
            x, y = box["x"] + share * box["width"], box["y"] + box["height"] / 2
            reader.page.mouse.click(x, y)
        case "choice":
            options = control["options"]
            now = options.index(element.input_value())
            element.select_option(options[now + 1 if now + 1 < len(options) else now - 1])
        case _:
            element.click()


@pytest.fixture
def calm_visitor(visitor: Reader) -> Iterator[Reader]:
    visitor.page.emulate_media(reduced_motion="reduce")
    yield visitor
    visitor.page.emulate_media(reduced_motion="no-preference")


@pytest.mark.parametrize(
    ("scene_id", "slider", "places"),
    [
        ("formation-pipeline", "station", ["1", "2"]),
        ("rotation-3d", "t", ["0.25", "0.5"]),
        ("lambertian-shading", "light_angle", ["-165", "-150"]),
    ],
)
def test_a_reader_who_asked_for_less_motion_sees_one_picture_after_another(
    calm_visitor: Reader, book: Any, scene_id: str, slider: str, places: list[str]
) -> None:
    figure = calm_visitor.turn_to_figure(book, scene_id)
    figure.evaluate(NOTE_PLACES, slider)
    figure.locator("button[name=play]").click()
    calm_visitor.page.wait_for_function("count => window.places.length >= count", arg=len(places))
    assert calm_visitor.page.evaluate("window.places")[: len(places)] == places


NOTE_PLACES = """(figure, slider) => {
  const input = figure.querySelector(`input[name="${slider}"]`);
  input.value = input.min;
  window.places = [];
  new MutationObserver(() => window.places.push(input.value))
    .observe(figure, {attributeFilter: ['data-frames']});
}"""
