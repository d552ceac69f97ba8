"""What is far below the window of an opened chapter is laid out a moment later: nobody can tell."""

from typing import Any

import pytest
from support.reader import Reader

pytestmark = pytest.mark.browser

CHAPTER = "digital-sensor/"
ELSEWHERE = "lens-distortion/"
WAITING = "document.querySelectorAll('[data-folded], .unfolding').length"
HEIGHT = "document.querySelector('.chapter').getBoundingClientRect().height"

TURN = """async ({url, ask}) => {
  [...document.querySelectorAll('a[href]')].find((link) => link.href === url).click();
  while (location.href !== url || document.activeElement?.id !== 'main') {
    await new Promise((resolve) => setTimeout(resolve));
  }
  return eval(ask);
}"""
LAST_WAITING = "getComputedStyle([...document.querySelectorAll('[data-folded]')].at(-1))"
LAST_SECTION = """() => {
  const link = [...document.querySelectorAll('#contents .sections a')].at(-1);
  link.click();
  return link.hash.slice(1);
}"""
RESTS_AT = """async (id) => {
  let last = NaN;
  for (let still = 0; still < 10; ) {
    await new Promise(requestAnimationFrame);
    const {top} = document.getElementById(id).getBoundingClientRect();
    still = top === last ? still + 1 : 0;
    last = top;
  }
  return last;
}"""
"""Where an element is on the screen once nothing moves."""


def turn_at_once(reader: Reader, address: str, ask: str = "null") -> Any:
    """As `Reader.turn_to`, but leave what waits to the page; what that answers just then."""
    return reader.page.evaluate(TURN, {"url": reader.root + address, "ask": ask})


def wait_unfolded(reader: Reader) -> None:
    reader.page.wait_for_function(f"!{WAITING}")


def test_a_chapter_is_soon_as_it_would_be_had_nothing_waited(plain_reader: Reader) -> None:
    plain_reader.open(CHAPTER, live=False)
    whole = plain_reader.page.evaluate(HEIGHT)
    plain_reader.turn_to(ELSEWHERE, live=False)
    assert turn_at_once(plain_reader, CHAPTER, WAITING) > 0
    wait_unfolded(plain_reader)
    assert plain_reader.page.evaluate(HEIGHT) == whole
    plain_reader.page.goto(plain_reader.root + CHAPTER)
    wait_unfolded(plain_reader)
    assert plain_reader.page.evaluate(HEIGHT) == whole


def test_a_link_pressed_at_once_leads_to_its_section(plain_reader: Reader) -> None:
    plain_reader.open(ELSEWHERE, live=False)
    turn_at_once(plain_reader, CHAPTER)
    section = plain_reader.page.evaluate(LAST_SECTION)
    place = plain_reader.page.evaluate(RESTS_AT, section)
    plain_reader.open(f"{CHAPTER}#{section}", live=False)
    assert place == pytest.approx(plain_reader.page.evaluate(RESTS_AT, section), abs=1)


def test_what_an_address_points_to_does_not_move_from_its_place(plain_reader: Reader) -> None:
    plain_reader.open(CHAPTER, live=False)
    section = plain_reader.page.evaluate(LAST_SECTION)
    plain_reader.page.goto("about:blank")
    plain_reader.page.goto(f"{plain_reader.root}{CHAPTER}#{section}")
    assert plain_reader.page.evaluate(WAITING) == 0


def test_who_comes_back_finds_the_line_that_was_left(plain_reader: Reader) -> None:
    plain_reader.open(CHAPTER, live=False)
    plain_reader.page.evaluate("scrollTo({top: 9000, behavior: 'instant'})")
    plain_reader.turn_to(ELSEWHERE, live=False)
    plain_reader.page.evaluate("history.back()")
    plain_reader.page.wait_for_function("scrollY === 9000")
    assert plain_reader.page.evaluate(WAITING) == 0


def test_paper_waits_for_nothing(plain_reader: Reader) -> None:
    plain_reader.open(ELSEWHERE, live=False)
    plain_reader.page.emulate_media(media="print")
    how = f"{LAST_WAITING}.contentVisibility"
    assert turn_at_once(plain_reader, CHAPTER, how) == "visible"
