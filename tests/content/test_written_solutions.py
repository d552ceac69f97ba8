"""The book's exercises: each solution has the error of the ladder's tier with the same method."""

import json
import re
from itertools import count
from pathlib import Path
from typing import Any

from simulations.editing.exercise import Exercise, findings
from simulations.registry import load_ladder
from site_builder.benchmarks.measuring import close

DATA = re.compile(r'<script type="application/json" class="quiz-data">(.*?)</script>', re.DOTALL)


def programs(page: str) -> list[Exercise]:
    questions: list[Any] = [json.loads(text) for text in DATA.findall(page)]
    return [Exercise(**each["program"]) for each in questions if each["kind"] == "code"]


def test_solutions_of_exercises_have_the_errors_of_their_tiers(book: Any, built_site: Path) -> None:
    by_chapter = {
        chapter["number"]: programs((built_site / chapter["url"] / "index.html").read_text())
        for chapter in book["chapters"]
    }
    assert {*range(1, 9), 10, 11} <= {number for number, some in by_chapter.items() if some}
    assert sum(map(len, by_chapter.values())) >= 12
    ticks = count()
    for exercise in (each for some in by_chapter.values() for each in some if each.ladder):
        found = findings(exercise, exercise.solution, "workload", load_ladder, lambda: next(ticks))
        tier = next(each for each in found["tiers"] if each["tier"] == exercise.tier)
        for metric, expected in tier["errors"].items():
            yours = found["yours"]["errors"][metric]
            assert close(yours, expected, relative=1e-3), f"{exercise.name} {metric}: {yours}"
