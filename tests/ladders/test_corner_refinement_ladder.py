"""The ways to refine a corner stand in the order that the book gives them."""

from functools import cache, partial

import cv2
import numpy as np
import pytest
from support.ladder_run import LadderRun

from simulations.ladders.corner_refinement import BOARD, LADDER, OFF_PX, RADIUS, _view, rms_px
from simulations.models.geometry.rotations import logarithm

RUN = LadderRun(LADDER)


@cache
def errors_px(look: str = "") -> dict[str, float]:
    return RUN.measured(partial(rms_px, look=look))


def test_the_reference_is_where_opencv_projects_the_board() -> None:
    view = _view()
    pose, lens = view.board_to_camera, np.array(view.lens.opencv)
    oracle, _ = cv2.projectPoints(
        BOARD.points_mm, logarithm(pose[:3, :3]), pose[:3, 3], view.K, lens
    )
    assert np.abs(oracle[:, 0] - RUN.truth[0]).max() < 1e-9


def test_searches_begin_off_the_corners_and_windows_hold_one_corner_each() -> None:
    for part in RUN.work:
        assert 0.5 * OFF_PX < rms_px((part.begin,), (part.truth,), (part,)) < 2 * OFF_PX
        apart = np.hypot(*(part.truth[:, None] - part.truth).transpose(2, 0, 1))
        assert apart[apart > 0].min() > 2 * RADIUS


@pytest.mark.parametrize(
    ("better", "worse", "at_least"),
    [
        ("taylor", "peak", 1.5),
        ("parabola-3", "taylor", 5.0),
        ("fit", "parabola-3", 1.3),
        ("fit", "gradients", 2.0),
    ],
)
def test_the_more_pixels_and_the_better_the_model_the_nearer(
    better: str, worse: str, at_least: float
) -> None:
    assert errors_px()[worse] > at_least * errors_px()[better]


@pytest.mark.parametrize("tier", ["parabola-8", "gradients"])
def test_uneven_light_moves_what_has_no_term_for_it(tier: str) -> None:
    assert errors_px("lit")[tier] > 4 * errors_px("noisy")[tier]
    assert errors_px("lit")["fit"] < 3 * errors_px("noisy")["fit"]


def test_opencv_s_refinement_is_the_one_by_slopes() -> None:
    part = RUN.work[0]
    until = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 30, 1e-4)
    begin = np.ascontiguousarray(part.begin[:, None], np.float32)
    theirs = cv2.cornerSubPix(part.codes, begin, (7, 7), (-1, -1), until)[:, 0]
    error = rms_px((theirs,), (part.truth,), (part,))
    assert 0.5 < error / errors_px("noisy")["gradients"] < 4.0
