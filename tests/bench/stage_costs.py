"""The cost of moving one control, as a share of a whole frame:
``PYTHONPATH=tests python -m bench.stage_costs``.

The frame after the move and the same frame with an empty cache are computed alternately, so that
other work on the machine affects both; the fastest of each counts, in processor time. The results
go into ``content/stage-costs.json``, from which the book's table is made.
"""

import time
from pathlib import Path
from typing import Any

from simulations.engine.controls import Value
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from simulations.registry import load_scene
from site_builder.benchmarks.measuring import write

DATA = Path(__file__).resolve().parents[2] / "content" / "stage-costs.json"
PAIRS = 9

SCENE: Scene[Any] = load_scene("camera")
START: dict[str, Value] = {"aperture": 2.0, "k1": -0.1}
"""Settings at which no stage is neutral."""
MOVES: dict[str, Value] = {
    "noise_sigma": 6.0,
    "exposure": 0.1,
    "k1": -0.11,
    "aperture": 2.1,
    "light_angle": 41.0,
    "focus": 3.3,
    "focal_length": 51.0,
    "back": 0.1,
}
"""One step of each slider, from the cheapest to the costliest."""


def time_frame(given: dict[str, Value], cache: StageCache) -> float:
    settings = SCENE.check(given)
    begun = time.process_time()
    SCENE.render(settings, SCENE.accuracy.default, cache)
    return (time.process_time() - begun) * 1e3


def measure_move(moved: dict[str, Value]) -> dict[str, float]:
    whole, after = [], []
    for _ in range(PAIRS):
        warm, cold = StageCache(), StageCache()
        time_frame(START, warm)
        after.append(time_frame({**START, **moved}, warm))
        whole.append(time_frame({**START, **moved}, cold))
    fastest, fastest_whole = min(after), min(whole)
    return {
        "ms": round(fastest, 2),
        "whole_ms": round(fastest_whole, 2),
        "share": round(fastest / fastest_whole, 4),
    }


def main() -> None:
    time_frame(START, StageCache())  # prepares tables that are computed only once
    moves = {}
    for control, value in MOVES.items():
        moves[control] = {"to": value, **measure_move({control: value})}
        print(f"{control} {moves[control]}")
    write({SCENE.id: {"start": START, "moves": moves}}, DATA)


if __name__ == "__main__":
    main()
