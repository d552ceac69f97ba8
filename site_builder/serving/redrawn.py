"""What a book shows of scenes whose code has changed: one frame is asked for after the other as the
book is read, but all of them can be drawn at once, on all cores, before."""

from collections.abc import Collection, Iterable, Iterator
from contextlib import suppress
from functools import partial

from simulations.engine.controls import ControlError
from simulations.registry import SCENE_MODULES, load_scene
from site_builder.benchmarks.loading import loaded
from site_builder.drawing.frames import Drawn, drawn_of
from site_builder.editor.sources import scene_sources
from site_builder.kept.ahead import Ask


def redrawn(modules: Collection[str], asked: Iterable[str]) -> list[Ask]:
    """Asks again for what of all that was ``asked`` is of the scenes that lie in ``modules``: what
    came last first, since that is the pictures, which take longest."""
    before = [*asked]
    changed = [key for key, name in SCENE_MODULES.items() if name in modules]
    return [ask for key in changed for ask in _asks(key, before)]


def _asks(scene_id: str, asked: Iterable[str]) -> Iterator[Ask]:
    before = drawn_of(scene_id, asked)
    if before:
        yield partial(_read, scene_id)
    yield from (partial(_draw, scene_id, drawn) for drawn in reversed(before))


def _draw(scene_id: str, drawn: Drawn) -> None:
    """Whatever is wrong with the scene now is met by who asks next, and told with its place."""
    draw, values, tier = drawn
    with suppress(LookupError, ControlError):
        scene = loaded("simulation", scene_id, load_scene, LookupError)
        draw(scene, scene.check(dict(values)), tier)


def _read(scene_id: str) -> None:
    with suppress(LookupError):
        scene_sources(loaded("simulation", scene_id, load_scene, LookupError))
