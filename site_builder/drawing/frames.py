"""Frames of scenes: drawn within limits, and kept."""

import io
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from PIL import Image

from simulations.engine.frame import Frame, Raster, StageReport
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from site_builder.drawing.apart import apart
from site_builder.kept.keeper import kept


@dataclass(frozen=True, slots=True)
class Picture:
    """The pixels of a panel as a file."""

    width: int
    height: int
    png: bytes


@dataclass(frozen=True, slots=True)
class Print:
    """A frame as a page shows it before it comes alive."""

    frame: Frame
    """Without its pixels."""
    pictures: Mapping[str, Picture]
    """By panel; of those that have pixels."""


@kept
def frame_at(scene: Scene[Any], settings: Any, tier: str) -> Frame:
    """What the scene says and draws at these settings, without its pixels. Raises whatever the
    scene does, and `LimitError`."""
    return apart(lambda: _without_pixels(scene.render(settings, tier, StageCache())))


@kept
def print_at(scene: Scene[Any], settings: Any, tier: str) -> Print:
    """The same with its pixels, as files."""

    def drawn() -> Print:
        frame = scene.render(settings, tier, StageCache())
        pictures = {
            panel.name: Picture(panel.raster.shape[1], panel.raster.shape[0], png(panel.raster))
            for panel in frame.panels
            if panel.raster is not None
        }
        return Print(_without_pixels(frame), pictures)

    return apart(drawn)


@kept
def reports_at(
    scene: Scene[Any], start: Mapping[str, object], moved: Mapping[str, object]
) -> tuple[StageReport, ...]:
    """What becomes of each stage when controls move from ``start``."""

    def run() -> tuple[StageReport, ...]:
        cache = StageCache()
        reports = scene.run(scene.check(start), scene.default_tier, cache).reports
        if moved:
            reports = scene.run(scene.check({**start, **moved}), scene.default_tier, cache).reports
        return reports

    return apart(run)


def _without_pixels(frame: Frame) -> Frame:
    return replace(frame, panels=tuple(replace(panel, raster=None) for panel in frame.panels))


def png(raster: Raster) -> bytes:
    """A raster as a PNG; without its alpha channel where that says nothing."""
    opaque = bool((raster[..., 3] == 255).all())
    buffer = io.BytesIO()
    Image.fromarray(raster[..., :3] if opaque else raster).save(buffer, "PNG", optimize=True)
    return buffer.getvalue()
