"""The hard cases that the book prints: each is asked, and its answer judged."""

import re

import numpy as np
import pytest
from support.found import TABLES
from support.worked_numbers import CONTENT

from simulations.engine.hard_cases import HardCases, answer, naive_answer, show

EACH = pytest.mark.parametrize("table", TABLES, ids=lambda table: table.id)


@EACH
def test_model_answers_as_decided(table: HardCases) -> None:
    for case in table.cases:
        got = answer(table, case)
        assert case.expected(got), f"{case.call} gave {show(got)}"


@EACH
def test_textbook_formula_can_be_shown_beside_it(table: HardCases) -> None:
    """What it says is not what the model says: else the case would teach nothing."""
    for case in table.cases:
        if case.naive:
            assert show(naive_answer(table, case)) != show(answer(table, case)), case.call


SECOND_IS_NO_VALIDITY = ("euler.from_matrix(", "apparent_wheel_speed(")
"""Of these, the angles and speeds hold whatever the mask says of them: locked, certain."""
BORDER = "undistort_clamped("
"""Finite on purpose, as its name says."""


def test_what_a_mask_calls_invalid_is_nan_and_the_rest_is_not() -> None:
    asked = [(case.call, answer(table, case)) for table in TABLES for case in table.cases]
    pairs = {
        call: (np.asarray(got[0]), np.asarray(got[1]))
        for call, got in asked
        if isinstance(got, tuple) and len(got) == 2 and np.asarray(got[1]).dtype == bool
        if not call.startswith((*SECOND_IS_NO_VALIDITY, BORDER))
    }
    assert pairs
    for call, (values, valid) in pairs.items():
        assert np.isnan(values[~valid]).all(), call
        assert not np.isnan(values[valid]).any(), call


def test_the_book_prints_every_table() -> None:
    text = "".join(file.read_text("utf-8") for file in CONTENT.glob("*.md"))
    assert {table.id for table in TABLES} == set(re.findall(r"^:+\{extremes\} (\S+)", text, re.M))
