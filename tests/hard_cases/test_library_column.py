"""What the tables say of OpenCV, SciPy, Pillow and plain NumPy is true of them as installed."""

import math
import warnings
from typing import Any

import cv2
import numpy as np
import pytest
import scipy
import scipy.fft
import scipy.ndimage
import skimage
import skimage.color
import skimage.metrics
from PIL import Image
from scipy.spatial.transform import Rotation, Slerp
from support.found import TABLES

from simulations.engine.hard_cases import HardCase, show

NAMES: dict[str, Any] = {
    "cv2": cv2,
    "scipy": scipy,
    "skimage": skimage,
    "np": np,
    "math": math,
    "Image": Image,
    "Rotation": Rotation,
    "Slerp": Slerp,
    "inf": np.inf,
    "nan": np.nan,
    "K": np.array([[800.0, 0.0, 320.0], [0.0, 800.0, 240.0], [0.0, 0.0, 1.0]]),
}
"""What the expressions of the library column may use."""

ASKED = [
    pytest.param(case, id=f"{table.id}-{case.id}")
    for table in TABLES
    for case in table.cases
    if case.library
]


@pytest.mark.parametrize("case", ASKED)
def test_library_says_what_the_book_claims(case: HardCase) -> None:
    assert case.library
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")  # a library's warning is part of what the book warns of
        try:
            got = eval(case.library.call, dict(NAMES))
        except (cv2.error, ValueError, ArithmeticError, np.linalg.LinAlgError) as failure:
            got = failure
    assert show_library(got) == case.library.answer


def show_library(got: Any) -> str:
    """As `show`; an exception by its name alone, since messages change with every release."""
    return type(got).__name__ if isinstance(got, Exception) else show(got)
