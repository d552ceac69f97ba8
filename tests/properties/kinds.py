"""Kinds of arguments: examples, legal values from the whole range of floats, and illegal ones."""

import dataclasses
import math
import re
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from simulations.models.color import cie
from simulations.models.color.chromatic_adaptation import RESPONSES
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.models.compression import blocks, chroma_upsampling
from simulations.models.compression.chroma_subsampling import SUBSAMPLING
from simulations.models.distortion import fisheye
from simulations.models.distortion.fisheye import Fisheye
from simulations.models.distortion.lens_model import Distortion
from simulations.models.distortion.radial_profile import RadialProfile
from simulations.models.geometry import homography_algebra, quaternions, rotations, transforms
from simulations.models.lens.chromatic_aberration import Glass
from simulations.models.lens.depth_of_field import Layer
from simulations.models.lens.singlet import Singlet
from simulations.models.light import brdf
from simulations.models.light.brdf import Material
from simulations.models.light.raycasting import Box, Sphere
from simulations.models.light.reflectance import DirectionalLight, PointLight
from simulations.models.projection import pinhole
from simulations.models.projection.single_view import fit_view
from simulations.models.projection.single_view_lengths import Stretch
from simulations.models.sampling import prefilters, resampling
from simulations.models.sampling.cubic_warp import cubic_warp
from simulations.models.sampling.slanted_edge_picture import edge_picture
from simulations.models.sensor import demosaicing
from simulations.models.sensor.bayer import PATTERNS
from simulations.models.sensor.photon_counting import SHOT_MODELS, Sensor

type Rng = np.random.Generator

NAN, INF = math.nan, math.inf
LANDMARKS = (
    *(0.0, 5e-324, 2.2e-308, 1e-200, 1e-154, 1e-16, 1e-8, 0.5, 1.0, 3.0),
    *(1e8, 1e16, 1.3e154, 1e200, 1.7e308, INF),
)
"""Where formulae break: smallest numbers, squares that vanish or overflow, infinity."""


@dataclasses.dataclass(frozen=True)
class Kind:
    """A range of values of an argument."""

    example: Any
    draw: Callable[[Rng], Any]
    ends: Sequence[Any] = ()
    """Legal values that must give a result, with examples of the other arguments."""
    illegal: Sequence[Any] = ()
    stack: bool = False
    """Whether each entry along the first axis has its own result."""
    single: bool = False
    """Whether a single number is legal in place of the array."""

    def shaped(self, shape: tuple[int, ...], mark: str, given: bool) -> "Kind":
        """Arrays of such numbers; with a mark, one more in the last axis is illegal."""
        rng, size = np.random.default_rng(0), math.prod(shape)
        entries = [e for e in self.ends if abs(e) <= 1.0] or [0.5 * self.example, self.example]
        low, high = min(entries), max(entries)
        spread = rng.uniform(low + 0.1 * (high - low), high, shape)
        example = np.full(shape, self.example) if given else spread
        square = len(shape) == 2 and shape[0] == shape[1] <= 4 and not given
        example = np.eye(shape[0]) + 0.1 * example if square else example

        def with_one(value: float) -> Any:
            changed = example.copy()
            changed.flat[-1] = value
            return changed

        wider = [np.concatenate([example, example[..., :1]], axis=-1)] if mark else []
        return Kind(
            example,
            lambda rng: np.reshape([self.draw(rng) for _ in range(size)], shape),
            [with_one(end) for end in self.ends],
            [with_one(value) for value in self.illegal] + wider,
            mark == "*",
            not mark and len(shape) == 1,
        )


def interval(closed_low: bool, low: float, high: float, closed_high: bool) -> Kind:
    def inside(value: float) -> bool:
        above = low < value or (closed_low and value == low)
        return above and (value < high or (closed_high and value == high))

    signed = [sign * value for value in (*LANDMARKS, low, high) for sign in (1.0, -1.0)]
    legal = list(filter(inside, signed))
    middle = next(filter(inside, (0.5, 1.0, 2.0, 2.0 * low, 0.5 * (low + high))))

    def draw(rng: Rng) -> float:
        any_size = float(rng.choice([1.0, -1.0]) * 10.0 ** rng.uniform(-20, 20))
        near = float(rng.uniform(max(low, middle - 5.0), min(high, middle + 5.0)))
        found = (legal[rng.integers(len(legal))], any_size, near)[rng.integers(3)]
        return found if inside(found) else middle

    ends = {low: closed_low, high: closed_high}
    steps = zip(ends.items(), (-INF, INF), strict=True)
    beyond = {math.nextafter(end, away) if closed else end for (end, closed), away in steps}
    illegal = [value for value in (*beyond, -INF, INF, NAN) if not inside(value)]
    return Kind(middle, draw, [end for end, closed in ends.items() if closed], illegal)


def integers(_left: bool, low: float, high: float, _right: bool) -> Kind:
    top = high if high < INF else low + 5
    legal = sorted({low, low + 1, top} & set(range(int(low), int(top) + 1)))
    beyond = [high + 1, INF] if high < INF else [INF]
    return Kind(
        int(min(low + 2, top)),
        lambda rng: int(legal[rng.integers(len(legal))]),
        [int(low), int(top)],
        [int(low) - 1, *beyond, low + 0.5, NAN],
    )


def listed(*legal: Any, no: Sequence[Any] = ()) -> Kind:
    """The listed values are legal, the first of which is the example; ``no`` are illegal."""
    return Kind(legal[0], lambda rng: legal[rng.integers(len(legal))], legal, no)


def arrays_of_ones(*shapes: tuple[int, ...]) -> list[Any]:
    return [np.ones(shape) for shape in shapes]


def one_of(*words: str) -> Kind:
    return listed(*words, no=["magic", ""])


def changed_somewhere(value: Any, *entries: float) -> list[Any]:
    """Arrays with one of the entries in the last place."""
    made = []
    for entry in entries:
        changed = np.array(value, float)
        changed.flat[-1] = entry
        made.append(changed)
    return made


NUMBER = interval(True, -INF, INF, True)
ANY = Kind(0.5, lambda rng: NAN if rng.random() < 0.05 else NUMBER.draw(rng), (0.0, INF, -INF, NAN))
I3, MIRROR = np.eye(3), np.diag([1.0, 1.0, -1.0])
TURN, UP = rotations.exponential([0.3, -0.5, 0.8]), (0.0, 0.0, 1.0)
K = pinhole.intrinsics((800.0, 790.0), (320.0, 240.0), 0.5)
KEYSTONE = transforms.projective([[1.1, 0.2, 30], [-0.1, 0.9, 5], [1e-3, 2e-4, 1]])
POSE = pinhole.look_at([1.0, 2.0, -3.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0])
COEFFICIENTS = [field.name for field in dataclasses.fields(Distortion)]
SPECTRUM = np.linspace(0.2, 1.0, WAVELENGTHS_NM.size)
DRIFTED = [
    *(np.diag([1.0, 1.0, 0.0]), I3 * 1.001, I3 * NAN, MIRROR, np.eye(4)),
    *(I3 + 1.1e-6 * np.eye(3, k=1), I3 - 1.1e-6 * np.eye(3, k=1)),
]
NO_DIRECTION = [(0.0, 0.0, 0.0), (NAN, 0.0, 1.0), (INF, 0.0, 0.0)]
NO_UNIT = [(0, 0, 2.0), (0, 0, 0.0), (NAN, 0, 1), (0, 0, 1 + 1.05e-4), (0, 0, 1 - 1.05e-4)]
NO_QUATERNION = [(0.0, 0, 0, 0), (NAN, 0, 0, 1), (INF, 0, 0, 0), (1.0, 0, 0)]
NO_CHROMATICITY = [
    *((0.3, 0.0), (0.3, 1e-6), (-0.1, 0.3), (0.6, 0.5), (NAN, 0.3), (0.3, NAN)),
    *((INF, 0.3), (0.3, 0.3, 0.4), 0.3),
]
NO_COEFFICIENT = [(NAN,), (0.0, INF), (-1.001e9,)]


def any_direction(length: int, illegal: Sequence[Any]) -> Kind:
    """Vectors that are finite and not zero."""

    def draw(rng: Rng) -> Any:
        vector = np.array([FINITE.draw(rng) for _ in range(length)])
        return vector if vector.any() else np.eye(length)[0]

    return Kind(np.array([0.6, 0.1, -0.3, 0.2])[:length], draw, list(np.eye(length)), illegal)


def sampled(make: Callable[[Rng], Any], *ends: Any, no: Sequence[Any] = ()) -> Kind:
    return Kind(make(np.random.default_rng(0)), make, ends, no)


def picture(*shape: int) -> Kind:
    """Light of 0 to 1 in float32."""
    return sampled(lambda rng: rng.random(shape, np.float32))


FINITE = interval(False, -INF, INF, False)
SEGMENTS = np.array([[(0.0, 0), (1, 0)], [(0, 1), (1, 1)]])
CODES = np.zeros((1, 1, 8, 8), int)
PLANES = np.ones((4, 8, 8), np.float32)
LEVELS = np.array([20.0, 40.0, 100.0])
EDGE = edge_picture(45, 60, 0.1, np.ones_like)
AXES = np.array([0, 0, 1, 1, 2, 2])


def turned(angles_rad: Any) -> Any:
    """Unit vectors (..., 2)."""
    return np.stack([np.cos(angles_rad), np.sin(angles_rad)], axis=-1)


def lines_along_axes() -> Any:
    """Ends (6, 2, 2) of two lines along each axis of a tilted camera."""
    starts = np.array([(0.0, 0.1, 0.2), (-0.3, 0.6, 0.4)])
    ends = np.concatenate([[(start, start + 0.8 * axis) for start in starts] for axis in np.eye(3)])
    pose = pinhole.look_at([1.5, -3.0, 2.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0])
    return pinhole.project(pinhole.world_to_camera(ends, pose), K)[0]


LINES = lines_along_axes()
VIEW = fit_view(LINES, AXES, (640.0, 480.0))

KINDS: dict[str, Kind] = {
    "any": ANY,
    "finite": FINITE,
    "angle": interval(True, -10.0, 10.0, True),
    "rng": sampled(lambda rng: rng),
    "shape": listed((2, 3)),
    "two": listed((0.5, 0.25), (1e200, -1e-300), no=[(NAN, 0.0), (0.0, INF)]),
    "sequence": listed("ZYX", "xyz", "zxz", "XYX", no=["", "xy", "xxy", "xYz", "abc", "zYX"]),
    "moving sequence": listed("ZYX", "XYX", no=["", "xyz", "ZYY", "zYX"]),
    "rotation": sampled(
        lambda rng: rotations.exponential(rng.normal(size=3)),
        I3 + 0.9e-6 * np.eye(3, k=1),
        no=DRIFTED,
    ),
    "invertible": listed(
        I3, 1e-100 * TURN, no=[0 * I3, KEYSTONE[[0, 0, 2]], I3 * NAN, I3 * 5e-324]
    ),
    "nearly rotation": listed(
        TURN,
        1e200 * TURN,
        np.diag([3.0, 2.0, -1.0]),
        np.diag([1.0, 1e-11, 0.0]),
        no=[-I3, np.diag([1.0, 0, 0]), 0 * I3, np.diag([1.0, 1e-13, 0.0]), I3 * NAN, np.eye(4)],
    ),
    "quaternion": any_direction(4, NO_QUATERNION),
    "axis": any_direction(3, NO_DIRECTION),
    "unit": listed(UP, (0.6, 0.0, 0.8), (0, 0, 1 + 0.9e-4), no=NO_UNIT),
    "light": listed(UP, (0.6, 0.0, 0.8), no=NO_UNIT),
    "normals": listed(np.array([UP, (0.6, 0.0, 0.8)]), np.zeros((2, 3))),
    "K": listed(K),
    "pose": listed(POSE, np.eye(4)),
    "chromaticity": listed((0.31, 0.33), (0.45, 0.41), (1 / 3, 1 / 3), no=NO_CHROMATICITY),
    "spectrum": listed(SPECTRUM, no=[0 * SPECTRUM, SPECTRUM[1:]]),
    "reflectance": listed(SPECTRUM, 0 * SPECTRUM, no=[1.1 * SPECTRUM, -SPECTRUM, SPECTRUM[1:]]),
    "curves": listed(np.stack([SPECTRUM] * 3, axis=1)),
    "glass": listed(Glass(), Glass(10.0, 1.0), Glass(1.1, INF)),
    "singlet": listed(Singlet(1 / 40, -1 / 40, 10.0, 1.5), Singlet(0.02, 0.01, 3.0, 1.8)),
    "distortion": sampled(
        lambda rng: Distortion(
            **{k: rng.uniform(-0.3, 0.3) * rng.integers(0, 2) for k in COEFFICIENTS}
        )
    ),
    "fisheye": sampled(lambda rng: Fisheye(*rng.uniform(-0.1, 0.1, 4))),
    "profile": sampled(lambda rng: RadialProfile((rng.uniform(-0.3, 0.3), 0.1), (0.05,))),
    "coefficients": listed((0.1, -0.2), (1e9, -1e9), no=NO_COEFFICIENT),
    "solid": listed(Sphere((0.0, 0.0, 3.0), 1.0), Box((0, 0, 2), (1, 1, 1), 0.7)),
    "place": listed(
        (0.5, 1.0, -2.0),
        (1e100, -1e100, 0.0),
        no=[(2e100, 0.0, 0.0), (0.0, INF, 0.0), (0.0, 0.0, NAN), (0.0, 1.0)],
    ),
    "size": listed(
        (1, 2, 3), (1e100, 1e-9, 1.0), no=[(0.0, 1, 1), (1, -1, 1), (1, 1, INF), (1, 1)]
    ),
    "colour": listed(
        (1.0, 0.5, 0.0),
        (1e30, 1.0, 1.0),
        no=[(1.0, NAN, 1.0), (INF, 1.0, 1.0), (1.0, -1.0, 1.0), (1.0, 1.0)],
    ),
    "lights": listed([DirectionalLight(UP), PointLight((1.0, 2.0, 3.0))]),
    "material": listed(Material(0.5, 0.3, 0.4), Material(1.0, 1.0, 0.01), Material(0.0, 0.0, 1.0)),
    "sensor": listed(
        Sensor(),
        Sensor(
            full_well_e=INF,
            read_noise_e=0.0,
            dark_current_e_per_s=0.0,
            gain_e_per_dn=1e-30,
            bits=16,
            black_level_dn=0.0,
            quantum_efficiency=1.0,
        ),
    ),
    "well": listed(1000.0, INF, 1e13, 0.5, no=[0.0, -1.0, NAN, 2e13]),
    "planes": picture(4, 8, 8),
    "plane": picture(8, 8),
    "picture": picture(8, 8, 3),
    "prefilter": listed(*map(prefilters.prefilter, prefilters.KINDS)),
    "prefilter kind": one_of(*prefilters.KINDS),
    "steady": listed(lambda time: np.ones(np.shape(time))),
    "flat lens": listed(np.ones_like),
    "turn": interval(True, -np.pi, np.pi, True),
    "opening": interval(True, 0.0, np.pi, False),
    "acute": interval(False, 0.0, np.pi / 2, False),
    "slant": interval(True, -np.pi / 4, np.pi / 4, True),
    "fisheye model": one_of(*fisheye.IDEAL_MODELS),
    "kernel": one_of(*resampling.KERNELS),
    "plain kernel": listed("bilinear", "nearest", "bicubic", "lanczos3", no=["spline", "magic"]),
    "pattern": one_of(*PATTERNS),
    "demosaicing": one_of(*demosaicing.METHODS),
    "brdf": one_of(*brdf.MODELS),
    "subsampling": one_of(*SUBSAMPLING),
    "filling": one_of(*chroma_upsampling.METHODS),
    "shot model": one_of(*SHOT_MODELS),
    "responses": one_of(*RESPONSES),
    "chromaticity white": listed((0.31, 0.33), (0.45, 0.41), no=[(0.3, 0.0), (NAN, 0.3), (0.3,)]),
    "primaries": listed(
        cie.SRGB_PRIMARIES_XY,
        no=[
            *(((0.2, 0.2), (0.3, 0.3), (0.4, 0.4)), ((0.6, 0.3), (0.3, 0.6), (0.1, 0.0))),
            *(((0.6, 0.3), (0.3, 0.6), (NAN, 0.1)), ((0.2, 0.2), (0.3, 0.3))),
        ],
    ),
    "lab white": listed((0.31, 0.33), no=[(0.3, 0.0), (0.0, 0.3), (-0.3, 0.3), (0.7, 0.4)]),
    "reflectance shape": listed(SPECTRUM, no=[SPECTRUM[1:]]),
    "knots": listed(np.array([0.1, 0.5, 0.2, 0.9]), np.ones(3), no=[np.ones(2)]),
    "colours": listed(np.ones((2, 3)), no=[np.ones((4,)), np.ones(()), np.ones((0, 3))]),
    "table": listed(blocks.LUMINANCE_TABLE),
    "codes": listed(np.arange(64).reshape(1, 1, 8, 8)),
    "whole codes": listed(np.arange(64).reshape(1, 1, 8, 8), no=[np.zeros((1, 1, 8, 8))]),
    "coded planes": listed(
        [CODES],
        [CODES + 32767],
        [CODES - 32767],
        no=[[CODES + 32768], [CODES - 32768], [CODES.astype(float)]],
    ),
    "cells": listed((2, 2), (1, 2), no=[(0, 2), (2, 0), (-1, 1), (1.5, 2), (2, NAN)]),
    "halves": listed((2, 2), no=[(3, 2), (1.5, 2)]),
    "curve": listed(
        np.array([[0.0, 0.0], [1.0, 0.1], [2.0, 0.0]]),
        [[0, 0], [1e150, 1]],
        no=[
            *(np.empty((0, 2)), [1.0, 2.0], [[0, 0], [NAN, 1], [1, 1]]),
            *([[0, 0], [1.001e150, 1]], [[0, 0], [1, -1.001e150]]),
        ],
    ),
    "decomposable": listed(
        I3,
        KEYSTONE,
        np.diag([1e75, 1e75, 1.0]),
        no=[
            *(np.diag([0.0, 1, 1]), I3[[0, 2, 1]], transforms.translation(1e76, 0)),
            *(np.diag([1e-76, 1e-76, 1]), np.diag([1e76, 1e76, 1])),
        ],
    ),
    "parts": listed(homography_algebra.decompose(KEYSTONE)),
    "homography": listed(
        KEYSTONE, 1e-300 * KEYSTONE, no=[0 * I3, *changed_somewhere(I3, NAN, INF)]
    ),
    "mild homography": listed(I3, KEYSTONE, no=[np.diag([0.0, 1.0, 1.0])]),
    "segments": listed(SEGMENTS, no=[SEGMENTS[:1], [np.zeros((2, 2)), *SEGMENTS]]),
    "unit quaternion": sampled(lambda rng: quaternions.normalise(rng.normal(size=4))),
    "rotation shape": listed(I3, TURN, no=[np.eye(2)]),
    "seen": listed((0.5, 0.25), no=[(NAN, 0.0)]),
    "layer": listed(
        Layer(PLANES, 0, 0, 1.5),
        Layer(PLANES, -1, 2, 0.0),
        no=[Layer(PLANES, 0, 0, radius) for radius in (-0.1, 1025.0, INF, NAN)],
    ),
    "radii": listed(
        np.ones((8, 8)),
        np.zeros((8, 8)),
        no=changed_somewhere(np.ones((8, 8)), -0.1, 1025.0, INF, NAN),
    ),
    "converging": listed(Singlet(1 / 40, -1 / 40, 10.0, 1.5), no=[Singlet(-0.02, 0.02, 6.0, 1.5)]),
    "stop": listed(-10.0, 10.0, 5.0, no=[0.0, 4.9, NAN]),
    "corners": listed(np.arange(12.0).reshape(3, 4), no=[*arrays_of_ones((1, 4), (4, 1, 3), (5,))]),
    "normal corners": listed(np.broadcast_to(UP, (3, 4, 3))),
    "grid size": listed(4, 2, no=[1, 0]),
    "plane normals": sampled(lambda rng: turned(rng.uniform(0, 7, 2))),
    "directions": listed(np.array([UP, (0.6, 0.0, 0.8)]), no=[np.ones((4, 2))]),
    "margin": listed(
        np.linspace(-2.0, 2.0, 12).reshape(3, 4),
        np.full((2, 2), 1e300),
        no=[*arrays_of_ones((1, 5), (5, 1), (5,), (2, 2, 2))],
    ),
    "unit direction": listed(UP),
    "position": listed((1.0, 2.0, 3.0)),
    "high light": listed(UP, (0.6, 0, 0.8), no=[*NO_UNIT[:3], (1.0, 0, 0), (0.6, 0, -0.8)]),
    "occluder": listed((0.5, 1.0, 2.0), (9e99, 0.0, 0.0)),
    "reference": listed(
        (0.5, 1.0, 5.0), no=[(1.0, 0.0, z) for z in (0.0, -1.0, INF, NAN)] + [(0.0, 1.0)]
    ),
    "affine camera": listed(
        np.eye(4)[[0, 1, 3]], no=[np.eye(3, 4), np.eye(4), np.diag([1, 1, 1, 2])[:3]]
    ),
    "focal lengths": listed(
        (800.0, 790.0),
        500.0,
        no=[0.0, (5.0, -1.0), NAN, INF, (0.0, 5.0), (5.0, 0.0), (INF, 5.0), (5.0, INF)],
    ),
    "camera": listed(pinhole.camera_matrix(K, POSE)),
    "eye": listed((0.5, 1.0, -2.0)),
    "target": listed(
        (0.5, 1.0, 3.0), no=[(0.5, 1.0, -2.0), (INF, 0, 0), (NAN, 0, 0), (1.7e308, 1.7e308, 0)]
    ),
    "up": listed((0.0, 1.0, 0.0), no=[(0, INF, 0), (0, 1e-10, 1), (0, 0, -1), (0, 0, 0)]),
    "turned": listed(TURN, I3),
    "pixels": listed(5, 1),
    "eight": listed(8, 3),
    "bits": listed(12, 16, no=[0, 17, 2.5, NAN]),
    "disc": listed(1.5, 0.0, 0.3, 9.5, 70.0, no=[-0.1, 1025.0, INF, NAN]),
    "gathered image": listed(np.ones((4, 5)), np.ones((4, 5, 3), np.float32)),
    "heights": listed([1.0, -10.0, 10.0], no=[[1.0, 11.0]]),
    "far": dataclasses.replace(interval(True, -9e99, 9e99, True), illegal=(NAN, INF, 1.1e100)),
    "drawn lines": listed(
        LINES, no=[LINES[:1], [LINES[0]] * 6, changed_somewhere(LINES, NAN)[0], LINES * 0]
    ),
    "drawn axes": listed(AXES, no=[AXES + 1, AXES * 0]),
    "picture size": listed((640.0, 480.0)),
    "view": listed(VIEW),
    "known": listed(Stretch(LINES[0])),
    "others": listed((Stretch(LINES[1]),)),
    "stretch": listed(LINES[0]),
    "axis number": listed(2, 1, no=[3, -1]),
    "baseline": listed((1.0, 0.2, 0.1), (0.0, 0.0, 1e-9), no=NO_DIRECTION),
    "K matrix": listed(K, no=[np.eye(3, 4)]),
    "seen plane": listed(
        (0.0, 0.6, 0.8, -1.0),
        (0.0, 0.6, 0.8, -1e-11),
        no=[[0, 0, 1, 0], [1, 1, 0, 1e-13], [0, 0, 0, 0], [NAN, 0, 1, 1], [0, 0, 1, INF]],
    ),
    "kernel sigma": listed(0.7, 0.0, 0.1, 1.0, 9.5, no=[-1e-9, 1.1e6, NAN, INF]),
    "divisible": listed(np.ones((8, 4)), no=[*arrays_of_ones((9, 8), (8,))]),
    "factor": listed(2, 1, 4, no=[0, 3]),
    "taps": listed(np.array([0.25, 0.5, 0.25]), no=[[0.5, 0.5], [[1.0]], []]),
    "warped shape": listed((6, 5), no=[(3, 5), (6, 3)]),
    "warp": listed(cubic_warp([[1.5]], [[2.5]], (8, 8))),
    "warped planes": picture(3, 8, 8),
    "falling": listed([0.0, 1.0, 2.0]),
    "fallen": listed([1.0, 0.6, 0.1], [1.0, 0.9, 0.85], no=[[0.4, 0.3, 0.1], [0.4, 0.9, 0.1]]),
    "peaks": listed((0.6, 0.5), (1e9, -1e9), no=[(0.6, NAN), (0.6, INF), (1.1e9, 0.6)]),
    "source shape": listed((4, 5), (1, 1), no=[(0, 5), (5, 0)]),
    "image": listed(
        np.ones((4, 5)), np.ones((4, 5, 3), np.float32), no=[*arrays_of_ones((2, 2, 3, 1), (4,))]
    ),
    "gather table": listed(resampling.gather_table([0.3, 0.2], (4, 5))),
    "gathered": listed(
        np.ones((4, 5)),
        np.ones((4, 5, 3)),
        no=[
            *arrays_of_ones((4, 6), (5, 5), (4,), (4, 5, 3, 1)),
            resampling.gather_source(np.ones((4, 5)), "bicubic"),
        ],
    ),
    "side": listed(3, 9, 1, no=[0, -1]),
    "edge": listed(EDGE, no=[*arrays_of_ones((8,), (20, 20, 3)), np.full((20, 20), NAN)]),
    "edge codes": listed(np.full((20, 20, 3), 99, np.uint8), no=[np.ones((20, 20, 3)), EDGE]),
    "truth": listed(True, False),
    "colour picture": listed(
        np.ones((4, 6, 3)),
        np.ones((1, 1, 3)),
        no=[*arrays_of_ones((4, 4), (4, 4, 4), (0, 4, 3), (2, 2, 2, 3))],
    ),
    "hues": listed(
        np.eye(3),
        np.array([(1.0, 0.5, 0.2), (0.2, 0.9, 0.1), (0.3, 0.3, 0.8)]),
        no=[np.outer([0.2, 0.5, 0.9], np.ones(3))],
    ),
    "patches": listed(np.array([(0.4, 0.2, 0.0), (0.3, 0.7, 0.1), (0.2, 0.1, 0.9)])),
    "white": listed((0.95, 1.0, 1.09)),
    "mosaic": sampled(
        lambda rng: rng.random((6, 6)),
        np.ones((1, 3)),
        np.ones((1, 1)),
        no=[*arrays_of_ones((4,), (4, 4, 3), (4, 0), (0, 3))],
    ),
    "means": listed(
        LEVELS,
        no=[
            *(LEVELS[:2], changed_somewhere(LEVELS, NAN)[0], [[20.0, 40.0, 100.0]]),
            *([100.0, 100.1, 900.0], [5.0, 5.0, 5.0], LEVELS[::-1]),
        ],
    ),
    "variances": listed(
        LEVELS / 5,
        no=[LEVELS[:2], changed_somewhere(LEVELS, INF)[0], [3.0, 2.0, 3.5], [0.1, 0.2, 0.4]],
    ),
    "enough samples": listed(20_000, no=[1, 2, 2.5]),
    "frames": listed(
        np.arange(128, dtype=np.uint16).reshape(2, 8, 8),
        no=[np.zeros((2, 7, 9), np.uint8), np.zeros((3, 8, 8), np.uint8), np.zeros((2, 64), int)],
    ),
    "highest": listed(255, 4095),
    "counts": listed([3, 4, 9], [0], no=[[], [1.0, NAN]]),
    "count": listed(3, 1, no=[0, -2]),
    "detailed": sampled(
        lambda rng: rng.random((6, 7, 3)),
        np.ones((3, 3, 3)),
        no=[
            *(np.zeros(shape) for shape in ((2, 9, 3), (9, 2, 3), (9, 9, 4), (9, 3))),
            *(np.full((5, 5, 3), value) for value in (NAN, INF)),
        ],
    ),
}


def kind_of(text: str) -> Kind:
    """``[shape] kind [= example]``, as in `arguments.toml`."""
    pattern = r"(?:([\dx]+)([!*]?) )?(.+?)(?: = (\S+))?"
    shape, mark, body, example = re.fullmatch(pattern, text).groups()  # type: ignore[union-attr]
    how, body = re.fullmatch(r"(whole |about )?(.+)", body).groups()  # type: ignore[union-attr]
    if limits := re.fullmatch(r"([\[(])(\S+), (\S+)([\])])", body):
        make = integers if how == "whole " else interval
        kind = make(limits[1] == "[", float(limits[2]), float(limits[3]), limits[4] == "]")
    else:
        kind = one_of(*body.split("|")) if "|" in body else KINDS[body]
    if how == "about ":
        kind = dataclasses.replace(kind, illegal=())
    if example:
        kind = dataclasses.replace(kind, example=float(example))
    sides = tuple(map(int, shape.split("x"))) if shape else ()
    return kind.shaped(sides, mark, given=bool(example)) if shape else kind
