"""The three curves of the standard observer, and two surfaces of the same colour."""

import numpy as np

from simulations.engine.drafting import label, swatch
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.models.arrays import Floats
from simulations.models.color.cie import xyz_to_linear_rgb
from simulations.models.color.illuminants import daylight
from simulations.models.color.observer import OBSERVER, tristimulus
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.models.color.srgb import encode_srgb
from simulations.models.color.surfaces import chart_patch, metameric_twins

WIDTH, HEIGHT = 320.0, 232.0
NM = Axis(380.0, 730.0, 34, 308)
CURVES = Plot(NM, Axis(0.0, 2.0, 186, 12))
SHARES = Plot(NM, Axis(0.0, 0.6, 186, 12))
LETTERS = (("x̄", "error", 616.0, 9), ("ȳ", "world", 536.0, -18), ("z̄", "image", 468.0, 9))
"""Each curve's name and colour, and the wavelength and offset of its label."""
DAYLIGHT_K = 6504.0
TICKS = (400, 500, 600, 700)
SEEN = NM.high >= WAVELENGTHS_NM


def twins() -> Floats:
    """(2, 81) reflectances: a blue-sky patch, and three inks mixed to look the same."""
    sky = chart_patch("sky")
    return np.stack([sky, metameric_twins(sky, daylight(DAYLIGHT_K))])


def pair_xyz() -> Floats:
    """(2, 3) CIE XYZ of both in daylight."""
    light = daylight(DAYLIGHT_K)
    return tristimulus(twins() * light, light)


def _axes(plot: Plot, ticks: tuple[tuple[float, str], ...]) -> str:
    across = Scale("wavelength", "nm", TICKS, style="muted small", tick_style="muted small")
    return plot.frame(across, Scale(ticks=ticks, tick_style="muted small"))


def _observer() -> str:
    marks = [_axes(CURVES, ((1.0, "1"), (2.0, "2")))]
    for values, (name, style, nm, aside) in zip(OBSERVER.T, LETTERS, strict=True):
        height = float(np.interp(nm, WAVELENGTHS_NM, values))
        marks.append(CURVES.curve(WAVELENGTHS_NM[SEEN], values[SEEN], f"{style} bold"))
        marks.append(label(np.add(CURVES.at(nm, height), (aside, -4)), name, f"{style} italic"))
    return "".join(marks)


def _surfaces() -> str:
    sky, twin = twins()
    marks = [
        _axes(SHARES, ((0.25, "¼"), (0.5, "½"))),
        SHARES.curve(WAVELENGTHS_NM[SEEN], sky[SEEN], "world bold"),
        SHARES.curve(WAVELENGTHS_NM[SEEN], twin[SEEN], "camera bold dashed"),
    ]
    for place, xyz in enumerate(pair_xyz()):
        colour = encode_srgb(np.clip(xyz_to_linear_rgb(xyz), 0.0, 1.0))
        marks.append(swatch((196 + 44 * place, 16), 44, 36, colour.tolist()))
    marks += [
        label((218, 68), "paint", "world", "middle"),
        label((262, 68), "inks", "camera", "middle"),
    ]
    return "".join(marks)


def draw() -> Illustration:
    x, y, z = pair_xyz()[0]
    panels = (
        Panel("observer", "The eye’s three curves", WIDTH, HEIGHT, overlay=_observer()),
        Panel("surfaces", "Two surfaces, one colour", WIDTH, HEIGHT, overlay=_surfaces()),
    )
    words = (
        "The curves x̄, ȳ and z̄ over the wavelength: hills in the orange, the green and the blue, "
        "the first with a second hill in the blue. Beside it the reflectances of a blue paint and "
        "of three inks, which cross several times: in daylight both give X, Y and Z of "
        f"{x:.2f}, {y:.2f} and {z:.2f}, and the same blue."
    )
    return Illustration(panels, words)
