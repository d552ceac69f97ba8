"""The answers of a class are merged in the browser, and nothing is sent."""

import json
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
from support.reader import Reader

pytestmark = pytest.mark.browser


def test_thirty_files_of_answers_become_a_table_by_question(
    plain_reader: Reader, tmp_path: Path
) -> None:
    page = plain_reader.page
    plain_reader.open("class/", live=False)
    told = json.loads(page.locator(".class-data").text_content() or "")
    questions = [{**each, **each["variants"][0]} for each in told]
    choice = next(each for each in questions if each["kind"] == "single")
    number = next(each for each in questions if each["kind"] == "number")
    drawn = next(each for each in told if len(each["variants"]) > 1)
    options = [option["correct"] for option in choice["options"]]
    right, wrong = options.index(True), [at for at, is_right in enumerate(options) if not is_right]
    firsts = [right if who % 3 == 0 else wrong[who % 4 == 0] for who in range(30)]
    files = []
    for who, first in enumerate(firsts):
        answers: dict[str, Any] = {
            f"quiz:{choice['id']}": {
                "edition": choice["edition"], "answer": [right], "right": True, "first": [first],
            },
            f"quiz:{number['id']}": {
                "edition": number["edition"] if who < 10 else "another", "answer": 0.125,
                "right": False,
            },
            f"quiz:{drawn['id']}": {
                "edition": drawn["variants"][-1]["edition"] if who < 5 else "another",
                "answer": 0.125, "right": False, "seed": "class",
            },
        }  # fmt: skip
        file = tmp_path / f"=Student {who}.json"
        name = "image-formation-progress"
        file.write_text(json.dumps({"format": name, "version": 1, "answers": answers}))
        files.append(file)
    sent: list[str] = []
    page.on("request", lambda request: sent.append(request.method))
    broken = tmp_path / "broken.json"
    broken.write_text("{")
    page.locator(".class-files").set_input_files([*files, broken])
    page.wait_for_function("document.querySelectorAll('.class-tables details').length === 3")

    said = page.locator(".class-said").inner_text()
    assert "30 files, 3 questions" in said
    assert "broken.json" in said
    summary = page.locator("summary", has_text=choice["name"]).inner_text()
    trap, count = Counter(first for first in firsts if first != right).most_common(1)[0]
    assert f"30 answered, {firsts.count(right)} right at first, 30 right at last" in summary
    assert summary.endswith(f"({count}): {choice['options'][trap]['text']}")
    assert "10 answered, 0 right" in page.locator("summary", has_text=number["name"]).inner_text()
    asked = f"{drawn['variants'][-1]['drawn']}: 0.125"
    summary = page.locator("summary", has_text=drawn["name"]).inner_text()
    assert summary.endswith(f"(5): {asked}"), "its numbers are told with the answer"

    with page.expect_download() as download:
        page.locator(".class-csv").click()
    rows = Path(download.value.path()).read_text().splitlines()
    assert len(rows) == 1 + 30 + 10 + 5
    assert sum(row.startswith(f"{number['id']},'=Student ") for row in rows) == 10
    assert set(sent) <= {"GET"}
