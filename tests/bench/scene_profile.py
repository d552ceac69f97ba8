"""What each control of each figure costs: ``PYTHONPATH=tests python -m bench.scene_profile``.

For every scene, in the tier it settles in and the one it drafts in: the default frame with nothing
at hand, and for each control the frame after moving it by one step from the default, everything
else at hand. Times are of the processor, the fastest of several; set ``OPENBLAS_NUM_THREADS=1`` to
count one thread, as in the browser.

``--json FILE`` keeps the result, ``--against FILE`` prints it beside a kept one, also one that the
script of another commit has kept: ``cd OTHER; PYTHONPATH=tests python -m bench.scene_profile --json
before.json``.
"""

import argparse
import json
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from simulations.engine.controls import Action, Choice, Control, Slider, Value
from simulations.engine.frame import Frame
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from simulations.registry import SCENE_MODULES, load_scene

COLD = "(cold)"
"""Stands for a control where the whole frame was computed."""
FEWEST, MOST = 3, 9
"""Repeats of each measurement."""
BUDGET_S = 0.5
"""Time after which a measurement is not repeated more often than it must be."""


@dataclass(frozen=True, slots=True)
class Cost:
    """One row of the table."""

    scene: str
    tier: str
    """Empty where the scene has none."""
    control: str
    """The one that was moved, or `COLD`."""
    ms: float
    """Time of the processor."""
    computed: tuple[str, ...]
    """Stages that ran; none are reported by scenes that compute in one go."""

    @property
    def key(self) -> tuple[str, str, str]:
        return self.scene, self.tier, self.control


def one_step(control: Control) -> Value:
    """The value next to the default."""
    match control:
        case Slider(default=default, step=step, maximum=maximum):
            return default + step if default + step <= maximum else default - step
        case Choice(options=options, default=default):
            names = list(options)
            return names[(names.index(default) + 1) % len(names)]
        case Action(labels=labels):
            return 1 % len(labels)
        case _:
            return not control.default


def timed(
    scene: Scene[Any], tier: str, given: dict[str, Value], cache: StageCache
) -> tuple[float, Frame]:
    """Milliseconds of the processor that a frame took, and the frame."""
    settings = scene.check(given)
    begun = time.process_time()
    frame = scene.render(settings, tier, cache)
    return (time.process_time() - begun) * 1e3, frame


def measure(scene: Scene[Any], tier: str, control: Control | None) -> Cost:
    """The fastest of several frames, each after a default frame of its own unless cold."""
    given = {} if control is None else {control.name: one_step(control)}
    times: list[float] = []
    begun = time.perf_counter()
    while len(times) < FEWEST or (len(times) < MOST and time.perf_counter() - begun < BUDGET_S):
        cache = StageCache()
        if control is not None:
            timed(scene, tier, {}, cache)
        taken, frame = timed(scene, tier, given, cache)
        times.append(taken)
    computed = tuple(stage.name for stage in frame.stages if stage.status == "computed")
    name = COLD if control is None else control.name
    return Cost(scene.id, tier, name, round(min(times), 2), computed)


def profile(scene: Scene[Any]) -> Iterator[Cost]:
    """All rows of one scene."""
    for tier in dict.fromkeys((scene.default_tier, scene.draft_tier)):
        timed(scene, tier, {}, StageCache())  # whatever is prepared once only
        for control in (None, *scene.controls):
            yield measure(scene, tier, control)


def line(cost: Cost) -> str:
    """A row of the table."""
    stages = f"{len(cost.computed)}: {', '.join(cost.computed)}" if cost.computed else "–"
    return f"{cost.scene:24} {cost.tier:14} {cost.control:16} {cost.ms:8.2f}  {stages}"


def comparison(now: Sequence[Cost], before: Sequence[Cost]) -> Iterator[str]:
    """Rows of both runs side by side, then those that only one of them has."""
    old = {cost.key: cost for cost in before}
    yield f"{'scene':24} {'tier':14} {'control':16} {'before':>8} {'now':>8} {'ratio':>6}  stages"
    for cost in now:
        row = f"{cost.scene:24} {cost.tier:14} {cost.control:16}"
        if cost.key not in old:
            yield f"{row} {'–':>8} {cost.ms:8.2f} {'new':>6}  {len(cost.computed)}"
            continue
        was = old.pop(cost.key)
        ratio = f"{cost.ms / was.ms:6.2f}" if was.ms else f"{'–':>6}"
        stages = f"{len(was.computed)} → {len(cost.computed)}"
        yield f"{row} {was.ms:8.2f} {cost.ms:8.2f} {ratio}  {stages}"
    for cost in old.values():
        yield f"{cost.scene:24} {cost.tier:14} {cost.control:16} {cost.ms:8.2f} {'–':>8}   gone"


def write(costs: Iterable[Cost], file: Path) -> None:
    text = json.dumps([asdict(cost) for cost in costs], ensure_ascii=False, indent=1)
    file.write_text(text + "\n", encoding="utf-8")


def read(file: Path) -> list[Cost]:
    rows = json.loads(file.read_text(encoding="utf-8"))
    return [Cost(**{**row, "computed": tuple(row["computed"])}) for row in rows]


def main() -> None:
    parser = argparse.ArgumentParser(prog="bench.scene_profile", description=__doc__)
    parser.add_argument("--scene", action="append", choices=[*SCENE_MODULES], default=[])
    parser.add_argument("--json", type=Path, help="keep the result in this file")
    parser.add_argument("--against", type=Path, help="compare with a kept result")
    asked = parser.parse_args()
    costs: list[Cost] = []
    for name in asked.scene or SCENE_MODULES:
        for cost in profile(load_scene(name)):
            costs.append(cost)
            print(line(cost), flush=True)
    if asked.json:
        write(costs, asked.json)
    if asked.against:
        kept = [
            cost for cost in read(asked.against) if not asked.scene or cost.scene in asked.scene
        ]
        print("", *comparison(costs, kept), sep="\n")


if __name__ == "__main__":
    main()
