"""Figures compared with plain JavaScript: ``PYTHONPATH=tests python -m bench.twins``.

Hand-written scripts (``js/twins.js``) draw the pictures of three figures from the same data; the
pictures are compared first. Then a script drags the slider of each, or chooses from its list, and
measures latencies as in `bench.drag`. The bound is on the ratio of the medians, so that drawings,
readouts and texts of the figure count against it. No latency is shorter than a display frame, so
the computing time is recorded as well.
"""

import base64
import statistics
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from bench.costs import store_section
from bench.drag import DRAG, MOVES, ROUNDS, figure_at_rest, hand_script, open_book, read_book
from numpy.typing import NDArray
from playwright.sync_api import JSHandle, Page

from simulations.engine.controls import Slider
from simulations.engine.frame import Raster
from simulations.engine.stages import StageCache
from simulations.registry import load_scene
from simulations.scenes._ball import CENTRE, HEIGHT, PIXELS_PER_UNIT, RADIUS_PX, WIDTH
from simulations.scenes.lens_distortion.stages import FOCAL_PX, HEIGHT_PX, MARGIN_PX, WIDTH_PX

FAR_CODES, FAR_SHARE = 2, 0.005
"""This share of a picture may differ by more than so many codes, at edges such as a rim."""
CHOOSE = "([drag, figure, hand]) => drag.choose({...hand, figure})"

INSTALL = """([twins, twin, given, slider]) => {
  const bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  const data = Object.fromEntries(Object.entries(given).map(([name, value]) => [name,
    value.floats ? new Float32Array(bytes(value.floats).buffer)
    : value.bytes ? bytes(value.bytes) : value]));
  const figure = document.createElement('div');
  const canvas = Object.assign(document.createElement('canvas'),
    {width: data.width, height: data.height});
  const hand = slider.options ? document.createElement('select')
    : Object.assign(document.createElement('input'), {type: 'range'});
  const {options = [], ...rest} = slider;
  hand.append(...options.map(option => new Option(option, option)));
  Object.assign(hand, rest);
  document.body.replaceChildren(figure);
  figure.append(canvas, hand);
  Object.assign(figure.dataset, {frames: 0, simulation: twin});
  figure.rests = true;
  const context = canvas.getContext('2d');
  const image = new ImageData(data.width, data.height);
  figure.draw = value => twins[twin](data, value, image.data);
  hand[slider.options ? 'onchange' : 'oninput'] = () => {
    const begun = performance.now();
    figure.draw(slider.options ? hand.value : hand.valueAsNumber);
    context.putImageData(image, 0, 0);
    figure.dataset.computeMs = performance.now() - begun;
    figure.dataset.frames = Number(figure.dataset.frames) + 1;
  };
  figure.pixels = value => {
    figure.draw(value);
    return btoa(Array.from(image.data, byte => String.fromCharCode(byte)).join(''));
  };
  return figure;
}"""


@dataclass(frozen=True, slots=True)
class Twin:
    """A picture drawn by Python and by plain JavaScript."""

    scene: str
    control: str
    function: str
    """Name in ``js/twins.js``."""
    panel: str
    given: Mapping[str, Any]
    """Data for the script, computed once."""
    entries: tuple[str, ...] = ()
    """For a list in place of a slider: the entry that is timed, then others that push it out of the
    cache."""
    settings: Mapping[str, Any] = field(default_factory=dict)
    """Values of the other controls."""

    @property
    def values(self) -> tuple[Any, ...]:
        """Values of the control at which both pictures are compared."""
        if self.entries:
            return self.entries[:1]
        slider = slider_of(self)
        return (slider.minimum / 2, slider.maximum / 2)

    @property
    def hand(self) -> dict[str, Any]:
        """Properties of the plain control."""
        if self.entries:
            return {"name": self.control, "options": [*self.entries]}
        slider = slider_of(self)
        ends = {"min": slider.minimum, "max": slider.maximum, "step": slider.step}
        return {"name": self.control, **{name: str(value) for name, value in ends.items()}}


def text(array: NDArray[Any]) -> str:
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode()


def lens_distortion() -> Twin:
    scene = load_scene("lens-distortion")
    outputs = scene.run(scene.check({"k1": -0.1}), "", StageCache()).outputs
    given = {
        "width": WIDTH_PX,
        "height": HEIGHT_PX,
        "marginX": MARGIN_PX[0],
        "marginY": MARGIN_PX[1],
        "focal": FOCAL_PX,
        "picture": {"floats": text(outputs["pinhole"].astype(np.float32))},
    }
    return Twin("lens-distortion", "k1", "distortion", "picture", given)


def matte_ball() -> Twin:
    scene = load_scene("lambertian-shading")
    settings = scene.check({})
    outputs = scene.run(settings, "", StageCache()).outputs
    ball, scale = outputs["body"], PIXELS_PER_UNIT
    wall = np.zeros((*ball.backdrop.shape[:2], 3), np.float32)
    wall[ball.square][ball.rim] = ball.behind_rim
    given = {
        "width": round(WIDTH * scale),
        "height": round(HEIGHT * scale),
        "centreX": CENTRE[0] * scale,
        "centreY": CENTRE[1] * scale,
        "radius": RADIUS_PX,
        "albedo": settings.albedo,
        "backdrop": {"bytes": text(ball.backdrop)},
        "wall": {"floats": text(wall)},
    }
    return Twin("lambertian-shading", "light_angle", "sphere", "camera", given)


def bilinear_mosaic() -> Twin:
    scene = load_scene("bayer-demosaic")
    settings = {"split": 1}
    outputs = scene.run(scene.check(settings), "", StageCache()).outputs
    height, width = outputs["mosaic"].shape
    cells = {"floats": text(outputs["mosaic"].astype(np.float32))}
    given = {"width": width, "height": height, "cells": cells}
    entries = ("bilinear", "nearest", "malvar")
    return Twin(*("bayer-demosaic", "method", "demosaic", "picture", given), *(entries, settings))


TWINS = (lens_distortion, matte_ball, bilinear_mosaic)


def slider_of(twin: Twin) -> Slider:
    (found,) = (each for each in load_scene(twin.scene).controls if each.name == twin.control)
    assert isinstance(found, Slider)
    return found


def expected(twin: Twin, value: Any) -> Raster:
    """The picture drawn by Python."""
    scene = load_scene(twin.scene)
    frame = scene.render(scene.check({**twin.settings, twin.control: value}), "", StageCache())
    (raster,) = (panel.raster for panel in frame.panels if panel.name == twin.panel)
    assert raster is not None
    return raster


def install(page: Page, twin: Twin) -> JSHandle:
    """Install the twin on the page as a figure with a control; raises `SystemExit` if its pictures
    differ."""
    figure = page.evaluate_handle(
        INSTALL, [hand_script(page, "twins.js"), twin.function, twin.given, twin.hand]
    )
    for value in twin.values:
        pixels = figure.evaluate("(figure, value) => figure.pixels(value)", value)
        drawn = np.frombuffer(base64.b64decode(pixels), np.uint8).astype(int)
        ours = expected(twin, value).reshape(-1).astype(int)
        far = float(np.mean(np.abs(drawn - ours) > FAR_CODES))
        if far > FAR_SHARE:
            raise SystemExit(f"{twin.function} at {value}: {far:.1%} of the codes differ")
    return figure


def medians(page: Page, twin: Twin, figure: JSHandle) -> tuple[float, float]:
    """Medians in milliseconds of the latency and of the computing time."""
    drag = hand_script(page)
    if twin.entries:
        value, *others = twin.entries
        hand = {"value": value, "others": others, "rounds": 4 * MOVES}
        found = page.evaluate(CHOOSE, [drag, figure, {"name": twin.control, **hand}])
    else:
        hand = {"moves": MOVES, "rounds": 2 * ROUNDS}
        found = page.evaluate(DRAG, [drag, figure, {"name": twin.control, **hand}])
    return statistics.median(found["latencies"]), statistics.median(found["computes"])


def main() -> None:
    chapters = read_book()["chapters"]
    found: dict[str, dict[str, float]] = {}
    with open_book() as (page, address):
        for make in TWINS:
            twin = make()
            url = next(each["url"] for each in chapters if twin.scene in each["simulations"])
            page.goto(address + url)
            figure = figure_at_rest(page, twin.scene)
            python, whole = medians(page, twin, figure)
            plain, loop = medians(page, twin, install(page, twin))
            ratio = round(python / plain, 2)
            found[twin.scene] = {
                "ms": round(python, 1),
                "plain_ms": round(plain, 1),
                "ratio": ratio,
                "compute_ms": round(whole, 1),
                "plain_compute_ms": round(loop, 1),
            }
            print(
                f"{twin.scene:20} {twin.control:12} figure {python:5.1f} ms, plain JavaScript "
                f"{plain:5.1f} ms: × {ratio:.2f} (computing {whole:.1f} and {loop:.1f} ms)"
            )
    store_section("twins", found)


if __name__ == "__main__":
    main()
