"""What holds on every page: looked at in one walk through the book, at each width in turn."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser
from support.page_scripts import SILENT_WORKER
from support.reader import PHONE, Reader, visit
from support.static_server import StaticServer

pytestmark = pytest.mark.browser

LISTS = ("references/", "lecture-plan/", "glossary/", "symbols/", "index-of-terms/")
TRANSLATED = ("de/", "de/why-image-formation/")
LARGER_LETTERS = """html { font-size: 34px !important; }"""
"""Twice those of a phone, as a reader may set them without enlarging the rest."""


@dataclass(frozen=True, slots=True)
class Look:
    """What must not be found on a page: a script that lists it, and what the script is told."""

    wrong: str
    script: str
    given: Any = None


WIDER = """(width) => {
  const {scrollWidth} = document.documentElement;
  return scrollWidth > width ? [scrollWidth] : [];
}"""
SCROLLED = """() => [...document.querySelectorAll("main *:not(pre, .other-panels)")]
  .filter((one) => ["auto", "scroll"].includes(getComputedStyle(one).overflowX))
  .filter((one) => one.scrollWidth > one.clientWidth + 1)
  .map((one) => `${one.className}: ${one.textContent.trim().slice(0, 40)}`)"""
SMALL_LEADS = """() => [...document.querySelectorAll(".panels.led > .panel")]
  .filter((one) => one.querySelector("img, canvas") && one.clientWidth < 480)
  .map((one) => one.dataset.panel)"""
OUT_OF_REACH = """async () => {
  const found = () => [...document.querySelectorAll("main *")]
    .filter((one) => ["auto", "scroll"].includes(getComputedStyle(one).overflowX))
    .filter((one) => one.checkVisibility())
    .filter((one) => one.scrollWidth > one.clientWidth + 1 && one.tabIndex < 0)
    .map((one) => `${one.className}: ${one.textContent.trim().slice(0, 40)}`);
  for (let left = 300; left && found().length; left -= 1) await new Promise(requestAnimationFrame);
  return found();
}"""
"""Scripts make it reachable, once the window has its size."""
COVERED = """() => {
  const side = document.querySelector('#contents').getBoundingClientRect();
  const shown = [...document.querySelectorAll('main figure, main .equation, main .table-wrapper')];
  return shown
    .filter((one) => one.checkVisibility() && one.getBoundingClientRect().left < side.right - 1)
    .map((one) => one.id || one.className);
}"""
CROWDED = """() => [...document.querySelectorAll("simulation-figure")].flatMap((figure) => {
  const seen = (what) => [...figure.querySelectorAll(what)].filter((one) => one.checkVisibility());
  const [cells, numbers] = [seen(".control-cell").length, seen("output").length];
  return cells > 3 || numbers > 3 ? [`${figure.dataset.simulation}: ${cells}, ${numbers}`] : [];
})"""
SMALL_LABELS = """(least) => [...document.querySelectorAll(
    ":is(simulation-figure, .drawing) svg.overlay"
  )]
  .flatMap((svg) => [...svg.querySelectorAll("text")].map((label) => {
    const scale = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
    return [label.textContent, parseFloat(getComputedStyle(label).fontSize) * scale];
  }))
  .filter(([, size]) => size < least)"""
PRESSED_ON_PAPER = """() => [...document.querySelectorAll("button, select, [type=range]")]
  .filter((one) => one.checkVisibility()).map((one) => one.outerHTML.slice(0, 80))"""
SHUT_ON_PAPER = """() => [...document.querySelectorAll(":is(.extremes, .ladder-table) tbody tr")]
  .filter((one) => !one.checkVisibility()).map((one) => one.textContent.slice(0, 40))"""
UNSAID = """() => [...document.querySelectorAll(
    "canvas.live, :is(a, label, .asked, button, h1, h2, h3, figcaption, [id$=-caption]) math")]
  .filter((thing) => !(thing.ariaLabel ?? thing.getAttribute("aria-labelledby")))
  .map((thing) => thing.parentElement.textContent.slice(0, 60))"""
"""Pictures, and formulae in names; axe asks it of what else has a name."""
OUTSIDE = """() => {
  const outside = [];
  for (const figure of document.querySelectorAll("simulation-figure")) {
    const [first, second] = figure.querySelectorAll(".panel");
    const all = [...figure.querySelectorAll(".control")];
    const controls = all.filter((one) => one.checkVisibility());
    if (!controls.length) outside.push(`${figure.dataset.simulation}: no control`);
    for (const shown of [[first, second ?? first], [second ?? first, ...controls]]) {
      shown[0].scrollIntoView({ behavior: "instant" });
      for (const one of shown) {
        const { left, right, top, bottom } = one.getBoundingClientRect();
        if (left < 0 || top < 0 || right > innerWidth || bottom > innerHeight) {
          outside.push(`${figure.dataset.simulation}: ${one.className}`);
        }
      }
    }
  }
  return outside;
}"""
TOO_SMALL = """() => {
  for (const fold of document.querySelectorAll(".more-controls")) fold.open = true;
  const controls = ":is(input[type=range], select, button, summary, .toggle label)";
  const touched = `.controls ${controls}, .panel-dots > button`;
  return [...document.querySelectorAll(touched)]
    .filter((one) => one.getBoundingClientRect().height < 43.9)
    .map((one) => one.name ?? one.textContent);
}"""
MOVED = """() => {
  const moved = [];
  for (const fold of document.querySelectorAll(".more-controls")) fold.open = true;
  for (const form of document.querySelectorAll(".control-grid")) {
    const before = form.getBoundingClientRect().height;
    for (const slider of form.querySelectorAll("input[type=range]")) {
      for (const value of [slider.min, slider.max]) {
        slider.value = value;
        slider.dispatchEvent(new Event("input", { bubbles: true }));
        const text = slider.parentElement.querySelector(".control-value");
        const room = slider.getBoundingClientRect().right + 1;
        const cut = text.getBoundingClientRect().right > room;
        if (cut || form.getBoundingClientRect().height !== before) moved.push(slider.id);
      }
    }
  }
  return moved;
}"""


def fits(width: int) -> list[Look]:
    return [
        Look("the page is wider", WIDER, width),
        *([Look("has to be pushed sideways", SCROLLED)] if width >= 360 else []),
    ]


REACH = Look("scrolls, but not by keyboard", OUT_OF_REACH)
LABELS = Look("a label is too small", SMALL_LABELS, 12.5)
LONGEST = Look("a value at its longest is cut, or moves what is around it", MOVED)
AT_A_DESK = {
    1440: [
        *(*fits(1440), REACH, LABELS),
        Look("a leading picture is small", SMALL_LEADS),
        Look("has no name for a screen reader", UNSAID),
    ],
    1280: [
        Look("lies under the contents", COVERED),
        Look("shows more than three controls or readouts at first", CROWDED),
    ],
}
BY_PHONE = {
    390: [
        Look("a label is too small", SMALL_LABELS, 10.5),
        Look("not on one screen: two panels, or one and the controls", OUTSIDE),
        Look("too small for a finger", TOO_SMALL),
    ],
    320: [*fits(320), REACH, LONGEST],
}
PRINTED = ("", "lens-distortion/", "speed-and-accuracy/", "where-the-models-break/")
"""With figures, questions, tables of ladders, and hard cases."""
ON_PAPER = [Look("can be pressed", PRESSED_ON_PAPER), Look("is shut", SHUT_ON_PAPER)]


def pages(book: Any) -> list[str]:
    return ["", *TRANSLATED, *LISTS, *(chapter["url"] for chapter in book["chapters"])]


def found(reader: Reader, looks: Iterable[Look], where: str) -> Iterator[str]:
    for look in looks:
        for what in reader.page.evaluate(look.script, look.given):
            yield f"{where}: {look.wrong}: {what}"


@pytest.fixture
def desk(brisk_chromium: Browser, site_server: StaticServer) -> Iterator[Reader]:
    """A reader to whom Python never answers: controls are there, and move nothing."""
    with visit(brisk_chromium, site_server, SILENT_WORKER) as someone:
        yield someone
    someone.assert_no_complaints()


@pytest.fixture
def phone(brisk_chromium: Browser, site_server: StaticServer) -> Iterator[Reader]:
    """Likewise with a telephone."""
    options = {"viewport": PHONE, "has_touch": True, "is_mobile": True}
    with visit(brisk_chromium, site_server, SILENT_WORKER, **options) as someone:
        yield someone
    someone.assert_no_complaints()


def walk(reader: Reader, book: Any, asked: Mapping[int, Iterable[Look]]) -> list[str]:
    """What is wrong on any page, at these widths."""
    wrong: list[str] = []
    for address in reader.leaf_through(pages(book)):
        for width, looks in asked.items():
            reader.page.set_viewport_size({"width": width, "height": 900 if width > 600 else 800})
            wrong += found(reader, looks, f"{address or 'landing page'} at {width}")
    return wrong


def test_every_page_is_in_order_at_a_desk(desk: Reader, book: Any) -> None:
    assert walk(desk, book, AT_A_DESK) == []


def test_every_page_is_in_order_on_a_phone(phone: Reader, book: Any) -> None:
    assert walk(phone, book, BY_PHONE) == []


@pytest.mark.deep
def test_every_page_fits_other_widths(desk: Reader, book: Any) -> None:
    others = {width: fits(width) for width in (1000, 360)}
    assert walk(desk, book, {1920: [LABELS], **others, 390: [*fits(390), LONGEST]}) == []


def test_on_paper_there_is_nothing_to_press_and_nothing_shut(desk: Reader) -> None:
    desk.page.emulate_media(media="print")
    wrong: list[str] = []
    for address in desk.leaf_through(PRINTED):
        wrong += found(desk, ON_PAPER, address)
    assert wrong == []


@pytest.mark.deep
def test_pages_of_source_fit_a_narrow_screen(plain_reader: Reader, built_site: Path) -> None:
    plain_reader.page.set_viewport_size({"width": 320, "height": 740})
    wrong: list[str] = []
    for page in sorted((built_site / "source").rglob("index.html")):
        address = page.parent.relative_to(built_site).as_posix() + "/"
        plain_reader.open(address, live=False)
        wrong += found(plain_reader, fits(320), address)
    assert wrong == []


@pytest.mark.deep
def test_no_chapter_scrolls_sideways_with_letters_twice_as_large(
    plain_reader: Reader, book: Any
) -> None:
    plain_reader.page.set_viewport_size({"width": 390, "height": 800})
    wrong: list[str] = []
    for address in plain_reader.leaf_through(pages(book)):
        plain_reader.page.add_style_tag(content=LARGER_LETTERS)
        wrong += found(plain_reader, [Look("the page is wider", WIDER, 390)], address)
    assert wrong == []
