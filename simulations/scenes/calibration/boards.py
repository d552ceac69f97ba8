"""The corners that are calibrated from: of the reader's photographs, or of simulated ones.

The camera of the simulation is known, so that the figure can be judged. Only the photograph that is
shown is rendered and its corners found; the others' corners are the true ones with the noise that
the finder has on such pictures.

All photographs of the reader's may show different boards or parts of one, as the pose of each is
found with the side of its own squares as the unit of length.
"""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from simulations.engine.photograph import Photograph
from simulations.engine.reading import Readings, UnfitError
from simulations.models.calibration.camera import Camera
from simulations.models.calibration.simulated import Sitting, sitting
from simulations.models.calibration.views import Views
from simulations.models.chequerboard.board import Board
from simulations.models.chequerboard.board_search import NoBoardError
from simulations.models.chequerboard.find_board import find_board
from simulations.models.distortion.lens_model import Distortion
from simulations.pictures.chequerboard import Look, View, photograph_of

LEAST, MOST = 3, 40
"""Photographs of a calibration. Of 40 all models and shapes are fitted in two seconds, in a browser
in six; the search for the corners of so many takes longer."""
SIZE = (640, 480)
LENS = Distortion(k1=-0.25, k2=0.08, p1=2e-4, p2=-1.5e-4)
TRUTH = Camera(520.0, 520.0, 322.0, 238.0, LENS)
"""The simulated camera. Its lens elements are a little off centre."""
BOARD = Board()
SIGMA_PX = 0.03
"""Standard deviation of the finder's corners on the simulated photographs, in x and in y."""
SEED = 14
FULL_FRAME_DIAGONAL_MM = math.hypot(36.0, 24.0)
LOOK = Look(shading=0.25, blur_px=1.2, noise_codes=6.0)
"""Hand-held, by the light of a lamp."""
NAMED = 6  # photographs in a sentence
DIGITS = 4  # decimals of the corners in px that are kept of a photograph


@dataclass(frozen=True, slots=True)
class Boards:
    """The corners found in all photographs of one size."""

    views: Views
    size: tuple[int, int]
    """Width and height of the photographs in px."""
    names: tuple[str, ...]
    numbers: tuple[int, ...]
    """Numbers of the reader's photographs; empty for simulated ones."""
    truth: Camera | None = None
    """The camera, if the photographs are simulated."""
    notes: tuple[str, ...] = ()
    """Sentences on the photographs, for the reader."""
    focal_px: float | None = None
    """Focal length that the files state, as an equivalent on full frame."""
    taken: Mapping[str, float | str] = field(default_factory=dict)
    """What all files say of camera and lens: ``make``, ``model``, ``lens``, ``focal_mm``."""

    def without(self, number: int) -> "Boards":
        """All but the photograph of this number, counted from 1; all if there is none."""
        if not 0 < number <= len(self.views):
            return self
        rest = [index for index in range(len(self.views)) if index != number - 1]
        return replace(
            self,
            views=self.views.take(rest),
            names=self.names[: number - 1] + self.names[number:],
            numbers=self.numbers[: number - 1] + self.numbers[number:],
        )


def read(photograph: Photograph) -> Mapping[str, Any]:
    """The size of the photograph in px, its corners in px with columns and rows, and its facts.

    Returns
    -------
    ``width`` and ``height``; ``corners``, pairs of x and y; ``indices``, pairs of column and row;
    ``columns`` and ``rows``, how many there are; ``blur_px``; ``facts``.

    Raises
    ------
    UnfitError
        With the sentence of `NoBoardError`.
    """
    try:
        board = find_board(photograph.codes)
    except NoBoardError as reason:
        raise UnfitError(str(reason)) from None
    height, width = photograph.codes.shape[:2]
    columns, rows = board.size
    return {
        "width": width,
        "height": height,
        "corners": board.places.round(DIGITS).tolist(),
        "indices": board.indices.tolist(),
        "columns": columns,
        "rows": rows,
        "blur_px": round(board.blur_px, 2),
        "facts": dict(photograph.facts),
    }


@lru_cache(maxsize=1)
def simulated_sitting() -> Sitting:
    """The places of the board in all simulated photographs."""
    return sitting(TRUTH, SIZE, MOST, BOARD, SEED)


def boards(readings: Readings) -> Boards:
    """The boards of the reader's photographs, or of the simulated ones if there are none.

    Of the reader's those of the most frequent size are used, at most `MOST`.
    """
    if not readings:
        names = tuple(f"Photograph {index + 1}" for index in range(MOST))
        return Boards(simulated_sitting().views(SIGMA_PX), SIZE, names, (), TRUTH)
    sizes = [(int(r.data["width"]), int(r.data["height"])) for r in readings]
    size, count = Counter(sizes).most_common(1)[0]
    used = [r for r, sides in zip(readings, sizes, strict=True) if sides == size][:MOST]
    facts = [r.data.get("facts", {}) for r in used]
    stated = facts[0].get("focal_35mm_mm")
    return Boards(
        Views.stack([(np.array(r.data["indices"]), np.array(r.data["corners"])) for r in used]),
        size,
        tuple(r.name for r in used),
        tuple(r.number for r in used),
        notes=tuple(
            _notes(len(readings) - count, count - len(used), facts, [r.name for r in used])
        ),
        # by the diagonals of picture and full frame
        focal_px=float(stated) * math.hypot(*size) / FULL_FRAME_DIAGONAL_MM if stated else None,
        taken={
            name: facts[0][name]
            for name in ("make", "model", "lens", "focal_mm")
            if name in facts[0] and all(each.get(name) == facts[0][name] for each in facts)
        },
    )


def _notes(
    others: int, spare: int, facts: Sequence[Mapping[str, Any]], names: Sequence[str]
) -> Iterator[str]:
    if others:
        are = "is" if others == 1 else "are"
        yield f"{others} of another size {are} left out; calibrate each size by itself."
    if spare:
        yield f"The first {MOST} are used."
    ways = [facts_of_one.get("orientation", 1.0) for facts_of_one in facts]
    (usual, _), *_ = Counter(ways).most_common(1)
    if turned := [name for name, way in zip(names, ways, strict=True) if way != usual]:
        them = "it" if len(turned) == 1 else "them"
        yield f"The camera was turned for {listed(turned)}; leave {them} out."
    focal = sorted({float(f["focal_mm"]) for f in facts if f.get("focal_mm")})
    if len(focal) > 1:
        yield (
            f"They were taken at {focal[0]:g} to {focal[-1]:g} mm; calibrate each zoom by itself."
        )
    cameras = sorted({f"{f['make']} {f['model']}" for f in facts if {"make", "model"} <= f.keys()})
    if len(cameras) > 1:
        yield f"They were taken by {' and '.join(cameras)}; calibrate each camera by itself."


def listed(names: Sequence[str], most: int = NAMED) -> str:
    """Names in a sentence, and how many more than ``most`` there are."""
    rest = len(names) - most
    *first, last = names if rest <= 0 else (*names[:most], f"{rest} more")
    return f"{', '.join(first)} and {last}" if first else last


def rendered(index: int, scale: float = 1.0) -> NDArray[np.uint8]:
    """(H, W, 1) codes of a simulated photograph, also smaller than `SIZE`."""
    simulated = simulated_sitting()
    pose = np.eye(4)
    pose[:3, :3] = simulated.poses.R[index]
    pose[:3, 3] = simulated.poses.t[index] * BOARD.side_mm
    camera = simulated.camera.scaled(scale)
    width, height = (round(scale * side) for side in simulated.size)
    look = replace(LOOK, blur_px=scale * LOOK.blur_px, seed=index)
    view = View(width, height, camera.matrix, LENS, pose)
    return photograph_of(BOARD, view, look)[..., None]
