"""Every figure, every control and every handle in the engines that the other tests do not use."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import pytest
from support.engines import ENGINES, HOW_TO
from support.engines.engine import Engine, drag, wait_for
from support.hands import PULLS
from support.page_scripts import FOLLOW, GRASP, OFFER, PUT_BACK, SETTLE, TRY_CONTROLS
from support.reader import chapter_of
from support.reading_order import SHOWN
from support.static_server import StaticServer

from simulations.registry import load_scene

pytestmark = [pytest.mark.browser, pytest.mark.deep]


@dataclass
class Walk:
    """A reader who goes from figure to figure; Python stays alive."""

    engine: Engine
    root: str
    complained: int = 0

    def go_to(self, chapter: str, scene: str) -> None:
        """To a figure that lives, as its page has put it."""
        address = self.root + chapter
        if not self.engine.ask(HERE, address):
            self.engine.ask(OFFER, address)
            self.engine.ask(FOLLOW, address)
            wait_for(self.engine, HERE, address)
        wait_for(self.engine, LIVES, scene)
        self.of_figure(PUT_BACK, scene)
        self.of_figure(SETTLE, scene)

    def of_figure(self, script: str, scene: str, /, *given: Any) -> Any:
        """What a script of a figure tells."""
        return self.engine.ask(OF_FIGURE.replace("SCRIPT", script), scene, *given)

    def grasp(self, scene: str, handle: str) -> Any:
        return self.of_figure(OF_HANDLE.replace("SCRIPT", GRASP), scene, handle)

    def complaints(self) -> list[str]:
        """Since this was last asked."""
        known, told = self.complained, self.engine.complaints()
        self.complained = len(told)
        return told[known:]


HERE = "(url) => location.href.split('?')[0] === url && document.activeElement.id === 'main'"
LIVES = "(scene) => document.querySelector(`#figure-${scene} [data-state=live]`) !== null"
OF_FIGURE = """(scene, ...given) =>
  (SCRIPT)(document.querySelector(`#figure-${scene} simulation-figure`), ...given)"""
OF_HANDLE = "(figure, handle) => (SCRIPT)(figure.querySelector(`[data-handle='${handle}']`))"


@pytest.fixture(scope="module", params=ENGINES)
def walk(
    request: pytest.FixtureRequest,
    site_server: StaticServer,
    tmp_path_factory: pytest.TempPathFactory,
) -> Iterator[Walk]:
    opened = ENGINES[request.param](tmp_path_factory.mktemp(request.param))
    if opened is None:
        pytest.skip(f"{request.param}: {HOW_TO}")
    with opened as engine:
        engine.open(site_server.url + "lecture-plan/")  # the lightest page
        yield Walk(engine, site_server.url)


@pytest.mark.parametrize("scene", dict.fromkeys(SHOWN))
def test_every_control_is_answered_and_every_handle_follows(
    walk: Walk, book: Any, scene: str
) -> None:
    walk.go_to(chapter_of(book, scene), scene)
    controls = next(each for each in book["simulations"] if each["id"] == scene)["controls"]
    wrong = [
        f"{told['name']}: {told}"
        for told in walk.of_figure(TRY_CONTROLS, scene, controls)
        if not (told["hit"] and told["focused"] and told["frames"] > 0)
    ]
    walk.go_to(chapter_of(book, scene), scene)
    names = [handle.name for handle in load_scene(scene).handles]
    wrong += [f"{name} does not follow" for name in names if not follows(walk, scene, name)]
    assert wrong + walk.complaints() == []


def follows(walk: Walk, scene: str, handle: str) -> bool:
    """Whether a handle, where it is shown, moves its settings when it is pulled."""
    start, width = walk.grasp(scene, handle), walk.engine.ask("() => innerWidth")
    for right, down in PULLS if start["shown"] else ():
        x, y = start["x"], start["y"]
        drag(walk.engine, (x, y), (min(x + right, width - 1), y + down))
        pulled = walk.grasp(scene, handle)
        if pulled["values"] != start["values"]:
            return bool(pulled["frames"] > start["frames"])
        start = pulled
    return not start["shown"]
