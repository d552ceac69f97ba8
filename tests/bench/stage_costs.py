"""What one moved control costs of a whole frame: ``PYTHONPATH=tests python -m bench.stage_costs``.

The frame after the move, and the same frame with nothing at hand, take turns, so that a busy
moment of the machine falls on both; of each, the fastest counts, in time of the processor. What is
found goes into ``content/stage-costs.json``, from which the book's table is made.
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

START: dict[str, dict[str, Value]] = {"camera": {"aperture": 2.0, "k1": -0.1}}
"""Settings at which no stage is neutral."""
MOVES: dict[str, dict[str, Value]] = {
    "camera": {
        "noise_sigma": 6.0,
        "exposure": 0.1,
        "k1": -0.11,
        "aperture": 2.1,
        "light_angle": 41.0,
        "focus": 3.3,
        "focal_length": 51.0,
        "back": 0.1,
    }
}
"""One step of each slider, from the cheapest to the costliest."""


def time_frame(scene: Scene[Any], given: dict[str, Value], cache: StageCache) -> float:
    settings = scene.check(given)
    begun = time.process_time()
    scene.render(settings, scene.default_tier, cache)
    return (time.process_time() - begun) * 1e3


def measure_move(
    scene: Scene[Any], start: dict[str, Value], moved: dict[str, Value]
) -> dict[str, float]:
    whole, after = [], []
    for _ in range(PAIRS):
        warm, cold = StageCache(), StageCache()
        time_frame(scene, start, warm)
        after.append(time_frame(scene, {**start, **moved}, warm))
        whole.append(time_frame(scene, {**start, **moved}, cold))
    fastest, fastest_whole = min(after), min(whole)
    return {
        "ms": round(fastest, 2),
        "whole_ms": round(fastest_whole, 2),
        "share": round(fastest / fastest_whole, 4),
    }


def measure(scene_id: str) -> dict[str, object]:
    """All moves of a scene."""
    scene, start = load_scene(scene_id), START[scene_id]
    time_frame(scene, start, StageCache())  # whatever is prepared once only
    moves = {}
    for control, value in MOVES[scene_id].items():
        moves[control] = {"to": value, **measure_move(scene, start, {control: value})}
        print(f"{scene_id}: {control} {moves[control]}")
    return {"start": start, "moves": moves}


if __name__ == "__main__":
    write({scene_id: measure(scene_id) for scene_id in MOVES}, DATA)
