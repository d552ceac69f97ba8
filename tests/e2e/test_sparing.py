"""Readers who pay for each byte, or whose device has little memory: Python waits until they ask."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, expect
from support.page_scripts import SILENT_WORKER
from support.reader import Reader, chapter_of, visit
from support.static_server import StaticServer

pytestmark = pytest.mark.browser

SCENE, CONTROL = "lens-distortion", "k1"
PYTHON = ("/runtime.json", "/worker.js", ".wasm", ".zip")
SAVES_DATA = "Object.defineProperty(navigator, 'connection', {value: {saveData: true}});"
SLOW_LINK = "Object.defineProperty(navigator, 'connection', {value: {effectiveType: '2g'}});"
LOST = "addEventListener('pagehide', (event) => event.stopImmediatePropagation());"
"""A tab that crashes hears nothing of its end."""
LITTLE_MEMORY = "Object.defineProperty(navigator, 'deviceMemory', {value: 0.5});"


@contextmanager
def sparing(
    chromium: Browser, server: StaticServer, script: str
) -> Iterator[tuple[Reader, list[str]]]:
    """A reader in such a browser, and the files of Python that it has fetched."""
    with visit(chromium, server, script) as someone:
        python = someone.note_requests(*PYTHON)
        yield someone, python
    someone.assert_no_complaints()


def begin_button(figure: Locator) -> Locator:
    return figure.get_by_role("button", name="Start the figures")


@pytest.mark.parametrize(
    "script",
    [LITTLE_MEMORY, *(pytest.param(x, marks=pytest.mark.deep) for x in (SAVES_DATA, SLOW_LINK))],
)
def test_nothing_of_python_is_fetched_unasked(
    brisk_chromium: Browser, server: StaticServer, book: Any, script: str
) -> None:
    with sparing(brisk_chromium, server, script) as (reader, python):
        reader.open(chapter_of(book, SCENE), live=False)
        figure = reader.figure(SCENE)
        reader.bring(begin_button(figure))
        reader.page.wait_for_load_state("networkidle")
        assert figure.get_attribute("data-state") == "waiting"
        assert not python


def test_a_waiting_figure_keeps_what_is_set_and_draws_it_once_asked(
    brisk_chromium: Browser, server: StaticServer, book: Any
) -> None:
    with sparing(brisk_chromium, server, SAVES_DATA) as (reader, python):
        reader.open(chapter_of(book, SCENE), live=False)
        figure = reader.figure(SCENE)
        slider = figure.locator(f"input[name={CONTROL}]")
        slider.focus()
        reader.page.keyboard.press("ArrowRight")
        chosen = slider.input_value()
        figure.locator(".early-mark").wait_for()  # a frame drawn beforehand
        assert not python

        begin_button(figure).focus()
        reader.page.keyboard.press("Enter")
        reader.wait_live()
        assert python
        assert not begin_button(figure).is_visible()
        assert slider.input_value() == chosen
        assert figure.locator(".early-mark").count() == 0

        reader.turn_to(book["chapters"][0]["url"])  # the rest of the visit is as any other
        reader.page.reload()
        begun = re.compile("starting|live")
        expect(reader.page.locator("simulation-figure").first).to_have_attribute(
            "data-state", begun
        )


def test_where_the_tab_was_lost_twice_while_python_started_the_third_start_waits_to_be_asked(
    brisk_chromium: Browser, server: StaticServer, book: Any
) -> None:
    with sparing(brisk_chromium, server, SILENT_WORKER + LOST) as (reader, _):
        states = []
        for _ in range(4):
            reader.open(chapter_of(book, SCENE), live=False)
            states.append(reader.figure(SCENE).get_attribute("data-state"))
        assert states == ["starting", "starting", "waiting", "waiting"]
        begin_button(reader.figure(SCENE)).click()
        assert reader.figure(SCENE).get_attribute("data-state") == "starting"


def test_who_leaves_a_page_before_python_has_started_is_not_taken_for_lost(
    brisk_chromium: Browser, server: StaticServer, book: Any
) -> None:
    with sparing(brisk_chromium, server, SILENT_WORKER) as (reader, _):
        for _ in range(3):
            reader.open(chapter_of(book, SCENE), live=False)
        assert reader.figure(SCENE).get_attribute("data-state") == "starting"
