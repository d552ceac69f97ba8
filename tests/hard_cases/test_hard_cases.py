"""Hard cases that the book prints, and known values beside them: the models' answers, and the
answers of other libraries as installed."""

import math
import re
import tomllib
import warnings
from pathlib import Path
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
from support.places import hard_cases
from support.worked_numbers import CONTENT

from simulations.engine.hard_cases import HardCases, answer, as_expected, naive_answer, show

EACH = pytest.mark.parametrize("table", hard_cases(), ids=lambda table: table.id)
KNOWN = tomllib.loads(Path(__file__).with_name("known_values.toml").read_text("utf-8"))
OTHER_MASKS = ("euler.from_matrix(", "apparent_wheel_speed(", "undistort_clamped(")
"""Calls whose result is valid even where its flag is false: locked, uncertain, clamped."""
IN_LIBRARIES: dict[str, Any] = {
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
"""Names that calls of other libraries may use."""


@EACH
def test_model_gives_the_expected_answer(table: HardCases) -> None:
    rows = [(case.call, case.expected) for case in table.cases]
    for call, expected in (*rows, *KNOWN.get(table.id, {}).items()):
        got = answer(table, call)
        assert as_expected(table, expected, got), f"{call} gave {show(got)}"
        if isinstance(got, tuple) and len(got) == 2 and not call.startswith(OTHER_MASKS):
            values, valid = map(np.asarray, got)
            if valid.dtype == bool:
                assert np.isnan(values[~valid]).all(), call
                assert not np.isnan(values[valid]).any(), call


@EACH
def test_printed_case_has_a_naive_or_library_answer(table: HardCases) -> None:
    """A case with neither belongs in ``known_values.toml``; a naive answer must be different."""
    for case in table.cases:
        assert case.naive or case.library, case.call
        if case.naive:
            model, formula = answer(table, case.call), naive_answer(table, case.naive)
            assert show(formula) != show(model), case.call


@EACH
def test_library_gives_the_answer_that_the_book_prints(table: HardCases) -> None:
    for case in table.cases:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")  # a library's warning is part of what the book shows
            try:
                got = eval(case.library or "''", {**IN_LIBRARIES})
            except (cv2.error, ValueError, ArithmeticError, np.linalg.LinAlgError) as failure:
                got = type(failure).__name__  # messages change with every release
        assert show(got) == case.library_answer, case.library


def test_book_names_the_versions_that_answer() -> None:
    text = (CONTENT / "15-hard-cases.md").read_text("utf-8")
    named = {"OpenCV": cv2, "SciPy": scipy, "NumPy": np, "scikit-image": skimage}
    for name, library in named.items():
        assert f"{name} {'.'.join(library.__version__.split('.')[:2])}" in text


def test_book_prints_every_table_and_known_values_have_one() -> None:
    text = "".join(file.read_text("utf-8") for file in CONTENT.glob("*.md"))
    tables = {table.id for table in hard_cases()}
    assert tables == set(re.findall(r"^:+\{extremes\} (\S+)", text, re.M))
    assert KNOWN.keys() <= tables
