"""Positions off the picture, pictures of one pixel, kernels that overshoot."""

import numpy as np

from simulations.engine.hard_cases import (
    HardCase,
    HardCases,
    LibraryAnswer,
    exactly,
    near,
    refused,
)
from simulations.models.sampling import resampling

RAMP = np.arange(12.0).reshape(3, 4)
EDGE = np.repeat([[0.0, 0.0, 0.0, 1.0, 1.0, 1.0]], 6, axis=0)

TABLE = HardCases(
    id="resampling",
    title="Resampling",
    names={**vars(resampling), "RAMP": RAMP, "EDGE": EDGE, "inf": np.inf, "nan": np.nan},
    cases=(
        HardCase(
            id="nan-position",
            call="sample(RAMP, [[nan, 1.0]])",
            why="A cast of NaN to an index is undefined, and differs between processors.",
            returns="The fill value, 0: a position that is not a number is off the picture.",
            expected=exactly([0.0]),
        ),
        HardCase(
            id="infinite-position",
            call="sample(RAMP, [[inf, 1.0]], fill=None)",
            why="∞ has no index either.",
            returns="The border pixel of that row, since the border repeats for ever.",
            expected=exactly([7.0]),
        ),
        HardCase(
            id="huge-position",
            call="sample(RAMP, [[1e300, 1.0]], fill=-1.0)",
            why="Far beyond the range of a 64-bit index.",
            returns="The fill value: positions are clamped before they become indices.",
            expected=exactly([-1.0]),
            library=LibraryAnswer(
                "cv2.remap(np.arange(12.0).reshape(3, 4), np.float32([[3e38]]), "
                "np.float32([[1.0]]), cv2.INTER_LINEAR, borderValue=-1)[0]",
                "[-1]",
            ),
        ),
        HardCase(
            id="left-edge",
            call="sample(RAMP, [[-0.5, 0.0]], fill=-1.0)",
            why="The outer edge of the first pixel, half a pixel left of its centre.",
            returns="Inside: the value of the border pixel.",
            expected=exactly([0.0]),
        ),
        HardCase(
            id="right-edge",
            call="sample(RAMP, [[3.5, 0.0]], fill=-1.0)",
            why="The outer edge of the last pixel. It must not belong to two neighbours at once.",
            returns="Outside: pixels are closed on the left and open on the right.",
            expected=exactly([-1.0]),
        ),
        HardCase(
            id="between-two-pixels",
            call="sample(RAMP, [[0.5, 0.0], [1.5, 0.0], [2.5, 0.0]], 'nearest')",
            why="Exactly half way: rounding to even would pick 0, 2, 2.",
            returns="1, 2, 3: always the right one, so that no pixel is skipped.",
            expected=exactly([1.0, 2.0, 3.0]),
            naive="np.rint([0.5, 1.5, 2.5])",
        ),
        HardCase(
            id="one-pixel",
            call="sample([[5.0]], [[0.2, -0.3]], 'lanczos3')",
            why="Six by six taps of a picture that has a single pixel.",
            returns="That pixel.",
            expected=near([5.0], 1e-6),
        ),
        HardCase(
            id="flat-lanczos",
            call="np.ptp(sample(np.ones((9, 9)), np.linspace([3, 4], [5, 4], 50), 'lanczos3'))",
            why="Lanczos weights do not quite add up to 1: a flat wall would ripple by 0.6 %.",
            returns="No more ripple than rounding: the weights are brought to a sum of 1.",
            expected=lambda got: got < 1e-6,
            naive="1 - np.sum(np.sinc(np.arange(-2.5, 3)) * np.sinc(np.arange(-2.5, 3) / 3))",
        ),
        HardCase(
            id="overshoot",
            call="sample(EDGE, [[1.5, 3.0], [3.5, 3.0]], 'bicubic')",
            why="Some bicubic weights are negative: near an edge they leave the data's range.",
            returns="Below 0 and above 1, as the kernel says. Clip when it becomes a picture.",
            expected=lambda got: got[0] < 0 and got[1] > 1,
            library=LibraryAnswer(
                "cv2.remap(np.repeat([[0.0, 0, 0, 1, 1, 1]], 6, axis=0), "
                "np.float32([[1.5, 3.5]]), np.float32([[3, 3]]), cv2.INTER_CUBIC)[0]",
                "[-0.09375, 1.0938]",
            ),
        ),
        HardCase(
            id="precise-fraction",
            call="sample(RAMP, [[1.01, 0.0]])",
            why="A fraction finer than 1/32 of a pixel.",
            returns="1.01.",
            expected=near([1.01], 1e-6),
            library=LibraryAnswer(
                "cv2.remap(np.arange(12.0).reshape(3, 4), np.float32([[1.01]]), "
                "np.float32([[0.0]]), cv2.INTER_LINEAR)[0]",
                "[1]",
            ),
        ),
        HardCase(
            id="large-values",
            call="sample(RAMP + 1e7, [[0.3, 0.6]]) - 1e7",
            why="In float32 the four weights do not add up to 1 by 3 · 10⁻⁸, which is 0.3 here.",
            returns="2.7: pictures of float64 are weighed in float64.",
            expected=near([2.7], 1e-8),
            naive="np.sum(np.outer(np.float32([0.4, 0.6]), np.float32([0.7, 0.3])) "
            "* (1e7 + np.array([[0.0, 1.0], [4.0, 5.0]]))) - 1e7",
        ),
        HardCase(
            id="shrink-to-one",
            call="resize(RAMP, 1, 1)",
            why="All pixels into one; reading the few nearest would forget the rest.",
            returns="Close to the mean, 5.5: the kernel widens as the picture shrinks.",
            expected=lambda got: abs(got[0, 0] - 5.5) < 1e-9,
            naive="RAMP[1, 1:3].mean() + 1",
            library=LibraryAnswer(
                "cv2.resize(np.arange(12.0).reshape(3, 4), (1, 1), "
                "interpolation=cv2.INTER_NEAREST)",
                "[[0]]",
            ),
        ),
        HardCase(
            id="shrink-a-grating",
            call="np.ptp(resize(np.tile([0.0, 1.0], (64, 32)), 21, 21))",
            why="Stripes of one pixel, reduced by about three: finer than the new grid can hold.",
            returns="Nearly flat grey. Plain bilinear reading makes coarse stripes of them.",
            expected=lambda got: got < 0.35,
            library=LibraryAnswer(
                "np.ptp(cv2.resize(np.tile([0.0, 1.0], (64, 32)), (21, 21)))", "0.95238"
            ),
        ),
        HardCase(
            id="size-zero",
            call="resize(RAMP, 0, 4)",
            why="A picture without rows.",
            returns="Refused.",
            expected=refused("height 0"),
            library=LibraryAnswer("cv2.resize(np.zeros((3, 4)), (4, 0))", "error"),
        ),
        HardCase(
            id="nan-pixel",
            call="np.isnan(sample([[0.0, nan, 0.0, 0.0]], [[0, 0], [0.5, 0], [3, 0]])).tolist()",
            why="A dead pixel that was marked as NaN.",
            returns="NaN where it takes part, with weight 0 as well, and nowhere else.",
            expected=lambda got: got == [True, True, False],
        ),
        HardCase(
            id="unknown-kernel",
            call="sample(RAMP, [[1.0, 1.0]], 'cubic')",
            why="A name that other libraries use.",
            returns="Refused, with the names that are legal.",
            expected=refused("cubic", "bicubic"),
        ),
    ),
)
