"""How long a frame takes when a slider moves, beside a fixed piece of work in NumPy.

Both take turns in one process and are timed on its thread's own clock, and of both the fastest
counts, so that other work on the machine matters little. `bench.drag` measures all sliders, in a
browser.
"""

import itertools
import json
import math
import time
from collections.abc import Callable, Iterator

import numpy as np
import pytest

from simulations import browser
from simulations.engine.controls import Slider
from simulations.registry import load_scene

FEWEST, LEAST_MS = 9, 800.0
"""How many frames are timed, and for how long at least."""
SLOWER = 1.6
"""Times as slow as it was that a frame may be: less than twice, more than machines differ."""
TIMES = {
    ("transform-2d", "pull_x"): 1.9,
    ("perspective-projection", "depth"): 11,
    ("camera-pose", "pan"): 12,
    ("gimbal", "tilt"): 9.1,
    ("lens-distortion", "k1"): 5.4,
    ("sensor-noise", "exposure"): 5.5,
}
"""How many times as long as the work a frame takes. Where it has become quicker, write the new
ratio here, which `pytest -rP` prints."""


def fixed_work() -> None:
    """Some arrays as large as a picture, and many small ones, as in a frame."""
    rows, columns = np.mgrid[0:120, 0:160] / 160.0
    light = np.linspace(0.0, 1.0, 256)
    for shift in range(6):
        picture = np.sqrt(rows * rows + (columns + shift) ** 2)
        light[np.rint(255.0 * np.clip(picture, 0.0, 1.0)).astype(np.uint8)].sum()
    matrix = np.eye(3)
    for _ in range(150):
        matrix = matrix @ np.array([[1.0, 0.001, 0.0], [-0.001, 1.0, 0.0], [0.0, 0.0, 1.0]])
        "".join(f"{number:.3f}" for number in matrix[0].tolist())


def thread_ms(work: Callable[[], object]) -> float:
    begun = time.thread_time()
    work()
    return (time.thread_time() - begun) * 1e3


def places(scene: str, name: str) -> Iterator[float]:
    """Places all over a slider, no two alike, so that no frame is at hand."""
    (slider,) = (control for control in load_scene(scene).controls if control.name == name)
    assert isinstance(slider, Slider)
    for place in itertools.count():
        share = math.modf(0.37 + place * 0.618034)[0]
        yield slider.minimum + share * (slider.maximum - slider.minimum)


def ratio(scene: str, name: str) -> float:
    """Of the quickest frame to the quickest piece of work."""

    def frame() -> object:
        values = json.dumps({name: next(moves)})
        return browser.render(f"times of {scene}", scene, values, "")

    moves = places(scene, name)
    frame()
    frames: list[float] = []
    works: list[float] = []
    while len(frames) < FEWEST or sum(frames) < LEAST_MS:
        frames.append(thread_ms(frame))
        works.append(thread_ms(fixed_work))
    return min(frames) / min(works)


@pytest.mark.parametrize(("scene", "name"), TIMES)
def test_frame_time_has_not_increased(scene: str, name: str) -> None:
    found = ratio(scene, name)
    print(f"{scene} {name}: {found:.3g} times as long as the work, {TIMES[scene, name]} before")
    assert found < SLOWER * TIMES[scene, name]
