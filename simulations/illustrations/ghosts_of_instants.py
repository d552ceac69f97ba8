"""A moving ball as the mean of few and of many instants, and as the integral."""

import numpy as np

from simulations.engine.drafting import label, picture
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.error_measures import root_mean_square
from simulations.models.sensor.exposure import mean_of_instants
from simulations.pictures import moving_ball

COUNTS = (4, 16)
FIRST, WIDTH = 26, 190.0  # column from which on the ball's way is shown
COLUMNS = 100


def exposed(count: int) -> Floats:
    """(96, 160) linear light: the mean of so many instants, or with 0 the integral."""
    x, y = moving_ball.grid()
    if not count:
        return moving_ball.exposed(x, y)
    behind = moving_ball.wall(x, y)
    return mean_of_instants(lambda time: moving_ball.instant(x, y, time, behind), count)


def error_codes(count: int) -> float:
    """RMS in codes, as shown, where the ball passes."""
    x, y = moving_ball.grid()
    swept = moving_ball.exposed(x, y) != moving_ball.wall(x, y)
    return 255 * root_mean_square((encode_srgb(exposed(count)) - encode_srgb(exposed(0)))[swept])


def draw() -> Illustration:
    height = WIDTH * moving_ball.HEIGHT / COLUMNS
    panels = []
    for count in (*COUNTS, 0):
        displayed = encode_srgb(exposed(count))[:, FIRST : FIRST + COLUMNS]
        overlay = picture((0.0, 0.0), WIDTH, height, to_rgba8(np.clip(displayed, 0.0, 1.0)))
        off = f"{error_codes(count):.1f} codes off" if count else "exact"
        overlay += label((WIDTH / 2, height + 18), off, "muted", "middle")
        title = f"{count} instants" if count else "The integral"
        panels.append(Panel(f"of-{count}", title, WIDTH, height + 24, overlay=overlay))
    return Illustration(
        tuple(panels),
        "A striped ball that moves to the right while the shutter is open. "
        + "; ".join(f"of {count} instants, {error_codes(count):.1f} codes off" for count in COUNTS)
        + "; by the integral its edges and stripes are smooth ramps.",
    )
