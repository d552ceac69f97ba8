"""Frames of scenes: drawn within limits, and cached."""

import functools
import io
from base64 import b64encode
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from simulations.engine.frame import Frame, Raster, StageReport
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from site_builder.cache import cached
from site_builder.sandbox import run_limited

SKETCH_PX = 320
"""The longer side of a sketch's pictures, at most."""
SKETCH_QUALITY = 70


@dataclass(frozen=True, slots=True)
class Picture:
    """The pixels of a panel as a file."""

    width: int
    height: int
    webp: bytes
    """Without loss: it is what Python draws in the page."""


@dataclass(frozen=True, slots=True)
class Print:
    """A frame as a page shows it before it comes alive."""

    frame: Frame
    """Without its pixels."""
    pictures: Mapping[str, Picture]
    """By panel; of those that have pixels."""


@dataclass(frozen=True, slots=True)
class Sketch:
    """A frame for the moment: its pixels are small, and not exact."""

    frame: Frame
    """Without its pixels."""
    pictures: Mapping[str, str]
    """Their addresses by panel, with the pictures in them."""


@cached
def frame_at(scene: Scene[Any], settings: Any, tier: str) -> Frame:
    """What the scene says and draws at these settings, without its pixels. Raises whatever the
    scene does, and `LimitError`."""
    return run_limited(functools.partial(_frame, scene, settings, tier))


@cached
def print_at(scene: Scene[Any], settings: Any, tier: str) -> Print:
    """The same with its pixels, as files."""
    return run_limited(functools.partial(_print, scene, settings, tier))


@cached
def sketches_at(
    scene: Scene[Any], settings: Sequence[Mapping[str, object]], tier: str
) -> tuple[Sketch, ...]:
    """The frames of several settings, one after the other. Raises whatever the scene does, and
    `LimitError`."""
    return run_limited(functools.partial(_sketches, scene, settings, tier))


@cached
def reports_at(
    scene: Scene[Any], start: Mapping[str, object], moved: Mapping[str, object]
) -> tuple[StageReport, ...]:
    """What becomes of each stage when controls move from ``start``."""
    return run_limited(functools.partial(_reports, scene, start, moved))


def _frame(scene: Scene[Any], settings: Any, tier: str) -> Frame:
    return _without_pixels(scene.render(settings, tier, StageCache()))


def _print(scene: Scene[Any], settings: Any, tier: str) -> Print:
    frame = scene.render(settings, tier, StageCache())
    for place in frame.handles:  # a pull that raises would do so in its reader's hand
        scene.pull(settings, place.name, (place.x, place.y), tier)
    pictures = {
        panel.name: Picture(panel.raster.shape[1], panel.raster.shape[0], webp(panel.raster))
        for panel in frame.panels
        if panel.raster is not None
    }
    return Print(_without_pixels(frame), pictures)


def _sketches(
    scene: Scene[Any], settings: Sequence[Mapping[str, object]], tier: str
) -> tuple[Sketch, ...]:
    cache = StageCache()
    return tuple(_sketch(scene.render(scene.check(one), tier, cache)) for one in settings)


def _reports(
    scene: Scene[Any], start: Mapping[str, object], moved: Mapping[str, object]
) -> tuple[StageReport, ...]:
    cache = StageCache()
    reports = scene.run(scene.check(start), scene.default_tier, cache).reports
    if moved:
        reports = scene.run(scene.check({**start, **moved}), scene.default_tier, cache).reports
    return reports


def _sketch(frame: Frame) -> Sketch:
    pictures = {
        panel.name: _small(panel.raster, pixelated=panel.pixelated)
        for panel in frame.panels
        if panel.raster is not None
    }
    return Sketch(_without_pixels(frame), pictures)


def _small(raster: Raster, *, pixelated: bool) -> str:
    """A raster as an address that holds it. Where the page shows its pixels as squares, each stays
    what it is."""
    from PIL import Image  # here and below: a book without pictures does without

    image, buffer = Image.fromarray(raster), io.BytesIO()
    if not pixelated:
        image.thumbnail((SKETCH_PX, SKETCH_PX))
    image.save(buffer, "WEBP", quality=SKETCH_QUALITY, lossless=pixelated, method=4)
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
    """A raster as a PNG; without its alpha channel where that says nothing."""
    from PIL import Image

    opaque = bool((raster[..., 3] == 255).all())
    buffer = io.BytesIO()
    Image.fromarray(raster[..., :3] if opaque else raster).save(buffer, "PNG", optimize=True)
    return buffer.getvalue()


def as_png(picture: bytes) -> bytes:
    """A picture as a PNG, for what knows no other kind."""
    from PIL import Image

    with Image.open(io.BytesIO(picture)) as image:
        return png(np.asarray(image.convert("RGBA")))
