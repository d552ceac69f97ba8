"""Cut-outs of three pictures, and what three methods of demosaicing make of them."""

import numpy as np

from simulations.engine.drafting import label, picture
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.error_measures import psnr_db
from simulations.models.sensor.demosaicing import demosaic, mosaic
from simulations.pictures.balloon import WHOLE
from simulations.pictures.mosaic_subjects import SUBJECTS

METHODS = {"": "Truth", "bilinear": "Bilinear", "malvar": "Malvar", "menon-unrefined": "Menon"}
CORNERS = {"balloon": (36, 108), "room": (148, 96), "soft": (80, 80)}
"""Row and column of the first pixel that is shown of each picture."""
CELLS, WIDTH, SIDE, GAP = 24, 190.0, 180.0, 26.0
BORDER = 8  # pixels left out of the PSNR


def displayed_picture(subject: str, method: str) -> Floats:
    """(H, W, 3) the picture as a screen shows it, or reconstructed from its mosaic by a method."""
    truth = SUBJECTS[subject].draw(WHOLE)
    guess = demosaic(mosaic(truth), method=method) if method else truth
    return encode_srgb(np.clip(guess, 0.0, 1.0))


def fidelity(subject: str, method: str) -> float:
    """PSNR in dB of the whole picture."""
    return psnr_db(displayed_picture(subject, method), displayed_picture(subject, ""), crop=BORDER)


def draw() -> Illustration:
    panels, words = [], []
    for method, title in METHODS.items():
        overlay = ""
        for index, (subject, (row, column)) in enumerate(CORNERS.items()):
            top = index * (SIDE + GAP)
            part = displayed_picture(subject, method)[row : row + CELLS, column : column + CELLS]
            overlay += picture(((WIDTH - SIDE) / 2, top), SIDE, SIDE, to_rgba8(part))
            if method:
                decibels = f"{fidelity(subject, method):.1f} dB"
                at = (WIDTH / 2, top + SIDE + 17)
                overlay += label(at, decibels, "muted", "middle")
                words.append(f"{title} {decibels} on the {SUBJECTS[subject].label.lower()}")
        height = len(CORNERS) * (SIDE + GAP)
        panels.append(Panel(title.lower(), title, WIDTH, height, overlay=overlay))
    return Illustration(
        tuple(panels),
        "Cut-outs of three pictures, true and filled in by three methods, with the PSNR of the "
        f"whole picture: {', '.join(words)}.",
    )
