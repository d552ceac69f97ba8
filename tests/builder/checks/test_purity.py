"""Clocks and unseeded chance, found in the sources of simulations."""

from pathlib import Path

import pytest

from site_builder.checks.purity import check_purity, impurities
from site_builder.diagnostics import Diagnostics

HEAD = """\
import os, random, secrets, time, uuid
import datetime as dt
import numpy as np
import numpy.random as npr
from datetime import datetime
from time import perf_counter as now
from numpy.random import default_rng, normal

"""
IMPURE = (
    "time.time()", "time.sleep(1)", "now()", "dt.datetime.now()", "datetime.today()",
    "dt.date.today()", "random.random()", "random.seed(3)", "random.Random()",
    "secrets.token_hex()", "uuid.uuid4()", "os.urandom(8)", "np.random.normal()",
    "np.random.seed(1)", "npr.rand(3)", "normal()", "default_rng()", "np.random.default_rng()",
    "np.random.default_rng(None)", "np.random.RandomState()",
)  # fmt: skip
PURE = (
    "np.random.default_rng(7)", "default_rng(seed=settings.seed)", "random.Random(3)",
    "settings.time()", "rng.normal()", "np.random.Generator(np.random.PCG64(1))",
    "frame.random()",
)  # fmt: skip


@pytest.mark.parametrize("call", IMPURE)
def test_clocks_and_chance_are_found_at_their_line(call: str) -> None:
    assert [line for line, _ in impurities(f"{HEAD}x = {call}\n")] == [HEAD.count("\n") + 1]


@pytest.mark.parametrize("call", PURE)
def test_what_settings_decide_is_left_alone(call: str) -> None:
    assert list(impurities(f"{HEAD}x = {call}\n")) == []


def test_the_engine_may_ask_a_clock_and_a_scene_may_not(tmp_path: Path) -> None:
    simulations = tmp_path / "simulations"
    for name in ("engine/watch.py", "browser.py", "scenes/orbit/scene.py"):
        (simulations / name).parent.mkdir(parents=True, exist_ok=True)
        (simulations / name).write_text("import time\n\nx = time.time()\n")
    problems = Diagnostics()
    check_purity(simulations, problems)
    assert list(map(str, problems.found)) == [
        "simulations/scenes/orbit/scene.py:3: time.time() asks a clock; "
        "legal: what settings say alone"
    ]
