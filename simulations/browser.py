"""The only functions that the browser's worker calls."""

import json
from dataclasses import dataclass

from simulations.engine.controls import clamp_values
from simulations.engine.frame import Raster, to_json
from simulations.engine.pipeline import StageCache
from simulations.registry import load_scene

_caches: dict[str, StageCache] = {}


@dataclass(frozen=True, slots=True)
class Reply:
    """A frame on its way to the page."""

    meta: str
    """`simulations.engine.frame.to_json` of the frame."""
    rasters: tuple[Raster, ...]
    """Pixels of the panels that have any, in the panels' order."""


def render(figure: str, scene_id: str, values: str, tier: str) -> Reply:
    """One frame of ``scene_id`` for the figure named ``figure``.

    ``values`` is a JSON object of control values; what is left out takes its default and
    numbers out of range are clamped. Raises `UnknownSceneError` and `ControlError`.
    """
    scene = load_scene(scene_id)
    frame = scene.render(
        clamp_values(scene.controls, json.loads(values)),
        tier if tier in scene.tiers else scene.default_tier,
        _caches.setdefault(figure, StageCache()),
    )
    rasters = tuple(panel.raster for panel in frame.panels if panel.raster is not None)
    return Reply(to_json(frame), rasters)


def forget(figure: str) -> None:
    """Drop the stage cache of a figure that left the page."""
    _caches.pop(figure, None)
