"""A reader's own picture in a figure: shown, taken away, and refused where it is none."""

import io
from pathlib import Path
from typing import Any

import pytest
from PIL import Image
from playwright.sync_api import FilePayload, expect
from support.reader import Reader

pytestmark = pytest.mark.browser

SCENE = "lens-distortion"


@pytest.fixture
def red_picture(tmp_path: Path) -> Path:
    path = tmp_path / "red.png"
    Image.new("RGB", (700, 300), (200, 0, 0)).save(path)
    return path


def middle_pixel(visitor: Reader) -> list[int]:
    rgba: list[int] = visitor.figure(SCENE).evaluate(
        """(figure) => {
             const canvas = figure.querySelector('[data-panel="picture"] canvas');
             const [x, y] = [canvas.width >> 1, canvas.height >> 1];
             return [...canvas.getContext('2d').getImageData(x, y, 1, 1).data];
           }"""
    )
    return rgba


def test_a_figure_shows_the_reader_s_picture_and_then_the_book_s_again(
    visitor: Reader, book: Any, red_picture: Path
) -> None:
    figure = visitor.turn_to_figure(book, SCENE)
    visitor.settle(figure)
    before, frames = middle_pixel(visitor), visitor.frames(figure)
    figure.locator("input[type=file]").set_input_files(red_picture)
    visitor.wait_frame(figure, frames)
    assert middle_pixel(visitor) == [200, 0, 0, 255]
    frames = visitor.frames(figure)
    figure.get_by_role("button", name="The book’s picture").click()
    visitor.wait_frame(figure, frames)
    assert middle_pixel(visitor) == before
    expect(figure.get_by_role("button", name="The book’s picture")).to_be_hidden()


def test_the_menu_of_pictures_leads_back_to_the_book_s(
    visitor: Reader, book: Any, red_picture: Path
) -> None:
    figure = visitor.turn_to_figure(book, SCENE)
    visitor.settle(figure)
    frames = visitor.frames(figure)
    figure.locator("input[type=file]").set_input_files(red_picture)
    visitor.wait_frame(figure, frames)
    frames = visitor.frames(figure)
    visitor.uncover(figure)
    figure.locator("select[name=picture]").select_option(index=1)
    visitor.wait_frame(figure, frames)
    visitor.settle(figure)
    assert middle_pixel(visitor) != [200, 0, 0, 255]
    expect(figure.get_by_role("button", name="The book’s picture")).to_be_hidden()


@pytest.mark.parametrize(("size", "cropped"), [((640, 480), False), ((640, 640), True)])
def test_a_picture_of_another_shape_is_said_to_be_cropped(
    visitor: Reader, book: Any, tmp_path: Path, size: tuple[int, int], cropped: bool
) -> None:
    picture = tmp_path / "shape.png"
    Image.new("RGB", size, (200, 0, 0)).save(picture)
    figure = visitor.turn_to_figure(book, SCENE)
    visitor.settle(figure)
    frames = visitor.frames(figure)
    figure.locator("input[type=file]").set_input_files(picture)
    visitor.wait_frame(figure, frames)
    expect(figure.locator(".photograph-cropped")).to_be_visible(visible=cropped)


def test_what_is_transparent_shows_a_white_ground(
    visitor: Reader, book: Any, tmp_path: Path
) -> None:
    picture = tmp_path / "glass.png"
    Image.new("RGBA", (640, 480), (0, 0, 0, 0)).save(picture)
    figure = visitor.turn_to_figure(book, SCENE)
    visitor.settle(figure)
    frames = visitor.frames(figure)
    figure.locator("input[type=file]").set_input_files(picture)
    visitor.wait_frame(figure, frames)
    assert middle_pixel(visitor) == [255] * 4


def small_picture() -> bytes:
    buffer = io.BytesIO()
    Image.new("RGB", (8, 8)).save(buffer, "PNG")
    return buffer.getvalue()


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("notes.png", b"no picture at all", "Can’t open “notes.png”"),
        ("dot.png", small_picture(), "“dot.png” has 8 × 8 pixels; it needs at least 16"),
    ],
)
def test_what_is_no_picture_is_refused_with_a_reason(
    visitor: Reader, book: Any, name: str, content: bytes, words: str
) -> None:
    figure = visitor.turn_to_figure(book, SCENE)
    file = FilePayload(name=name, mimeType="image/png", buffer=content)
    figure.locator("input[type=file]").set_input_files([file])
    expect(figure.locator(".figure-message")).to_contain_text(words)
    expect(figure).to_have_attribute("data-state", "live")
