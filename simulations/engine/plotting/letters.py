"""Widths of words in view box units, for placing labels without overlap.

They are estimates, rather too large, for the book's sans-serif face at the size of labels where a
panel is smallest (`static/css/overlay.css`).
"""

import re

from simulations.engine.drafting import SCRIPT, SCRIPT_SIZE

LARGE, SMALL = 16.0, 15.5
"""Sizes of labels in view box units, plain and ``small``."""
ASCENT, DESCENT = 0.72, 0.22
"""Width of a letter, as a share of the size."""
STRONG = 1.05
"""Width of bold letters relative to plain ones."""
NARROW, WIDE, WIDEST = "fijlrt.,:;'!|()[]·-/ ’‘\u00a0\u2009", "mwABDGHKNOQRUVXYΔΩμ%+−=×<>→", "MW—…"
PLAIN_EM, NARROW_EM, WIDE_EM, WIDEST_EM = 0.56, 0.36, 0.7, 1.0

_OF_LETTER = {
    **dict.fromkeys(NARROW, NARROW_EM),
    **dict.fromkeys(WIDE, WIDE_EM),
    **dict.fromkeys(WIDEST, WIDEST_EM),
}


def size_of(style: str) -> float:
    """View box units."""
    return SMALL if "small" in style.split() else LARGE


def width_of(words: str, style: str = "") -> float:
    """Largest width of a label in view box units; indices as in `drafting.label`."""
    size = size_of(style) * (STRONG if "strong" in style.split() else 1.0)
    scripts = [found[2] or found[3] for found in SCRIPT.finditer(words)]
    plain = re.sub(SCRIPT, "", words)
    return size * (_em(plain) + SCRIPT_SIZE * sum(map(_em, scripts)))


def _em(words: str) -> float:
    return sum(_OF_LETTER.get(letter) or _of_other(letter) for letter in words)


def _of_other(letter: str) -> float:
    return WIDE_EM if letter.isupper() and not letter.isascii() else PLAIN_EM
