"""Picture files that a page cannot show, or cannot carry."""

import io
import zlib
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image
from support.little_book import diagnostics

from site_builder.build import Options, check_site
from site_builder.checks import pictures as picture_checks
from site_builder.diagnostics.diagnostic import BuildError


def picture(width: int, height: int, kind: str = "PNG") -> bytes:
    buffer = io.BytesIO()
    Image.new("L", (width, height), 200).save(buffer, kind)
    return buffer.getvalue()


@pytest.fixture
def told(make_book: Callable[..., Options]) -> Callable[..., list[str]]:
    """What is said of a picture file."""

    def find(name: str, data: bytes) -> list[str]:
        options = make_book()
        (options.root / "content" / "images" / name).write_bytes(data)
        found = diagnostics(options)
        return [str(one).removeprefix(f"content/images/{name}:") for one in found]

    return find


@pytest.mark.parametrize(
    ("name", "data", "says"),
    [
        ("a.png", b"", "1: no picture; legal: PNG"),
        ("a.png", picture(60, 60)[:-20], "1: a damaged picture: "),
        ("a.jpg", picture(60, 60, "JPEG")[:-200], "1: a damaged picture: "),
        ("a.png", picture(60, 60, "JPEG"), "1: holds JPEG; legal: PNG, as its name says"),
    ],
)
def test_a_picture_that_cannot_be_shown_is_reported(
    told: Callable[..., list[str]], name: str, data: bytes, says: str
) -> None:
    assert told(name, data)[0].startswith(says)


def test_a_photograph_that_says_where_it_was_taken_is_a_warning(
    told: Callable[..., list[str]],
) -> None:
    buffer, exif = io.BytesIO(), Image.Exif()
    exif.get_ifd(0x8825)[1] = "N"
    Image.new("L", (8, 8)).save(buffer, "JPEG", exif=exif)
    (only,) = told("a.jpg", buffer.getvalue())
    assert only.startswith("1: warning: says where it was taken")


def test_a_whole_picture_is_in_order(told: Callable[..., list[str]]) -> None:
    for kind in ("png", "webp", "jpeg"):
        assert told(f"a.{kind}", picture(8, 8, kind.upper())) == []


def test_a_picture_too_large_to_be_read_is_refused_unread(told: Callable[..., list[str]]) -> None:
    small = picture(8, 8)
    for side, says in (
        (7_000, "7000 × 7000 px; legal: "),
        (50_000, "more pixels than can be read"),
    ):
        chunk = b"IHDR" + side.to_bytes(4) * 2 + small[24:29]
        vast = small[:12] + chunk + zlib.crc32(chunk).to_bytes(4) + small[33:]
        assert told("a.png", vast)[-1].startswith(f"1: {says}")


def test_a_picture_of_too_many_pixels_is_refused(
    told: Callable[..., list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(picture_checks, "MOST_PIXELS", 60)
    assert told("a.png", picture(8, 8)) == ["1: 8 × 8 px; legal: at most 60 pixels"]


def test_a_heavy_file_is_refused_unread(
    told: Callable[..., list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(picture_checks, "MOST_BYTES", 2_000_000)
    assert told("a.svg", b" " * 2_100_000)[0] == "1: a picture of 2.1 MB; legal: at most 2 MB"


def test_a_picture_of_the_book_is_published_only_as_checked(
    make_book: Callable[..., Options], tmp_path: Path
) -> None:
    """A folder beside ``images`` is no way around the check."""
    options = make_book()
    (tmp_path / "content/other").mkdir()
    (tmp_path / "content/other/b.svg").write_bytes(b"<html/>")
    with pytest.raises(BuildError, match=r"content/other/b\.svg:1:"):
        check_site(options)
