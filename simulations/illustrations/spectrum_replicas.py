"""The spectrum of a picture before and after sampling: copies at every multiple of the rate."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import line
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.models.arrays import Floats
from simulations.models.sampling.aliasing import alias_frequency

PLOT = Plot(Axis(-1.6, 1.6, 14, 386), Axis(0, 1.25, 128, 24))
HIGHEST = (
    ("kept", "Nothing above half the rate", 0.38),
    ("folded", "Detail above half the rate", 0.72),
)
"""Name, title and highest frequency of a picture, in cycles per sample."""
FREQUENCY = np.linspace(-1.6, 1.6, 641)


def spectrum(frequency: Floats, highest: float) -> Floats:
    """Amplitude of a picture without detail above ``highest``."""
    return np.clip(1 - (np.abs(frequency) / highest) ** 2, 0, None)


def _panel(name: str, title: str, highest: float) -> Panel:
    marks = [
        PLOT.area(FREQUENCY, spectrum(FREQUENCY - copy, highest), "muted fill thin dashed")
        for copy in (-2, -1, 1, 2)
    ]
    marks.append(PLOT.area(FREQUENCY, spectrum(FREQUENCY, highest), "image fill bold"))
    base = np.linspace(-0.5, 0.5, 201)
    foreign = np.maximum(spectrum(base - 1, highest), spectrum(base + 1, highest))
    if foreign.max() > 0:
        for half in (base <= 0, base >= 0):
            marks.append(PLOT.area(base[half], foreign[half], "error fill"))
        x, y = PLOT.at(abs(float(alias_frequency(highest))) - 0.02, 0)
        for place in (x, 2 * PLOT.at(0, 0)[0] - x):
            marks.append(label((place, y + 36), "aliases", "error", "middle"))
    for nyquist in (-0.5, 0.5):
        marks.append(line(PLOT.at(nyquist, 0), PLOT.at(nyquist, 1.2), "camera dashed"))
    marks += [
        line(PLOT.at(-1.6, 0), PLOT.at(1.6, 0), "muted"),
        PLOT.x_axis(Scale(ticks=(-1, 0, 1), tick_style="muted small")),
        PLOT.x_axis(Scale(ticks=((-0.5, "−½"), (0.5, "½")), tick_style="camera small")),
        label((PLOT.at(0.5, 0)[0] + 6, 20), "Nyquist", "camera small"),
    ]
    return Panel(name, title, 400.0, 176.0, overlay="".join(marks))


def draw() -> Illustration:
    words = (
        "Amplitude over frequency, with copies of the spectrum at every whole number. "
        f"Where the highest frequency is {HIGHEST[0][2]:g} the copies stand apart. "
        f"Where it is {HIGHEST[1][2]:g} they reach below the Nyquist frequency of ½, down to "
        f"{abs(float(alias_frequency(HIGHEST[1][2]))):.2f}, and lie there as aliases."
    )
    return Illustration(tuple(_panel(*item) for item in HIGHEST), words)
