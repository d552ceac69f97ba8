"""The frame of the close-up in the picture of the lens-aberrations scene."""

from simulations.engine.drawing import rectangle

WIDTH, HEIGHT = 400.0, 300.0


def close_up_frame(left: float, top: float) -> str:
    """The frame of the close-up; ``left`` and ``top`` are shares of the picture."""
    corner, size = (left * WIDTH, top * HEIGHT), ((1 - left) * WIDTH - 1, (1 - top) * HEIGHT - 1)
    return "".join(rectangle(corner, *size, style) for style in ("casing", "camera"))
