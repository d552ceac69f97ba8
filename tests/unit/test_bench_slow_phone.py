"""What `make bench` measures on a slow phone."""

import subprocess
import sys
import time
from pathlib import Path

import bench.slowed
import pytest
from bench.latency import row
from bench.slow_phone import drag_summary
from support.places import ROOT

from site_builder.benchmarks.costs import Cost, read_costs

BUSY = "import time\nwhile time.process_time() < 0.2: pass\nprint(time.process_time())"


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_a_slowed_program_takes_so_many_times_as_long() -> None:
    command = [sys.executable, str(Path(bench.slowed.__file__)), "4", sys.executable, "-c", BUSY]
    begun = time.perf_counter()
    ran_s = float(subprocess.run(command, capture_output=True, check=True, text=True).stdout)
    assert time.perf_counter() - begun > 3.0 * ran_s


def test_a_slider_is_late_if_its_median_move_is() -> None:
    quick = row("one", "a", [100.0, 200.0, 900.0], [1.0])
    late = row("two", "b", [100.0, 300.0, 900.0], [1.0])
    found = drag_summary([quick, quick, late])
    assert (found["sliders"], found["late"], found["slowest_ms"]) == (3, 1, 300.0)


@pytest.mark.parametrize("name", ["cold ratio", "first slider_ms", "drags in_time", "heavy rate"])
def test_the_book_can_tell_what_was_measured(name: str) -> None:
    assert isinstance(read_costs(ROOT).find(f"slow_phone {name}"), Cost)
