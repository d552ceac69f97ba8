"""Rules for every page, checked in one walk through the book on desktop, phone and paper."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser
from support.page_scripts import SILENT_WORKER
from support.reader import Reader, visit
from support.static_server import StaticServer

pytestmark = pytest.mark.browser

LISTS = ("references/", "lecture-plan/", "glossary/", "symbols/", "index-of-terms/")
LARGER_LETTERS = """html { font-size: 34px !important; }"""
"""Text twice as large as a phone's default, set without zooming."""


@dataclass(frozen=True, slots=True)
class Rule:
    """A fault that no page may have: its name, and a script that lists its places."""

    fault: str
    script: str
    argument: Any = None


WIDER = """(width) => {
  const {scrollWidth} = document.documentElement;
  return scrollWidth > width ? [scrollWidth] : [];
}"""
SCROLLED = """() => [...document.querySelectorAll("main *:not(pre, textarea, .other-panels)")]
  .filter((one) => ["auto", "scroll"].includes(getComputedStyle(one).overflowX))
  .filter((one) => one.scrollWidth > one.clientWidth + 1)
  .map((one) => `${one.className}: ${one.textContent.trim().slice(0, 40)}`)"""
SMALL_LEADS = """() => [...document.querySelectorAll("figure:not(.small) .panels.led > .panel")]
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
"""Scripts make scrollable parts focusable once the window has its size."""
COVERED = """() => {
  const side = document.querySelector('#contents').getBoundingClientRect();
  const shown = [...document.querySelectorAll('main figure, main .equation, main .table-wrapper')];
  return shown
    .filter((one) => one.checkVisibility() && one.getBoundingClientRect().left < side.right - 1)
    .map((one) => one.id || one.className);
}"""
CROWDED = """(more) => [...document.querySelectorAll("simulation-figure")].flatMap((figure) => {
  const seen = (what) => [...figure.querySelectorAll(what)].filter((one) => one.checkVisibility());
  const [cells, numbers] = [seen(".control-cell").length, seen("output").length];
  const {id} = figure.closest("figure");
  const [most, mostNumbers] = more[id] ?? [2, 1];
  return cells > most || numbers > mostNumbers ? [`${id}: ${cells}, ${numbers}`] : [];
})"""
MORE_IN_SIGHT = {
    "figure-camera": (4, 1), "figure-camera-pose": (1, 3),
    "figure-single-view": (2, 2), "figure-chequerboard": (2, 2),
}  # fmt: skip
"""Controls and numbers of figures whose subject is how they act together."""
SMALL_LABELS = """(least) => [...document.querySelectorAll(
    ":is(simulation-figure, .drawing) svg.overlay"
  )]
  .flatMap((svg) => [...svg.querySelectorAll("text")].map((label) => {
    const scale = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
    return [label.textContent, parseFloat(getComputedStyle(label).fontSize) * scale];
  }))
  .filter(([, size]) => size < least)"""
CONTROLS_ON_PAPER = """() => [...document.querySelectorAll("button, select, [type=range]")]
  .filter((one) => one.checkVisibility()).map((one) => one.outerHTML.slice(0, 80))"""
FOLDED_ON_PAPER = """() => [...document.querySelectorAll(":is(.extremes, .ladder-table) tbody tr")]
  .filter((one) => !one.checkVisibility()).map((one) => one.textContent.slice(0, 40))"""
UNNAMED = """() => [...document.querySelectorAll(
    "canvas.live, :is(a, label, .asked, button, h1, h2, h3, figcaption, [id$=-caption]) math")]
  .filter((thing) => !(thing.ariaLabel ?? thing.getAttribute("aria-labelledby")))
  .map((thing) => thing.parentElement.textContent.slice(0, 60))"""
"""Pictures, and formulae in accessible names; axe checks the other names."""
OUTSIDE = """() => {
  const outside = [];
  for (const figure of document.querySelectorAll("simulation-figure")) {
    const [first, second] = figure.querySelectorAll(".panel");
    const all = [...figure.querySelectorAll(".control")];
    const controls = all.filter((one) => one.checkVisibility());
    const small = figure.matches(".small *");
    if (!controls.length && !small) outside.push(`${figure.dataset.simulation}: no control`);
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
    .filter((one) => one.checkVisibility() && one.getBoundingClientRect().height < 43.9)
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


TOUCH_ON_PURPOSE = ["figure-perspective-projection top: x × (point)"]
"""Labels that touch on purpose: in this figure the point is about to cross the plane."""
TOUCHING = """(known) => {
  const found = new Set();
  const box = (text) => {
    const {left, right, top, bottom} = text.getBoundingClientRect();
    const air = 0.2 * (bottom - top);
    return {left: left - 1, right: right + 1, top: top + air, bottom: bottom - air};
  };
  const overlap = (a, b) =>
    a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
  for (const fold of document.querySelectorAll('details:has(simulation-figure)')) fold.open = true;
  for (const view of document.querySelectorAll('simulation-figure .panel-view')) {
    const panel = view.getBoundingClientRect();
    const of = `${view.closest('figure').id} ${view.closest('.panel').dataset.panel}: `;
    const texts = [...view.querySelectorAll('svg.overlay text')]
      .filter((text) => text.textContent.trim() && getComputedStyle(text).opacity !== '0')
      .map((text) => ({words: text.textContent, ...box(text)}));
    const marks = [...view.querySelectorAll('.handle:not(.drag, .aim, [hidden])')]
      .map((mark) => {
        const share = (name) => Number.parseFloat(mark.style.getPropertyValue(name)) / 100;
        const x = panel.left + share('--x') * panel.width;
        const y = panel.top + share('--y') * panel.height;
        return {words: `(${mark.dataset.handle})`,
                left: x - 10, right: x + 10, top: y - 10, bottom: y + 10};
      });
    texts.forEach((text, index) => {
      for (const other of [...texts.slice(index + 1), ...marks]) {
        if (overlap(text, other)) found.add(`${of}${text.words} × ${other.words}`);
      }
      if (text.left < panel.left - 2 || text.right > panel.right + 2 ||
          text.top < panel.top - 1 || text.bottom > panel.bottom + 1) {
        found.add(`${of}${text.words} is cut`);
      }
    });
  }
  return [...found].filter((one) => !known.includes(one));
}"""
"""Lists labels that touch; a fifth of the line height above and below the letters is empty."""


HIGH = """(most) => {
  for (const fold of document.querySelectorAll('details:has(simulation-figure)')) fold.open = true;
  return [...document.querySelectorAll('figure.simulation')]
    .map(({id, offsetHeight}) => [id, offsetHeight])
    .filter(([, height]) => height > most);
}"""
"""Figures with controls, tools and caption that are higher than a window under its header."""
OUTSIDE_HEADER = """() => [...document.querySelectorAll(".site-header *")]
  .filter((one) => one.checkVisibility() && one.getBoundingClientRect().right > innerWidth + 1)
  .map((one) => one.className)"""
EMBED_CODES = """() => [...document.querySelectorAll("[data-copy-embed]")]
  .map(({dataset}) => [new URL(dataset.copyEmbed, location.href).href, +dataset.height])"""
OVERFLOW = "() => document.documentElement.scrollHeight - innerHeight"


FIRST_FIGURE_IS_FAR = """(most) => {
  const panels = document.querySelector('simulation-figure .panels');
  const far = panels ? panels.getBoundingClientRect().top + scrollY : 0;
  return far > most ? [far] : [];
}"""
UNORDERED = """() => [...document.querySelectorAll('.figure-caption')].filter((caption) => {
  const panels = caption.closest('figure').querySelector('.panels');
  const above = caption.getBoundingClientRect().top < panels.getBoundingClientRect().top;
  return above !== Boolean(caption.compareDocumentPosition(panels) & 4);
}).map((caption) => caption.id)"""
"""Captions whose order on the screen differs from the source, which screen readers follow."""


def fits(width: int) -> list[Rule]:
    return [
        Rule("the page is wider", WIDER, width),
        *([Rule("scrolls sideways", SCROLLED)] if width >= 360 else []),
    ]


KEYBOARD = Rule("scrolls, but not by keyboard", OUT_OF_REACH)
LABELS = Rule("a label is too small", SMALL_LABELS, 12.5)
LONG_VALUES = Rule("a long value is cut or moves the layout", MOVED)
TOUCHES = Rule("a label touches another, a handle or an edge", TOUCHING, TOUCH_ON_PURPOSE)
TOO_FAR = "the first figure is more than two screens away"
ON_DESKTOP = {
    1440: [
        *(*fits(1440), KEYBOARD, LABELS, TOUCHES),
        Rule(TOO_FAR, FIRST_FIGURE_IS_FAR, 2 * 900),
        Rule("higher than the window", HIGH, 850),
        Rule("the place of a caption differs from the source", UNORDERED),
        Rule("a leading picture is small", SMALL_LEADS),
        Rule("has no name for a screen reader", UNNAMED),
    ],
    1280: [
        Rule("lies under the contents", COVERED),
        Rule("shows more than two controls or one number at first", CROWDED, MORE_IN_SIGHT),
    ],
}
ON_PHONE = {
    390: [
        *(TOUCHES, Rule(TOO_FAR, FIRST_FIGURE_IS_FAR, 2 * 844)),
        Rule("higher than the window", HIGH, 790),
        Rule("a label is too small", SMALL_LABELS, 10.5),
        Rule("not on one screen: two panels, or one and the controls", OUTSIDE),
        Rule("too small for a finger", TOO_SMALL),
    ],
    320: [*fits(320), KEYBOARD, LONG_VALUES],
}
PRINTED_PAGES = ("", "lens-distortion/", "speed-and-accuracy/", "hard-cases/")
"""Pages with figures, questions, tables of ladders and hard cases."""
ON_PAPER = [Rule("is a control", CONTROLS_ON_PAPER), Rule("is folded", FOLDED_ON_PAPER)]


def pages(book: Any) -> list[str]:
    return ["", *LISTS, *(chapter["url"] for chapter in book["chapters"])]


def faults(reader: Reader, rules: Iterable[Rule], where: str) -> Iterator[str]:
    for rule in rules:
        for place in reader.page.evaluate(rule.script, rule.argument):
            yield f"{where}: {rule.fault}: {place}"


@pytest.fixture
def desktop(baseline_chromium: Browser, site_server: StaticServer) -> Iterator[Reader]:
    """A reader whose Python never starts: controls are shown, but change nothing."""
    with visit(baseline_chromium, site_server, SILENT_WORKER) as reader:
        yield reader
    reader.assert_no_errors()


def faults_of_all_pages(
    reader: Reader, book: Any, rules_by_width: Mapping[int, Iterable[Rule]]
) -> list[str]:
    """Faults of all pages at these widths."""
    wrong: list[str] = []
    for address in reader.open_each(pages(book)):
        for width, rules in rules_by_width.items():
            reader.page.set_viewport_size({"width": width, "height": 900 if width > 600 else 844})
            wrong += faults(reader, rules, f"{address or 'landing page'} at {width}")
    return wrong


def test_every_page_follows_the_rules_on_a_desktop(desktop: Reader, book: Any) -> None:
    assert faults_of_all_pages(desktop, book, ON_DESKTOP) == []


def test_every_page_follows_the_rules_on_a_phone(quiet_phone: Reader, book: Any) -> None:
    assert faults_of_all_pages(quiet_phone, book, ON_PHONE) == []


@pytest.mark.deep
def test_every_page_fits_other_widths(desktop: Reader, book: Any) -> None:
    others = {width: fits(width) for width in (1000, 360)}
    assert (
        faults_of_all_pages(
            desktop, book, {1920: [LABELS], **others, 390: [*fits(390), LONG_VALUES]}
        )
        == []
    )


RIGHT_EDGES = """table => [...table.querySelectorAll("tr")]
  .map(row => [...row.querySelectorAll(".number")]
    .filter(cell => cell.getClientRects().length)
    .map(cell => Math.round(cell.getBoundingClientRect().right)))
  .filter(row => row.length)"""


def test_paper_shows_everything_without_controls_or_given_answers(desktop: Reader) -> None:
    page = desktop.page
    wrong: list[str] = []
    page.emulate_media(media="print")
    for address in desktop.open_each(PRINTED_PAGES):
        wrong += faults(desktop, ON_PAPER, address)
    assert wrong == []
    page.emulate_media(media="screen")
    desktop.turn_to("lens-distortion/", live=False)
    question = page.locator("form.quiz[data-kind=single]").first
    question.locator("input[name=answer]").first.check()
    question.locator("button[type=submit]").click()
    assert question.locator(".feedback").is_visible()
    page.emulate_media(media="print")
    assert not question.locator(".feedback").is_visible()
    assert question.locator(".option:visible").count() > 1
    desktop.turn_to("speed-and-accuracy/", live=False)
    page.set_viewport_size({"width": 640, "height": 900})  # A4 without margins
    tables = page.locator(".ladder table")
    assert tables.count()
    for table in tables.all():
        errors, times, *rows = table.evaluate(RIGHT_EDGES)
        assert rows
        assert rows == [errors + times] * len(rows), "numbers stand below their headings"


@pytest.mark.deep
def test_pages_of_source_code_fit_a_narrow_screen(plain_reader: Reader, built_site: Path) -> None:
    plain_reader.page.set_viewport_size({"width": 320, "height": 740})
    wrong: list[str] = []
    for page in sorted((built_site / "source").rglob("index.html")):
        address = page.parent.relative_to(built_site).as_posix() + "/"
        plain_reader.open(address, live=False)
        wrong += faults(plain_reader, fits(320), address)
    assert wrong == []


@pytest.mark.deep
def test_no_chapter_scrolls_sideways_with_text_twice_as_large(
    plain_reader: Reader, book: Any
) -> None:
    plain_reader.page.set_viewport_size({"width": 390, "height": 800})
    wrong: list[str] = []
    for address in plain_reader.open_each(pages(book)):
        plain_reader.page.add_style_tag(content=LARGER_LETTERS)
        wrong += faults(plain_reader, [Rule("the page is wider", WIDER, 390)], address)
        plain_reader.page.set_viewport_size({"width": 320, "height": 800})
        wrong += faults(plain_reader, [Rule("lies outside the header", OUTSIDE_HEADER)], address)
        plain_reader.page.set_viewport_size({"width": 390, "height": 800})
    assert wrong == []


@pytest.mark.deep
def test_copied_iframe_shows_the_whole_figure(plain_reader: Reader, book: Any) -> None:
    page, frames = plain_reader.page, []
    for _ in plain_reader.open_each(chapter["url"] for chapter in book["chapters"]):
        frames += page.evaluate(EMBED_CODES)
    wrong = []
    for address, height in frames:
        page.set_viewport_size({"width": 1000, "height": height})
        page.goto(address)
        if page.evaluate(OVERFLOW) > 0:
            wrong.append(address)
    assert wrong == []
