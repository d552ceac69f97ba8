"""Frames of scenes, drawn in the pool and cached."""

import functools
import io
from base64 import b64encode
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from simulations.engine.frame import Frame, Raster, StageReport
from simulations.engine.scene import Scene
from simulations.engine.settings import values_of
from simulations.engine.stages import StageCache
from site_builder.cache.hashing import module_of
from site_builder.cache.results import cached
from site_builder.diagnostics.blame import at_settings, in_module
from site_builder.pool.processes import run_in_pool

type Values = Mapping[str, object]
"""Values of settings, by name."""
SMALL_PX = 320
"""The longer side of a small frame's pictures, at most."""
SMALL_QUALITY = 70


@dataclass(frozen=True, slots=True)
class Picture:
    """The pixels of a panel as a file."""

    width: int
    height: int
    webp: bytes
    """Without loss: it is what Python draws in the page."""


@dataclass(frozen=True, slots=True)
class StaticFrame:
    """A frame as a page shows it before Python has started."""

    frame: Frame
    """Without its pixels."""
    pictures: Mapping[str, Picture]
    """By panel, for panels that have pixels."""


@dataclass(frozen=True, slots=True)
class SmallFrame:
    """A frame to be shown for a moment: its pictures are small and lossy."""

    frame: Frame
    """Without its pixels."""
    pictures: Mapping[str, str]
    """By panel, as data URLs."""


@cached
def frame_at(scene: Scene[Any], settings: Any, tier: str) -> Frame:
    """The frame at these settings, without its pixels. Raises whatever the scene does, and
    `KilledError`."""
    return run_in_pool(functools.partial(_frame, scene, values_of(settings), tier), scene.id)


@cached
def static_frame(scene: Scene[Any], settings: Any, tier: str) -> StaticFrame:
    """The same with its pixels, as files."""
    return run_in_pool(functools.partial(_static_frame, scene, values_of(settings), tier), scene.id)


@cached
def small_frames(
    scene: Scene[Any], settings: Sequence[Values], tier: str
) -> tuple[SmallFrame, ...]:
    """The frames of several settings, one after the other. Raises whatever the scene does, and
    `KilledError`."""
    return run_in_pool(functools.partial(_small_frames, scene, settings, tier), scene.id)


@cached
def reports_at(scene: Scene[Any], start: Values, moved: Values) -> tuple[StageReport, ...]:
    """Which stages run again when controls move from ``start``."""
    return run_in_pool(functools.partial(_reports, scene, start, moved), scene.id)


def _frame(scene: Scene[Any], values: Values, tier: str) -> Frame:
    return _without_pixels(_rendered(scene, values, tier, StageCache()))


def _rendered(scene: Scene[Any], values: Values, tier: str, cache: StageCache) -> Frame:
    """Whatever it raises carries the settings that are not those at the start."""
    start, settings = values_of(scene.check({})), scene.check(values)
    now = values_of(settings)
    moved = {name: value for name, value in now.items() if value != start[name]}
    with at_settings(moved), in_module(module_of(scene) or ""):
        return scene.render(settings, tier, cache)


def _static_frame(scene: Scene[Any], values: Values, tier: str) -> StaticFrame:
    frame, settings = _rendered(scene, values, tier, StageCache()), scene.check(values)
    with in_module(module_of(scene) or ""):
        for place in frame.handles:  # a pull that raises shall do so now
            scene.pull(settings, place.name, (place.x, place.y), tier)
    pictures = {
        panel.name: Picture(panel.raster.shape[1], panel.raster.shape[0], webp(panel.raster))
        for panel in frame.panels
        if panel.raster is not None
    }
    return StaticFrame(_without_pixels(frame), pictures)


def _small_frames(
    scene: Scene[Any], settings: Sequence[Values], tier: str
) -> tuple[SmallFrame, ...]:
    cache = StageCache()
    return tuple(_small_frame(_rendered(scene, one, tier, cache)) for one in settings)


def _reports(scene: Scene[Any], start: Values, moved: Values) -> tuple[StageReport, ...]:
    cache = StageCache()
    reports = scene.run(scene.check(start), scene.accuracy.default, cache).reports
    if moved:
        reports = scene.run(scene.check({**start, **moved}), scene.accuracy.default, cache).reports
    return reports


def _small_frame(frame: Frame) -> SmallFrame:
    pictures = {
        panel.name: _small_picture(panel.raster, pixelated=panel.pixelated)
        for panel in frame.panels
        if panel.raster is not None
    }
    return SmallFrame(_without_pixels(frame), pictures)


def _small_picture(raster: Raster, *, pixelated: bool) -> str:
    """A raster as a data URL. Where the page shows its pixels as squares, it is lossless."""
    from PIL import Image  # here and below: only where something is not cached

    image, buffer = Image.fromarray(raster), io.BytesIO()
    if not pixelated:
        image.thumbnail((SMALL_PX, SMALL_PX))
    image.save(buffer, "WEBP", quality=SMALL_QUALITY, lossless=pixelated, method=4)
    return f"data:image/webp;base64,{b64encode(buffer.getvalue()).decode()}"


def _without_pixels(frame: Frame) -> Frame:
    return replace(frame, panels=tuple(replace(panel, raster=None) for panel in frame.panels))


def webp(raster: Raster) -> bytes:
    """A raster as a WebP that has all of it: three quarters of a PNG, and sooner packed."""
    from PIL import Image

    buffer = io.BytesIO()
    Image.fromarray(raster).save(buffer, "WEBP", lossless=True, exact=True, method=4)
    return buffer.getvalue()


def png(raster: Raster) -> bytes:
    """A raster as a PNG; without its alpha channel where all pixels are opaque."""
    from PIL import Image

    opaque = bool((raster[..., 3] == 255).all())
    buffer = io.BytesIO()
    Image.fromarray(raster[..., :3] if opaque else raster).save(buffer, "PNG", optimize=True)
    return buffer.getvalue()


def pixels(picture: bytes) -> Raster:
    """The pixels of a picture's file."""
    from PIL import Image

    with Image.open(io.BytesIO(picture)) as image:
        return np.asarray(image.convert("RGBA"))


def as_png(picture: bytes) -> bytes:
    """A picture as a PNG, for what supports no other kind."""
    return png(pixels(picture))
