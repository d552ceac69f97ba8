"""What is written twice, in Python for the page as served and in JavaScript for the page as used,
says the same."""

import json
from collections.abc import Callable, Iterator
from dataclasses import asdict
from math import inf
from pathlib import Path
from typing import Any, cast

import pytest
from playwright.sync_api import Browser, Page
from support.static_server import serving

from simulations.engine.controls import Slider, describe
from simulations.engine.frame import Frame, Panel, StageReport, to_json
from simulations.engine.message import Message
from simulations.registry import SCENE_MODULES, load_scene
from site_builder.assets.pages import write_scripts
from site_builder.benchmarks.charts import linear_axis, log_axis
from site_builder.benchmarks.quantities import milliseconds, with_unit
from site_builder.languages.words import ENGLISH
from site_builder.pages.views.control import value_text
from site_builder.pages.views.simulation import count_stages, reason_text

pytestmark = pytest.mark.browser

ROOT = Path(__file__).parents[2]
MODULES = (
    "figure/stage_report",
    "ladder/bench",
    "ladder/chart",
    "page/text",
    "page/words",
)
CALL = """async ([module, name, calls]) => {
  const url = new URL(`js/${module}.js`, location.href);
  const twin = (await import(url))[name];
  return calls.map((given) => twin(...given));
}"""


@pytest.fixture(scope="module")
def page(brisk_chromium: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    """An empty page beside the scripts."""
    folder = tmp_path_factory.mktemp("scripts")
    write_scripts(ROOT, folder, MODULES)
    (folder / "index.html").write_text("<!DOCTYPE html><title>Scripts</title>", encoding="utf-8")
    with serving(folder) as server, brisk_chromium.new_page() as page:
        page.goto(server.url)
        yield page


type Pairs = Iterator[tuple[list[Any], object]]
"""Arguments, and what Python answers to them."""


def sent(*stages: StageReport) -> list[Any]:
    """The stages of a frame, as the page receives them."""
    frame = Frame((Panel("panel", "", 400, 300),), (), "Shows.", stages)
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
    """Of times, errors and decibels."""
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
def test_a_script_answers_as_python_does(
    page: Page, module: str, function: str, pairs: Callable[[], Pairs]
) -> None:
    calls, expected = zip(*pairs(), strict=True)
    assert page.evaluate(CALL, [module, function, calls]) == pytest.approx(list(expected))
