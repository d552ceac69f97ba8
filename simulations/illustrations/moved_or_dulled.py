"""Three pictures, moved by two pixels, and without their fine waves: what PSNR makes of both."""

import numpy as np

from simulations.engine.drafting import picture
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats
from simulations.models.error_measures import psnr_db
from simulations.models.sampling.fine_detail import FINE
from simulations.pictures.round_windows import INSIDE, PICTURES, SIZE, pictures_at, places

WIDTH, HEIGHT = 190.0, 79.0  # of a crop
CROP = slice(56, 76), slice(40, 88)  # rows and columns
MOVED_PX = 2.0


def sharp_pictures() -> Floats:
    """(128, 128, 3) the pictures."""
    return pictures_at(*places())


def shifted_pictures() -> Floats:
    """(128, 128, 3) the same, two pixels farther to the right."""
    x, y = places()
    return pictures_at(x - MOVED_PX, y)


def blurred_pictures() -> Floats:
    """(128, 128, 3) the same, without waves shorter than six pixels."""
    frequency = np.hypot(np.fft.fftfreq(SIZE)[:, None], np.fft.fftfreq(SIZE))
    waves = np.fft.fft2(sharp_pictures(), axes=(0, 1)) * (frequency < FINE)[..., None]
    return np.fft.ifft2(waves, axes=(0, 1)).real


def psnr_each(copies: Floats) -> list[float]:
    """PSNR of the three copies, in dB, within the window."""
    truth = sharp_pictures()
    return [psnr_db(copies[INSIDE, n], truth[INSIDE, n]) for n in range(len(PICTURES))]


def crops(pictures: Floats) -> str:
    """A piece of each picture, one above the other, magnified."""
    return "".join(
        picture((0.0, n * (HEIGHT + 3.0)), WIDTH, HEIGHT, to_rgba8(pictures[*CROP, n]))
        for n in range(len(PICTURES))
    )


def draw() -> Illustration:
    panels_by_title = {
        "The pictures": sharp_pictures(),
        "Moved by 2 px": shifted_pictures(),
        "Without waves below 6 px": blurred_pictures(),
    }
    panels = tuple(
        Panel(f"copy-{n}", title, WIDTH, 3 * HEIGHT + 6, overlay=crops(pictures))
        for n, (title, pictures) in enumerate(panels_by_title.items())
    )
    words = (
        "Pieces of three pictures. Moved by two pixels they look the same. Without waves shorter "
        "than six pixels the fine waves are gone, the outer rings grey, the discs soft."
    )
    return Illustration(panels, words)
