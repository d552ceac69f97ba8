"""The thin lens: focus and blur.

Distances along the optical axis in millimetres, measured from the lens and positive; objects may be
at infinity. Szeliski, 2nd ed., §2.2.3.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.lens.vignetting import vignetting_cos4
from simulations.models.require import require, require_positive

__all__ = [
    "circle_of_confusion_mm",
    "depth_of_field",
    "hyperfocal",
    "principal_distance_mm",
    "thin_lens_image_distance",
    "vignetting_cos4",
    "working_f_number",
]


def thin_lens_image_distance(focal_mm: float, distance_mm: ArrayLike) -> Floats:
    """Distance behind the lens at which an object is sharp: 1/F = 1/Z + 1/z.

    Parameters
    ----------
    focal_mm : float
        Focal length, positive and finite.
    distance_mm : (...) floats
        Object distance, at least the focal length. For an object at infinity the image is at F; for
        one at F the rays leave parallel and the image distance is inf.

    Raises
    ------
    ValueError
        For objects inside the focal length: their image is virtual and no sensor can catch it.
    """
    require_positive("focal_mm", focal_mm)
    distance = np.asarray(distance_mm, float)
    if not np.all(distance >= focal_mm):
        raise ValueError(
            f"distance_mm {_worst(distance)}; legal: the focal length, {focal_mm:g} mm, or more: "
            "nearer objects have a virtual image"
        )
    with np.errstate(divide="ignore", over="ignore"):
        return focal_mm / _share_beyond(distance, focal_mm)


def principal_distance_mm(focal_mm: float, focus_mm: float) -> float:
    """From the lens to a sensor that sees ``focus_mm`` sharp: z_s = F s / (s − F), at least F.

    A focused camera projects with this distance, not with the focal length: x = z_s X / Z. So its
    picture grows a little as the focus comes nearer, which is called focus breathing. The two are
    equal only at infinity. Photogrammetry's other name for it is the camera constant.

    Parameters
    ----------
    focal_mm : float
        Focal length, positive and finite.
    focus_mm : float
        Distance in focus, beyond the focal length; may be inf.
    """
    _check_focus(focal_mm, focus_mm)
    return float(thin_lens_image_distance(focal_mm, focus_mm))


def working_f_number(focal_mm: float, f_number: float, focus_mm: float) -> float:
    """N z_s / F: the distance from lens to sensor in diameters of the opening.

    The light on the axis falls with its square. At infinity it is N, the number on the lens; for a
    nearer focus the sensor is farther away and gets less light. Parameters as in
    `circle_of_confusion_mm`.
    """
    focal_mm, f_number, focus_mm = _checked_lens(focal_mm, f_number, focus_mm)
    return f_number / float(_share_beyond(focus_mm, focal_mm))  # may overflow to inf


def _share_beyond(far: ArrayLike, near: ArrayLike) -> Floats:
    """1 − near / far, for far ≥ near > 0: 1 at infinity.

    The difference of the distances comes first. It is exact for close distances, for which a
    quotient rounded to a number near 1 would lose digits.
    """
    with np.errstate(invalid="ignore"):
        share = np.subtract(far, near) / far
    return np.where(np.isinf(far), 1.0, share)


def circle_of_confusion_mm(
    focal_mm: float, f_number: float, focus_mm: float, depth_mm: ArrayLike
) -> Floats:
    """Diameter on the sensor of the disc that a point at ``depth_mm`` spreads into.

    ``c = A F / (1 − F/s) · |1/Z − 1/s|`` with aperture diameter A = F/N. In dioptres the
    formula is right for both Z → ∞ and s → ∞.

    Parameters
    ----------
    focal_mm : float
        Focal length, positive and finite.
    f_number : float
        N, positive; inf is a pinhole and blurs nothing.
    focus_mm : float
        Distance in focus, beyond the focal length; may be inf.
    depth_mm : (...) floats
        Object distance, not negative; 0 (on the lens) gives inf, inf is legal.
    """
    focal_mm, f_number, focus_mm = _checked_lens(focal_mm, f_number, focus_mm)
    depth = np.asarray(depth_mm, float)
    if not np.all(depth >= 0.0):
        raise ValueError(f"depth_mm {_worst(depth)}; legal: 0 or more, before the lens")
    if f_number == np.inf:
        return np.zeros_like(depth)
    near, far = np.minimum(depth, focus_mm), np.maximum(depth, focus_mm)
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        defocus_per_mm = _share_beyond(far, near) / near
        aperture_mm = focal_mm / f_number
        diameter = aperture_mm * focal_mm / _share_beyond(focus_mm, focal_mm) * defocus_per_mm
    # Points in focus are sharp and points on the lens infinitely blurred, for any aperture.
    blur: Floats = np.where(np.isinf(defocus_per_mm), np.inf, diameter)
    return np.where(defocus_per_mm == 0.0, 0.0, blur)


def depth_of_field(
    focal_mm: float, f_number: float, focus_mm: float, coc_mm: float
) -> tuple[float, float]:
    """Nearest and furthest distance whose circle of confusion does not exceed ``coc_mm``.

    Exact, not the usual approximation for Z ≫ F. The far limit is inf from the `hyperfocal`
    distance on; a pinhole (``f_number`` inf) has (0, inf).
    """
    focal_mm, f_number, focus_mm = _checked_lens(focal_mm, f_number, focus_mm)
    require_positive("coc_mm", coc_mm)
    share = float(_share_beyond(focus_mm, focal_mm))
    tolerance_per_mm = float(coc_mm) * f_number / focal_mm * share / focal_mm
    near_vergence = 1.0 / focus_mm + tolerance_per_mm
    nearest = 1.0 / near_vergence if near_vergence > 0.0 else np.inf  # both may underflow
    # At the hyperfocal distance itself the difference is zero but for rounding.
    far_vergence = 1.0 / focus_mm - tolerance_per_mm
    furthest = 1.0 / far_vergence if far_vergence > 1e-15 * tolerance_per_mm else np.inf
    return nearest, furthest


def hyperfocal(focal_mm: float, f_number: float, coc_mm: float) -> float:
    """The nearest focus at which infinity is acceptably sharp: F²/(N c) + F.

    Focused there, everything from half that distance on is sharp.
    """
    require_positive("focal_mm", focal_mm)
    require_positive("coc_mm", coc_mm)
    require("f_number", f_number, f_number > 0.0, "above 0 (inf is a pinhole)")
    focal = float(focal_mm)
    return focal * (focal / float(f_number) / float(coc_mm)) + focal  # may underflow or overflow


def _checked_lens(focal_mm: float, f_number: float, focus_mm: float) -> tuple[float, float, float]:
    """The three as Python's floats, whose products and quotients overflow without a warning."""
    _check_focus(focal_mm, focus_mm)
    require("f_number", f_number, f_number > 0.0, "above 0 (inf is a pinhole)")
    return float(focal_mm), float(f_number), float(focus_mm)


def _check_focus(focal_mm: float, focus_mm: float) -> None:
    require_positive("focal_mm", focal_mm)
    require(
        "focus_mm",
        focus_mm,
        focus_mm > focal_mm,
        f"above the focal length, {focal_mm:g} mm: a nearer object has a virtual image, "
        "which no sensor can catch",
    )


def _worst(distances: Floats) -> float:
    """The entry for an error message: a NaN if there is one, else the smallest."""
    return float(np.min(distances))
