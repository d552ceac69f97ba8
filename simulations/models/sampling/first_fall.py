"""Where a curve of contrast falls to a level: MTF50, at half."""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.require import require


def first_fall(frequency: ArrayLike, contrast: ArrayLike, level: float) -> float:
    """The lowest frequency at which a curve (n,) falls to ``level``, between its samples.

    At level ½ of the whole chain it is called MTF50. Infinite if the curve stays above; raises
    `ValueError` if it begins below.
    """
    along, curve = np.asarray(frequency, float), np.asarray(contrast, float)
    require("contrast at the start", curve[0], curve[0] > level, f"above {level:g}")
    below = np.flatnonzero(curve <= level)
    if below.size == 0:
        return np.inf
    end = int(below[0])
    share = (curve[end - 1] - level) / (curve[end - 1] - curve[end])
    return float(along[end - 1] + share * (along[end] - along[end - 1]))
