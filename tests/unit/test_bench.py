"""Benchmarks: costs beyond their budgets, stored costs, slowed programs and late sliders."""

import json
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import bench.slowed
import pytest
from bench.costs import over_budget, store_section
from bench.drag import Drag, summary

BUSY = "import time\nwhile time.process_time() < 0.2: pass\nprint(time.process_time())"


@pytest.mark.parametrize(
    ("cold", "most", "named"),
    [
        ({"ratio": 0.45, "book_ms": 9e9}, 0.45, []),
        ({"ratio": 0.54}, 0.45, ["start cold ratio: 0.54, 20% beyond its budget of 0.45"]),
        ({"ratio": 2}, 0, ["start cold ratio: 2, beyond its budget of 0"]),
        ({}, 0.45, ["start cold ratio: not measured"]),
        ({"ratio": None}, 0.45, ["start cold ratio: not measured"]),
        ({"ratio": float("nan")}, 0.45, ["start cold ratio: nan, nan% beyond its budget of 0.45"]),
    ],
)
def test_cost_beyond_its_budget_or_not_measured_is_reported(
    cold: Any, most: float, named: list[str]
) -> None:
    assert [*over_budget({"start": {"cold": cold}}, {"start": {"cold": {"ratio": most}}})] == named


def test_one_section_of_costs_is_replaced_and_others_stay(tmp_path: Path) -> None:
    file = tmp_path / "costs.json"
    store_section("start", {"ratio": 0.4}, file)
    store_section("bytes", {"paint_kb": 99}, file)
    store_section("start", {"ratio": 0.3}, file)
    stored = json.loads(file.read_text(encoding="utf-8"))
    assert stored == {"bytes": {"paint_kb": 99}, "start": {"ratio": 0.3}}


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_slowed_program_takes_proportionally_longer() -> None:
    command = [sys.executable, str(Path(bench.slowed.__file__)), "4", sys.executable, "-c", BUSY]
    begun = time.perf_counter()
    ran_s = float(subprocess.run(command, capture_output=True, check=True, text=True).stdout)
    assert time.perf_counter() - begun > 3.0 * ran_s


def drag(slow: int) -> Drag:
    """A drag of 24 moves at a quarter of the speed; ``slow`` of them are late and cheap."""
    latencies = [90.0] * slow + [50.0] * (24 - slow)
    levels = ["cheap"] * slow + ["best"] * (24 - slow)
    return Drag("one", "a", 4.0, latencies, [1.0], levels, "best")


def test_slider_is_late_if_over_one_in_twenty_moves_is_late() -> None:
    in_time, late = drag(1), drag(3)
    assert (in_time.late, late.late, late.late_moves) == (False, True, 3)
    found = summary([in_time, late, drag(20)])
    assert (found["sliders"], found["late"], found["at_rest"], found["slowest_ms"]) == (3, 2, 2, 90)
