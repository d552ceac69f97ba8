"""The chain backwards: the ambiguity of each link's inverse."""

import math

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import dot, line
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis, Plot
from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb

WIDTH, HEIGHT, ROW, TOP = 400.0, 346.0, 46.0, 24.0
FIELD = (222.0, 388.0)  # left and right edge of the column of ambiguities
LINKS = ("pose", "projection", "lens", "pixel grid", "light", "sensor", "file")
LEFT_OPEN = (
    "one point", "a ray", "one point", "waves that agree there", "paint or light", "a probability",
    "a short interval",
)  # fmt: skip


def _point(plot: Plot) -> list[str]:
    return [dot(plot.at(0.5, 0.0), "world", 5)]


def _ray(plot: Plot) -> list[str]:
    return [line(plot.at(0, 0), plot.at(1, 0), "world bold"), dot(plot.at(0, 0), "camera", 4)]


def _waves(plot: Plot) -> list[str]:
    x, samples = np.linspace(0, 1, 200), np.arange(6) / 5
    marks = [plot.curve(x, 0.9 * np.cos(2 * np.pi * n * x), "world thin") for n in (1, 4)]
    places = [plot.at(float(s), 0.9 * math.cos(2 * math.pi * s)) for s in samples]
    return marks + [dot(place, "image", 3) for place in places]


def _pairs(plot: Plot) -> list[str]:
    light = np.linspace(0.02, 1, 300)
    return [plot.curve(light, -1 + 0.16 / light, "world bold")]


def _bell(plot: Plot) -> list[str]:
    z = np.linspace(-4, 4, 121)
    density: Floats = np.exp(-0.5 * z * z)
    return [plot.area((z + 4) / 8, 2 * density - 1, "world fill")]


def _interval(plot: Plot) -> list[str]:
    low, high = (float(decode_srgb(code / 255)) for code in (148.5, 149.5))
    edges = [0.5 + 14 * (value - 0.5 * (low + high)) for value in (low, high)]
    ends = [line(plot.at(x, -0.5), plot.at(x, 0.5), "world") for x in edges]
    return [line(plot.at(edges[0], 0), plot.at(edges[1], 0), "world bold"), *ends]


SHOWN = (_point, _ray, _point, _waves, _pairs, _bell, _interval)


def draw() -> Illustration:
    marks = []
    for index, (name, open_, show) in enumerate(zip(LINKS, LEFT_OPEN, SHOWN, strict=True)):
        y = TOP + ROW * index
        plot = Plot(Axis(0, 1, *FIELD), Axis(-1.0, 1.0, y + 15, y - 15))
        if index:
            marks.append(line((8, y - ROW / 2), (392, y - ROW / 2), "muted thin faint"))
        marks += show(plot)
        marks.append(label((10, y + 5), name, "strong"))
        marks.append(label((92, y + 5), open_, "muted small"))
    pairs = "; ".join(f"{name}, {open_}" for name, open_ in zip(LINKS, LEFT_OPEN, strict=True))
    words = f"For each link, what its output leaves open of its input: {pairs}."
    return Illustration((Panel("links", "", WIDTH, HEIGHT, overlay="".join(marks)),), words)
