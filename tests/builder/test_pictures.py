"""Picture files and drawings: those that a page cannot show or carry, or that could do more than
show themselves, are refused."""

import io
import zlib
from collections.abc import Callable

import pytest
from PIL import Image
from support.little_book import MakeBook, diagnostics

from site_builder.checks import pictures as picture_checks
from site_builder.checks.svg import SVG, read_overlay, read_svg

type Reported = Callable[[str, bytes], list[str]]


def picture(width: int, height: int, kind: str = "PNG") -> bytes:
    buffer = io.BytesIO()
    Image.new("L", (width, height), 200).save(buffer, kind)
    return buffer.getvalue()


@pytest.fixture
def reported(make_book: MakeBook) -> Reported:
    """What is reported of a picture file."""

    def find(name: str, data: bytes) -> list[str]:
        options = make_book()
        (options.root / "content" / "images" / name).write_bytes(data)
        found = diagnostics(options)
        return [str(one).removeprefix(f"content/images/{name}:") for one in found]

    return find


def vast(side: int) -> bytes:
    """A picture that claims to be of so many pixels."""
    small = picture(8, 8)
    chunk = b"IHDR" + side.to_bytes(4) * 2 + small[24:29]
    return small[:12] + chunk + zlib.crc32(chunk).to_bytes(4) + small[33:]


@pytest.mark.parametrize(
    ("name", "data", "says"),
    [
        ("a.png", b"", "1: no picture; legal: PNG"),
        ("a.png", picture(60, 60)[:-20], "1: a damaged picture: "),
        ("a.jpg", picture(60, 60, "JPEG")[:-200], "1: a damaged picture: "),
        ("a.png", picture(60, 60, "JPEG"), "1: holds JPEG; legal: PNG, as its name says"),
        ("a.png", vast(7_000), "1: 7000 × 7000 px; legal: "),
        ("a.png", vast(50_000), "1: more pixels than can be read"),
    ],
    ids=["empty", "cut", "cut", "another kind", "large", "vast"],
)
def test_a_picture_that_cannot_be_shown_is_reported(
    reported: Reported, name: str, data: bytes, says: str
) -> None:
    assert reported(name, data)[-1].startswith(says)


def test_a_photograph_that_says_where_it_was_taken_is_a_warning(reported: Reported) -> None:
    buffer, exif = io.BytesIO(), Image.Exif()
    exif.get_ifd(0x8825)[1] = "N"
    Image.new("L", (8, 8)).save(buffer, "JPEG", exif=exif)
    (only,) = reported("a.jpg", buffer.getvalue())
    assert only.startswith("1: warning: says where it was taken")


def test_a_whole_picture_has_no_report(reported: Reported) -> None:
    for kind in ("png", "webp", "jpeg"):
        assert reported(f"a.{kind}", picture(8, 8, kind.upper())) == []


def test_a_picture_of_too_many_pixels_or_bytes_is_refused(
    reported: Reported, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(picture_checks, "MOST_PIXELS", 60)
    assert reported("a.png", picture(8, 8)) == ["1: 8 × 8 px; legal: at most 60 pixels"]
    monkeypatch.setattr(picture_checks, "MOST_BYTES", 2_000_000)
    assert "1: a picture of 2.1 MB; legal: at most 2 MB" in reported("a.svg", b" " * 2_100_000)


HEAD = f'<svg xmlns="{SVG}" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 9 9">'
INERT = (
    '<g class="a b"><path d="M0 0"/><text x="1">Words</text></g>',
    '<use href="#a"/><use xlink:href="#a"/><rect fill="url(#g)"/>',
    "<style>.a { fill: url( '#g' ); }</style>",
    '<image href="data:image/png;base64,iVBORw0KGgo="/>',
    '<metadata><a xmlns="http://creativecommons.org/ns#"/></metadata>',
    '<text aria-label="javascript" data-note="on">onload=alert(1)</text>',
)
ATTACKS = (
    "<script>alert(1)</script>",
    '<script href="https://a.example/x.js"/>',
    '<h:script xmlns:h="http://www.w3.org/1999/xhtml">alert(1)</h:script>',
    '<g onload="alert(1)"/>',
    '<g ONLOAD="alert(1)"/>',
    '<animate onbegin="alert(1)" attributeName="x" dur="1s"/>',
    '<set attributeName="href" to="javascript:alert(1)"/>',
    "<foreignObject><p>Words</p></foreignObject>",
    '<iframe xmlns="http://www.w3.org/1999/xhtml" src="javascript:alert(1)"/>',
    '<a href="javascript:alert(1)"><text>x</text></a>',
    '<a xlink:href="javascript:alert(1)"><text>x</text></a>',
    '<use href="https://a.example/x.svg#a"/>',
    '<use href="data:image/svg+xml;base64,AAAA#a"/>',
    '<image href="https://a.example/x.png"/>',
    '<image href="data:image/svg+xml;base64,AAAA"/>',
    "<style>@import 'https://a.example/x.css';</style>",
    "<style>a{fill:url(https://a.example/x)}</style>",
    "<style>@\\69mport 'x';</style>",
    "<style>@imp<![CDATA[ort 'x';]]></style>",
    '<rect fill="url(//a.example/x)"/>',
    "<rect style=\"fill: url( 'x' )\"/>",
    '<rect style="behavior: url(#x)"/>',
    '<handler type="text/javascript">alert(1)</handler>',
    '<listener event="click" handler="#h"/>',
    '<embed src="javascript:alert(1)"/>',
    '<g xml:base="javascript:alert(1)//"><use href="#a"/></g>',
    '<filter><feImage href="https://a.example/x"/></filter>',
)
NO_DRAWINGS = (
    f'<!DOCTYPE svg [<!ENTITY a "b">]>{HEAD}&a;</svg>',
    f'<!DOCTYPE svg [<!ENTITY a SYSTEM "file:///etc/passwd">]>{HEAD}&a;</svg>',
    f'<?xml-stylesheet href="x.css"?>{HEAD}</svg>',
    '<html xmlns="http://www.w3.org/1999/xhtml"><script>alert(1)</script></html>',
    "<svg></svg>",
    f"{HEAD}<g>",
    "",
    '<?xml version="1.0" encoding="utf-7"?><svg/>',
    HEAD.encode("utf-16").decode("latin-1"),
)


@pytest.mark.parametrize("markup", INERT)
def test_a_drawing_that_only_shows_itself_may_be_published(markup: str) -> None:
    assert read_svg(f"{HEAD}{markup}</svg>".encode()).faults == ()


@pytest.mark.parametrize("markup", ATTACKS)
def test_a_drawing_that_does_more_is_refused_at_its_line(markup: str) -> None:
    faults = read_svg(f"{HEAD}\n\n{markup}</svg>".encode()).faults
    assert {fault.line for fault in faults} == {3}
    assert read_overlay(markup).faults, "a drawing of a scene"


@pytest.mark.parametrize("file", NO_DRAWINGS)
def test_a_file_that_is_no_drawing_is_refused(file: str) -> None:
    assert read_svg(file.encode("latin-1")).faults


def test_a_style_element_may_stand_in_a_file_and_not_in_a_drawing_of_a_scene() -> None:
    (fault,) = read_overlay(f"<g/>\n{INERT[2]}").faults
    assert (fault.line, fault.message.partition(";")[0]) == (2, "<style> in a drawing")
    assert read_overlay('<g class="a b"><g class="b c"/></g>').classes == {"a", "b", "c"}
