"""Numbers about speed and accuracy: from the file, never typed, and refused once they are stale."""

import json
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from support.html_outline import read_html
from support.little_book import diagnostics, rendered
from support.toy_ladder import ERRORS, FILE, toy_data, toy_ladder, toy_measurements

from simulations.engine.ladder import Ladder
from site_builder.benchmarks.measurements import COMMAND
from site_builder.build import Options
from site_builder.markdown.roles.measured import LEGAL, measured_text

type Find = Callable[..., list[str]]


@pytest.fixture
def find(make_book: Callable[..., Options]) -> Find:
    """Diagnostics of a page about the toy ladder."""

    def find(body: str, data: object = None) -> list[str]:
        text = data if isinstance(data, str) else json.dumps(data or toy_data())
        options = replace(make_book(body, {FILE: text}), load_ladder=toy_ladder)
        return [str(one) for one in diagnostics(options)]

    return find


def entry(**changes: object) -> Any:
    """Measurements whose ladder has been changed."""
    data = toy_data()
    data["ladders"]["toy"] |= changes
    return data


def lacking(part: str) -> Any:
    data = toy_data()
    del data["ladders"]["toy"][part]
    return data


LADDER = ":::{ladder} toy\n:default: Good.\n:::\n"
AGAIN = f"run `{COMMAND} --ladder toy`"
STALE = f"{FILE} is out of date: the "
NONE: Any = {"machine": {}, "ladders": {}}
TOY = toy_data()["ladders"]["toy"]
TWO: Any = {**toy_data(), "ladders": {"toy": TOY, "lost": TOY}}
TABLE = ":::{ladder-table} All\n:::\n"


def test_a_page_in_order_has_no_mistakes(find: Find) -> None:
    psnr = ":::{ladder} toy\n:metric: psnr\n:::\n"
    assert find(f"{{measured}}`toy fine native`\n\n{LADDER}\n{psnr}\n{TABLE}") == []


@pytest.mark.parametrize(
    ("line", "body", "message"),
    [
        (5, ":::{ladder}\n:::\n", "{ladder} names no ladder; legal: ':::{ladder} id'"),
        (5, ":::{ladder} tyo\n:::\n", "unknown ladder 'tyo'; legal: toy"),
        (5, ":::{ladder} toy\n:metric: mrs\n:::\n", "unknown metric 'mrs' of 'toy'; legal: rms"),
        (5, ":::{ladder} toy\n:::\n", "ladder 'toy' judged by 'rms' does not explain its default"),
        (6, LADDER.replace("Good.", "{measured}`toy fnie rms`"), "unknown tier of toy 'fnie'; did"),
        (
            7,
            LADDER.replace(":d", ":metric: psnr\n:d"),
            "ladder 'toy' judged by 'psnr' explains",
        ),
        (5, "{measured}`toy fnie native`\n", "unknown tier of toy 'fnie'; did you mean 'fine'?"),
        (5, "{measured}`toy fine natvie`\n", "unknown number of toy 'natvie'; did you mean 'na"),
        (5, "{measured}`toy fine over exact rms`\n", "rms of 'fine' over 'exact': the second has"),
        (5, "{measured}`browsr`\n", "unknown measured thing 'browsr'; did you mean 'browser'?"),
        (5, "{measured}`toy fine`\n", f"{{measured}} 'toy fine'; {LEGAL}"),
        (5, ":::{ladder-table}\n:::\n", "{ladder-table} has no caption; legal: ':::{ladder-table}"),
        (5, ":::{ladder-table} All\nMore.\n:::\n", "{ladder-table} with a body; legal: "),
    ],
)
def test_a_mistake_is_reported_at_its_line(find: Find, line: int, body: str, message: str) -> None:
    (found,) = find(body)
    assert found.startswith(f"content/00-first.md:{line}: {message}")


@pytest.mark.parametrize(
    ("body", "data", "message"),
    [
        (LADDER, NONE, f"ladder 'toy' is not in {FILE}; {AGAIN}"),
        (TABLE, TWO, "unknown ladder 'lost'; legal: toy"),
        (
            LADDER,
            entry(workload="two numbers"),
            f"{STALE}workload of ladder 'toy' changed from",
        ),
        (LADDER, entry(metrics={"rms": "codes"}), f"{STALE}metrics of ladder 'toy' changed from"),
        (LADDER, entry(tiers={}), f"{STALE}tiers of ladder 'toy' changed from [] to ['exact',"),
        (LADDER, lacking("workload"), f"{FILE}: ladder 'toy' is not as `{COMMAND}` writes it"),
        (LADDER, lacking("metrics"), f"{FILE}: ladder 'toy' is not as `{COMMAND}` writes it"),
        (LADDER, lacking("tiers"), f"{FILE}: ladder 'toy' is not as `{COMMAND}` writes it"),
    ],
)
def test_measurements_that_do_not_fit_the_ladders_are_reported(
    find: Find, body: str, data: object, message: str
) -> None:
    (found,) = find(body, data)
    assert found.startswith(f"content/00-first.md:5: {message}")
    assert FILE not in message or found.endswith(AGAIN)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (
            '{\n"machine": }',
            "2: malformed JSON: Expecting value; run `",
        ),
        *(
            (content, "1: no 'machine' or no 'ladders'; run `")
            for content in ("[]", "{}", '{"machine": {}}')
        ),
    ],
)
def test_a_file_of_another_shape_is_reported(find: Find, content: str, message: str) -> None:
    assert find("Text.\n", content) == [f"{FILE}:{message}{COMMAND}`"]


def test_a_ladder_whose_own_code_fails_is_reported_with_its_reason(
    make_book: Callable[..., Options],
) -> None:
    def load(_ladder_id: str) -> Ladder:
        raise ImportError("no module")

    options = make_book(":::{ladder} toy\n:::\n", {FILE: json.dumps(toy_data())})
    (found,) = diagnostics(replace(options, load_ladder=load))
    assert found.message == "ladder 'toy' cannot be loaded: ImportError: no module"


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ("toy fine native", "2.0\u00a0ms"),
        ("toy exact browser", "27\u00a0ms"),
        ("toy rough rms", "3.0\u00a0px"),
        ("toy rough psnr", "27.0\u00a0dB"),
        ("toy exact rms", "none"),
        ("toy rough rms bare", "3.0"),
        ("toy exact over fine native", "4.5"),
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
    markup = rendered(replace(options, load_ladder=toy_ladder))["first/index.html"]
    page = read_html(markup)
    rows = [e.attributes["data-tier"] for e in page.elements if "data-tier" in e.attributes]
    assert rows == [*ERRORS] * 2
    text = markup.decode()
    assert 'id="ladder-toy-2"' in text
    assert 'href="#ladder-toy"' in text
    assert text.count("It is <em>good</em>.") == 1
    assert "Netscape 4" in text
    assert "beaten by Fine" in text
