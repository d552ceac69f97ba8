"""Drawings that are changed in place are what a fresh parse of their markup would be."""

from typing import Any

import pytest
from support.reader import Reader

from simulations.engine.controls import Slider
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from simulations.registry import SCENE_MODULES, load_scene

pytestmark = pytest.mark.browser

SHOW = """async ([sequences, look]) => {
  const { Overlay } = (await customElements.whenDefined('simulation-figure')).inside;
  const svg = () => document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const looks = { wrong, kept };
  return sequences.flatMap(looks[look]);

  function wrong(markups) {
    const overlay = new Overlay(svg());
    return markups.filter((markup) => {
      const fresh = svg();
      fresh.innerHTML = markup;
      overlay.show(markup);
      return !overlay.svg.isEqualNode(fresh);
    });
  }

  function kept([first, second]) {
    const overlay = new Overlay(svg());
    overlay.show(first);
    const before = [...overlay.svg.children];
    overlay.show(second);
    return [[...overlay.svg.children].map((element) => before.indexOf(element))];
  }
}"""


def drawings(scene: Scene[Any]) -> list[list[str]]:
    """Of each panel: at the default, with every slider at its ends, and at the default again."""
    sliders = [control for control in scene.controls if isinstance(control, Slider)]
    low = {slider.name: slider.minimum for slider in sliders}
    high = {slider.name: slider.maximum for slider in sliders}
    cache = StageCache()
    shown = [
        scene.render(scene.clamp(given), scene.draft_tier, cache).panels
        for given in ({}, low, high, {})
    ]
    return [[panel.overlay for panel in panels] for panels in zip(*shown, strict=True)]


def test_a_drawing_is_what_a_fresh_one_would_be_after_any_change(visitor: Reader) -> None:
    sequences = [each for name in SCENE_MODULES for each in drawings(load_scene(name))]
    mixed = [markup for markups in sequences for markup in markups]
    assert len(set(mixed)) > 100
    assert visitor.page.evaluate(SHOW, [[*sequences, mixed], "wrong"]) == []


@pytest.mark.parametrize(
    ("before", "after", "kept"),
    [
        ("<path d='M0,0'/><text>1</text>", "<path d='M0,1'/><text>2</text>", [0, 1]),
        ("<path/><circle/>", "<path/><rect/><circle/>", [0, -1, 1]),
        ("<path/><rect/><circle/>", "<path/><circle/>", [0, 2]),
        ("<path/><circle/>", "<rect/><circle r='1'/>", [-1, 1]),
    ],
)
def test_elements_that_are_still_drawn_stay(
    visitor: Reader, before: str, after: str, kept: list[int]
) -> None:
    assert visitor.page.evaluate(SHOW, [[[before, after]], "kept"]) == [kept]
