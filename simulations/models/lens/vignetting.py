"""Why corners are darker than the centre: natural and mechanical vignetting.

Szeliski, 2nd ed., §2.2.3.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.require import require, require_positive


def vignetting_cos4(r_over_f: ArrayLike) -> Floats:
    """Natural vignetting: relative irradiance cos⁴α at image radius r, with tan α = r/f.

    f is the distance from lens to sensor: the focal length where the lens is focused at infinity,
    and else `thin_lens.principal_distance_mm`.

    Parameters
    ----------
    r_over_f : (...) floats
        Distance from the principal point divided by f; the sign does not matter; at infinity the
        light is 0.

    Returns
    -------
    (...) floats in [0, 1], as ``1 / (1 + (r/f)²)²``: no trigonometric function is needed.
    """
    r = np.asarray(r_over_f, float)
    with np.errstate(over="ignore"):
        cos2 = 1.0 / (1.0 + r * r)
    return cos2 * cos2


def mechanical_vignetting(
    tan_field: ArrayLike, pupil_radius_mm: float, rim_radius_mm: float, separation_mm: float
) -> Floats:
    """The share of the aperture that a second, displaced rim leaves open (cat's-eye bokeh).

    Seen from a point off the axis, the rim of a lens element ``separation_mm`` before or behind the
    aperture shifts across it by ``separation · tan α``; light passes where the two discs overlap.

    Parameters
    ----------
    tan_field : (...) floats
        Tangent of the field angle α, which may be infinite: a rim at the aperture itself
        (separation 0) hides the same at all angles.
    pupil_radius_mm, rim_radius_mm : float
        Radii of aperture and rim, positive and finite.
    separation_mm : float
        Distance between the two along the axis, not negative.

    Returns
    -------
    (...) floats in [0, 1]: overlap area divided by the aperture's area.
    """
    for name, value in (("pupil_radius_mm", pupil_radius_mm), ("rim_radius_mm", rim_radius_mm)):
        require_positive(name, value)
    require("separation_mm", separation_mm, 0.0 <= separation_mm < np.inf, "0 or more, finite")
    tan = np.asarray(tan_field, float)
    if separation_mm == 0.0:
        tan = np.where(np.isinf(tan), 0.0, tan)
    with np.errstate(over="ignore"):
        shift = tan * separation_mm / pupil_radius_mm
    # In units of the pupil, so that squares neither vanish nor overflow.
    rim = min(max(float(rim_radius_mm) / float(pupil_radius_mm), 1e-70), 1e70)
    return disc_overlap_area(shift, 1.0, rim) / np.pi


def disc_overlap_area(distance: ArrayLike, radius_a: float, radius_b: float) -> Floats:
    """Area (...) common to two discs whose centres are ``distance`` (...) apart.

    The chord through the points where the circles meet cuts it into two segments. The chord is
    computed from the three lengths by Heron's formula, and the angles from the chord. An arccosine
    would lose half of the digits if the discs just touch, and sectors minus the kite between them
    all digits if one disc is much larger than the other.

    Parameters
    ----------
    distance : (...) floats; the sign does not matter.
    radius_a, radius_b : float, 1e-70 to 1e70, so that no product of four lengths overflows.
    """
    small, large = sorted((float(radius_a), float(radius_b)))
    if not (small >= 1e-70 and large <= 1e70):
        raise ValueError(f"radii {radius_a} and {radius_b}; legal: 1e-70 to 1e70")
    gap, full = large - small, np.pi * small**2
    apart = np.abs(np.asarray(distance, float))
    d = np.clip(apart, gap, large + small)  # outside this range the area is a limit of the formula
    # The difference of neighbouring numbers first: it is exact.
    beyond = np.clip(apart - large, -small, small)
    chord = np.sqrt((small - beyond) * (small + beyond))
    chord *= np.sqrt((d + gap) * (d + (large + small)))  # times the distance, d
    squares = gap * (large + small)
    lead = np.where(d < small, d * d - squares, beyond * (d + large) + small * small)
    area = _segment(small, np.arctan2(chord, lead))
    area += _segment(large, np.arctan2(chord, d * d + squares))
    return np.where(apart - large <= -small, full, np.clip(area, 0.0, full))


def _segment(radius: float, half_angle: Floats) -> Floats:
    """Area of a disc beyond a chord that subtends twice the angle: R² (α − sin α cos α)."""
    turn = 2.0 * half_angle
    square = np.minimum(turn * turn, 1.0)
    series = np.zeros_like(turn)
    for k in range(15, 1, -2):  # turn − sin turn = turn³/3! − turn⁵/5! + … , for small turns
        series = square / (k * (k - 1)) * (1.0 - series)
    lens = np.where(turn < 1.0, series * turn, turn - np.sin(turn))
    return 0.5 * (radius * lens) * radius
