"""All numbers of a toy floating-point format: as many between 1 and 2 as between 4 and 8."""

from simulations.engine.drafting import dimension, label
from simulations.engine.drawing import line, path
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis

WIDTH, HEIGHT, FOOT = 400.0, 128.0, 66.0
AXIS = Axis(0.0, 8.0, 14, 386)
BITS, LOWEST, HIGHEST = 3, -2, 3
"""Bits after the leading one, and the exponents from the least normal one up to the end."""


def numbers() -> list[float]:
    """Every number from 0 up to the end of the axis, those below the least normal one included."""
    step = 2.0 ** (LOWEST - BITS)
    small = [n * step for n in range(2**BITS)]
    normal = [
        (1 + n / 2**BITS) * 2.0**exponent
        for exponent in range(LOWEST, HIGHEST)
        for n in range(2**BITS)
    ]
    return [*small, *normal, 2.0**HIGHEST]


def draw() -> Illustration:
    places = [AXIS.place(number) for number in numbers()]
    marks = [
        path([[(x, FOOT - 16), (x, FOOT)] for x in places], "image thin"),
        line((AXIS.start, FOOT), (AXIS.end, FOOT), "muted"),
    ]
    for exponent in range(HIGHEST + 1):
        x = AXIS.place(2.0**exponent)
        marks.append(line((x, FOOT - 24), (x, FOOT + 4), "camera bold"))
        marks.append(label((x, FOOT + 20), f"{2**exponent}", "camera", "middle"))
    marks.append(label((AXIS.start, FOOT + 20), "0", "camera", "middle"))
    for low in (1, 2, 4):
        ends = [(AXIS.place(value), FOOT - 34) for value in (low, 2 * low)]
        marks.append(dimension(ends[0], ends[1], "muted"))
        gap = f"gap {2.0**-BITS * low:g}" if low > 1 else f"{2.0**-BITS * low:g}"
        middle = ((ends[0][0] + ends[1][0]) / 2, FOOT - 44)
        marks.append(label(middle, gap, "muted small", "middle"))
    caption = "64-bit numbers: 2^{52} steps from each power of two to the next"
    marks.append(label((AXIS.start, HEIGHT - 4), caption, "small"))
    words = (
        f"A number line from 0 to {2**HIGHEST} with every number of a format that has {BITS} bits "
        f"behind the leading one. From each power of two to the next there are {2**BITS} steps, so "
        "the gaps double: 0.125 from 1 to 2, 0.25 from 2 to 4, 0.5 from 4 to 8. Below 0.25 they "
        "stay alike."
    )
    return Illustration((Panel("line", "", WIDTH, HEIGHT, overlay="".join(marks)),), words)
