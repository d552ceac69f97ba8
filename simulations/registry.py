"""The tables of scenes and ladders: id to module. A module is imported only when asked for."""

from collections.abc import Mapping
from importlib import import_module
from types import ModuleType
from typing import Any

from simulations.engine.controls import suggestion
from simulations.engine.ladder import Ladder
from simulations.engine.scene import Scene

SCENE_MODULES = {
    "formation-pipeline": "simulations.scenes.formation_pipeline.scene",
    "transform-2d": "simulations.scenes.transform_2d.scene",
    "perspective-projection": "simulations.scenes.perspective_projection.scene",
    "lens-distortion": "simulations.scenes.lens_distortion.scene",
    "lambertian-shading": "simulations.scenes.reflection.lambertian",
    "bayer-demosaic": "simulations.scenes.bayer_demosaic.scene",
    "camera": "simulations.scenes.camera.scene",
    "rotation-3d": "simulations.scenes.rotation_3d.scene",
    "aliasing": "simulations.scenes.aliasing.scene",
    "wagon-wheel": "simulations.scenes.wagon_wheel.scene",
    "phong": "simulations.scenes.reflection.phong",
    "sensor-noise": "simulations.scenes.sensor_noise.scene",
    "depth-of-field": "simulations.scenes.depth_of_field.scene",
    "lens-aberrations": "simulations.scenes.lens_aberrations.scene",
    "jpeg": "simulations.scenes.jpeg.scene",
    "tiled-floor": "simulations.scenes.tiled_floor.scene",
    "two-views": "simulations.scenes.two_views.scene",
    "resolution": "simulations.scenes.resolution.scene",
    "real-lens": "simulations.scenes.real_lens.scene",
    "brdf": "simulations.scenes.brdf.scene",
    "second-bounce": "simulations.scenes.second_bounce.scene",
    "spectrum-to-rgb": "simulations.scenes.spectrum_to_rgb.scene",
}

LADDER_MODULES = {
    "inverse-distortion": "simulations.ladders.inverse_distortion",
    "inverse-strong": "simulations.ladders.inverse_strong",
    "inverse-decentring": "simulations.ladders.inverse_decentring",
    "srgb": "simulations.ladders.srgb",
    "demosaicing": "simulations.ladders.demosaicing",
    "resampling": "simulations.ladders.resampling",
    "shot-noise": "simulations.ladders.shot_noise",
    "rotation-interpolation": "simulations.ladders.rotation_interpolation",
    "small-rotations": "simulations.ladders.small_rotations",
    "shading": "simulations.ladders.shading",
    "precision": "simulations.ladders.precision",
    "vignetting": "simulations.ladders.vignetting",
    "block-dct": "simulations.ladders.block_dct",
    "chroma-upsampling": "simulations.ladders.chroma_upsampling",
    "homography-estimation": "simulations.ladders.homography_estimation.ladder",
    "anti-aliasing": "simulations.ladders.anti_aliasing",
    "edge-coverage": "simulations.ladders.edge_coverage",
    "chromatic-aberration": "simulations.ladders.chromatic_aberration",
    "depth-of-field": "simulations.ladders.depth_of_field.ladder",
    "wide-discs": "simulations.ladders.wide_discs",
    "exposure-blur": "simulations.ladders.exposure_blur",
}


class UnknownIdError(KeyError):
    """No scene or no ladder of that id; the message names the nearest legal one, or all."""

    def __str__(self) -> str:
        return str(self.args[0])


def load_scene(scene_id: str) -> Scene[Any]:
    """The scene ``scene_id``: the ``SCENE`` of its module. Raises `UnknownIdError`."""
    return _module("simulation", scene_id, SCENE_MODULES).SCENE


def load_ladder(ladder_id: str) -> Ladder:
    """The ladder ``ladder_id``: the ``LADDER`` of its module. Raises `UnknownIdError`."""
    return _module("ladder", ladder_id, LADDER_MODULES).LADDER


def _module(kind: str, wanted: str, modules: Mapping[str, str]) -> ModuleType:
    if wanted not in modules:
        hint = suggestion(wanted, modules) or f"; legal: {', '.join(modules)}"
        raise UnknownIdError(f"unknown {kind} {wanted!r}{hint}")
    return import_module(modules[wanted])
