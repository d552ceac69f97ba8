"""What is written twice, in Python for the page as served and in JavaScript for the page as used,
says the same."""

import json
from collections.abc import Iterator
from dataclasses import asdict
from math import inf
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page
from support.scripts import write_scripts
from support.static_server import serving

from simulations.engine.controls import Slider, describe
from simulations.engine.frame import Frame, Panel, StageReport, to_json
from simulations.engine.message import Message
from simulations.registry import SCENE_MODULES, load_scene
from site_builder.benchmarks.quantities import milliseconds, with_unit
from site_builder.charts.axes import linear_axis, log_axis
from site_builder.languages.words import ENGLISH
from site_builder.pages.views.control import value_text
from site_builder.pages.views.simulation import count_stages, reason_text

pytestmark = pytest.mark.browser

ROOT = Path(__file__).parents[2]
MODULES = (
    "figure/control_kinds",
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


def ask(page: Page, module: str, name: str, calls: list[list[Any]]) -> list[Any]:
    """What the function ``name`` of a script answers to each list of arguments."""
    return list(page.evaluate(CALL, [module, name, calls]))


def sent(*stages: StageReport) -> list[Any]:
    """What a frame tells the page of them."""
    frame = Frame((Panel("panel", "", 400, 300),), (), "Shows.", stages)
    return list(json.loads(to_json(frame))["stages"])


def test_the_value_beside_a_slider(page: Page) -> None:
    calls, texts = [], []
    for scene_id in SCENE_MODULES:
        for control in load_scene(scene_id).controls:
            if isinstance(control, Slider):
                nearest = control.minimum + control.step
                for value in (control.minimum, nearest, control.default, control.maximum):
                    calls.append([describe(control), value])
                    texts.append(value_text(control, value))
    assert ask(page, "figure/control_kinds", "formatValue", calls) == texts


def test_a_number_and_its_unit(page: Page) -> None:
    calls = [["16.0", "px"], ["30", "°"], ["none", ""], ["0.3", "codes of 255"]]
    texts = [with_unit(text, unit) for text, unit in calls]
    assert ask(page, "page/text", "withUnit", calls) == texts


def test_milliseconds_in_the_table_of_a_ladder(page: Page) -> None:
    times = [
        0.0,
        0.00123,
        0.0996,
        0.41,
        0.999,
        9.94,
        9.97,
        42.4,
        99.4,
        99.7,
        100.0,
        1234.0,
        56789.0,
    ]
    texts = [milliseconds(time) for time in times]
    assert ask(page, "ladder/bench", "milliseconds", [[time] for time in times]) == texts


@pytest.mark.parametrize(
    "statuses", [[], ["computed"], ["reused", "computed", "skipped", "reused"]]
)
def test_the_count_of_stages(page: Page, statuses: list[Any]) -> None:
    stages = [StageReport("stage", status, "") for status in statuses]
    calls = [[sent(*stages)]]
    assert ask(page, "figure/stage_report", "countStages", calls) == [count_stages(stages)]


def test_why_a_stage_was_computed_or_not(page: Page) -> None:
    reads, follows = (Message(f"workings.{key}", {"names": "a, b"}) for key in ("reads", "follows"))
    reasons: list[str | tuple[Message, ...]] = [
        (reads, follows),
        (Message("workings.unneeded"),),
        "no blur",
        "",
    ]
    texts = [reason_text(reason) for reason in reasons]
    calls = [[sent(StageReport("s", "skipped", reason))[0]["reason"]] for reason in reasons]
    assert ask(page, "figure/stage_report", "reasonText", calls) == texts


def test_a_number_as_the_language_writes_it(page: Page) -> None:
    numbers = ["1.50", "undefined", "under 10⁻⁹", "∞", "f/2.8"]
    texts = [ENGLISH.numeral(number) for number in numbers]
    assert ask(page, "page/words", "numeral", [[number] for number in numbers]) == texts


@pytest.mark.parametrize(
    "axis",
    [
        log_axis([0.02, 30.0], 48.0, 408.0),
        log_axis([1e-9, 1e-3], 270.0, 34.0, none=290.0),
        linear_axis([12.0, 55.5], 270.0, 34.0, none=20.0),
    ],
    ids=["time", "error", "decibels"],
)
def test_the_place_of_a_point_on_an_axis(page: Page, axis: Any) -> None:
    values = [1e-12, 1e-6, 0.5, 20.0, 1e4] + ([0.0 if axis.scale.log else inf] if axis.none else [])
    places = ask(page, "ladder/chart", "position", [[asdict(axis), v] for v in values])
    assert places == pytest.approx([axis.position(value) for value in values])
