"""Benchmarks: costs beyond their budgets, stored costs, slowed programs and late sliders."""

import json
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import bench.slowed
import pytest
from bench.costs import beyond, keep
from bench.drag import row
from bench.slow_phone import drag_summary

BUSY = "import time\nwhile time.process_time() < 0.2: pass\nprint(time.process_time())"


@pytest.mark.parametrize(
    ("cold", "named"),
    [
        ({"ratio": 0.45, "book_ms": 9e9}, []),
        ({"ratio": 0.54}, ["start cold ratio: 0.54, 20% beyond its budget of 0.45"]),
        ({}, ["start cold ratio: not measured"]),
        ({"ratio": None}, ["start cold ratio: not measured"]),
        ({"ratio": float("nan")}, ["start cold ratio: nan, nan% beyond its budget of 0.45"]),
    ],
)
def test_cost_beyond_its_budget_or_not_measured_is_reported(cold: Any, named: list[str]) -> None:
    assert [*beyond({"start": {"cold": cold}}, {"start": {"cold": {"ratio": 0.45}}})] == named


def test_one_section_of_costs_is_replaced_and_others_stay(tmp_path: Path) -> None:
    file = tmp_path / "costs.json"
    keep("start", {"ratio": 0.4}, file)
    keep("bytes", {"paint_kb": 99}, file)
    keep("start", {"ratio": 0.3}, file)
    stored = json.loads(file.read_text(encoding="utf-8"))
    assert stored == {"bytes": {"paint_kb": 99}, "start": {"ratio": 0.3}}


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_slowed_program_takes_proportionally_longer() -> None:
    command = [sys.executable, str(Path(bench.slowed.__file__)), "4", sys.executable, "-c", BUSY]
    begun = time.perf_counter()
    ran_s = float(subprocess.run(command, capture_output=True, check=True, text=True).stdout)
    assert time.perf_counter() - begun > 3.0 * ran_s


def test_slider_is_late_if_its_median_move_is_late() -> None:
    quick, late = (row("one", "a", [100.0, middle, 900.0], [1.0]) for middle in (200.0, 300.0))
    found = drag_summary([quick, quick, late])
    assert (found["sliders"], found["late"], found["slowest_ms"]) == (3, 1, 300.0)
