"""Shot noise: an evenly lit wall in four exposures."""

import math

import numpy as np

from simulations.engine.drafting import label, picture
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.sensor.photon_counting import shot_noise

SIDE, CELLS, PITCH = 190.0, 12, 14.0
MEANS_E = (3, 30, 300, 3000)
GREY = 0.3  # displayed brightness of the mean, in linear light
SEED = 6


def electron_counts(mean_e: float) -> Floats:
    """Electrons counted in each cell."""
    return shot_noise(np.full((CELLS, CELLS), float(mean_e)), np.random.default_rng(SEED))


def draw() -> Illustration:
    panels = []
    edge = (SIDE - CELLS * PITCH) / 2
    for mean in MEANS_E:
        displayed = encode_srgb(np.clip(GREY * electron_counts(mean) / mean, 0, 1))
        noise = f"noise {100 / math.sqrt(mean):.2g} %"
        overlay = picture((edge, 0.0), CELLS * PITCH, CELLS * PITCH, to_rgba8(displayed))
        overlay += label((SIDE / 2, CELLS * PITCH + 20), noise, "muted", "middle")
        panels.append(Panel(f"mean-{mean}", f"{mean} electrons", SIDE, 196, overlay=overlay))
    words = "A wall of one grey, seen by 12 by 12 cells, with " + ", ".join(
        f"{mean} electrons a cell (noise {100 / math.sqrt(mean):.2g} %)" for mean in MEANS_E
    )
    return Illustration(
        tuple(panels), f"{words}. The first is a scatter of blacks and whites, the last is even."
    )
