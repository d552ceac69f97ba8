"""The stages of the still life: surfaces, light, blur, and bytes."""

from collections.abc import Mapping

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.color.srgb import encode_srgb_table
from simulations.models.projection import pinhole
from simulations.pictures.still_life.light import LitScene
from simulations.scenes._still_life_camera.picture import (
    blur_layers,
    find_surfaces,
    light_surfaces,
    overlay,
)
from simulations.scenes._still_life_camera.rays import Rays
from simulations.scenes.still_life.settings import Settings
from simulations.scenes.still_life.view import FILM_WIDTH_MM, FOCAL_MM, disc_width

DRAFT = "draft"
"""The picture while a control moves."""
COLUMNS, DRAFT_COLUMNS = 800, 400
"""Pixels across, at rest and in the draft; half as many down."""


def parameters(_settings: Settings, tier: str) -> Mapping[str, Value]:
    """Further parameters of the stages."""
    return {"columns": DRAFT_COLUMNS if tier == DRAFT else COLUMNS, "back": 0.0, "enlarged": 1.0}


def _rays(columns: int) -> Rays:
    rows = columns // 2
    K = pinhole.intrinsics(
        columns * FOCAL_MM / FILM_WIDTH_MM, ((columns - 1) / 2.0, (rows - 1) / 2.0)
    )
    return Rays(pinhole.pixel_rays(K, columns, rows), np.ones((rows, columns), bool))


def _defocus(lit: LitScene, aperture: float, focus: float, columns: int) -> LitScene:
    return blur_layers(lit, lambda depth: columns * disc_width(aperture, focus, depth) / 2.0)


def _picture(lit: LitScene, enlarged: float) -> Raster:
    return to_rgba8(encode_srgb_table(overlay(lit, enlarged).transpose(1, 2, 0)))


STAGES = (
    Stage("rays", _rays),
    Stage("surfaces", find_surfaces, ("rays",)),
    Stage("light", light_surfaces, ("surfaces",)),
    Stage("defocus", _defocus, ("light",)),
    Stage("picture", _picture, ("defocus",)),
)
