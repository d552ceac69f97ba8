"""Scripts against Python's answers, updated drawings against freshly parsed ones, and subset fonts
against whole ones."""

import io
import json
from base64 import b64encode
from collections.abc import Callable, Iterator
from dataclasses import asdict, replace
from math import inf
from typing import Any, cast

import cv2
import numpy as np
import pytest
from fontTools.ttLib import TTFont
from playwright.sync_api import Browser, Page
from support.places import ROOT
from support.reader import Reader
from support.static_server import serving

from simulations.engine.controls import Slider, describe
from simulations.engine.frame import Frame, Panel, StageReport, to_json
from simulations.engine.message import Message
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from simulations.registry import SCENE_MODULES, load_scene
from site_builder.assets.page_assets import write_scripts
from site_builder.benchmarks.charts import linear_axis, log_axis
from site_builder.benchmarks.judgements import milliseconds, with_unit
from site_builder.formulae.temml import to_mathml
from site_builder.languages.words import ENGLISH
from site_builder.output.fonts import MATHS_FACES, cut, source_file
from site_builder.pages.views.simulation import count_stages, reason_text, value_text

pytestmark = pytest.mark.browser

MODULES = ("figure/stage_report", "ladder/bench", "ladder/chart", "page/text", "page/words")
CALL = """async ([module, name, calls]) => {
  const url = new URL(`js/${module}.js`, location.href);
  const twin = (await import(url))[name];
  return calls.map((given) => twin(...given));
}"""


@pytest.fixture(scope="module")
def page(baseline_chromium: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    """An empty page that can import the scripts."""
    folder = tmp_path_factory.mktemp("scripts")
    write_scripts(ROOT, folder, MODULES)
    (folder / "index.html").write_text("<!DOCTYPE html><title>Scripts</title>", encoding="utf-8")
    with serving(folder) as server, baseline_chromium.new_page() as page:
        page.goto(server.url)
        yield page


type Pairs = Iterator[tuple[list[Any], object]]
"""Arguments of a function, and Python's results."""


def sent(*stages: StageReport) -> list[Any]:
    """The stages of a frame, as the page receives them."""
    frame = Frame((Panel("panel", "", 400, 300),), (), "Shows.", stages=stages)
    return list(json.loads(to_json(frame))["stages"])


def values_beside_sliders() -> Pairs:
    for scene_id in SCENE_MODULES:
        for control in load_scene(scene_id).controls:
            if isinstance(control, Slider):
                nearest = control.minimum + control.step
                for value in (control.minimum, nearest, control.default, control.maximum):
                    yield [describe(control), value], value_text(control, value)


def numbers_with_units() -> Pairs:
    for text, unit in (("16.0", "px"), ("30", "°"), ("none", ""), ("0.3", "codes of 255")):
        yield [text, unit], with_unit(text, unit)


def times_of_ladders() -> Pairs:
    short = (0.0, 0.00123, 0.0996, 0.41, 0.999, 9.94, 9.97)
    for time in (*short, 42.4, 99.4, 99.7, 100.0, 1234.0, 56789.0):
        yield [time], milliseconds(time)


def counts_of_stages() -> Pairs:
    for statuses in ("", "computed", "reused computed skipped reused"):
        stages = [StageReport("stage", cast("Any", status), "") for status in statuses.split()]
        yield [sent(*stages)], count_stages(stages)


def reasons_of_stages() -> Pairs:
    reads, follows = (
        Message(f"stage_report.{key}", {"names": "a, b"}) for key in ("reads", "follows")
    )
    reasons: tuple[str | tuple[Message, ...], ...] = (
        *((reads, follows), (Message("stage_report.unneeded"),)),
        *("no blur", ""),
    )
    for reason in reasons:
        yield [sent(StageReport("s", "skipped", reason))[0]["reason"]], reason_text(reason)


def numerals_of_the_language() -> Pairs:
    for number in ("1.50", "undefined", "under 10⁻⁹", "∞", "f/2.8"):
        yield [number], ENGLISH.numeral(number)


def places_on_axes() -> Pairs:
    """Places of times, errors and decibels."""
    for axis, nothing in (
        (log_axis([0.02, 30.0], 48.0, 408.0), ()),
        (log_axis([1e-9, 1e-3], 270.0, 34.0, none=290.0), (0.0,)),
        (linear_axis([12.0, 55.5], 270.0, 34.0, none=20.0), (inf,)),
    ):
        for value in (1e-12, 1e-6, 0.5, 20.0, 1e4, *nothing):
            yield [asdict(axis), value], axis.position(value)


@pytest.mark.parametrize(
    ("module", "function", "pairs"),
    [
        ("page/text", "formatValue", values_beside_sliders),
        ("page/text", "withUnit", numbers_with_units),
        ("ladder/bench", "milliseconds", times_of_ladders),
        ("figure/stage_report", "countStages", counts_of_stages),
        ("figure/stage_report", "reasonText", reasons_of_stages),
        ("page/words", "numeral", numerals_of_the_language),
        ("ladder/chart", "position", places_on_axes),
    ],
)
def test_script_function_agrees_with_python(
    page: Page, module: str, function: str, pairs: Callable[[], Pairs]
) -> None:
    calls, expected = zip(*pairs(), strict=True)
    assert page.evaluate(CALL, [module, function, calls]) == pytest.approx(list(expected))


OVERLAYS = """async (sequences) => {
  const { Overlay } = (await customElements.whenDefined('simulation-figure')).internals;
  const svg = () => document.createElementNS("http://www.w3.org/2000/svg", "svg");
  return sequences.flatMap((markups) => {
    const overlay = new Overlay(svg());
    return markups.filter((markup) => {
      const fresh = svg();
      fresh.innerHTML = markup;
      overlay.show(markup);
      return !overlay.svg.isEqualNode(fresh);
    });
  });
}"""


def drawings(scene: Scene[Any]) -> list[list[str]]:
    """Panels at the default, with every slider at its ends, and at the default again."""
    sliders = [control for control in scene.controls if isinstance(control, Slider)]
    low = {slider.name: slider.minimum for slider in sliders}
    high = {slider.name: slider.maximum for slider in sliders}
    cache, level = StageCache(), scene.accuracy.cheapest
    shown = [scene.render(scene.clamp(given), level, cache).panels for given in ({}, low, high, {})]
    return [[panel.overlay for panel in panels] for panels in zip(*shown, strict=True)]


def test_updated_drawing_equals_a_freshly_parsed_one(visitor: Reader) -> None:
    sequences = [each for name in SCENE_MODULES for each in drawings(load_scene(name))]
    mixed = [markup for markups in sequences for markup in markups]
    assert len(set(mixed)) > 100
    assert visitor.page.evaluate(OVERLAYS, [*sequences, mixed]) == []


KINDS = {
    "root": r"\sqrt{\frac{a}{b} + \sqrt{2}}",
    "fraction": r"\frac{a + b}{1 - \frac{c}{d}}",
    "matrix": r"\begin{bmatrix} a & b \\ c & d \\ e & f \end{bmatrix}",
    "cases": r"\begin{cases} x & x > 0 \\ -x & \text{otherwise} \end{cases}",
    "overline": r"\overline{AB} + \bar{N}",
    "accents": r"\hat{\mathbf{n}} + \tilde{x} + \vec{v} + \dot{q}",
    "braces": r"\overbrace{a + b + c} + \underbrace{d + e}",
    "big operators": r"\sum \int \prod \frac{a}{b}",
    "fences": r"\left( \frac{a}{b} \right) + \left\{ \frac{e}{f} \right\}",
    "bars": r"\left\lVert \frac{c}{d} \right\rVert + \left| \frac{g}{h} \right|",
}

ROW_PX = 130
SHOW = """([markups, height]) => {
  const place = document.createElement('div');
  place.id = 'kinds';
  place.style.cssText = 'position: absolute; inset: 0 auto auto 0; z-index: 99;'
    + 'width: 400px; background: white; color: black; font-size: 32px';
  for (const markup of markups) {
    const row = document.createElement('div');
    row.style.cssText = `height: ${height}px; padding: 20px; box-sizing: border-box`;
    row.innerHTML = markup;
    place.append(row);
  }
  document.body.append(place);
  return document.fonts.ready;
}"""
LOAD = """async (font) => {
  const bytes = Uint8Array.from(atob(font), (letter) => letter.charCodeAt(0));
  document.fonts.add(await new FontFace('Whole', bytes.buffer).load());
  for (const one of document.querySelectorAll('#kinds math')) one.style.fontFamily = 'Whole';
}"""
WIDTHS = """() => [...document.querySelectorAll('#kinds math')]
  .map((one) => one.getBoundingClientRect().width)"""


def whole_font() -> str:
    """The maths face with every character of its source, in Base64."""
    source = source_file(MATHS_FACES[0]).read_bytes()
    every = frozenset(TTFont(io.BytesIO(source)).getBestCmap())
    return b64encode(cut(replace(MATHS_FACES[0], characters=every), source)).decode()


def widths_and_ink(reader: Reader) -> tuple[list[float], list[float]]:
    """Widths of the formulae in pixels, and the ink of each in black pixels."""
    data = np.frombuffer(reader.page.locator("#kinds").screenshot(), np.uint8)
    picture: Any = cv2.imdecode(data, cv2.IMREAD_GRAYSCALE)
    rows = np.split(picture, len(KINDS))
    return reader.page.evaluate(WIDTHS), [float(np.sum(1 - row / 255.0)) for row in rows]


@pytest.mark.deep
def test_subset_faces_draw_formulae_like_the_whole_font(plain_reader: Reader) -> None:
    plain_reader.open("lecture-plan/", live=False)
    formulae = [to_mathml(formula, display=True) for formula in KINDS.values()]
    plain_reader.page.evaluate(SHOW, [formulae, ROW_PX])
    widths, ink = widths_and_ink(plain_reader)
    plain_reader.page.evaluate(LOAD, whole_font())
    whole_widths, whole_ink = widths_and_ink(plain_reader)
    assert widths == pytest.approx(whole_widths, abs=2), [*KINDS]
    assert ink == pytest.approx(whole_ink, rel=0.02), [*KINDS]
