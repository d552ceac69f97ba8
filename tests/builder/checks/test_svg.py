"""SVG that may be published, and all that could do more than show itself."""

import pytest

from site_builder.checks.svg import SVG, read_overlay, read_svg

HEAD = f'<svg xmlns="{SVG}" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 9 9">'

INERT = {
    "shapes": '<g class="a b"><path d="M0 0"/><text x="1">Words</text></g>',
    "own addresses": '<use href="#a"/><use xlink:href="#a"/><rect fill="url(#g)"/>',
    "own style": "<style>.a { fill: url( '#g' ); }</style>",
    "own picture": '<image href="data:image/png;base64,iVBORw0KGgo="/>',
    "notes": '<metadata><a xmlns="http://creativecommons.org/ns#"/></metadata>',
    "words": '<text aria-label="javascript" data-note="on">onload=alert(1)</text>',
}

ATTACKS = {
    "script": "<script>alert(1)</script>",
    "script by address": '<script href="https://a.example/x.js"/>',
    "script of HTML": '<h:script xmlns:h="http://www.w3.org/1999/xhtml">alert(1)</h:script>',
    "event": '<g onload="alert(1)"/>',
    "event in capitals": '<g ONLOAD="alert(1)"/>',
    "event of an animation": '<animate onbegin="alert(1)" attributeName="x" dur="1s"/>',
    "animated address": '<set attributeName="href" to="javascript:alert(1)"/>',
    "foreign object": "<foreignObject><p>Words</p></foreignObject>",
    "frame": '<iframe xmlns="http://www.w3.org/1999/xhtml" src="javascript:alert(1)"/>',
    "link": '<a href="javascript:alert(1)"><text>x</text></a>',
    "old link": '<a xlink:href="javascript:alert(1)"><text>x</text></a>',
    "used from elsewhere": '<use href="https://a.example/x.svg#a"/>',
    "used from data": '<use href="data:image/svg+xml;base64,AAAA#a"/>',
    "picture from elsewhere": '<image href="https://a.example/x.png"/>',
    "picture of SVG": '<image href="data:image/svg+xml;base64,AAAA"/>',
    "imported style": "<style>@import 'https://a.example/x.css';</style>",
    "style from elsewhere": "<style>a{fill:url(https://a.example/x)}</style>",
    "spelt style": "<style>@\\69mport 'x';</style>",
    "split style": "<style>@imp<![CDATA[ort 'x';]]></style>",
    "paint from elsewhere": '<rect fill="url(//a.example/x)"/>',
    "paint in a style": "<rect style=\"fill: url( 'x' )\"/>",
    "old behaviour": '<rect style="behavior: url(#x)"/>',
    "handler": '<handler type="text/javascript">alert(1)</handler>',
    "listener": '<listener event="click" handler="#h"/>',
    "embedded": '<embed src="javascript:alert(1)"/>',
    "base": '<g xml:base="javascript:alert(1)//"><use href="#a"/></g>',
    "filter from elsewhere": '<filter><feImage href="https://a.example/x"/></filter>',
}
WHOLE = {
    "entity": f'<!DOCTYPE svg [<!ENTITY a "b">]>{HEAD}&a;</svg>',
    "entity of a file": f'<!DOCTYPE svg [<!ENTITY a SYSTEM "file:///etc/passwd">]>{HEAD}&a;</svg>',
    "style sheet": f'<?xml-stylesheet href="x.css"?>{HEAD}</svg>',
    "page": '<html xmlns="http://www.w3.org/1999/xhtml"><script>alert(1)</script></html>',
    "no namespace": "<svg></svg>",
    "half": f"{HEAD}<g>",
    "nothing": "",
    "encoding": '<?xml version="1.0" encoding="utf-7"?><svg/>',
    "another encoding": HEAD.encode("utf-16").decode("latin-1"),
}


@pytest.mark.parametrize("name", INERT)
def test_what_only_shows_itself_may_be_published(name: str) -> None:
    assert read_svg(f"{HEAD}{INERT[name]}</svg>".encode()).faults == ()


@pytest.mark.parametrize("name", ATTACKS)
def test_what_does_more_is_told_at_its_line(name: str) -> None:
    faults = read_svg(f"{HEAD}\n\n{ATTACKS[name]}</svg>".encode()).faults
    assert faults
    assert {fault.line for fault in faults} == {3}


@pytest.mark.parametrize("name", ATTACKS)
def test_drawings_of_scenes_are_held_to_the_same(name: str) -> None:
    assert read_overlay(ATTACKS[name]).faults


def test_a_style_element_may_stand_in_a_file_and_not_in_a_drawing() -> None:
    (fault,) = read_overlay(f"<g/>\n{INERT['own style']}").faults
    assert (fault.line, fault.message.partition(";")[0]) == (2, "<style> in a drawing")


@pytest.mark.parametrize("name", WHOLE)
def test_files_that_are_no_drawing_are_told(name: str) -> None:
    assert read_svg(WHOLE[name].encode("latin-1")).faults


def test_a_name_that_is_nearly_right_is_suggested() -> None:
    (fault,) = read_overlay("<circel/>").faults
    assert fault.message == "unknown element 'circel'; did you mean 'circle'?"


def test_classes_are_gathered() -> None:
    assert read_overlay('<g class="a b"><g class="b c"/></g>').classes == {"a", "b", "c"}
