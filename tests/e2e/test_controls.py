"""Every control of every scene can be reached and draws another frame; each kind of control
answers keys and the mouse."""

from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

import pytest
from playwright.sync_api import Locator
from support.page_scripts import TRY_CONTROLS
from support.reader import Reader
from support.reading_order import SAMPLED

pytestmark = pytest.mark.browser

type Kind = tuple[str, str]
"""A kind of control, and of a button what it does."""
type Gesture = Callable[[Reader, Locator, Any, int], None]

KINDS: tuple[Kind, ...] = (
    ("slider", ""),
    ("action", "play"),
    ("action", "step"),
    ("action", ""),
    ("choice", ""),
    ("toggle", ""),
)
"""In the order in which the book first shows them, so that few pages are turned."""


@pytest.fixture(scope="module", params=SAMPLED)
def scene(request: pytest.FixtureRequest, book: Any) -> Any:
    shown = {id_ for chapter in book["chapters"] for id_ in chapter["simulations"]}
    assert request.param in shown, "no chapter shows it"
    return scene_of(book, request.param)


@pytest.fixture
def figure(guest: Reader, book: Any, scene: Any) -> Locator:
    """As the page has put it."""
    return at_rest(guest, book, scene["id"])


def at_rest(reader: Reader, book: Any, scene: str) -> Locator:
    figure = reader.stay_at_figure(book, scene)
    reader.put_back(figure)
    return figure


def scene_of(book: Any, id_: str) -> Any:
    return next(scene for scene in book["simulations"] if scene["id"] == id_)


def kind_of(control: Any) -> Kind:
    return control["kind"], control.get("effect", "")


def first_of_each_kind(scene: Any) -> list[Any]:
    """They change the picture. What the other controls do to it is Python's affair:
    `tests/scenes/test_control_sweeps.py`."""
    firsts: dict[Kind, Any] = {}
    for control in scene["controls"]:
        firsts.setdefault(kind_of(control), control)
    return [*firsts.values()]


def test_every_control_can_be_reached_and_draws_another_frame(scene: Any, figure: Locator) -> None:
    """The mouse finds what nothing covers, and what can be focused takes keys: what these do to
    each kind of control is tried below."""
    firsts = first_of_each_kind(scene)
    others = [control for control in scene["controls"] if control not in firsts]
    told = figure.evaluate(TRY_CONTROLS, [*firsts, *others])
    assert len(told) == len(scene["controls"])
    for number, control in enumerate(told):
        assert control["hit"], f"{control['name']} is covered by {control['cover']}"
        assert control["focused"], f"{control['name']} cannot be focused"
        assert control["frames"] > 0, f"{control['name']} asks for no frame"
        assert control["changed"] or number >= len(firsts), f"{control['name']} changes nothing"


@pytest.fixture(params=KINDS, ids=" ".join, scope="module")
def example(request: pytest.FixtureRequest, book: Any) -> tuple[str, Any]:
    """The first control of a kind in the book, and its scene."""
    return next(
        (scene, control)
        for chapter in book["chapters"]
        for scene in chapter["simulations"]
        for control in scene_of(book, scene)["controls"]
        if kind_of(control) == request.param
    )


def test_each_kind_of_control_changes_a_figure_by_keyboard(
    guest: Reader, book: Any, example: tuple[str, Any]
) -> None:
    scene, control = example
    assert_changes(guest, at_rest(guest, book, scene), control, press)


def test_each_kind_of_control_changes_a_figure_by_mouse(
    guest: Reader, book: Any, example: tuple[str, Any]
) -> None:
    scene, control = example
    assert_changes(guest, at_rest(guest, book, scene), control, click)


def assert_changes(reader: Reader, figure: Locator, control: Any, act: Gesture) -> None:
    """Some gesture on the control changes what is shown; later frames are let through."""
    reader.uncover(figure)
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


def press(reader: Reader, element: Locator, control: Any, _attempt: int) -> None:
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


def click(reader: Reader, element: Locator, control: Any, attempt: int) -> None:
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


def test_a_reader_who_asked_for_less_motion_sees_one_picture_after_another(
    calm_visitor: Reader, book: Any
) -> None:
    """Each for a second or more, which the clock of the test makes short."""
    slider, places = "t", ["0.25", "0.5"]
    figure = calm_visitor.turn_to_figure(book, "rotation-3d")
    seen = figure.evaluate(WALK, [slider, len(places)])
    assert seen["places"] == places
    assert len(seen["moves"]) >= len(places)
    assert all(later - earlier > 990 for earlier, later in pairwise(seen["moves"]))


WALK = """async (figure, [slider, count]) => {
  const input = figure.querySelector(`input[name="${slider}"]`);
  const play = figure.querySelector('button[name=play]');
  const usual = setTimeout;
  const [seen, moves] = [[], []];
  globalThis.setTimeout = (then, ms = 0, ...rest) => usual(() => {
    const [now, before] = [5 * performance.now(), input.value];
    then(...rest);
    if (input.value !== before) moves.push(now);
  }, ms / 5);
  input.value = input.min;
  await new Promise((resolve) => {
    const watch = new MutationObserver(() => {
      seen.push(input.value);
      if (seen.length < count) return;
      watch.disconnect();
      resolve();
    });
    watch.observe(figure, {attributeFilter: ['data-frames']});
    play.click();
  });
  globalThis.setTimeout = usual;
  play.click();
  return {places: seen, moves};
}"""


PLAYS = """figure => {
  const time = figure.querySelector('input[name=time]');
  return new Promise((resolve) => {
    const start = time.value;
    setTimeout(() => resolve(time.value !== start), 1500);
  });
}"""


def test_a_wheel_turns_as_it_comes_into_view_until_a_hand_is_on_it(
    visitor: Reader, book: Any
) -> None:
    figure = visitor.turn_to_figure(book, "wagon-wheel")
    assert figure.evaluate(PLAYS)
    figure.locator("input[name=speed]").focus()
    visitor.page.keyboard.press("ArrowRight")
    assert not figure.evaluate(PLAYS)


def test_a_wheel_stands_where_the_reader_asked_for_less_motion(
    calm_visitor: Reader, book: Any
) -> None:
    assert not calm_visitor.turn_to_figure(book, "wagon-wheel").evaluate(PLAYS)
