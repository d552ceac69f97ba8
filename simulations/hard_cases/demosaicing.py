"""Mosaics of one pixel, of one row, of odd sizes; flat colours, hard edges, missing values."""

import numpy as np

from simulations.engine.hard_cases import (
    HardCase,
    HardCases,
    LibraryAnswer,
    exactly,
    near,
    refused,
)
from simulations.models import error_measures
from simulations.models.sensor import bayer, demosaicing

ORANGE = np.array([1.0, 0.5, 0.1])


def spread(method: str, pattern: str, height: int, width: int) -> float:
    """Largest departure from a flat orange after mosaic and reconstruction."""
    flat = np.broadcast_to(ORANGE, (height, width, 3))
    restored = demosaicing.demosaic(bayer.mosaic(flat, pattern), pattern, method)
    return float(np.abs(restored - ORANGE).max())


def edge(method: str) -> np.ndarray:
    """Range of the values that a method returns for a sharp grey edge between 0 and 1."""
    grey = np.repeat(np.repeat([[0.0, 1.0]], 6, axis=1), 12, axis=0)[..., None] * np.ones(3)
    restored = demosaicing.demosaic(bayer.mosaic(grey), "RGGB", method)
    return np.array([restored.min(), restored.max()])


TABLE = HardCases(
    id="demosaicing",
    title="Demosaicing",
    names={
        **vars(bayer),
        **vars(demosaicing),
        **vars(error_measures),
        "spread": spread,
        "edge": edge,
        "inf": np.inf,
        "nan": np.nan,
    },
    cases=(
        HardCase(
            id="single-pixel",
            call="demosaic([[0.25]])",
            why="One red pixel: nothing at all is known of green and blue.",
            returns="Grey of that value. With no colour to see, none is invented.",
            expected=exactly([[[0.25, 0.25, 0.25]]]),
            library=LibraryAnswer(
                "cv2.cvtColor(np.uint8([[64]]), cv2.COLOR_BayerRGGB2RGB)[0, 0]", "[0, 0, 0]"
            ),
        ),
        HardCase(
            id="single-row",
            call="demosaic([[1.0, 0.5, 1.0, 0.5]])[0, :, 2]",
            why="A row of red and green filters holds no blue.",
            returns="The mean of the two colours that there are.",
            expected=exactly([0.75, 0.75, 0.75, 0.75]),
        ),
        HardCase(
            id="flat-nearest",
            call="spread('nearest', 'RGGB', 5, 7)",
            why="Odd sizes leave half a quad at two borders.",
            returns="0: a flat colour stays exactly flat, up to the last pixel.",
            expected=exactly(0.0),
        ),
        HardCase(
            id="flat-bilinear",
            call="spread('bilinear', 'BGGR', 5, 7)",
            why="At the border half of the neighbours are missing.",
            returns="Rounding at most: mirroring about the edge pixel keeps the filters' order.",
            expected=near(0.0, 1e-15),
            library=LibraryAnswer(
                "np.ptp(cv2.cvtColor(np.tile(np.uint8([[26, 128], [128, 255]]), (3, 4)), "
                "cv2.COLOR_BayerBGGR2RGB)[..., 0])",
                "0",
            ),
        ),
        HardCase(
            id="flat-malvar",
            call="spread('malvar', 'GRBG', 2, 2)",
            why="A filter of 5 × 5 on a picture of 2 × 2.",
            returns="0: the corrections of a flat colour cancel without rounding.",
            expected=exactly(0.0),
        ),
        HardCase(
            id="flat-menon",
            call="spread('menon', 'GBRG', 2, 9)",
            why="A decision between rows and columns where both are equally calm.",
            returns="No more than rounding: a tie goes to the rows, and both agree.",
            expected=near(0.0, 1e-15),
        ),
        HardCase(
            id="overshoot-malvar",
            call="edge('malvar')",
            why="Gradient-corrected filters have negative weights.",
            returns="Below 0 and above 1, left as they are: only the caller knows when to clip.",
            expected=lambda got: got[0] < 0.0 and got[1] > 1.0,
        ),
        HardCase(
            id="no-overshoot-bilinear",
            call="edge('bilinear')",
            why="The same edge through averages only.",
            returns="Within 0 and 1, but with colour fringes.",
            expected=exactly([0.0, 1.0]),
        ),
        HardCase(
            id="hot-pixel",
            call="np.isnan(demosaic(np.pad([[nan]], 4), method='bilinear')).sum()",
            why="A dead pixel marked as NaN spreads through every average.",
            returns="9: red in its 3 × 3 surroundings, and not one value beyond.",
            expected=exactly(9),
        ),
        HardCase(
            id="huge-values",
            call="demosaic(np.full((4, 4), 1e300)).max()",
            why="Sums of four near the largest number.",
            returns="1e300.",
            expected=near(1e300),
        ),
        HardCase(
            id="whole-numbers",
            call="demosaic(np.array([[10, 11], [11, 10]], np.uint8))[0, 0, 1]",
            why="11 + 11 fits into eight bits; 200 + 200 would wrap around to 144.",
            returns="11, in floating point: codes become numbers before anything is added.",
            expected=exactly(11.0),
            naive="(np.uint8(200) + np.uint8(200)) // 2",
        ),
        HardCase(
            id="empty",
            call="demosaic(np.zeros((0, 4)))",
            why="A picture without rows.",
            returns="Refused.",
            expected=refused("(0, 4)", "not empty"),
        ),
        HardCase(
            id="colour-picture",
            call="demosaic(np.zeros((4, 4, 3)))",
            why="A picture that has been through demosaicing already.",
            returns="Refused.",
            expected=refused("(4, 4, 3)"),
        ),
        HardCase(
            id="unknown-pattern",
            call="mosaic(np.zeros((4, 4, 3)), 'RGBG')",
            why="A pattern that is no Bayer mosaic.",
            returns="Refused, with the four that are.",
            expected=refused("RGBG", "RGGB"),
        ),
        HardCase(
            id="perfect-score",
            call="psnr_db(np.ones((9, 9)), np.ones((9, 9)), crop=0)",
            why="No error at all: log 1/0.",
            returns="∞ dB.",
            expected=exactly(np.inf),
            library=LibraryAnswer("cv2.PSNR(np.ones((9, 9)), np.ones((9, 9)))", "361.2"),
        ),
        HardCase(
            id="score-of-nothing",
            call="psnr_db(np.ones((9, 9)), np.ones((9, 9)), crop=5)",
            why="The crop leaves no pixel: the mean of nothing.",
            returns="Refused.",
            expected=refused("crop 5"),
            naive="np.float64(0.0) / 0",
        ),
        HardCase(
            id="score-of-a-glare",
            call="psnr_db(np.full((20, 20), inf), np.zeros((20, 20)))",
            why="The logarithm of 1/∞.",
            returns="−∞ dB.",
            expected=exactly(-np.inf),
        ),
    ),
)
