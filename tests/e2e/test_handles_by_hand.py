"""A hand on the handles of a figure, and on one that is asked much."""

from typing import Any

import pytest
from support.hands import drag, middle
from support.reader import Reader
from support.reading_order import SAMPLED

from simulations.registry import load_scene

pytestmark = pytest.mark.browser

PULLS = ((41.0, 32.0), (-34.0, 26.0), (40.0, -60.0), (120.0, 0.0))
"""CSS pixels by which a handle is pulled until something moves: it may be at an end, or its next
place far."""
KEYS = ("ArrowLeft", "ArrowUp", "ArrowRight", "ArrowDown")


@pytest.mark.parametrize("scene", SAMPLED)
def test_every_handle_moves_its_settings_and_goes_along(
    guest: Reader, book: Any, scene: str
) -> None:
    """By a hand, and by the arrow keys."""
    figure = guest.stay_at_figure(book, scene)
    guest.put_back(figure)
    for handle in load_scene(scene).handles:
        grip = figure.locator(f'[data-handle="{handle.name}"]')
        start = grip.evaluate(GRASP)
        if not start["shown"]:
            continue
        for right, down in PULLS:
            x, y = start["x"], start["y"]
            drag(guest, (x, y), (x + right, y + down))
            pulled = grip.evaluate(GRASP)
            if pulled["values"] != start["values"]:
                break
            start = pulled
        assert pulled["values"] != start["values"], handle.name
        assert pulled["frames"] > start["frames"], handle.name
        grip.focus()
        for key in KEYS:
            guest.page.keyboard.press(key)
            led = grip.evaluate(GRASP)
            if led["values"] != pulled["values"]:
                break
        assert led["values"] != pulled["values"], f"{handle.name} by keyboard"
        assert led["told"] == led["words"], handle.name


PULLED = """async () => {
  const {inside} = await customElements.whenDefined('simulation-figure');
  const runtime = inside.sharedRuntime();
  for (let pull = 0; pull < 3; pull += 1) await runtime.call('forget', {figure: ''}, () => 3);
}"""
"""Wait until all pulls are answered: one that is asked, the one that waits for it, and the last
word on them; what is as urgent as they are is asked in its turn."""

GRASP = """async (grip) => {
  const figure = grip.closest('simulation-figure');
  await (PULLED)();
  while (!figure.rests) await new Promise(requestAnimationFrame);
  grip.scrollIntoView({block: 'center', behavior: 'instant'});
  const {x, y, width, height} = grip.getBoundingClientRect();
  const driven = grip.dataset.drives.split(' ').map((name) => {
    const control = figure.querySelector(`.control [name="${name}"]`);
    const box = control.closest('.control');
    if (box.matches('.points')) {
      const share = (axis) => Math.round(parseFloat(grip.style.getPropertyValue(axis)));
      const words = `${box.ariaLabel} x ${share('--x')}, y ${share('--y')}`;
      return {value: control.value, words};
    }
    const said = control.selectedOptions
      ? control.selectedOptions[0].text.trim()
      : box.querySelector('.control-value').textContent;
    const label = box.querySelector('label').textContent.trim();
    return {value: control.value, words: `${label} ${said}`};
  });
  return {
    shown: grip.checkVisibility() && width > 0,
    x: x + width / 2,
    y: y + height / 2,
    values: driven.map(({value}) => value).join(' '),
    words: driven.map(({words}) => words).join(', '),
    told: grip.getAttribute('aria-valuetext'),
    frames: Number(figure.dataset.frames),
  };
}""".replace("PULLED", PULLED)
"""A handle once nothing moves it, in the middle of the window; what the page's controls say of what
it drives."""


def test_a_handle_stays_under_the_pointer_and_ends_at_the_last_of_many_moves(
    visitor: Reader, book: Any
) -> None:
    figure = visitor.turn_to_figure(book, "lambertian-shading")
    grip = figure.locator('[data-handle="probe"]')
    visitor.bring(grip)
    start = middle(grip)
    end = (start[0] + 60, start[1])
    mouse = visitor.page.mouse
    mouse.move(*start)
    mouse.down()
    grip.evaluate(SWAY, [80, *start])
    mouse.move(*end)
    mouse.up()
    visitor.settle(figure)
    assert middle(grip)[0] == pytest.approx(end[0], abs=2)


SWAY = """async (grip, [count, x, y]) => {
  for (let step = 0; step < count; step += 1) {
    const at = {clientX: x + 90 * Math.sin(step / 9), clientY: y};
    grip.dispatchEvent(new PointerEvent('pointermove', {bubbles: true, isPrimary: true, ...at}));
    await new Promise((resolve) => setTimeout(resolve, 4));
  }
}"""
"""Faster than a test could send them from outside."""
