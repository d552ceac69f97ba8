"""The corners that are calibrated from: of the reader's photographs, or of simulated ones.

The camera of the simulation is known, so that the figure can be judged. Only the photograph that is
shown is rendered and its corners found; the others' corners are the true ones with the noise that
the finder has on such pictures.
"""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from simulations.engine.reading import Readings
from simulations.models.calibration.camera import Camera
from simulations.models.calibration.simulated import Sitting, sitting
from simulations.models.calibration.views import Views
from simulations.models.chequerboard.board import Board
from simulations.models.distortion.lens_model import Distortion
from simulations.pictures.chequerboard import Look, View, photograph_of
from simulations.scenes.calibration.settings import MOST

SIZE = (640, 480)
TRUTH = Camera(520.0, 520.0, 322.0, 238.0, Distortion(k1=-0.25, k2=0.08, p1=2e-4, p2=-1.5e-4))
"""The simulated camera. Its lens elements are a little off centre."""
BOARD = Board()
SIGMA_PX = 0.03
"""Standard deviation of the finder's corners on the simulated photographs, in x and in y."""
SEED = 14
FULL_FRAME_DIAGONAL_MM = math.hypot(36.0, 24.0)
LOOK = Look(shading=0.25, blur_px=1.2, noise_codes=6.0)
"""Hand-held, by the light of a lamp."""


@dataclass(frozen=True, slots=True)
class Boards:
    """The corners found in all photographs of one size."""

    views: Views
    size: tuple[int, int]
    """Width and height of the photographs in px."""
    names: tuple[str, ...]
    numbers: tuple[int, ...]
    """By which the reader's photographs are known; empty for simulated ones."""
    truth: Camera | None = None
    """The camera, if the photographs are simulated."""
    notes: tuple[str, ...] = ()
    """What the reader should know of the photographs: sentences."""
    focal_px: float | None = None
    """Focal length that the files state, as an equivalent on full frame."""

    @property
    def true_focal(self) -> float | None:
        """f_x of the simulated camera."""
        return self.truth.fx if self.truth else None


@lru_cache(maxsize=1)
def simulated_sitting() -> Sitting:
    """The places of the board in all simulated photographs."""
    return sitting(TRUTH, SIZE, MOST, BOARD, SEED)


def boards(readings: Readings) -> Boards:
    """Of the reader's photographs, or of the simulated ones if there are none."""
    if readings:
        return _own(readings)
    names = tuple(f"Photograph {index + 1}" for index in range(MOST))
    return Boards(simulated_sitting().views(SIGMA_PX), SIZE, names, (), TRUTH)


def _own(readings: Readings) -> Boards:
    """Those of the most frequent size, `MOST` of them."""
    sizes = [(int(r.data["width"]), int(r.data["height"])) for r in readings]
    size, count = Counter(sizes).most_common(1)[0]
    kept = [r for r, own in zip(readings, sizes, strict=True) if own == size][:MOST]
    views = Views.stack([(np.array(r.data["indices"]), np.array(r.data["corners"])) for r in kept])
    facts = [r.data.get("facts", {}) for r in kept]
    return Boards(
        views,
        size,
        tuple(r.name for r in kept),
        tuple(r.number for r in kept),
        notes=tuple(_notes(len(readings) - count, count - len(kept), facts)),
        focal_px=_stated_focal_px(facts[0], size),
    )


def _notes(others: int, spare: int, facts: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    if others:
        are = "is" if others == 1 else "are"
        yield f"{others} of another size {are} left out; calibrate each size by itself."
    if spare:
        yield f"The first {MOST} are used."
    focal = sorted({float(f["focal_mm"]) for f in facts if f.get("focal_mm")})
    if len(focal) > 1:
        yield (
            f"They were taken at {focal[0]:g} to {focal[-1]:g} mm; calibrate each zoom by itself."
        )
    cameras = sorted({f"{f['make']} {f['model']}" for f in facts if {"make", "model"} <= f.keys()})
    if len(cameras) > 1:
        yield f"They were taken by {' and '.join(cameras)}; calibrate each camera by itself."


def _stated_focal_px(facts: Mapping[str, Any], size: tuple[int, int]) -> float | None:
    """By the diagonals of picture and full frame."""
    stated = facts.get("focal_35mm_mm")
    return float(stated) * math.hypot(*size) / FULL_FRAME_DIAGONAL_MM if stated else None


def rendered(index: int, scale: float = 1.0) -> NDArray[np.uint8]:
    """(H, W, 1) codes of a simulated photograph, also smaller than `SIZE`."""
    simulated = simulated_sitting()
    pose = np.eye(4)
    pose[:3, :3] = simulated.poses.R[index]
    pose[:3, 3] = simulated.poses.t[index] * BOARD.side_mm
    camera = simulated.camera.scaled(scale)
    width, height = (round(scale * side) for side in simulated.size)
    look = replace(LOOK, blur_px=scale * LOOK.blur_px, seed=index)
    return photograph_of(BOARD, View(width, height, camera.matrix, camera.lens, pose), look)[
        ..., None
    ]
