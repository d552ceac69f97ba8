"""Numbers about speed and accuracy: from the file, never typed, and refused once they are stale."""

import json
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from support.html_outline import read_html
from support.little_book import diagnostics
from support.toy_ladder import ERRORS, FILE, toy_data, toy_ladder, toy_measurements

from simulations.engine.ladder import Ladder
from site_builder.build import Options, check_site, render_site
from site_builder.diagnostics import BuildError
from site_builder.markdown.roles.measured import LEGAL, measured_text
from site_builder.output.assets import content_bytes

type Find = Callable[..., list[str]]


@pytest.fixture
def find(make_book: Callable[..., Options]) -> Find:
    """Diagnostics of a page about the toy ladder."""

    def find(body: str, data: object = None) -> list[str]:
        text = data if isinstance(data, str) else json.dumps(data or toy_data())
        options = replace(make_book(body, {FILE: text}), load_ladder=toy_ladder)
        return [str(one) for one in diagnostics(options)]

    return find


def test_a_page_in_order_has_no_mistakes(find: Find) -> None:
    assert (
        find(
            "{measured}`toy fine native`\n\n:::{ladder} toy\n:default: Good.\n:::\n\n"
            ":::{ladder} toy\n:metric: psnr\n:::\n\n:::{ladder-table} All\n:::\n"
        )
        == []
    )


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (":::{ladder}\n:::\n", "{ladder} names no ladder; legal: ':::{ladder} id'"),
        (":::{ladder} tyo\n:::\n", "unknown ladder 'tyo'; legal: toy"),
        (":::{ladder} toy\n:metric: mrs\n:::\n", "unknown metric 'mrs' of 'toy'; legal: rms, psnr"),
        (
            ":::{ladder} toy\n:::\n",
            "ladder 'toy' judged by 'rms' does not explain its default; "
            "legal: a line ':default: …', why its figures settle in 'fine'",
        ),
        ("{measured}`toy fnie native`\n", "unknown tier of toy 'fnie'; did you mean 'fine'?"),
        ("{measured}`toy fine natvie`\n", "unknown number of toy 'natvie'; did you mean 'native'?"),
        (
            "{measured}`toy fine over exact rms`\n",
            "rms of 'fine' over 'exact': the second has no error",
        ),
        ("{measured}`browsr`\n", "unknown measured thing 'browsr'; did you mean 'browser'?"),
        ("{measured}`toy fine`\n", f"{{measured}} 'toy fine'; {LEGAL}"),
        (
            ":::{ladder-table}\n:::\n",
            "{ladder-table} has no caption; legal: ':::{ladder-table} Caption'",
        ),
        (
            ":::{ladder-table} All\nMore.\n:::\n",
            "{ladder-table} with a body; legal: a caption behind its name, no more",
        ),
    ],
)  # fmt: skip
def test_a_mistake_is_reported_at_its_line(find: Find, body: str, message: str) -> None:
    assert find(body) == [f"content/00-first.md:5: {message}"]


@pytest.mark.parametrize(
    ("entry", "what"),
    [
        (
            {"workload": "two numbers"},
            "the workload of ladder 'toy' changed from two numbers to a number",
        ),
        ({"metrics": {"rms": "codes", "psnr": "dB"}}, "the metrics of ladder 'toy' changed from"),
        ({"tiers": {}}, "the tiers of ladder 'toy' changed from [] to ['exact',"),
    ],
)
def test_what_has_changed_since_it_was_measured_is_refused(
    find: Find, entry: dict[str, Any], what: str
) -> None:
    data = toy_data()
    data["ladders"]["toy"] |= entry
    (message,) = find(":::{ladder} toy\n:default: Good.\n:::\n", data)
    assert message.startswith(f"content/00-first.md:5: {FILE} is out of date: {what}")
    assert message.endswith("run `make bench LADDER=toy`")


def test_a_ladder_without_measurements_is_reported_where_it_is_shown(find: Find) -> None:
    found = find(":::{ladder} toy\n:default: Good.\n:::\n", {"machine": {}, "ladders": {}})
    assert found == [
        f"content/00-first.md:5: ladder 'toy' is not in {FILE}; run `make bench LADDER=toy`"
    ]


def test_a_table_of_ladders_needs_them_all_to_be_measured(find: Find) -> None:
    data = toy_data()
    data["ladders"]["lost"] = data["ladders"]["toy"]
    assert find(":::{ladder-table} All\n:::\n", data) == [
        "content/00-first.md:5: unknown ladder 'lost'; legal: toy"
    ]


def test_a_ladder_whose_own_code_fails_is_reported_with_its_reason(
    make_book: Callable[..., Options],
) -> None:
    def load(_ladder_id: str) -> Ladder:
        raise ImportError("no module")

    options = make_book(":::{ladder} toy\n:::\n", {FILE: json.dumps(toy_data())})
    with pytest.raises(BuildError) as raised:
        check_site(replace(options, load_ladder=load))
    assert [str(found) for found in raised.value.diagnostics] == [
        "content/00-first.md:5: ladder 'toy' cannot be loaded: ImportError: no module"
    ]


def test_a_malformed_file_is_reported_at_its_line(find: Find) -> None:
    assert find("Text.\n", '{\n"machine": }') == [
        f"{FILE}:2: malformed JSON: Expecting value; run `make bench`"
    ]


@pytest.mark.parametrize("content", ["[]", "{}", '{"machine": {}}'])
def test_a_file_of_another_shape_is_reported(find: Find, content: str) -> None:
    assert find("Text.\n", content) == [f"{FILE}:1: no 'machine' or no 'ladders'; run `make bench`"]


@pytest.mark.parametrize("lost", ["workload", "metrics", "tiers"])
def test_an_entry_that_lacks_a_part_says_how_to_measure_again(find: Find, lost: str) -> None:
    data = toy_data()
    del data["ladders"]["toy"][lost]
    assert find("A {measured}`toy fine rms`.\n", data) == [
        f"content/00-first.md:5: {FILE}: ladder 'toy' is not as `make bench` writes it "
        f"(KeyError: '{lost}'); run `make bench LADDER=toy`"
    ]


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ("toy fine native", "2.0\u00a0ms"),
        ("toy exact browser", "27\u00a0ms"),
        ("toy rough rms", "3.0\u00a0px"),
        ("toy rough psnr", "27.0\u00a0dB"),
        ("toy exact rms", "none"),
        ("toy rough rms bare", "3.0"),
        ("toy waste verdict", "beaten by Fine"),
        ("toy exact over fine native", "4.5"),
        ("ladders", "1"),
        ("tiers", "4"),
        ("beaten", "1"),
        ("processor", "abacus"),
    ],
)
def test_a_measured_number_is_written_for_reading(words: str, text: str) -> None:
    assert measured_text(words, toy_measurements()) == text


def test_a_ladder_s_page_is_complete_without_scripts(make_book: Callable[..., Options]) -> None:
    body = (
        ":::{ladder-table} All\n:::\n\n:::{ladder} toy\n:default: It is *good*.\nSee it.\n:::\n\n"
        ":::{ladder} toy\n:metric: psnr\n:::\n"
    )
    options = make_book(body, {FILE: json.dumps(toy_data())})
    site = render_site(replace(options, load_ladder=toy_ladder))
    markup = content_bytes(site["first/index.html"])
    page = read_html(markup)
    rows = [e.attributes["data-tier"] for e in page.elements if "data-tier" in e.attributes]
    assert rows == [*ERRORS] * 2
    text = markup.decode()
    assert 'id="ladder-toy-2"' in text
    assert 'href="#ladder-toy"' in text
    assert text.count("It is <em>good</em>.") == 1
    assert "Netscape 4" in text
    assert "beaten by Fine" in text
