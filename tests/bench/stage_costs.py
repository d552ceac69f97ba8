"""The cost of moving one control: ``PYTHONPATH=tests python -m bench.stage_costs``.

Of the camera as a share of a whole frame, for the book's table; of every scene with levels at each
of them, from which pages expect the first times of a device.

The frame after the move and the same frame with an empty cache are computed alternately, so that
other work on the machine affects both; the fastest of each counts, in processor time. The results
go into ``content/stage-costs.json``, from which the book's table is made.
"""

import time
from pathlib import Path
from typing import Any

from simulations.engine.controls import Slider, Value
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from simulations.registry import SCENE_MODULES, load_scene
from site_builder.benchmarks.measuring import significant, write

DATA = Path(__file__).resolve().parents[2] / "content" / "stage-costs.json"
PAIRS = 9

SCENE: Scene[Any] = load_scene("camera")
START: dict[str, Value] = {"aperture": 2.0, "k1": -0.1}
"""Settings at which no stage is neutral."""
MOVES: dict[str, Value] = {
    "noise_sigma": 6.0, "exposure": 0.1, "k1": -0.11, "aperture": 2.1, "light_angle": 41.0,
    "focus": 3.3, "focal_length": 51.0, "back": 0.1,
}  # fmt: skip
"""One step of each slider, from the cheapest to the costliest."""


TIMES = 3
"""Frames of each control and level, of which the fastest counts."""


def time_frame(
    given: dict[str, Value], cache: StageCache, scene: Scene[Any] = SCENE, level: str = ""
) -> float:
    settings = scene.check(given)
    begun = time.process_time()
    scene.render(settings, level, cache)
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


def level_costs(scene: Scene[Any], level: str) -> dict[str, float]:
    """Milliseconds of a frame from scratch, named by nothing, and after a step of each slider."""
    sliders = [control for control in scene.controls if isinstance(control, Slider)]
    time_frame({}, StageCache(), scene, level)
    found = {"": min(time_frame({}, StageCache(), scene, level) for _ in range(TIMES))}
    for slider in sliders:
        cache = StageCache()
        time_frame({}, cache, scene, level)
        back = -1 if slider.default + TIMES * slider.step > slider.maximum else 1
        places = [slider.default + back * slider.step * k for k in range(1, TIMES + 1)]
        found[slider.name] = min(
            time_frame({slider.name: place}, cache, scene, level)
            for place in places
            if slider.minimum <= place <= slider.maximum
        )
    return {name: significant(ms, 3) for name, ms in found.items()}


def main() -> None:
    time_frame(START, StageCache())  # prepares tables that are computed only once
    moves = {}
    for control, value in MOVES.items():
        moves[control] = {"to": value, **measure_move({control: value})}
        print(f"{control} {moves[control]}")
    data: dict[str, dict[str, Any]] = {SCENE.id: {"start": START, "moves": moves}}
    for scene in map(load_scene, SCENE_MODULES):
        levels = {name: level_costs(scene, name) for name in scene.accuracy.names}
        if levels:
            print(f"{scene.id} {levels}")
            data[scene.id] = {**data.get(scene.id, {}), "levels": levels}
    write(data, DATA)


if __name__ == "__main__":
    main()
