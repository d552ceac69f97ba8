"""A reader's way through the book in the engines that the other tests do not use."""

from pathlib import Path
from typing import Any

import pytest
from support.engines import ENGINES, HOW_TO
from support.engines.engine import Engine, click, drag, press, wait_for
from support.page_scripts import LIVE
from support.static_server import StaticServer, serving

pytestmark = pytest.mark.browser

SCENE = "lens-distortion"
CHAPTER = "lens-distortion/"
HANDLE = f"#figure-{SCENE} [data-handle=point]"
SLIDER = f"#figure-{SCENE} input[name=k1]"
QUESTION, PREDICTION = "#quiz-outward-bow", "#predict-corner-of-a-barrel"


@pytest.mark.parametrize("name", ENGINES)
def test_a_reader_plays_answers_searches_turns_the_page_comes_back_and_goes_offline(
    name: str, built_site: Path, tmp_path: Path
) -> None:
    opened = ENGINES[name](tmp_path)
    if opened is None:
        pytest.skip(f"{name}: {HOW_TO}")
    with serving(built_site) as host, opened as engine:
        engine.open(host.url + CHAPTER)
        wait_for(engine, f"() => {LIVE}")
        moves_a_figure(engine)
        answers(engine)
        searches(engine)
        turns_the_page(engine)
        comes_back(engine, host)
        assert not engine.complaints()
        goes_offline(engine, host)


def moves_a_figure(engine: Engine) -> None:
    """By its slider, by a handle, by the handle's keys."""
    x, y = middle(engine, SLIDER)
    start = state(engine)
    click(engine, (x + 30, y))
    wait_for(engine, MOVED, SCENE, start)
    x, y = middle(engine, HANDLE)
    start = state(engine)
    drag(engine, (x, y), (x + 10, y + 8), (x + 24, y + 18))
    wait_for(engine, MOVED, SCENE, start)
    start = state(engine)
    engine.ask("(handle) => document.querySelector(handle).focus()", HANDLE)
    press(engine, ARROW_LEFT)
    wait_for(engine, MOVED, SCENE, start)


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


def turns_the_page(engine: Engine) -> None:
    click(engine, middle(engine, ".pager a[rel=next]"))
    wait_for(engine, "(left) => !location.pathname.endsWith(left)", CHAPTER)
    wait_for(engine, f"() => document.activeElement.id === 'main' && {LIVE}")


def comes_back(engine: Engine, host: StaticServer) -> None:
    """What was answered before is there still."""
    engine.open(host.url + CHAPTER)
    wait_for(engine, f"() => {LIVE}")
    wait_for(engine, ANSWERED, PREDICTION, "correct")


def goes_offline(engine: Engine, host: StaticServer) -> None:
    wait_for(engine, "() => Boolean(navigator.serviceWorker.controller)")
    host.gone = True
    engine.open(host.url + "perspective-projection/")
    wait_for(engine, f"() => document.querySelector('simulation-figure') && {LIVE}")


def middle(engine: Engine, selector: str) -> tuple[float, float]:
    """Of an element, which is brought into the window and rests there."""
    x, y = engine.ask(MIDDLE, selector)
    return x, y


def state(engine: Engine) -> Any:
    return engine.ask(STATE, SCENE)


ARROW_LEFT, ESCAPE = "\ue012", "\ue00c"

MIDDLE = """async (selector) => {
  const element = document.querySelector(selector);
  element.scrollIntoView({block: 'center', inline: 'center', behavior: 'instant'});
  let place;
  for (let still = 0, last = ''; still < 5; ) {
    await new Promise(requestAnimationFrame);
    place = element.getBoundingClientRect();
    still = `${place.x} ${place.y}` === last ? still + 1 : 0;
    last = `${place.x} ${place.y}`;
  }
  return [place.x + place.width / 2, place.y + place.height / 2];
}"""
STATE = """(scene) => {
  const figure = document.querySelector(`#figure-${scene} simulation-figure`);
  return [figure.querySelector('[name=k1]').value, Number(figure.dataset.frames)];
}"""
MOVED = f"""(scene, [value, frames]) => {{
  const [now, painted] = ({STATE})(scene);
  return now !== value && painted > frames
    && document.querySelector(`#figure-${{scene}} simulation-figure`).rests;
}}"""
ANSWERED = """(form, verdict) => document.querySelector(form).dataset.answered === verdict"""
