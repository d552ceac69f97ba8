"""Scenes rendered in CPython and in Pyodide in Chromium, at the same settings.

Every scene of the registry, at its defaults, in each tier, and with each control at each of its
ends (in ``make test``, tiers and ends of some scenes). The C libraries of the two may differ in the
last place of a float, so a limited share of pixels may differ by one code, and one pixel in ten
thousand by more, where a ray grazes an edge; texts and drawings are rounded and must be equal.
"""

import base64
import json
from hashlib import sha256
from typing import Any

import numpy as np
import pytest
from support.reader import Reader

from simulations import browser as native
from simulations.engine.controls import Control
from simulations.registry import SCENE_MODULES, load_scene

pytestmark = pytest.mark.browser

PAGE = "lecture-plan/"
LARGEST_SHARE_OF_GRAZED_PIXELS = 1e-4
LARGEST_SHARE_OF_DIFFERENT_CODES = 1e-3

ENDS_OF = ("aliasing", "lens-distortion", "perspective-projection")
"""Scenes whose tiers and controls `make test` also compares: random numbers, a warp, a drawing."""

RENDER = """async ([figure, scene, values, tier, digests]) => {
  const {sharedRuntime} = (await customElements.whenDefined('simulation-figure')).internals;
  const reply = await sharedRuntime().call('render', {figure, scene, values, tier});
  const encode = async (buffer, number) => {
    const digest = new Uint8Array(await crypto.subtle.digest('SHA-256', buffer)).toHex();
    return digest === digests[number] ? null : new Uint8Array(buffer).toBase64();
  };
  return {meta: reply.meta, rasters: await Promise.all(reply.rasters.map(encode))};
}"""
"""A raster with the given digest is not transferred, as most rasters are equal byte by byte."""


@pytest.fixture
def resident(guest: Reader) -> Reader:
    """The reader on a page without figures, opened once for all tests."""
    if not guest.page.url.endswith(PAGE):
        guest.turn_to(PAGE, live=False)
    return guest


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_scene_is_the_same_in_the_browser(resident: Reader, scene_id: str) -> None:
    assert_same_in_browser(resident, scene_id, [({}, load_scene(scene_id).accuracy.default)])


@pytest.mark.parametrize(
    "scene_id",
    [
        pytest.param(scene_id, marks=[] if scene_id in ENDS_OF else pytest.mark.deep)
        for scene_id in SCENE_MODULES
    ],
)
def test_tiers_and_ends_of_controls_are_the_same_in_the_browser(
    resident: Reader, scene_id: str
) -> None:
    scene = load_scene(scene_id)
    moved = [{control.name: value} for control in scene.controls for value in ends(control)]
    at_ends = [(values, scene.accuracy.default) for values in moved]
    assert_same_in_browser(
        resident, scene_id, [*(({}, tier) for tier in scene.accuracy.names), *at_ends]
    )


def assert_same_in_browser(
    resident: Reader, scene_id: str, settings: list[tuple[dict[str, Any], str]]
) -> None:
    resident.page.evaluate(
        RENDER, [f"{scene_id}-ahead", scene_id, "{}", "", []]
    )  # uses up the frame computed in advance
    for values, tier in settings:
        given = json.dumps(values)
        ours = native.render(scene_id, scene_id, given, tier)
        digests = [sha256(raster.tobytes()).hexdigest() for raster in ours.rasters]
        theirs = resident.page.evaluate(RENDER, [scene_id, scene_id, given, tier, digests])
        where = f"{scene_id} {given} {tier}"
        assert json.loads(theirs["meta"]) == json.loads(ours.meta), where
        assert len(theirs["rasters"]) == len(ours.rasters), where
        for raster, encoded in zip(ours.rasters, theirs["rasters"], strict=True):
            if encoded is not None:
                _assert_same_pixels(raster, base64.b64decode(encoded), where)


def ends(control: Control) -> list[Any]:
    """The control's extreme states, except its default."""
    return [end for end in control.extremes() if end != control.default]


def _assert_same_pixels(ours: np.ndarray, encoded: bytes, where: str) -> None:
    theirs = np.frombuffer(encoded, np.uint8).reshape(ours.shape)
    difference = np.abs(ours.astype(np.int16) - theirs.astype(np.int16))
    wrong = float(np.mean(difference.max(axis=-1) > 1))
    assert wrong <= LARGEST_SHARE_OF_GRAZED_PIXELS, f"{where}: {wrong:.3%} of pixels differ"
    share = np.count_nonzero(difference) / difference.size
    assert share <= LARGEST_SHARE_OF_DIFFERENT_CODES, f"{where}: {share:.2%} of codes differ"
