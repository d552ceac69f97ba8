"""A monkey on every page: it clicks, drags, types and goes back and forth, and breaks nothing."""

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
from support.page_scripts import OFFER
from support.reader import visit
from support.static_server import StaticServer

pytestmark = [pytest.mark.browser, pytest.mark.deep]

CANCELLED = "ServiceWorker intercepted"
"""Firefox says so where a page is left while it fetches."""
STEPS = 30
"""On each page."""
SEED = 20
LISTS = ("glossary/", "symbols/", "references/", "index-of-terms/", "licences/", "")
TYPED = [*KEYS, " ", "/", "?", "0", "-", "7", "x", "[", "]"]


@contextmanager
def opened(name: str, chromium: Browser, host: StaticServer, profile: Path) -> Iterator[Engine]:
    if name == "Chromium":
        with visit(chromium, host) as reader:
            yield Chromium(reader)
        return
    window = ENGINES[name](profile)
    if window is None:
        pytest.skip(f"{name}: {HOW_TO}")
    with window as engine:
        yield engine


@pytest.mark.parametrize("name", ["Chromium", *ENGINES])
def test_a_monkey_on_every_page_breaks_nothing(
    name: str, chromium: Browser, server: StaticServer, book: Any, tmp_path: Path
) -> None:
    random = default_rng(SEED)
    with opened(name, chromium, server, tmp_path) as engine:
        engine.open(server.url)
        for address in [*(chapter["url"] for chapter in book["chapters"]), *LISTS]:
            turn(engine, server.url + address)
            done = [step(engine, random) for _ in range(STEPS)]
            waits(engine, AT_REST)
            said = [said for said in engine.complaints() if CANCELLED not in said]
            wrong = [*ask(engine, WRONG), *said]
            assert not wrong, f"{address}: {wrong} after {done}"


def ask(engine: Engine, expression: str, *arguments: Any) -> Any:
    """As the engine's, but once more where the browser has just loaded a page."""
    with suppress(RuntimeError, PlaywrightError):
        return engine.ask(expression, *arguments)
    time.sleep(1)
    return engine.ask(expression, *arguments)


def waits(engine: Engine, expression: str, *arguments: Any) -> None:
    with suppress(RuntimeError, PlaywrightError):
        return wait_for(engine, expression, *arguments)
    return wait_for(engine, expression, *arguments)


def turn(engine: Engine, url: str) -> None:
    """Turn to a page of the book; load it where the monkey has left the book."""
    if ask(engine, "(url) => url.startsWith(location.origin)", url):
        engine.ask(f"(url) => {{ ({OFFER})(url); main.lastElementChild.click(); }}", url)
    else:
        engine.open(url)
    waits(engine, "(url) => location.href === url && document.readyState === 'complete'", url)


def step(engine: Engine, random: Generator) -> str:
    """Do something; what it was."""
    doing = STEPS_BY_NAME[random.choice(list(STEPS_BY_NAME), p=SHARES)]
    try:
        return doing(engine, random)
    except (RuntimeError, PlaywrightError):
        time.sleep(1)
        return f"{doing.__name__}, but the browser was just loading a page"


def at_random(engine: Engine, random: Generator) -> tuple[float, float] | None:
    """A place in the window that may be pressed: every other time one that is meant to be."""
    x, y, chosen = random.random(3)
    place = engine.ask(PLACE, x, y, 2 * chosen - 1)
    return (place[0], place[1]) if place else None


def clicks(engine: Engine, random: Generator) -> str:
    if place := at_random(engine, random):
        click(engine, place)
    return f"click {place}"


def drags(engine: Engine, random: Generator) -> str:
    if place := at_random(engine, random):
        ends = random.integers((0, 0), (1200, 800), (3, 2)).tolist()
        drag(engine, place, *((x, y) for x, y in ends))
    return f"drag {place}"


def types(engine: Engine, random: Generator) -> str:
    keys = random.choice(TYPED, 5).tolist()
    press(engine, *keys)
    return f"press {[KEYS.get(key, key) for key in keys]}"


def travels(engine: Engine, random: Generator) -> str:
    by = int(random.choice([-1, 1]))
    engine.ask("(by) => { if (history.length > 8) history.go(by); }", by)
    return f"go {by}"


def scrolls(engine: Engine, random: Generator) -> str:
    part = random.random()
    engine.ask("(part) => scrollTo(0, part * document.body.scrollHeight)", part)
    return f"scroll to {part:.2f}"


STEPS_BY_NAME: dict[str, Callable[[Engine, Generator], str]] = {
    "clicks": clicks,
    "drags": drags,
    "types": types,
    "travels": travels,
    "scrolls": scrolls,
}
SHARES = (0.4, 0.2, 0.2, 0.05, 0.15)

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
"""Not where the browser would open something of its own, nor out of the book."""
AT_REST = """() => [...document.querySelectorAll('simulation-figure')]
  .every((figure) => figure.rests)"""
WRONG = """() => [...document.querySelectorAll('simulation-figure[data-state=failed]')]
  .map((figure) => [figure.dataset.simulation, figure.querySelector('.figure-message').textContent])
  .concat(document.querySelector('main#main h1') ? [] : ['no page'])"""
