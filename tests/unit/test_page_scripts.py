"""Scripts of the page, run in Node: raw files, tables and typed numbers."""

import json
from pathlib import Path
from typing import Any

import pytest
from support.places import ROOT
from support.scripts import output_of

FIXTURES = Path(__file__).parents[1] / "fixtures"
PROGRAM = """
import { isRaw } from "./js/raw/is_raw.js";
import { isBayer, isCutOff, mosaicOf } from "./js/raw/cells.js";
import { unshare } from "./js/raw/unshared.js";
import { FunctionOfParts } from "./js/raw/without_eval.js";

const text = (...parts) => parts.map((part) =>
  typeof part === "string" ? [part.length, ...Buffer.from(part)] : part).flat();
const section = (id, ...parts) => [id, text(...parts).length, ...text(...parts)];
const program = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0,
  ...section(1, [1, 96, 0, 0]),
  ...section(2, [4], "a", "f", [0, 0], "a", "t", [1, 112, 1, 1, 9], "a", "g", [3, 127, 0],
             "a", "m", [2, 3, 1, 2]),
]);
const m = unshare(program);
await WebAssembly.instantiate(program, {a: {
  f() {}, g: 1, m, t: new WebAssembly.Table({element: "anyfunc", initial: 1, maximum: 9}),
}});

const raw = {};
for (const [name, head] of Object.entries(FILES)) {
  raw[name] = await isRaw(new Blob([Buffer.from(head, "latin1")]));
}

const about = {
  width: 2, height: 4, flip: 6, filters: 0x16161616, cdesc: "RGBG",
  color_data: {maximum: 99, cam_mul: []},
};
const cells = {
  raw_width: 5, left_margin: 1, top_margin: 1,
  data: Uint16Array.from([0, 0, 0, 0, 0, 0, 11, 22, 12, 24, 0, 33, 44, 35, 47]),
};
const linear = {width: 2, height: 1, colors: 4, data: Uint16Array.from([3, 1, 4, 0, 6, 3, 5, 0])};
const mosaic = mosaicOf(about, cells, linear);
const rows = [[33, 44, 35, 46], [0, 0, 0, 0], [7, 9, 7, 9], [98, 99, 98, 99], [999, 999, 999, 999]];
const cutOff = rows.map((row) => {
  const data = Uint16Array.from([...cells.data.slice(0, 11), ...row]);
  return isCutOff(about, {...cells, data});
});

const add = new FunctionOfParts(
  ["invoker", "fn", "runDestructors", "fromRetWire", "toClassParamWire", "toArg0Wire"],
  "return function (arg0) {\\nvar thisWired = toClassParamWire(null, this);\\n"
    + "var arg0Wired = toArg0Wire(null, arg0);\\nvar rv = invoker(fn, thisWired, arg0Wired);\\n"
    + "var ret = fromRetWire(rv);\\nreturn ret;\\n}",
)((fn, self, value) => fn + self + value, 100, null, (sum) => 2 * sum,
  (_, self) => self.ten, (_, value) => Number(value));

console.log(JSON.stringify({
  isShared: m.buffer instanceof SharedArrayBuffer, pages: m.buffer.byteLength / 65536, raw,
  bayer: [0xb4b4b4b4, 0x94949494, 9, 0, 0x49249249].map((filters) => isBayer({filters})),
  mosaic: {...mosaic, codes: [...mosaic.codes], about: JSON.parse(mosaic.about)},
  cutOff, sum: add.call({ten: 10}, "1"),
}));
"""
FILES = {
    "a.dng": "II*\0",
    "a.nef": "MM\0*",
    "a.rw2": "IIU\0",
    "a.orf": "IIRO",
    "a.raf": "FUJIFILMCCD-RAW 0201",
    "a.cr3": "\0\0\0\x18ftypcrx \0\0\0\1",
    "a.heic": "\0\0\0\x18ftypheic\0\0\0\1",
    "a.jpg": "\xff\xd8\xff\xe1",
    "a.png": "\x89PNG\r\n",
    "empty": "",
}
TYPED: dict[str, float | None] = {
    "2.5": 2.5, "2,5": 2.5, "0,125": 0.125, "−3": -3, " – 3 ": -3, "+1e-3": 0.001,
    "1,5E3": 1500, ".5": 0.5, ",5": 0.5, "1,234.5": 1234.5, "1.234,5": 1234.5,
    "1,234,567": 1234567, "1 234,5": 1234.5, "12\u202f345": 12345, "1,000": 1000, "1.000": 1,
    "1.2×10^3": 1200, "1,2 · 10⁻³": 0.0012, "-1.5 x 10^ −2": -0.015, "−10^4": -10000,
    "－１．５": -1.5, "１２，５": 12.5, "1.2×103": None, "3 5": None, "1,2,3": None, "2-3": None,
    "3 px": None, "": None,
}  # fmt: skip
"""Values in a book whose decimal sign is a point; None where the text is no number."""


@pytest.fixture(scope="module")
def output(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    program = f"const FILES = {json.dumps(FILES)};\n{PROGRAM}"
    modules = (f"raw/{name}" for name in ("is_raw", "cells", "unshared", "without_eval"))
    printed: dict[str, Any] = output_of(tmp_path_factory.mktemp("raw"), program, ROOT, *modules)
    return printed


def test_raw_files_are_recognised_by_their_content(output: dict[str, Any]) -> None:
    assert {name for name, is_raw in output["raw"].items() if is_raw} == {*list(FILES)[:6]}


def test_threaded_program_gets_an_unshared_memory(output: dict[str, Any]) -> None:
    assert not output["isShared"]
    assert output["pages"] == 1


def test_only_quads_of_two_by_two_cells_are_a_bayer_mosaic(output: dict[str, Any]) -> None:
    assert output["bayer"] == [True, True, False, False, False]


def test_mosaic_has_its_black_levels_and_no_margins(output: dict[str, Any]) -> None:
    mosaic = output["mosaic"]
    assert (mosaic["width"], mosaic["height"]) == (4, 2), "as the sensor lies"
    assert mosaic["codes"] == [11, 22, 12, 24, 33, 44, 35, 47]
    assert mosaic["about"] == {"colours": "BGGR", "black": [7, 21, 32, 41], "white": 99}


def test_uniform_last_row_is_cut_off_unless_it_is_white(output: dict[str, Any]) -> None:
    assert output["cutOff"] == [False, True, True, False, True]


def test_functions_of_the_bindings_are_made_without_eval(output: dict[str, Any]) -> None:
    assert output["sum"] == 2 * (100 + 10 + 1)


CELLS = {
    **{
        begin + "1+1": f"'{begin}1+1"
        for begin in ("=", " =", "\u3000=", "＝", "＋", "－", "@", "\t", "+")
    },
    "\ra": '"\'\ra"',
    "-a,b": '"\'-a,b"',
    "-1.5": "-1.5",
    "+2": "+2",
    "a=1": "a=1",
    'say "x"': '"say ""x"""',
    "": "",
}
"""Texts and their CSV fields."""


def test_text_in_a_csv_is_no_formula_and_numbers_stay_numbers(tmp_path: Path) -> None:
    program = (
        'import { csv } from "./js/page/dom.js";\n'
        f"console.log(JSON.stringify({json.dumps(list(CELLS))}.map((one) => csv([[one]]))));\n"
    )
    assert output_of(tmp_path, program, ROOT, "page/dom") == [f"{c}\r\n" for c in CELLS.values()]


@pytest.mark.parametrize(
    ("book", "exceptions"),
    [(ROOT, {}), (FIXTURES / "german-book", {"1,000": 1, "1.000": 1000})],
    ids=["point", "comma"],
)
def test_typed_numbers_may_have_either_decimal_sign_and_any_minus(
    book: Path, exceptions: dict[str, float], tmp_path: Path
) -> None:
    program = (
        'import { parseNumber } from "./js/page/words.js";\n'
        f"console.log(JSON.stringify({json.dumps(list(TYPED))}.map(parseNumber)));\n"
    )
    found = output_of(tmp_path, program, book, "page/words")
    assert dict(zip(TYPED, found, strict=True)) == {**TYPED, **exceptions}
