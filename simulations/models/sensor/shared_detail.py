"""Correlation of the fine detail of the colours of a picture.

Demosaicing methods that combine the colours assume that it is high. Gunturk, Altunbasak and
Mersereau: Color plane interpolation using alternating projections, IEEE Transactions on Image
Processing 11(9), 2002, measured it on photographs.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_colours
from simulations.models.require import require


def shared_detail(linear: ArrayLike) -> tuple[float, float]:
    """Correlation of red's fine detail with green's, and of blue's with green's, −1 to 1.

    Parameters
    ----------
    linear : (H, W, 3)
        At least 3 × 3 pixels. Fine detail is what a pixel differs by from the mean of its four
        neighbours; pixels at the border are left out.

    Returns
    -------
    red, blue : float
        NaN if one of the two colours has no fine detail.

    Raises
    ------
    ValueError
        For another shape, and for values that are not finite.
    """
    picture = as_colours(linear)
    if picture.ndim != 3 or min(picture.shape[:2]) < 3:
        raise ValueError(f"picture of shape {picture.shape}; legal: (H, W, 3), 3 x 3 or more")
    largest = float(np.abs(picture).max())
    require("picture reaches", largest, np.isfinite(largest), "finite")
    wide = picture.astype(np.float64) / (largest or 1.0)  # squares neither overflow nor vanish
    sides = wide[:-2, 1:-1] + wide[2:, 1:-1] + wide[1:-1, :-2] + wide[1:-1, 2:]
    red, green, blue = (wide[1:-1, 1:-1] - sides / 4).reshape(-1, 3).T
    return _correlation(red, green), _correlation(blue, green)


def _correlation(a: Floats, b: Floats) -> float:
    a, b = a - a.mean(), b - b.mean()
    scale = float(np.sqrt((a @ a) * (b @ b)))
    return float(a @ b) / scale if scale > 0 else float("nan")
