"""Frames: formatted numbers, JSON, pixels, and the refusal of invalid parts."""

import json
import math
from typing import Any

import numpy as np
import pytest

from simulations.engine.frame import (
    Frame,
    Panel,
    Readout,
    Sound,
    StageReport,
    format_magnitude,
    format_number,
    matrix_readout,
    readout,
    to_json,
    value_with_error,
)
from simulations.engine.photograph import Photograph
from simulations.engine.raster import to_rgba8

PANEL = Panel("a", "", 400, 300)
DOUBLES: Any = np.zeros((2, 2, 3))
SILENCE = np.zeros(4, np.float32)


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (3.14159, 2, "3.14"),
        (-0.25, 2, "−0.25"),
        (-0.001, 2, "0.00"),
        (-0.0, 0, "0"),
        (10.0, 0, "10"),
        (float("inf"), 2, "∞"),
        (float("-inf"), 2, "−∞"),
        (float("nan"), 2, "undefined"),
    ],
)
def test_numbers_have_fixed_decimals_and_a_true_minus_sign(
    value: float, digits: int, text: str
) -> None:
    assert format_number(value, digits) == text


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (14.23, "14.2"),
        (3.456, "3.46"),
        (0.0351, "0.035"),
        (3.14e-5, "3.1\u00a0×\u00a010⁻⁵"),
        (9.97e-5, "1.0\u00a0×\u00a010⁻⁴"),
        (9e-10, "under 10⁻⁹"),
    ],
)
def test_number_of_unknown_size_has_at_least_two_digits(value: float, text: str) -> None:
    assert format_magnitude(value, 1e-9) == text


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (2.1134, 0.0423, "2.11 ± 0.04"),
        (2.1134, 0.0123, "2.113 ± 0.012"),
        (2.1134, 0.0354, "2.113 ± 0.035"),
        (2.1134, 0.0355, "2.11 ± 0.04"),
        (2.1134, 0.0996, "2.11 ± 0.10"),
        (18.7, 0.0014, "18.7000 ± 0.0014"),
        (1234.4, 234.0, "1230 ± 230"),
        (-1106.7, 54.0, "−1110 ± 50"),
        (-0.004, 0.3, "0.00 ± 0.30"),
        (2.1134, 0.0, "2.11340 ± under 0.00001"),
        (1106.7, 1e-9, "1106.70 ± under 0.01"),
        (0.0, 0.0, "0.00000 ± under 0.00001"),
        (math.nan, 0.1, "undefined"),
        (2.0, math.inf, "undefined"),
    ],
)
def test_measured_value_has_a_nonzero_error_of_one_or_two_digits(
    value: float, error: float, text: str
) -> None:
    assert value_with_error(value, error) == text


def test_matrix_is_written_in_columns_of_equal_width() -> None:
    rows = matrix_readout("R", "Rotation", [[0, -1], [1, 0]], digits=0).text.split("\n")
    assert [row.replace("\u2007", "").split(" ") for row in rows] == [["0", "−1"], ["1", "0"]]
    assert len({len(row) for row in rows}) == 1


def test_frame_without_pixels_and_samples_is_json() -> None:
    frame = Frame(
        (Panel("a", "A", 400, 300, raster=np.zeros((2, 3, 4), np.uint8)), Panel("b", "", 1, 1)),
        (readout("x", "x", 1.5, "px", role="ray"),),
        "Shows.",
        stages=(StageReport("blur", "skipped", "no blur"),),
        sound=Sound(SILENCE, 8000),
    )
    data = json.loads(to_json(frame))
    assert [panel["raster"] for panel in data["panels"]] == [{"width": 3, "height": 2}, None]
    assert data["readouts"] == [
        {"name": "x", "label": "x", "text": "1.50", "unit": "px", "role": "ray"}
    ]
    assert data["stages"] == [{"name": "blur", "status": "skipped", "reason": "no blur"}]
    assert data["sound"] == {"rate": 8000}
    assert "sound" not in json.loads(to_json(Frame((PANEL,), (), "Silent.")))


def test_pixels_are_rounded_clipped_and_never_nan() -> None:
    rgba = to_rgba8(np.array([[0.0, 0.5, 1.0, -1.0, 2.0, np.nan, np.inf, -np.inf]]))
    assert rgba[0, :, 0].tolist() == [0, 128, 255, 0, 255, 0, 255, 0]
    assert (rgba[..., 3] == 255).all()
    assert rgba.flags.c_contiguous
    covered = to_rgba8(np.ones((1, 2, 3)), alpha=np.array([[0.0, 1.0]]))
    assert covered[0].tolist() == [[255, 255, 255, 0], [255, 255, 255, 255]]


def test_photographs_are_compared_by_their_number() -> None:
    black, white = (np.full((1, 1, 3), level, np.uint8) for level in (0, 255))
    assert Photograph(1, black, "a", {"iso": 100}) == Photograph(1, white)
    assert Photograph(1, black) != Photograph(2, black)
    assert len({Photograph(1, black, facts={"iso": 100}), Photograph(1, white)}) == 1


def _panel(raster: Any) -> Panel:
    return Panel("a", "", 400, 300, raster=raster)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Frame((PANEL, PANEL), (), "Shows."), "duplicate panel"),
        (lambda: Frame((PANEL,), (readout("x", "x", 1),) * 2, "Shows."), "duplicate readout"),
        (lambda: Frame(tuple(Panel(n, "", 4, 3, lead=True) for n in "ab"), (), "Two."), "all lead"),
        (lambda: Frame((PANEL,), (), "  "), "description"),
        (lambda: Readout("x", "x", "1", role="Light blue"), "role 'Light blue'"),
        (lambda: _panel(np.zeros((4, 4, 3), np.uint8)), "legal: C-contiguous"),
        (lambda: _panel(np.zeros((4, 4), np.uint8)), "legal: C-contiguous"),
        (lambda: _panel(np.zeros((4, 4, 4))), "legal: C-contiguous"),
        (lambda: _panel(np.zeros((4, 8, 4), np.uint8)[:, ::2]), "legal: C-contiguous"),
        (lambda: Sound(DOUBLES[0, 0], 22_050), "legal: an array of float32"),
        (lambda: Sound(np.zeros((2, 4), np.float32), 22_050), r"legal: \(N,\)"),
        (lambda: Sound(SILENCE - 1.5, 22_050), "up to 1.5; legal: from -1 to 1"),
        (lambda: Sound(SILENCE + np.float32(np.nan), 22_050), "up to nan"),
        (lambda: Sound(SILENCE, 4000), "legal: 8000 to 96000 Hz"),
        (lambda: Photograph(1, np.zeros((2, 2), np.uint8)), r"legal: \(H, W, 3\) uint8"),
        (lambda: Photograph(1, DOUBLES), r"legal: \(H, W, 3\) uint8"),
        (lambda: Photograph(1, np.zeros((0, 2, 3), np.uint8)), r"legal: \(H, W, 3\) uint8"),
    ],
)
def test_invalid_frames_are_refused(make: Any, message: str) -> None:
    with pytest.raises((TypeError, ValueError), match=message):
        make()
