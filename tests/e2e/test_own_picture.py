"""A reader's own picture in a figure: shown, taken away, and refused where it is none."""

import io
from typing import Any

import pytest
from PIL import Image
from playwright.sync_api import FilePayload, Locator, expect
from support.reader import Reader

pytestmark = pytest.mark.browser

SCENE = "lens-distortion"
RED, GLASS = (200, 0, 0, 255), (0, 0, 0, 0)
MIDDLE_PIXEL = """(figure) => {
  const canvas = figure.querySelector('[data-panel="picture"] canvas');
  const [x, y] = [canvas.width >> 1, canvas.height >> 1];
  return [...canvas.getContext('2d').getImageData(x, y, 1, 1).data];
}"""


def picture(width: int, height: int, colour: tuple[int, ...], name: str = "own.png") -> FilePayload:
    buffer = io.BytesIO()
    Image.new("RGBA", (width, height), colour).save(buffer, "PNG")
    return FilePayload(name=name, mimeType="image/png", buffer=buffer.getvalue())


def choose(reader: Reader, figure: Locator, file: FilePayload) -> list[int]:
    """Give the figure a picture; the pixel in the middle of what it shows then."""
    frames = reader.frames(figure)
    figure.locator("input[type=file]").set_input_files([file])
    reader.wait_frame(figure, frames)
    pixel: list[int] = figure.evaluate(MIDDLE_PIXEL)
    return pixel


def test_a_figure_shows_the_reader_s_picture_and_then_the_book_s_again(
    visitor: Reader, book: Any
) -> None:
    """By its button, and by the menu of pictures."""
    figure = visitor.turn_to_figure(book, SCENE)
    visitor.settle(figure)
    before = figure.evaluate(MIDDLE_PIXEL)
    away = figure.get_by_role("button", name="The book’s picture")
    cropped = figure.locator(".photograph-cropped")
    assert choose(visitor, figure, picture(640, 480, RED)) == [*RED]
    expect(cropped).to_be_hidden()
    frames = visitor.frames(figure)
    away.click()
    visitor.wait_frame(figure, frames)
    assert figure.evaluate(MIDDLE_PIXEL) == before
    expect(away).to_be_hidden()
    assert choose(visitor, figure, picture(640, 640, RED)) == [*RED]
    expect(cropped).to_be_visible()
    white = [255] * 4
    assert choose(visitor, figure, picture(640, 480, GLASS)) == white, "what is transparent"
    visitor.uncover(figure)
    frames = visitor.frames(figure)
    figure.locator("select[name=picture]").select_option(index=1)
    visitor.wait_frame(figure, frames)
    visitor.settle(figure)
    assert figure.evaluate(MIDDLE_PIXEL) not in (white, [*RED])
    expect(away).to_be_hidden()


def test_what_is_no_picture_is_refused_with_a_reason(visitor: Reader, book: Any) -> None:
    figure = visitor.turn_to_figure(book, SCENE)
    none = FilePayload(name="notes.png", mimeType="image/png", buffer=b"no picture at all")
    for file, words in (
        (none, "Can’t open “notes.png”"),
        (picture(8, 8, RED, "dot.png"), "“dot.png” has 8 × 8 pixels; it needs at least 16"),
    ):
        figure.locator("input[type=file]").set_input_files([file])
        expect(figure.locator(".figure-message")).to_contain_text(words)
        expect(figure).to_have_attribute("data-state", "live")
