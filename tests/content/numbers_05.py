"""Chapter 5: light on surfaces."""

from math import acos, cos, degrees, radians, sin

import numpy as np
from support.worked_numbers import Says

from simulations.models.color import encode_srgb
from simulations.models.reflectance import lambert, phong

CHAPTER = "05-lighting-and-reflectance"


def a_number_to_check_by_hand() -> Says:
    light = (sin(radians(30)), 0, cos(radians(30)))
    normal = np.array((0.0, 0, 1))
    yield rf"= ({light[0]:g}, 0, {light[2]:.3f})$"
    yield f"Their dot product is ${light[2]:.3f}$."
    brightness = float(lambert(normal, light, 0.8))
    yield rf"$I = 0.8 \times {light[2]:.3f} = {brightness:.3f}$ of full white"
    yield rf"${brightness:.3f} \times 255 = {255 * brightness:.0f}$"
    encoded = float(encode_srgb(brightness))
    yield f"${brightness:.3f}$ becomes ${encoded:.3f}$"
    yield f"the pixel's value is **{255 * encoded:.0f}**"


def how_wide_a_highlight_is() -> Says:
    normal = np.array((0.0, 0, 1))
    for shininess in (1, 10, 100, 1000):
        width = acos(2 ** (-1 / shininess))
        view = (sin(width), 0, cos(width))
        seen = phong(normal, normal, view, 0.0, specular=1.0, shininess=shininess)
        assert np.isclose(seen, 0.5), "half of the peak"
        yield f"| {shininess} | {degrees(width):.1f}° |"
    wide, narrow = (degrees(acos(2 ** (-1 / shininess))) for shininess in (10, 1000))
    yield rf"$1/\sqrt{{\alpha}}$: from {wide:.1f}° to {narrow:.1f}° at half height"


def negative_dot_product() -> Says:
    cosine = -0.4
    light = np.array((0, np.sqrt(1 - cosine**2), cosine))
    yield f"- [x] {float(lambert(np.array((0.0, 0, 1)), light, 0.5)):g}\n"


def halfway_exponent() -> Says:
    yield f"- [x] {25 * 2**2}\n"
    yield rf"Four times the exponent, $\alpha = {4 * 20}$"


def a_cosine_just_above_one() -> Says:
    above = 1.0 + float(np.finfo(np.float32).eps)
    yield f"may come out as {above:.7f}"
    yield f"Raised to the power 1000 that is {above**1000:.4f}"
    yield f"a shininess of a million makes it {above**1e6:.2f}"


WORKED = (
    a_cosine_just_above_one,
    a_number_to_check_by_hand,
    how_wide_a_highlight_is,
    negative_dot_product,
    halfway_exponent,
)
