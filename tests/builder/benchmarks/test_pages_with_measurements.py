"""Pages with measured numbers: written for reading, and refused once they are stale."""

import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest
from support.little_book import diagnostics
from support.toy_ladder import FILE, toy_data, toy_ladder, toy_measurements

from simulations.engine.frame import Frame
from simulations.engine.ladder import Ladder
from simulations.engine.scene import Scene
from simulations.engine.settings import slider
from simulations.engine.stages import Outputs, Stage
from site_builder.benchmarks.measurements import COMMAND, MeasurementError
from site_builder.benchmarks.readouts import DATA as COSTS
from site_builder.benchmarks.readouts import STAGE_DATA as DATA
from site_builder.benchmarks.readouts import read_cost, read_stage_costs
from site_builder.build import Options
from site_builder.markdown.roles.numbers import LEGAL, measured_text

type MakeBook = Callable[..., Options]


def changed(**changes: object) -> Any:
    """Measurements of the toy ladder with some entries changed; None removes one."""
    data = toy_data()
    toy = data["ladders"]["toy"] | changes
    data["ladders"]["toy"] = {name: value for name, value in toy.items() if value is not None}
    return data


LADDER = ":::{ladder} toy\n:default: Good.\n:::\n"
PSNR = ":::{ladder} toy\n:metric: psnr\n:::\n"
TABLE = ":::{ladder-table} All\n:::\n"
TOY = toy_data()["ladders"]["toy"]
TWO = {**toy_data(), "ladders": {"toy": TOY, "lost": TOY}}
FIRST = "content/00-first.md:5: "
STALE = f"{FIRST}{FILE} is out of date: the "
UNFIT = f"{FIRST}{FILE}: ladder 'toy' is not as `{COMMAND}` writes it"
PARTS = f"{FILE}:1: no 'machine' or no 'ladders'; run `{COMMAND}`"


@pytest.mark.parametrize(
    ("body", "data", "message"),
    [
        (f"{{measured}}`toy fine native`\n\n{LADDER}\n{PSNR}\n{TABLE}", toy_data(), ""),
        (":::{ladder}\n:::", None, FIRST + "{ladder} names no ladder; legal: ':::{ladder} id'"),
        (":::{ladder} tyo\n:::", None, f"{FIRST}unknown ladder 'tyo'; legal: toy"),
        (PSNR.replace("psnr", "mrs"), None, f"{FIRST}unknown metric 'mrs' of 'toy'; legal: rms"),
        (":::{ladder} toy\n:::", None, f"{FIRST}ladder 'toy' judged by 'rms' does not explain its"),
        (PSNR.replace(":m", ":default: D\n:m"), None, "ladder 'toy' judged by 'psnr' explains"),
        (LADDER.replace("Good.", "{measured}`toy fnie rms`"), None, "md:6: unknown tier of toy"),
        ("{measured}`toy fnie native`", None, f"{FIRST}unknown tier of toy 'fnie'; did you mean"),
        ("{measured}`toy fine natvie`", None, f"{FIRST}unknown number of toy 'natvie'; did you"),
        ("{measured}`toy fine over exact rms`", None, "rms of 'fine' over 'exact': the second has"),
        ("{measured}`browsr`", None, f"{FIRST}unknown measured thing 'browsr'; did you mean"),
        ("{measured}`toy fine`", None, f"{FIRST}{{measured}} 'toy fine'; {LEGAL}"),
        (":::{ladder-table}\n:::", None, FIRST + "{ladder-table} has no caption; legal: "),
        (":::{ladder-table} All\nMore.\n:::", None, FIRST + "{ladder-table} with a body; legal: "),
        (LADDER, {"machine": {}, "ladders": {}}, f"{FIRST}ladder 'toy' is not in {FILE}; run `"),
        (TABLE, TWO, f"{FIRST}unknown ladder 'lost'; legal: toy"),
        (LADDER, changed(workload="two"), f"{STALE}workload of ladder 'toy' changed from"),
        (LADDER, changed(metrics={"rms": "codes"}), f"{STALE}metrics of ladder 'toy' changed from"),
        (LADDER, changed(tiers={}), f"{STALE}tiers of ladder 'toy' changed from [] to ['exact',"),
        (LADDER, changed(workload=None), UNFIT),
        (LADDER, changed(metrics=None), UNFIT),
        (LADDER, changed(tiers=None), UNFIT),
        ("Text.", '{\n"machine": }', f"{FILE}:2: malformed JSON: Expecting value; run `{COMMAND}`"),
        ("Text.", "[]", PARTS),
        ("Text.", "{}", PARTS),
        ("Text.", '{"machine": {}}', PARTS),
    ],
)
def test_mistakes_in_pages_and_data(
    make_book: MakeBook, body: str, data: object, message: str
) -> None:
    text = data if isinstance(data, str) else json.dumps(data or toy_data())
    options = replace(make_book(f"{body}\n", {FILE: text}), load_ladder=toy_ladder)
    found = [str(one) for one in diagnostics(options)]
    assert len(found) == bool(message)
    assert message in "".join(found)


def test_a_ladder_whose_code_fails(make_book: MakeBook) -> None:
    def load(_ladder_id: str) -> Ladder:
        raise ImportError("no module")

    options = make_book(LADDER, {FILE: json.dumps(toy_data())})
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
def test_measured_numbers_in_text(words: str, text: str) -> None:
    assert measured_text(words, toy_measurements()) == text


def test_a_cost_that_the_ladder_does_not_state() -> None:
    with pytest.raises(MeasurementError, match="states no 'each'"):
        measured_text("toy fine each", toy_measurements())


@pytest.mark.parametrize(
    ("asked", "found"),
    [
        ("start cold book_ms", (1234.5, "ms")),
        ("start cold ratio", (0.41, "")),
        ("machine cores", (2.0, "")),
        ("start cold book", "did you mean 'book_ms'"),
        ("starts", "did you mean 'start'"),
        ("start cold", "book_ms, ratio"),
        ("start cold ratio more", "unknown cost 'more'"),
    ],
)
def test_costs_of_pages(asked: str, found: tuple[float, str] | str, tmp_path: Path) -> None:
    with pytest.raises(MeasurementError, match="run `make bench`"):
        read_cost(tmp_path, "start")
    file = tmp_path / COSTS
    file.parent.mkdir()
    start = {"cold": {"book_ms": 1234.5, "ratio": 0.41}}
    file.write_text(json.dumps({"start": start, "machine": {"cores": 2}}), encoding="utf-8")
    if isinstance(found, str):
        with pytest.raises(MeasurementError, match=found):
            read_cost(tmp_path, asked)
    else:
        cost = read_cost(tmp_path, asked)
        assert not isinstance(cost, str)
        assert (cost.value, cost.unit) == found


@dataclass(frozen=True, slots=True)
class Settings:
    number: float = slider("Number", 2, 0, 9, 1)
    gain: float = slider("Gain", 3, 0, 9, 1)
    offset: float = slider("Offset", 0, 0, 9, 1)


def lifted(value: float, offset: float) -> float:
    return value + offset


def draw(_settings: Settings, outputs: Outputs) -> Frame:
    return Frame((), (), f"{outputs['lifted']:g} in all.")


SUMS = Scene(
    "sums", "Sums", Settings, draw,
    stages=(
        Stage("tens", lambda number: 10 * number),
        Stage("gained", lambda tens, gain: gain * tens, ("tens",)),
        Stage("lifted", lifted, ("gained",), neutral=lambda offset: "" if offset else "no offset"),
    ),
)  # fmt: skip
MOVE = {"to": 1, "ms": 1.0, "whole_ms": 2.0, "share": 0.5}


@pytest.mark.parametrize(
    ("start", "control", "again", "reused", "skipped"),
    [
        ({}, "offset", ("lifted",), 2, 0),
        ({}, "number", ("tens", "gained"), 0, 1),
        ({"offset": 4}, "number", ("tens", "gained", "lifted"), 0, 0),
    ],
)
def test_stages_that_a_move_runs_again(
    start: object, control: str, again: object, reused: int, skipped: int, tmp_path: Path
) -> None:
    (tmp_path / DATA).parent.mkdir()
    recorded = {"sums": {"start": start, "moves": {control: MOVE}}}
    (tmp_path / DATA).write_text(json.dumps(recorded), encoding="utf-8")
    costs = read_stage_costs(tmp_path, SUMS)
    (move,) = costs.moves
    assert (move.again, move.reused, move.skipped, costs.stages) == (again, reused, skipped, 3)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "has no scene 'demo'"),
        ({"other": {}}, "has no scene 'demo'"),
        ([], "has no scene 'demo'"),
        ({"demo": {"start": {}}}, "KeyError: 'moves'"),
        ({"demo": {"start": {}, "moves": {}}}, "no median for empty data"),
        ({"demo": {"start": {}, "moves": {"zoom": MOVE}}}, "unknown parameter 'zoom'"),
    ],
)
def test_stale_costs_of_stages(make_book: MakeBook, content: object, message: str) -> None:
    options = make_book(files={str(DATA): None if content is None else json.dumps(content)})
    with pytest.raises(MeasurementError, match=f"(?s){message}.*bench.stage_costs"):
        read_stage_costs(options.root, options.load_scene("demo"))
