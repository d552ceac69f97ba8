"""Chapter 0: from a speck of paint to 149."""

from math import cos, hypot, radians, sqrt

import numpy as np
from support.worked_numbers import Says

from simulations.models.color import encode_srgb
from simulations.models.distortion import Distortion, distort
from simulations.models.projection import intrinsics, project

CHAPTER = "00-why-image-formation"
K = intrinsics(800.0, (320.0, 240.0))
LENS = Distortion(k1=-0.2)


def pixel_of(x_m: float, y_m: float, depth_m: float) -> tuple[float, float]:
    bent = distort(np.array([x_m, y_m]) / depth_m, LENS)
    pixel, _ = project([*bent, 1.0], K)
    return float(pixel[0]), float(pixel[1])


def from_a_speck_to_its_place() -> Says:
    x, y, z = np.subtract((0.4, -0.3, 3.0), (0.0, 0.0, -1.0))
    yield rf"in camera coordinates the speck is at $({x:g}, {y:g}, {z:.1f})$ m"
    yield rf"$x = {x:g}/{z:g} = {x / z:g}$ and $y = {y:g}/{z:g} = {y / z:g}$"
    squared = (x / z) ** 2 + (y / z) ** 2
    factor = 1 - 0.2 * squared
    yield rf"$r^2 = 0.1^2 + 0.075^2 = {squared:.6f}$ and the factor is {factor:.6f}"
    bent = distort([x / z, y / z], LENS)
    yield rf"moves to $({bent[0]:.5f}, {bent[1]:.5f})$"
    u, v = pixel_of(x, y, z)
    yield rf"$320 + 800 \cdot {bent[0]:.5f} = {u:.2f}$"
    yield rf"$240 - 800 \cdot {-bent[1]:.5f} = {v:.2f}$"
    yield f"The nearest cell is column {round(u)}, row {round(v)}."
    straight, _ = project([x, y, z], K)
    yield rf"the place would have been $({straight[0]:.0f}, {straight[1]:.0f})$ exactly"
    assert 0.3 < hypot(u - straight[0], v - straight[1]) < 0.35, "about a third of a pixel"


def from_light_to_a_code() -> Says:
    light = 0.6 * cos(radians(60))
    yield rf"$0.6 \cdot \cos 60^\circ = {light:.2f}$ of the light of a white wall"
    yield f"Our cell expects {10_000 * light:.0f}. Photons are random; say it gets 3007 this time."
    reported = round(3007 * 4095 / 10_000)
    yield rf"$3007 \cdot 4095/10\,000 = {reported}$"
    linear = reported / 4095
    encoded = float(encode_srgb(linear))
    yield rf"${reported}/4095 = {linear:.4f}$"
    yield rf"turns this into {encoded:.3f}, and ${encoded:.3f} \cdot 255 = {encoded * 255:.0f}$"
    assert round(255 * float(encode_srgb(0.3))) == 149, "3000 electrons give 149 as well"


def the_point_at_twice_the_distance() -> Says:
    u, v = pixel_of(0.4, -0.3, 8.0)
    yield f"The place moves to $({u:.2f}, {v:.2f})$"
    yield f"rather than to {149 / 2 + 0.5:.0f}: that is the sRGB curve"


def shot_noise_of_3000_electrons() -> Says:
    yield rf"$\sqrt{{3000}} \approx {sqrt(3000):.0f}$"


WORKED = (
    from_a_speck_to_its_place,
    from_light_to_a_code,
    the_point_at_twice_the_distance,
    shot_noise_of_3000_electrons,
)
