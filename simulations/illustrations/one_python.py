"""The same modules run twice: by the author's Python for the page, and in the reader's browser."""

from simulations.engine.drafting import box, label
from simulations.engine.drawing import arrow, line
from simulations.engine.illustration import Illustration, Panel

WIDTH, HEIGHT = 400.0, 300.0
COLUMNS = (104.0, 296.0)
BOX_WIDTH, BOX_HEIGHT = 168.0, 42.0
ROWS = (92.0, 166.0, 240.0)
SOURCE = ("scenes and models", "camera")  # the modules that both run
ROWS_OF_WORDS = (
    (("CPython", "world"), ("CPython in WebAssembly", "world")),
    (("frame at the first settings", "image"), ("frame at your settings", "image")),
    (("picture in the page", "light"), ("canvas in its place", "light")),
)
HEADINGS = ("when the book is built", "while you read")


def draw() -> Illustration:
    middle = WIDTH / 2
    marks = [
        box((middle - BOX_WIDTH / 2, 10), BOX_WIDTH, 36, 4, f"{SOURCE[1]} fill"),
        label((middle, 33), SOURCE[0], f"{SOURCE[1]} strong", "middle"),
        line((middle, 76), (middle, HEIGHT - 6), "muted dashed"),
    ]
    for x, heading in zip(COLUMNS, HEADINGS, strict=True):
        side = -1 if x < middle else 1
        marks.append(label((x, 82), heading, "muted small", "middle"))
        marks.append(arrow((middle + side * 52, 46), (middle + side * 72, 70), "muted"))
    for (left, right), y in zip(ROWS_OF_WORDS, ROWS, strict=True):
        for (words, role), x in zip((left, right), COLUMNS, strict=True):
            marks.append(box((x - BOX_WIDTH / 2, y), BOX_WIDTH, BOX_HEIGHT, 4, f"{role} fill"))
            marks.append(label((x, y + 26), words, role, "middle"))
            if y != ROWS[0]:
                marks.append(arrow((x, y - (ROWS[1] - ROWS[0] - BOX_HEIGHT)), (x, y), "muted"))
    sentences = "; ".join(
        f"{heading}, {column[0][0]} computes the {column[1][0]}, shown as a {column[2][0]}"
        for heading, column in zip(HEADINGS, zip(*ROWS_OF_WORDS, strict=True), strict=True)
    )
    words = f"The same {SOURCE[0]} are run twice: {sentences}."
    return Illustration((Panel("runs", "", WIDTH, HEIGHT, overlay="".join(marks)),), words)
