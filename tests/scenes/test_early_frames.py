"""What a figure shows before Python has started is what Python would show."""

import json
from typing import Any

import pytest

from simulations.engine.frame import to_json
from simulations.engine.scene import Scene
from simulations.engine.settings import values_of
from simulations.engine.stages import StageCache
from simulations.registry import SCENE_MODULES, load_scene
from site_builder.document.blocks import Simulation
from site_builder.document.places import Passage
from site_builder.figures import initial_frames as prerendered_frames


@pytest.mark.parametrize("scene", SCENE_MODULES)
def test_each_frame_says_and_draws_what_its_scene_does(
    scene: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Only the ends are prepared, so that none is drawn between."""
    monkeypatch.setattr(prerendered_frames, "FRAMES", 2)
    of: Scene[Any] = load_scene(scene)
    start = values_of(of.check({}))
    figure = Simulation(of, f"figure-{scene}", {}, of.default_tier, Passage(), "", 1)
    strip = prerendered_frames.prerender("page", figure)
    if strip is None:
        return
    cache = StageCache()
    told = json.loads(strip.data)
    for frame in (told["frames"][0], told["frames"][-1]):
        settings = of.check({**start, told["control"]: frame["value"]})
        truth = json.loads(to_json(of.render(settings, of.default_tier, cache)))
        assert frame["readouts"] == truth["readouts"]
        assert frame["description"] == truth["description"]
        assert [panel["overlay"] for panel in frame["panels"]] == [
            panel["overlay"] for panel in truth["panels"]
        ]
