"""Chapter 7: sampling."""

from math import pi, radians, sin

import numpy as np
from support.worked_numbers import Says

from simulations.models.resampling import KERNELS
from simulations.models.sampling import alias_frequency, apparent_wheel_speed, box_mtf

CHAPTER = "07-sampling-and-aliasing"


def seen(cycles: float) -> float:
    """The frequency in the picture, whichever way its wave runs."""
    return abs(float(alias_frequency(cycles)))


def the_shirt_at_twenty_metres() -> Says:
    stripe_um, pixel_um, focal_mm = 2000, 4, 50
    for distance_mm, cycles in ((4000, "{:.2f}"), (20_000, "{:.1f}")):
        image_um = stripe_um * focal_mm / distance_mm
        pixels = image_um / pixel_um
        yield f"A stripe covers {image_um:g} µm"
        yield f"or {pixels:g} pixels"
        yield f"{cycles.format(1 / pixels)} cycles per pixel"
        if distance_mm == 4000:
            yield f"$50/4000 = 1/{distance_mm / focal_mm:g}$"
        else:
            yield f"$1/{distance_mm / focal_mm:g}$"
    alias = seen(0.8)
    yield f"$|0.8 - 1| = {alias:g}$ cycles per pixel, a false stripe every {1 / alias:g} pixels"
    wide_mm = pixel_um * 1e-3 / alias * 20_000 / focal_mm
    yield f"{wide_mm:.0f} mm wide, four times the truth"
    assert np.isclose(wide_mm, 4 * 2)


def folded_frequencies() -> Says:
    for true, shown in ((0.8, 0.2), (0.7, 0.3), (1.0, 0.0)):
        assert np.isclose(seen(true), shown)
    yield f"A frequency of 0.8 is shown as {seen(0.8):g}"
    yield f"$|0.7 - \\mathrm{{round}}(0.7)| = |0.7 - 1| = {seen(0.7):g}$"
    yield f"- [x] {seen(0.7):g} cycles per pixel"
    yield f"- [ ] {0.7 - 0.5:.1f} cycles per pixel"


def what_a_cell_s_width_lets_through() -> Says:
    yield rf"At the Nyquist frequency that is $2/\pi = {2 / pi:.2f}$"
    assert np.isclose(box_mtf(0.5), 2 / pi)
    yield f"at 0.8 cycles per pixel it is {float(box_mtf(0.8)):.2f}; at 1 it is exactly zero"
    assert abs(float(box_mtf(1.0))) < 1e-15


def the_cubic_s_weights_halfway() -> Says:
    far, near = 16 * KERNELS["bicubic"].weigh(np.array([1.5, 0.5]))
    assert np.isclose(2 * (far + near), 16), "they add up to one"
    yield "are 1.5, 0.5, 0.5 and 1.5 pixels away"
    yield f"are ${far:g}/16$, ${near:g}/16$, ${near:g}/16$ and ${far:g}/16$"


def wagon_wheels() -> Says:
    speed, _ = apparent_wheel_speed(2.9, 8, 24.0)
    yield f"brings {2.9 * 8:.1f} spokes a second"
    yield f"${2.9 * 8:.1f} - 24 = {2.9 * 8 - 24:.1f}$ spokes a second"
    assert np.isclose(speed, -0.1), "a tenth of a turn a second, backwards"
    yield f"at 12 spokes a second, which is half the frame rate: {12 / 8:g} turns a second"
    speed, _ = apparent_wheel_speed(5.0, 6, 24.0)
    yield f"- [x] A wheel turning forwards at {float(speed):.0f} turn a second."


def at_nyquist() -> Says:
    yield rf"$|\sin 30^\circ| = {abs(sin(radians(30))):.1f}$"


WORKED = (
    the_shirt_at_twenty_metres,
    folded_frequencies,
    what_a_cell_s_width_lets_through,
    the_cubic_s_weights_halfway,
    wagon_wheels,
    at_nyquist,
)
