"""The one conversion that every model starts with."""

import numpy as np
from numpy.typing import ArrayLike, NDArray


def as_floats(values: ArrayLike) -> NDArray[np.floating]:
    """As an array of floats: float32 stays float32 (pictures), whole numbers become float64."""
    array = np.asarray(values)
    floats: NDArray[np.floating] = array if array.dtype.kind == "f" else array.astype(np.float64)
    return floats
