"""Widths of words, for grounds of labels and for placing labels without overlap.

The widths are from the book's sans-serif face, rounded to 1/20 of the size of its letters. Sizes
in view box units hold where a panel is smallest (`static/css/overlay.css`).
"""

import functools
import re

SCRIPT = re.compile(r"([_^])(?:\{([^}]*)\}|(.))")
"""An index or an exponent: ``z_s``, ``r^2``, ``N_{min}``."""
SCRIPT_SIZE = 0.74
"""Size of a script's letters, relative to the label's."""
LARGE, SMALL = 16.0, 15.5
"""Sizes of labels in view box units, plain and ``small``."""
ASCENT, DESCENT = 0.72, 0.22
"""Height and depth of letters, as shares of the size."""
STRONG = 1.06
"""Width of bold letters relative to plain ones."""
USUAL_EM, CAPITAL_EM = 0.52, 0.68
"""Widths of letters that the table does not have."""
LETTERS_EM = {
    0.2: " \u00a0\u2009",
    0.26: "',.:;Iijl|·‘’′",
    0.31: "!()-[]f{}",
    0.36: "/rt°²³⁰¹₀₁₂₃",
    0.42: "*?sz",
    0.46: '"cvxy“”ντ″',
    0.57: "ACEPRSTZbdhnopquµαβδμρση",
    0.62: "&BDGK→↑πΔ",
    0.66: "HNOQU⁻",
    0.72: "wφωΩψ",
    0.77: "M",
    0.84: "%W—∞½@m",
    0.96: "…",
}
"""Letters by their widths."""

_OF_LETTER = {letter: width for width, letters in LETTERS_EM.items() for letter in letters}


def size_of(style: str) -> float:
    """View box units."""
    return SMALL if "small" in style.split() else LARGE


def width_of(words: str, style: str = "") -> float:
    """Largest width of a label in view box units; indices as in `drafting.label`."""
    return size_of(style) * width_em(words, strong="strong" in style.split())


@functools.lru_cache(512)
def width_em(words: str, *, strong: bool = False) -> float:
    """Width of a label in sizes of its letters; indices as in `drafting.label`."""
    scripts = [found[2] or found[3] for found in SCRIPT.finditer(words)]
    plain = SCRIPT.sub("", words)
    weight = STRONG if strong else 1.0
    return weight * (_em(plain) + SCRIPT_SIZE * sum(map(_em, scripts)))


def _em(words: str) -> float:
    return sum(_OF_LETTER.get(letter) or _of_other(letter) for letter in words)


def _of_other(letter: str) -> float:
    return CAPITAL_EM if letter.isupper() and not letter.isascii() else USUAL_EM
