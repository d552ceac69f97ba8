"""Chapter 7: sampling."""

from math import pi, radians, tan

import numpy as np
from support.frames import outputs_of
from support.worked_numbers import Says, source

from simulations.models.lens.diffraction import lens_transfer
from simulations.models.sampling.aliasing import box_mtf
from simulations.models.sampling.first_fall import first_fall
from simulations.models.sampling.resampling import KERNELS
from simulations.models.sensor.resolution import pixel_transfer
from simulations.scenes.slanted_edge.edge import Sharpness
from simulations.scenes.slanted_edge.scene import SCENE as SLANTED_EDGE

CHAPTER = "07-sampling-and-aliasing"


def the_border_belongs_to_neither_side() -> Says:
    """Exactly twice the frequency is not enough: at the zero crossings nothing is recorded."""
    yield r"f_{\text{sample}} > 2\, f_{\max}"
    assert np.allclose(np.sin(pi * np.arange(9)), 0)
    assert r"\ge 2" not in source(CHAPTER)
    assert "at least twice as fast" not in source(CHAPTER)
    spacings_um = (1000 / 30, 1000 / 60, 16.0, 3.3)
    shown = ("33⅓ µm", "16⅔ µm", "16 µm", "3.3 µm")
    for spacing, text in zip(spacings_um, shown, strict=True):
        key = spacing == max(s for s in spacings_um if 1000 / s > 2 * 30)
        yield f"- [{'x' if key else ' '}] {text}\n"
    yield f": {1000 / 16:g} samples per millimetre, *more than* twice 30."


def what_a_cell_s_width_lets_through() -> Says:
    yield rf"At the Nyquist frequency that is $2/\pi = {2 / pi:.2f}$"
    assert np.isclose(box_mtf(0.5), 2 / pi)
    yield f"where the cell still passes {float(box_mtf(0.5)):.2f}"
    yield f"at 0.8 cycles per pixel it is {float(box_mtf(0.8)):.2f}; at 1 it is exactly zero"
    assert abs(float(box_mtf(1.0))) < 1e-15
    beyond = np.linspace(1, 3, 2001)
    highest = beyond[np.argmax(box_mtf(beyond))]
    most, still = float(box_mtf(highest)), float(box_mtf(1.5))
    yield f"{most:.2f} near {highest:.1f}, still {still:.2f} at 1.5"
    assert np.sinc(1.2) < 0, "crests and troughs exchanged"


def what_cell_and_plate_let_through() -> Says:
    f = np.linspace(0, 4, 4001)
    both = box_mtf(f) * np.abs(np.cos(pi * f))
    assert np.allclose(both, np.abs(np.sinc(2 * f)), atol=1e-12)
    yield f"From Nyquist on that never exceeds {both[f >= 0.5].max():.2f}"
    yield f"and {np.interp(0.8, f, both):.2f} of the shirt's contrast is left"
    yield "at 0.4 cycles per pixel, which the grid could hold, the cell and the plate leave "
    yield f"the cell and the plate leave {np.interp(0.4, f, both):.2f}"


def a_pixel_s_mtf_by_hand() -> Says:
    rise = np.diff([0, 0.25, 0.5, 0.75, 1])
    halfway = np.array([-3, -1, 1, 3]) / 8
    total = float(rise @ np.cos(2 * pi * 0.5 * halfway))
    near, far = (float(np.cos(radians(deg))) for deg in (22.5, 67.5))
    yield r"$\frac14 \cdot 2\,(\cos 22.5^\circ + \cos 67.5^\circ)$, which is $\frac12\,("
    formula = float(box_mtf(0.5))
    yield f"({near:.3f} + {far:.3f}) = {total:.2f}$. The pixel's formula gives {formula:.2f}"


def what_a_slant_is_good_for() -> Says:
    step = tan(radians(5))
    yield rf"$\tan 5^\circ = {step:.3f}$ pixels"
    yield f"after $1/{step:.3f} = {1 / step:.1f}$ rows"
    assert round(1 / step) == 11
    yield "Eleven rows meet the edge at eleven different places"
    yield "is ¼, nearly: every fourth row"
    assert np.isclose(tan(radians(14)), 0.25, atol=0.001)


def _sharpness(**given: object) -> Sharpness:
    found: Sharpness = outputs_of(SLANTED_EDGE, **given)["sharpness"]
    return found


def the_error_of_one_edge() -> Says:
    found = _sharpness()
    assert found.reading is not None
    rows = found.reading.pixels.line.rows.size
    yield f"The rectangle of the figure holds {rows} rows, and the noise is 1 % of the step"
    half = found.half.frequency
    contrast, errors = found.reading.transfer(half * np.array([0.8, 1.0, 1.2]))
    fall = float(contrast[0] - contrast[2]) / (0.4 * half)
    error = float(errors[1]) / fall
    yield f"falls to one half at {half:.3f} cycles per pixel, where its standard error is "
    yield f"its standard error is {errors[1]:.4f}. From 0.8 to 1.2 times that frequency"
    yield f"it falls from {contrast[0]:.3f} to {contrast[2]:.3f}, by {fall:.2f} per cycle per pixel"
    yield f"is ${errors[1]:.4f} / {fall:.2f} = {error:.4f}$ cycles per pixel"
    yield f"{250 * error:.1f} cycles per millimetre: an error of {100 * error / half:.1f} %"
    assert np.isclose(error, found.half.error, rtol=0.02)


def what_pixels_as_small_as_points_would_add() -> Says:
    frequency = np.linspace(0, 200, 20001)
    half = first_fall(frequency, lens_transfer(frequency, 0.55, 8), 0.5)
    yield f"even pixels as small as points would not bring it beyond {half:.0f}"
    four, two = (_mtf50_at_f_8(pitch) for pitch in (4, 2))
    yield "by a seventh, not by a factor of two"
    assert round(1 / (two / four - 1)) == 7
    yield "At this frequency a pixel of 4 µm takes about a seventh of the contrast"
    assert round(1 / (1 - float(pixel_transfer(four, 4)))) == 7


def _mtf50_at_f_8(pitch: float) -> float:
    frequency = np.linspace(0, 200, 20001)
    both = lens_transfer(frequency, 0.55, 8) * pixel_transfer(frequency, pitch)
    return first_fall(frequency, both, 0.5)


def the_cubic_s_weights_halfway() -> Says:
    far, near = 16 * KERNELS["bicubic"].weigh(np.array([1.5, 0.5]))
    assert np.isclose(2 * (far + near), 16), "they add up to one"
    yield "are 1.5, 0.5, 0.5 and 1.5 pixels away"
    yield f"are ${far:g}/16$, ${near:g}/16$, ${near:g}/16$ and ${far:g}/16$"


def the_spline_s_weights() -> Says:
    far, near = 48 * KERNELS["spline"].weigh(np.array([1.5, 0.5]))
    assert np.isclose(2 * (far + near), 48)
    yield f"are ${far:g}/48$, ${near:g}/48$, ${near:.0f}/48$ and ${far:g}/48$"
    own, beside = 6 * KERNELS["spline"].weigh(np.array([0.0, 1.0]))
    yield f"it has ${own:g}/6$ on its own sample and ${beside:g}/6$ on each"
