"""Why corners are darker than the centre: natural and mechanical vignetting.

Szeliski, 2nd ed., §2.2.3.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

type Floats = NDArray[np.floating]


def vignetting_cos4(r_over_f: ArrayLike) -> Floats:
    """Natural vignetting: relative irradiance cos⁴α at image radius r, with tan α = r/f.

    Parameters
    ----------
    r_over_f : (...) floats
        Distance from the principal point divided by the focal length; the sign does not
        matter, and infinitely far out the light is 0.

    Returns
    -------
    (...) floats in [0, 1], as ``1 / (1 + (r/f)²)²``: no trigonometric function is needed.
    """
    r = np.asarray(r_over_f, float)
    with np.errstate(over="ignore"):
        cos2 = 1.0 / (1.0 + r * r)
    result: Floats = cos2 * cos2
    return result


def mechanical_vignetting(
    tan_field: ArrayLike, pupil_radius_mm: float, rim_radius_mm: float, separation_mm: float
) -> Floats:
    """The share of the aperture that a second, displaced rim leaves free (cat's-eye bokeh).

    Seen from a point off the axis, the rim of a lens element ``separation_mm`` before or
    behind the aperture shifts across it by ``separation · tan α``; light passes where the two
    discs overlap.

    Parameters
    ----------
    tan_field : (...) floats
        Tangent of the field angle α.
    pupil_radius_mm, rim_radius_mm : float
        Radii of aperture and rim, positive and finite.
    separation_mm : float
        Distance between the two along the axis, not negative.

    Returns
    -------
    (...) floats in [0, 1]: overlap area divided by the aperture's area.
    """
    for name, value in (("pupil_radius_mm", pupil_radius_mm), ("rim_radius_mm", rim_radius_mm)):
        if not 0.0 < value < np.inf:
            raise ValueError(f"{name} {value!r}: must be positive and finite")
    if not 0.0 <= separation_mm < np.inf:
        raise ValueError(f"separation_mm {separation_mm!r}: must be finite and not negative")
    with np.errstate(over="ignore"):
        shift = np.abs(np.asarray(tan_field, float) * separation_mm) / pupil_radius_mm
    # In units of the pupil, so that tiny and huge lenses neither vanish nor overflow when squared.
    rim = min(max(rim_radius_mm / pupil_radius_mm, 1e-100), 1e100)
    result: Floats = disc_overlap_area(shift, 1.0, rim) / np.pi
    return result


def disc_overlap_area(distance: ArrayLike, radius_a: float, radius_b: float) -> Floats:
    """Area (...) common to two discs whose centres are ``distance`` (...) apart.

    At most that of the smaller, and never negative, also where they just touch and the formula
    has lost half of its digits.
    """
    a, b = float(radius_a), float(radius_b)
    inside = np.asarray(distance, float) <= abs(a - b)  # one disc contains the other
    # Outside [|a−b|, a+b] the formula is at its limits.
    d = np.clip(np.asarray(distance, float), max(abs(a - b), 1e-16 * min(a, b)), a + b)
    gap = (a - b) * ((a + b) / d)  # (a² − b²)/d, which squares would lose where discs are alike
    angle_a = np.arccos(np.clip((d + gap) / (2.0 * a), -1.0, 1.0))
    angle_b = np.arccos(np.clip((d - gap) / (2.0 * b), -1.0, 1.0))
    kite = (a + b - d) * (d + a - b) * (d - a + b) * (d + a + b)
    lens = a * a * angle_a + b * b * angle_b - 0.5 * np.sqrt(np.maximum(kite, 0.0))
    smaller = np.pi * min(a, b) ** 2
    area: Floats = np.where(inside, smaller, np.clip(lens, 0.0, smaller))
    return area
