"""Corners of a chequerboard to parts of a pixel, from places that are right to a pixel."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.chequerboard.board import Board
from simulations.models.chequerboard.corner_fit import fit_corners
from simulations.models.chequerboard.corner_windows import cone, windows
from simulations.models.chequerboard.local_lattice import lattice_of, predict
from simulations.models.chequerboard.quadratic_saddle import quadratic_saddle
from simulations.models.distortion.lens_model import Distortion
from simulations.models.error_measures import root_mean_square
from simulations.models.geometry.rotations import exponential
from simulations.models.projection.pinhole import intrinsics
from simulations.pictures.chequerboard import Codes, Glare, Look, View, photograph_of, true_corners

BOARD = Board(10, 7, 25.0)
RADIUS = 8
"""Radius of the windows in px, nearly half a square."""
STEPS = 5
OFF_PX = 0.8
"""Largest error of the places at which a search begins, in x and in y."""
LOOKS = {
    "noisy": Look(noise_codes=2.0),
    "blurred": Look(blur_px=2.0, noise_codes=2.0),
    "lit": Look(noise_codes=2.0, shading=0.5, glare=Glare(150.0, 120.0, 50.0, 0.3)),
}


@dataclass(frozen=True, slots=True)
class Part:
    """A photograph, and the known data of its corners."""

    look: str
    codes: Codes
    begin: Floats
    """(N, 2) px, off by up to `OFF_PX`."""
    edges: Floats
    """(N, 2, 2) directions of the edges, px to the next corner."""
    truth: Floats
    """(N, 2) px, hidden from the tiers."""


type Workload = tuple[Part, ...]
type Refine = Callable[[Part], Floats]


def prepare() -> Workload:
    return _photographed(_view(), LOOKS, 5, 0)


def draw(index: int) -> Workload:
    """Other leans of the board by up to 35°, other noise, and blurs of 1.5 to 3 px."""
    rng = np.random.default_rng(index)
    blurred = replace(LOOKS["blurred"], blur_px=rng.uniform(1.5, 3.0))
    turn = rng.uniform((-0.4, -0.4, -0.2), (0.4, 0.4, 0.2))
    return _photographed(_view(turn, 360.0), {**LOOKS, "blurred": blurred}, index, 3 * index)


def _photographed(view: View, looks: Mapping[str, Look], start_seed: int, seed: int) -> Workload:
    random = np.random.default_rng(start_seed)
    truth = true_corners(BOARD, view)
    indices = BOARD.indices.astype(int)
    lattice = lattice_of(truth, indices, light=False)
    predicted = predict(lattice, indices[:, ::-1] + 1)
    edges = np.stack([predicted.across, predicted.down], axis=1)
    return tuple(
        Part(
            name,
            photograph_of(BOARD, view, replace(look, seed=seed + number)),
            truth + random.uniform(-OFF_PX, OFF_PX, truth.shape),
            edges,
            truth,
        )
        for number, (name, look) in enumerate(looks.items())
    )


def _view(turn_rad: ArrayLike = (0.5, 0.3, 0.1), depth: float = 340.0) -> View:
    """320 × 240 px, the board leaning by 35°, through a barrel lens."""
    pose = np.eye(4)
    pose[:3, :3] = exponential(np.asarray(turn_rad))
    pose[:3, 3] = np.array([4.0, -6.0, depth]) - pose[:3, :3] @ [100.0, 62.5, 0.0]
    K = intrinsics(340.0, (161.3, 117.8))
    return View(320, 240, K, Distortion(k1=-0.3, k2=0.09), pose)


def reference(workload: Workload) -> tuple[Floats, ...]:
    return tuple(part.truth for part in workload)


def peak(part: Part) -> Floats:
    """The pixel where the saddle is most curved, within two of the start."""
    near = np.stack(np.meshgrid(np.arange(-2, 3), np.arange(-2, 3)), axis=-1).reshape(-1, 2)
    middles = np.rint(part.begin)[:, None] + near
    response, _ = _curvature(part, middles.reshape(-1, 2).astype(float))
    best = response.reshape(middles.shape[:2]).argmax(axis=1)
    place: Floats = middles[np.arange(len(best)), best].astype(float)
    return place


def taylor_step(part: Part) -> Floats:
    """From the peak, one step to where the slopes are zero: Taylor's formula in 3 × 3 pixels."""
    place = peak(part)
    _, step = _curvature(part, place)
    return place + np.clip(step, -1.0, 1.0)


def _curvature(part: Part, places: Floats) -> tuple[Floats, Floats]:
    """(N,) negative determinant of the second derivatives, and (N, 2) the step to the saddle."""
    v = np.moveaxis(_square(part, places), 1, 0)
    xx, yy = v[5] - 2 * v[4] + v[3], v[7] - 2 * v[4] + v[1]
    xy, x, y = 0.25 * (v[8] - v[6] - v[2] + v[0]), 0.5 * (v[5] - v[3]), 0.5 * (v[7] - v[1])
    response = xy * xy - xx * yy
    size = np.where(np.abs(response) > 1e-9, response, np.inf)
    return response, np.stack([yy * x - xy * y, xx * y - xy * x], axis=-1) / size[:, None]


def _square(part: Part, places: Floats) -> Floats:
    """(N, 9) the 3 × 3 pixels about the places, row by row."""
    column, row = np.rint(places).astype(int).T
    offset = np.arange(-1, 2)
    square = part.codes[row[:, None, None] + offset[:, None], column[:, None, None] + offset]
    return square.reshape(-1, 9).astype(float)


def parabola(part: Part, *, radius: int) -> Floats:
    return quadratic_saddle(part.codes, part.begin, radius, STEPS)


def gradients(part: Part) -> Floats:
    """The point whose joins with the pixels are at right angles to their slopes, in least squares.

    W. Förstner and E. Gülch, *A fast operator for detection and precise location of distinct
    points*, 1987; `cv2.cornerSubPix` does the same.
    """
    down, right = np.gradient(part.codes.astype(float))
    found = part.begin.copy()
    for _ in range(STEPS):
        across, along = windows(right, found, RADIUS), windows(down, found, RADIUS)
        dx, dy = across.x - found[:, :1], across.y - found[:, 1:]
        weight = cone(dx, dy, RADIUS)
        gx, gy = across.values, along.values
        xx, xy, yy = ((weight * a * b).sum(axis=1) for a, b in ((gx, gx), (gx, gy), (gy, gy)))
        along_slope = weight * (gx * dx + gy * dy)
        x, y = (gx * along_slope).sum(axis=1), (gy * along_slope).sum(axis=1)
        determinant = (xx * yy - xy * xy)[:, None]
        found += np.stack([yy * x - xy * y, xx * y - xy * x], axis=-1) / determinant
    return found


def fitted(part: Part) -> Floats:
    return fit_corners(part.codes, part.begin, part.edges, RADIUS).places


def run(workload: Workload, *, refine: Refine) -> tuple[Floats, ...]:
    return tuple(refine(part) for part in workload)


def rms_px(
    result: tuple[Floats, ...], truth: tuple[Floats, ...], workload: Workload, *, look: str = ""
) -> float:
    """RMS distance over the corners of one photograph, or of all."""
    distances = [
        np.hypot(*(refined - true).T)
        for refined, true, part in zip(result, truth, workload, strict=True)
        if look in ("", part.look)
    ]
    return root_mean_square(np.concatenate(distances))


TIERS: tuple[tuple[str, str, str, Refine], ...] = (
    ("peak", "Most curved pixel", "25 × 9 pixels", peak),
    ("taylor", "Taylor step from there", "26 × 9 pixels", taylor_step),
    ("parabola-3", "Parabola, radius 3", "37 pixels, 5 steps", partial(parabola, radius=3)),
    ("parabola-8", "Parabola, radius 8", "225 pixels, 5 steps", partial(parabola, radius=RADIUS)),
    ("gradients", "Slopes of the edges", "225 pixels, 5 steps", gradients),
    ("fit", "Two blurred edges", "225 pixels, at most 8 steps", fitted),
)

LADDER = Ladder(
    id="corner-refinement",
    title="Corners to parts of a pixel",
    workload="54 corners in each of three photographs of 320 × 240 px, σ = 2 codes: "
    "sharp, blurred by 2 px, and unevenly lit",
    prepare=prepare,
    tiers=tuple(
        Tier(name, label, cost, partial(run, refine=refine)) for name, label, cost, refine in TIERS
    ),
    reference=reference,
    reference_label="the corners that the photographs were rendered from",
    metrics=(
        Metric("rms", "RMS error", "px", rms_px),
        Metric("noisy", "RMS error, sharp", "px", partial(rms_px, look="noisy")),
        Metric("blurred", "RMS error, blurred", "px", partial(rms_px, look="blurred")),
        Metric("lit", "RMS error, unevenly lit", "px", partial(rms_px, look="lit")),
    ),
    default_tier="fit",
    draw=draw,
    items=3 * 54,
    item="corner",
)
