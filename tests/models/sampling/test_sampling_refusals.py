"""What models of sampling refuse, by the name of the parameter."""

from typing import Any

import numpy as np
from support.refusals import Call, assert_refused, each_of

from simulations.models.sampling import aliasing, prefilters
from simulations.models.sampling.cubic_warp import cubic_warp, warp
from simulations.models.sampling.fine_detail import fine_detail
from simulations.models.sampling.magnification import magnify
from simulations.models.sampling.resampling import (
    gather,
    gather_source,
    gather_table,
    resize,
    sample,
)
from simulations.models.sampling.slanted_edge import read_edge
from simulations.models.sampling.slanted_edge_picture import edge_picture

NAN, INF = np.nan, np.inf
PICTURE = np.ones((4, 5))
TABLE = gather_table([0, 0], (4, 5))
CUBIC = gather_table([0, 0], (4, 5), "bicubic", np.float32)
EDGE = edge_picture(45, 60, 0.1, np.ones_like)
BOX = prefilters.prefilter("box")
NO_SIZE = [0.0, -1.0, INF, NAN]
NO_CENTRE = [[0.5, 0.5], [[1.0]], []]
NO_PHASE = [INF, NAN, 1.001e9, -1.001e9]
NO_IMAGE = [np.ones(shape) for shape in ((2, 2, 3, 1), (4,), (0, 3))]
OTHER_SIZES = [np.ones(shape) for shape in ((4, 6), (5, 5), (4,), (4, 5, 3, 1))]
NO_DETAIL = [(np.full((8, 8), NAN), np.eye(8))]
UNEQUAL = [(np.zeros((4, 4)), np.zeros((4, 5))), (np.zeros(4), np.zeros(4))]


def kept(factor: int, shape: Any = (8, 9), kernel: Any = (1.0,)) -> Any:
    return aliasing.filter_and_sample(np.zeros(shape), factor, kernel)


@each_of(
    ("x_px from .*legal: 1 to 3, of 5", lambda x: cubic_warp([[x]], [[2.0]], (5, 5)), [0.99, 3.01]),
    ("x_px from", lambda x: cubic_warp([[2.0, x]], [[2.0, 2.0]], (5, 5)), [NAN, INF]),
    ("y_px from", lambda y: cubic_warp([[2.0]], [[y]], (5, 5)), [0.99, 3.01, NAN]),
    ("legal: 4 x 4 or more", lambda shape: cubic_warp([[1.0]], [[1.0]], shape), [(3, 4), (4, 3)]),
    (
        r"legal: \(channels, 5, 6\)",
        lambda shape: warp(cubic_warp([[2.0]], [[2.0]], (5, 6)), np.zeros(shape, np.float32)),
        [(5, 6), (3, 6, 5), (3, 5, 7)],
    ),
    (r"legal: equal", lambda pair: fine_detail(*pair), UNEQUAL),
    ("picture", lambda pair: fine_detail(*pair), NO_DETAIL),
    ("above 0", lambda truth: fine_detail(np.zeros((8, 8)), truth), [np.ones((8, 8))]),
    (
        "scale .*; legal: above 0, finite",
        lambda scale: magnify(PICTURE.astype(np.float32), scale),
        NO_SIZE,
    ),
    ("'median'; legal: none, box", prefilters.prefilter, ["median"]),
    ("factor 0; legal: whole numbers, 1 or more", prefilters.supersample, [0]),
    ("legal: at most 1e9", lambda f: prefilters.transfer(BOX, [0.5, f]), NO_PHASE),
    ("^frequency .*1e9", lambda f: prefilters.filtered_wave(BOX, 0.0, f, 0.0), NO_PHASE),
    ("^chirp .*1e9", lambda c: prefilters.filtered_wave(BOX, 0.0, 0.1, c), NO_PHASE),
    ("cubic", lambda kernel: sample(PICTURE, [0, 0], kernel), ["cubic"]),
    ("height 0.*legal: 1 or more", lambda rows: resize(PICTURE, rows, 5), [0]),
    ("legal: 1 or more", lambda columns: resize(PICTURE, 5, columns), [0]),
    ("image of shape", lambda image: resize(image, 5, 5), NO_IMAGE),
    ("^kernel 'spline' .*; legal: nearest", lambda k: resize(PICTURE, 2, 2, k), ["spline"]),
    ("source_shape", lambda shape: gather_table([0, 0], shape), [(0, 5), (5, 0)]),
    ("legal for the table", lambda image: gather(TABLE, image), OTHER_SIZES),
    ("^image of float64; legal: float32", lambda image: gather(CUBIC, image), [PICTURE]),
    ("another kernel", lambda k: gather(TABLE, gather_source(PICTURE, k)), ["bicubic", "spline"]),
    ("rate", lambda rate: aliasing.alias_frequency(1.0, rate), NO_SIZE),
    ("frequency", lambda f: aliasing.alias_frequency([0.1, f]), [NAN, INF]),
    ("spokes", lambda spokes: aliasing.apparent_wheel_speed(1.0, spokes, 24.0), [0]),
    ("scale", lambda scale: aliasing.zone_plate(0, 0, scale), NO_SIZE),
    ("sigma", aliasing.gaussian_kernel, [-1e-9, 1.1e6, NAN, INF]),
    ("light of 0 or more, finite", lambda light: aliasing.contrast([0.1, light]), [-1.0, INF]),
    ("finite", lambda frequency: aliasing.box_mtf([0.5, frequency]), [NAN]),
    ("finite", lambda width: aliasing.box_mtf([0.5], width), [INF, NAN]),
    ("a divisor", kept, [0, 2]),
    ("a divisor", lambda shape: kept(2, shape), [(9, 8), (8,)]),
    ("legal: one axis of odd length", lambda kernel: kept(1, (4, 4), kernel), NO_CENTRE),
    ("picture .*legal: .H, W", read_edge, [np.zeros(8), np.zeros((20, 20, 3))]),
    ("finite", read_edge, [np.full((20, 20), NAN)]),
    ("angle_rad", lambda angle: edge_picture(4, 4, angle, np.ones_like), [1.0]),
    ("frequency", lambda f: read_edge(EDGE).transfer([f]), [4.0]),
)
def test_models_of_sampling_refuse(message: str, call: Call, values: Any) -> None:
    assert_refused(message, call, values)


def test_the_ends_of_the_ranges_are_legal() -> None:
    assert aliasing.gaussian_kernel(1e6).size == 8_000_001
    bright = np.full((4, 4), 1e308)
    assert (aliasing.filter_and_sample(bright, 2, np.ones(3)) == INF).all()
