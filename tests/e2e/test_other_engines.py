"""A reader's way through the book in the engines that the other tests do not use, and a monkey's
through every page in all of them."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import pytest
from numpy.random import Generator, default_rng
from playwright.sync_api import Browser
from playwright.sync_api import Error as PlaywrightError
from support.engines import ENGINES, HOW_TO
from support.engines.chromium import KEYS, Chromium
from support.engines.engine import Engine, click, drag, press, wait_for
from support.page_scripts import BRING, LIVE, OFFER
from support.reader import visit
from support.static_server import StaticServer, serving

pytestmark = pytest.mark.browser

SCENE, CHAPTER = "lens-distortion", "lens-distortion/"
FIGURE = f"#figure-{SCENE}"
HANDLE, SLIDER = f"{FIGURE} [data-handle=point]", f"{FIGURE} input[name=k1]"
PART, LINE = f"{FIGURE} .workshop-part", f"{FIGURE} .cm-line"
QUESTION, PREDICTION = "#quiz-outward-bow", "#predict-corner-of-a-barrel"
ARROW_LEFT, ENTER, ESCAPE, HOME = "\ue012", "\ue007", "\ue00c", "\ue011"
SPARING = pytest.param("WebKitGTK", False)
"""It runs WebAssembly ten times as slowly: one start of Python, in `make test`."""
WHOLE = [pytest.param("Firefox", True), pytest.param("WebKitGTK", True, marks=pytest.mark.deep)]


@pytest.mark.parametrize(("name", "whole"), [*WHOLE, SPARING])
def test_a_reader_plays_edits_answers_searches_turns_the_page_comes_back_and_goes_offline(
    name: str, whole: bool, built_site: Path, tmp_path: Path
) -> None:
    opened = ENGINES[name](tmp_path)
    if opened is None:
        pytest.skip(f"{name}: {HOW_TO}")
    with serving(built_site) as host, opened as engine:
        engine.open(host.url + CHAPTER)
        wait_for(engine, f"() => {LIVE}")
        moves_a_figure(engine)
        if whole:
            edits_its_python(engine)
        answers(engine)
        searches(engine)
        click(engine, middle(engine, ".pager a[rel=next]"))
        wait_for(engine, "(left) => !location.pathname.endsWith(left)", CHAPTER)
        wait_for(engine, f"() => document.activeElement.id === 'main' && {ONE_LIVES}")
        if whole:
            engine.open(host.url + CHAPTER)
            wait_for(engine, f"() => {ONE_LIVES}")
            wait_for(engine, ANSWERED, PREDICTION, "correct")
        assert not engine.complaints()
        wait_for(engine, "() => Boolean(navigator.serviceWorker.controller)")
        host.gone = True
        engine.open(host.url + ("perspective-projection/" if whole else "glossary/"))
        wait_for(engine, f"() => {ONE_LIVES}" if whole else HAS_TERMS)


def moves_a_figure(engine: Engine) -> None:
    """By its slider, by a handle, by the handle's keys."""
    x, y = middle(engine, SLIDER)
    start = engine.ask(STATE, SCENE)
    click(engine, (x + 30, y))
    wait_for(engine, MOVED, SCENE, start)
    x, y = middle(engine, HANDLE)
    start = engine.ask(STATE, SCENE)
    drag(engine, (x, y), (x + 10, y + 8), (x + 24, y + 18))
    wait_for(engine, MOVED, SCENE, start)
    start = engine.ask(STATE, SCENE)
    engine.ask("(handle) => document.querySelector(handle).focus()", HANDLE)
    press(engine, ARROW_LEFT)
    wait_for(engine, MOVED, SCENE, start)


def edits_its_python(engine: Engine) -> None:
    """And has it run, in an interpreter of its own."""
    click(engine, middle(engine, f"{FIGURE} .open-python"))
    wait_for(engine, "(part) => Boolean(document.querySelector(part))", PART)
    click(engine, middle(engine, PART))
    wait_for(engine, "(line) => document.querySelector(line)?.innerText.startsWith('def')", LINE)
    click(engine, middle(engine, LINE))
    press(engine, HOME, *"print(6*7)", ENTER)
    click(engine, middle(engine, f"{FIGURE} .workshop .run"))
    wait_for(engine, SAYS, f"{FIGURE} .workshop-result", "Running your code.")


def answers(engine: Engine) -> None:
    """A question wrongly, a prediction rightly."""
    click(engine, middle(engine, f'{QUESTION} label:has(input[value="0"])'))
    click(engine, middle(engine, f"{QUESTION} button[type=submit]"))
    wait_for(engine, ANSWERED, QUESTION, "wrong")
    click(engine, middle(engine, f"{PREDICTION} input[name=guess]"))
    press(engine, *"-40")
    click(engine, middle(engine, f"{PREDICTION} button[type=submit]"))
    wait_for(engine, ANSWERED, PREDICTION, "correct")


def searches(engine: Engine) -> None:
    engine.ask("() => document.getElementById('main').focus()")
    press(engine, "/")
    wait_for(engine, "() => document.activeElement.matches('dialog.search input')")
    press(engine, *"vignetting")
    wait_for(engine, "() => document.querySelector('dialog.search a[data-result]')?.href")
    press(engine, ESCAPE)
    wait_for(engine, "() => !document.querySelector('dialog.search').open")


def middle(engine: Engine, selector: str) -> tuple[float, float]:
    """Of an element, which is brought into the window and rests there."""
    x, y = engine.ask(MIDDLE, selector)
    return x, y


ONE_LIVES = "document.querySelector('simulation-figure[data-state=live]') !== null"
HAS_TERMS = "() => document.querySelector('#circle-of-confusion') !== null"
MIDDLE = f"""async (selector) => {{
  const element = document.querySelector(selector);
  await ({BRING})(element);
  const {{x, y, width, height}} = element.getBoundingClientRect();
  return [x + width / 2, y + height / 2];
}}"""
STATE = """(scene) => {
  const figure = document.querySelector(`#figure-${scene} simulation-figure`);
  return [figure.querySelector('[name=k1]').value, Number(figure.dataset.frames)];
}"""
MOVED = f"""(scene, [value, frames]) => {{
  const [now, painted] = ({STATE})(scene);
  return now !== value && painted > frames
    && document.querySelector(`#figure-${{scene}} simulation-figure`).rests;
}}"""
SAYS = "(place, words) => document.querySelector(place)?.textContent.includes(words)"
ANSWERED = "(form, verdict) => document.querySelector(form)?.dataset.answered === verdict"


CANCELLED = "ServiceWorker intercepted"
"""Firefox says so where a page is left while it fetches."""
STEPS, SEED = 30, 20
"""On each page."""
LISTS = ("glossary/", "symbols/", "references/", "index-of-terms/", "licences/", "")
TYPED = [*KEYS, " ", "/", "?", "0", "-", "7", "x", "[", "]"]
BETWEEN_PAGES = (RuntimeError, PlaywrightError)
"""Raised where the browser is just loading a page."""


@contextmanager
def engine_of(name: str, chromium: Browser, host: StaticServer, profile: Path) -> Iterator[Engine]:
    if name == "Chromium":
        with visit(chromium, host) as reader:
            yield Chromium(reader)
        return
    window = ENGINES[name](profile)
    if window is None:
        pytest.skip(f"{name}: {HOW_TO}")
    with window as engine:
        yield engine


@pytest.mark.deep
@pytest.mark.parametrize("name", ["Chromium", *ENGINES])
def test_a_monkey_on_every_page_breaks_nothing(
    name: str, chromium: Browser, server: StaticServer, book: Any, tmp_path: Path
) -> None:
    """It clicks, drags, types, scrolls, and goes back and forth."""
    random = default_rng(SEED)
    with engine_of(name, chromium, server, tmp_path) as engine:
        engine.open(server.url)
        for address in [*(chapter["url"] for chapter in book["chapters"]), *LISTS]:
            url = server.url + address
            if twice(engine.ask, engine, "(url) => url.startsWith(location.origin)", url):
                engine.ask(f"(url) => {{ ({OFFER})(url); main.lastElementChild.click(); }}", url)
            else:
                engine.open(url)
            there = "(url) => location.href === url && document.readyState === 'complete'"
            twice(wait_for, engine, there, url)
            done = [step(engine, random) for _ in range(STEPS)]
            twice(wait_for, engine, AT_REST)
            said = [said for said in engine.complaints() if CANCELLED not in said]
            wrong = [*twice(engine.ask, engine, WRONG), *said]
            assert not wrong, f"{address}: {wrong} after {done}"


def twice(call: Callable[..., Any], engine: Engine, *given: Any) -> Any:
    """What a call answers; once more where the browser has just loaded a page."""
    arguments = given if call == engine.ask else (engine, *given)
    with suppress(*BETWEEN_PAGES):
        return call(*arguments)
    time.sleep(1)
    return call(*arguments)


def step(engine: Engine, random: Generator) -> str:
    """Do something at random; its name."""
    what = str(random.choice([*SHARES], p=[*SHARES.values()]))
    x, y, chosen = random.random(3)
    ends = random.integers((0, 0), (1200, 800), (3, 2)).tolist()
    keys = random.choice(TYPED, 5).tolist()
    try:
        place = engine.ask(PLACE, x, y, 2 * chosen - 1) if what in ("click", "drag") else None
        match what:
            case "click" if place:
                click(engine, place)
            case "drag" if place:
                drag(engine, place, *((x, y) for x, y in ends))
            case "type":
                press(engine, *keys)
            case "travel":
                by = int(random.choice([-1, 1]))
                engine.ask("(by) => { if (history.length > 8) history.go(by); }", by)
            case "scroll":
                engine.ask("(part) => scrollTo(0, part * document.body.scrollHeight)", x)
    except BETWEEN_PAGES:
        time.sleep(1)
        return f"{what} between pages"
    return f"{what} {place or [KEYS.get(key, key) for key in keys]}"


SHARES = {"click": 0.4, "drag": 0.2, "type": 0.2, "travel": 0.05, "scroll": 0.15}
PLACE = """(x, y, chosen) => {
  let place = [8 + x * (innerWidth - 24), 8 + y * (innerHeight - 24)];
  const meant = [...document.querySelectorAll(
    'main :is(button, summary, input, a[href], label, [data-handle]), header button')]
    .filter((one) => one.checkVisibility());
  if (chosen > 0 && meant.length) {
    const one = meant[Math.floor(chosen * meant.length)];
    one.scrollIntoView({block: 'center', behavior: 'instant'});
    const {left, top, width, height} = one.getBoundingClientRect();
    place = [left + width / 2, top + height / 2];
  }
  const under = document.elementFromPoint(...place);
  const link = under?.closest('a[href]')?.href ?? location.href;
  const leads = !link.startsWith(location.origin);
  return !under || leads || under.closest('select, .intake, .photograph, label:has([type=file])')
    ? null : place;
}"""
"""A place in the window, every other time one that is meant to be pressed; not where the browser
would open something of its own, nor out of the book."""
AT_REST = """() => [...document.querySelectorAll('simulation-figure')]
  .every((figure) => figure.rests)"""
WRONG = """() => [...document.querySelectorAll('simulation-figure[data-state=failed]')]
  .map((figure) => [figure.dataset.simulation, figure.querySelector('.figure-message').textContent])
  .concat(document.querySelector('main#main h1') ? [] : ['no page'])"""
