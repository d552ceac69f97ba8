"""What the worker is told of edited code: a frame, or what went wrong and on which line."""

import json
from typing import Any

import numpy as np
import pytest

from simulations import browser
from simulations.editing.definitions import module_source

STAGES = "simulations.scenes.jpeg"


def answer(edits: dict[str, str], figure: str = "figure-edited") -> browser.EditedReply:
    return browser.render_edited(figure, "jpeg", "{}", "", json.dumps(edits))


def problem_with(edits: dict[str, str]) -> Any:
    reply = answer(edits)
    assert reply.frame is None
    return json.loads(reply.problem)


def test_a_figure_with_edits_is_drawn_by_them_and_another_by_the_book() -> None:
    before = browser.render("figure-other", "jpeg", "{}", "")
    text = "def whole_codes():\n    return 0.2 * balloon()"
    reply = answer({f"{STAGES}:whole_codes": text})
    assert reply.problem == "null"
    assert reply.frame
    assert reply.frame.meta != before.meta
    browser.render("figure-other", "jpeg", '{"quality": 11}', "")
    after = browser.render("figure-other", "jpeg", "{}", "")
    assert json.loads(after.meta)["readouts"] == json.loads(before.meta)["readouts"]
    pairs = zip(after.rasters, before.rasters, strict=True)
    assert all(np.array_equal(a, b) for a, b in pairs)


def test_what_was_not_edited_and_does_not_depend_on_it_is_reused_as_ever() -> None:
    edits = {f"{STAGES}:fidelity": "def fidelity(decoded, original):\n    return 30.0"}
    answer(edits)
    again = answer(edits)
    assert again.frame
    stages = json.loads(again.frame.meta)["stages"]
    assert {stage["status"] for stage in stages} <= {"reused", "skipped"}


QUALITY, ORIGINAL = f"{STAGES}:fidelity", f"{STAGES}:whole_codes"
HEAD = "def fidelity(decoded, original):\n"


@pytest.mark.parametrize(
    ("edits", "line", "message"),
    [
        (
            {QUALITY: f"{HEAD}    x = 1\n    return x / 0\n"},
            3,
            "ZeroDivisionError: division by zero",
        ),
        (
            {
                ORIGINAL: "\n" * 20 + "def whole_codes():\n    return 0.2 * balloon()",
                QUALITY: f"{HEAD}    raise SystemExit('enough')",
            },
            2,
            "SystemExit: enough",
        ),
        ({QUALITY: "def fidelity(a, b):\n  return (1"}, 2, "SyntaxError"),
    ],
    ids=["exception", "below another edit", "no Python"],
)
def test_what_goes_wrong_is_reported_with_the_line_of_the_edit(
    edits: dict[str, str], line: int, message: str
) -> None:
    found = problem_with(edits)
    assert (found["definition"], found["line"]) == (QUALITY, line)
    assert found["message"].startswith(message)


def test_an_exception_in_the_books_code_is_told_with_the_line_that_called_it() -> None:
    text = "def coded(planes, quality, subsampling, tier):\n"
    text += "    return jpeg.encode(planes, -5, subsampling, TRANSFORMS[tier])"
    told = problem_with({f"{STAGES}:coded": text})
    assert (told["definition"], told["line"]) == (f"{STAGES}:coded", 2)
    said = told["message"]["values"]
    assert said["error"].startswith("ValueError: quality -5; legal")
    assert said["file"].startswith("simulations/models/")


def test_a_line_of_the_books_is_that_of_its_file_also_below_an_edit() -> None:
    lines = module_source(STAGES).split("\n")
    raised = next(number for number, text in enumerate(lines, 1) if "return psnr_db" in text)
    text = "\n" * 7 + "def whole_codes():\n    return balloon()\n\npsnr_db = None"
    told = problem_with({f"{STAGES}:whole_codes": text})
    assert told["message"]["key"] == "workshop.raised_in"
    place = {"file": "simulations/scenes/jpeg.py", "line": str(raised)}
    assert place.items() <= told["message"]["values"].items()


def test_a_mistake_that_no_line_of_the_reader_made_has_none() -> None:
    text = "def fidelity(decoded):\n    return 1.0"
    told = problem_with({f"{STAGES}:fidelity": text})
    assert told["line"] == 0
    assert "stage 'psnr' comes after" in told["message"]["values"]["error"]


def test_what_the_code_prints_is_told_up_to_a_length() -> None:
    text = "def fidelity(decoded, original):\n    print('shape', decoded.shape)\n    return 1.0"
    assert answer({f"{STAGES}:fidelity": text}).printed.startswith("shape (")
    text = text.replace("'shape'", "'x' * 10**6")
    assert len(answer({f"{STAGES}:fidelity": text}).printed) == browser.MOST_PRINTED


@pytest.mark.parametrize("figure", ["figure-a", "figure-b"])
def test_the_error_of_an_edited_frame_is_that_of_the_edited_code(figure: str) -> None:
    edits = json.dumps({"simulations.scenes.sensor_noise.sensor:FULL_WELL_E": "FULL_WELL_E = 50"})
    book = browser.error(figure, "sensor-noise", "{}", "")
    edited = browser.error(figure, "sensor-noise", "{}", "", edits)
    assert json.loads(book) != json.loads(edited)
