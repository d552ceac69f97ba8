"""From the raw values of a sensor to a file: what each step does, and the bits of a pixel."""

from simulations.engine.drafting import box, label
from simulations.engine.drawing import arrow
from simulations.engine.illustration import Illustration, Panel

STATIONS = (
    ("raw mosaic", "one colour a cell, in proportion to light", "12 bits", "light"),
    ("three colours", "the two others filled in from neighbours", "36 bits", "light"),
    ("white paper white", "three factors: white balance", "36 bits", "world"),
    ("colours of a display", "a 3 × 3 matrix", "36 bits", "world"),
    ("codes", "the sRGB curve, rounded", "24 bits", "camera"),
    ("JPEG", "what is seen least left out", "2 to 3 bits", "image"),
)
"""What comes out, what the step does, the bits of a pixel, and a role."""
LEFT, BOX_WIDTH, BOX_HEIGHT, STEP = 8.0, 138.0, 30.0, 46.0


def draw() -> Illustration:
    marks = []
    for index, (name, what, bits, role) in enumerate(STATIONS):
        y = 8 + index * STEP
        middle, line = LEFT + BOX_WIDTH / 2, y + 20
        marks.append(box((LEFT, y), BOX_WIDTH, BOX_HEIGHT, 4, f"{role} fill"))
        marks.append(label((middle, line), name, f"{role} strong", "middle"))
        marks.append(label((LEFT + BOX_WIDTH + 10, line - 6), what, "muted small"))
        marks.append(label((LEFT + BOX_WIDTH + 10, line + 9), bits, "small"))
        if index:
            marks.append(arrow((middle, y - STEP + BOX_HEIGHT), (middle, y), "muted"))
    words = "; ".join(f"{name}: {what}, {bits} a pixel" for name, what, bits, _ in STATIONS)
    size = (400.0, 8 + len(STATIONS) * STEP)
    return Illustration((Panel("chain", "", *size, overlay="".join(marks)),), f"{words}.")
