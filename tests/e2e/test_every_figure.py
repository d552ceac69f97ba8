"""Controls and handles of every figure respond to mouse and keyboard."""

import re
from collections.abc import Callable
from typing import Any

import pytest
from playwright.sync_api import Locator, expect
from support.frames import frame_of, texts_of
from support.page_scripts import READ_HANDLE, TRY_CONTROLS
from support.places import ROOT
from support.reader import PULLS, Reader

from simulations.registry import load_scene

pytestmark = pytest.mark.browser

KEYS = ("ArrowLeft", "ArrowUp", "ArrowRight", "ArrowDown")
CHAPTERS = sorted((ROOT / "content").glob("*.md"))
DIRECTIVE = re.compile(r"^:+\{simulation\} *([\w-]+)", re.MULTILINE)
SCENES = dict.fromkeys(
    name for file in CHAPTERS for name in DIRECTIVE.findall(file.read_text(encoding="utf-8"))
)
"""Scenes in the order of the book, so that a visit to all of them turns few pages."""
SAMPLE = ("formation-pipeline", "lens-distortion", "wagon-wheel")
"""Scenes in `make test`: every kind of control, pixels in tiers, drawings, a film. Python's own
results are tested for all scenes, in `tests/scenes`."""


@pytest.mark.parametrize(
    "scene",
    [pytest.param(name, marks=[] if name in SAMPLE else pytest.mark.deep) for name in SCENES],
)
def test_every_control_and_handle_of_a_figure_responds(
    guest: Reader, book: Any, scene: str
) -> None:
    """Every control can be reached and makes a frame; the first of each kind changes the picture by
    keyboard and by mouse. (`tests/scenes` tests that all controls change their frames.)"""
    controls = scene_of(book, scene)["controls"]
    figure = guest.figure_at_rest(book, scene)
    answers = figure.evaluate(TRY_CONTROLS, controls)
    assert all(one["hit"] and one["focused"] and one["frames"] > 0 for one in answers), answers
    for control in {kind_of(control): control for control in reversed(controls)}.values():
        for gesture in (press, click):
            guest.restore(figure)
            assert changes(guest, figure, control, gesture), (control["name"], gesture.__name__)
    guest.restore(figure)
    for handle in load_scene(scene).handles:
        grip = f'[data-handle="{handle.name}"]'
        shown = f"#figure-{scene} {grip}, [data-with=figure-{scene}] {grip}"
        assert_follows(guest, guest.page.locator(shown).first, handle.name)


def assert_follows(guest: Reader, grip: Locator, name: str) -> None:
    """The handle, where it is shown, moves its settings by a drag and by arrow keys."""
    start = pulled = grip.evaluate(READ_HANDLE)
    if not start["visible"]:
        return
    for right, down in PULLS:
        x, y = pulled["x"], pulled["y"]
        guest.drag((x, y), (x + right, y + down))
        pulled = grip.evaluate(READ_HANDLE)
        if pulled["values"] != start["values"]:
            break
    assert pulled["values"] != start["values"], name
    assert pulled["frames"] > start["frames"], name
    grip.focus()
    for key in KEYS:
        guest.page.keyboard.press(key)
        moved = grip.evaluate(READ_HANDLE)
        if moved["values"] != pulled["values"]:
            break
    assert moved["values"] != pulled["values"], f"{name} by keyboard"
    assert moved["announced"] == moved["words"], name


def scene_of(book: Any, name: str) -> Any:
    return next(scene for scene in book["simulations"] if scene["id"] == name)


def kind_of(control: Any) -> tuple[str, str]:
    return control["kind"], control.get("effect", "")


type Gesture = Callable[[Reader, Locator, Any, int], None]


def changes(guest: Reader, figure: Locator, control: Any, gesture: Gesture) -> bool:
    """Whether a gesture on a control, tried a few times, changes what the figure shows."""
    guest.open_controls(figure)
    element = figure.locator(f'.controls [name="{control["name"]}"]')
    parts = guest.page.locator(f"[data-with={figure.evaluate('one => one.parentElement.id')}]")
    before = [guest.content(each) for each in (figure, *parts.all())]
    for attempt in range(4):
        frames = guest.frames(figure)
        gesture(guest, element, control, attempt)
        # A gesture at the end of a slider makes no frame; some buttons move others a little later.
        if control.get("effect") in ("play", "set") or figure.evaluate(MAKES_A_FRAME, frames):
            guest.wait_frame(figure, frames)
        guest.settle(figure)
        if [guest.content(each) for each in (figure, *parts.all())] != before:
            return True
    return False


MAKES_A_FRAME = "(figure, frames) => !figure.rests || Number(figure.dataset.frames) > frames"


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
    box = reader.scroll_to(element)
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


def test_many_moves_end_at_the_pointer_without_a_leak(visitor: Reader, book: Any) -> None:
    """Drag a handle, then a slider."""
    figure = visitor.turn_to_figure(book, "lambertian-shading")
    grip = figure.locator('[data-handle="probe"]')
    visitor.scroll_to(grip)
    x, y = visitor.middle(grip)
    mouse = visitor.page.mouse
    mouse.move(x, y)
    mouse.down()
    for sway in (90, -90, 60):
        mouse.move(x + sway, y, steps=15)
    mouse.up()
    visitor.settle(figure)
    assert visitor.middle(grip)[0] == pytest.approx(x + 60, abs=2)

    figure = visitor.turn_to_figure(book, "perspective-projection")
    slider = figure.locator("[name=depth]")
    box = visitor.scroll_to(slider)
    counts: list[dict[str, float]] = []
    while len(counts) < 2 or leaks(*counts[-2:]):  # a leak grows in every round
        assert len(counts) < 6, counts
        x, y = box["x"] + 0.3 * box["width"], box["y"] + box["height"] / 2
        visitor.drag((x, y), (x + 60, y), steps=40)
        visitor.settle(figure)
        depth = float(slider.input_value())
        expected = texts_of(frame_of(load_scene("perspective-projection"), depth=depth))["x"]
        assert figure.locator("output[name=x]").inner_text() == expected
        counts.append(page_counts(visitor))


def leaks(before: dict[str, float], after: dict[str, float]) -> bool:
    """Whether nodes or listeners grew over some thirty frames."""
    more = {name: after[name] - before[name] for name in ("Nodes", "JSEventListeners")}
    return more["Nodes"] >= 15 or more["JSEventListeners"] > 0


def page_counts(reader: Reader) -> dict[str, float]:
    """Numbers of nodes and listeners of the page after garbage collection."""
    session = reader.page.context.new_cdp_session(reader.page)
    session.send("HeapProfiler.collectGarbage")
    session.send("Performance.enable")
    metrics = session.send("Performance.getMetrics")["metrics"]
    session.detach()
    return {each["name"]: each["value"] for each in metrics}


def test_figures_play_in_view_until_touched_and_in_steps_for_less_motion(
    visitor: Reader, book: Any
) -> None:
    """With less motion each picture stands for a second or more, by a clock five times as fast."""
    page = visitor.page
    figure = visitor.turn_to_figure(book, "wagon-wheel")
    assert figure.evaluate(PLAYS, ["time", SOON])
    figure.locator("input[name=speed]").focus()
    page.keyboard.press("ArrowRight")
    assert not figure.evaluate(PLAYS, ["time", A_WHILE])
    figure = visitor.turn_to_figure(book, "phong")
    start = figure.evaluate("f => JSON.parse(f.querySelector('script.schema').text).values")
    assert figure.evaluate(PLAYS, ["light_angle", SOON])
    page.evaluate("scrollTo(0, 0)")
    expect(figure.locator("[name=light_angle]")).to_have_value(f"{start['light_angle']:g}")
    visitor.turn_to("lecture-plan/", live=False)
    figure = visitor.turn_to_figure(book, "phong")
    assert figure.evaluate(PLAYS, ["light_angle", SOON])
    figure.dispatch_event("pointerdown")
    assert not figure.evaluate(PLAYS, ["light_angle", A_WHILE])
    page.emulate_media(reduced_motion="reduce")
    visitor.turn_to("lecture-plan/", live=False)
    figure = visitor.turn_to_figure(book, "wagon-wheel")
    assert not figure.evaluate(PLAYS, ["time", A_WHILE])
    steps = visitor.turn_to_figure(book, "rotation-3d").evaluate(STEPS, ["t", 2])
    assert steps["places"] == ["0.25", "0.5"]
    assert steps["rest"] > 990
    page.emulate_media(reduced_motion="no-preference")


SOON, A_WHILE = 1800, 90
"""Animation frames within which a figure moves, and in which one at rest does not."""
PLAYS = """async (figure, [name, frames]) => {
  const input = figure.querySelector(`input[name=${name}]`);
  const start = input.value;
  for (let left = frames; left && input.value === start; left -= 1) {
    await new Promise(requestAnimationFrame);
  }
  return input.value !== start;
}"""
STEPS = """async (figure, [slider, count]) => {
  const input = figure.querySelector(`input[name="${slider}"]`);
  const play = figure.querySelector('button[name=play]');
  const usual = setTimeout;
  const [places, moves] = [[], []];
  globalThis.setTimeout = (then, ms = 0, ...rest) => usual(() => {
    const [now, before] = [5 * performance.now(), input.value];
    then(...rest);
    if (input.value === before) return;
    moves.push(now);
    places.push(input.value);
  }, ms / 5);
  input.value = input.min;
  await new Promise((resolve) => {
    const watch = new MutationObserver(() => {
      if (places.length < count) return;
      watch.disconnect();
      resolve();
    });
    watch.observe(figure, {attributeFilter: ['data-frames']});
    play.click();
  });
  globalThis.setTimeout = usual;
  play.click();
  return {places: places.slice(0, count), rest: moves[count - 1] - moves[0]};
}"""
