"""Whatever photographs an instrument is given, it draws a frame, and says what is wrong."""

from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np
import pytest
from support.chequerboards import SIZE, photographs

from simulations.engine.controls import PointLists
from simulations.engine.photograph import Codes, Photograph
from simulations.engine.reading import Reading, Readings, UnfitError
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from simulations.models.arrays import Floats
from simulations.scenes.calibration.scene import SCENE as CALIBRATION
from simulations.scenes.photon_transfer.frames import read
from simulations.scenes.photon_transfer.scene import SCENE as PHOTON_TRANSFER
from simulations.scenes.single_view.scene import SCENE as SINGLE_VIEW
from simulations.scenes.slanted_edge.scene import SCENE as SLANTED_EDGE

type Given = tuple[dict[str, object], Photograph | None, Readings]


def photograph(light: Floats, number: int = 1, **facts: float | str) -> Photograph:
    """Grey, or in colour, from codes of any size."""
    codes: Codes = np.clip(light, 0, 255).astype(np.uint8)
    colours = codes if codes.ndim == 3 else np.repeat(codes[..., None], 3, axis=2)
    return Photograph(number, colours, f"{number}.png", facts)


def boards(rng: np.random.Generator) -> Given:
    """Boards that are small, the same, mirrored, cut, random, or one of them a line or a point."""
    views = photographs(int(rng.integers(1, 7)), int(rng.integers(4))).views(0.05)
    corners, indices = list(views.pixels), list(views.board)
    line = np.stack([np.linspace(10, 600, 54), np.linspace(20, 300, 54)], axis=1)
    match rng.integers(9):
        case 0:
            corners = [0.03 * each + rng.uniform(0, 450, 2) for each in corners]
        case 1:
            corners = [corners[0]] * len(corners)
        case 2:
            corners = [
                (SIZE[0], 0) - each * (1, -1) if rng.random() < 0.5 else each for each in corners
            ]
        case 3:
            cuts = rng.integers(1, 12, len(corners))
            corners, indices = (
                [a[:n] for a, n in zip(each, cuts, strict=True)] for each in (corners, indices)
            )
        case 4:
            corners = [rng.uniform(0, 450, each.shape) for each in corners]
        case 5:
            corners[-1] = line
        case 6:
            corners[0], indices[0] = line[:5], indices[0][:5]
        case 7:
            corners[-1] = np.full_like(corners[-1], 100.0)
    readings = tuple(
        Reading(
            number,
            f"{number}.jpg",
            {
                "width": SIZE[0],
                "height": SIZE[1],
                "corners": p.tolist(),
                "indices": b.astype(int).tolist(),
            },
        )
        for number, (p, b) in enumerate(zip(corners, indices, strict=True), 1)
    )
    given = {
        "photographs": int(rng.choice((3, 40))),
        "lens": str(rng.choice(("none", "k3", "fisheye", "supported"))),
        "shape": str(rng.choice(("flat", "supported"))),
        "detail": str(rng.choice(("models", "sheet", "board"))),
        "without": int(rng.choice((0, len(readings)))),
    }
    looked = photograph(np.zeros((48, 64)), len(readings)) if rng.random() < 0.5 else None
    return given, looked, readings


def walls(rng: np.random.Generator) -> Given:
    """Pairs and single pictures of walls: black, white, without noise or with much of it."""
    readings = []
    for number in range(1, int(rng.integers(1, 9))):
        light, noise = rng.choice((0, 1, 100, 100, 254, 255)), rng.choice((0.0, 0.1, 2.0, 60.0))
        shape = (70, 80, 3) if rng.random() < 0.5 else (70, 80)
        taken = photograph(rng.normal(light, noise, shape), number, exposure_s=0.1)
        with suppress(UnfitError):
            readings.append(Reading(number, taken.name, read(taken)))
    level, most = int(rng.integers(110)), int(rng.integers(5, 100))
    return {"light": level, "most": most}, None, tuple(readings)


def edges(rng: np.random.Generator) -> Given:
    """Rectangles over steps, stripes, waves, noise or nothing, in pictures of any size."""
    height, width = rng.integers(1, 150, 2)
    x = np.arange(width) - width / 2 + rng.uniform(-1, 1) * np.arange(height)[:, None]
    made: list[Floats] = [
        rng.uniform(0, 255, (height, width)),
        np.full((height, width), 9.0),
        60 + 150.0 * (x > 0),
        60 + 150.0 * (np.abs(x) < 3),
        60 + 150 / (1 + np.exp(-np.clip(x / 3, -50, 50))),
        128 + 100 * np.sin(x),
    ]
    given = {name: rng.uniform(20, 60) for name in ("x", "y", "width", "height")}
    kept = {"kept": ";0.1,0.1_0.9,0.7", "response": str(rng.choice(("srgb", "linear")))}
    return {**given, **kept}, photograph(made[rng.integers(len(made))]), ()


def lines(rng: np.random.Generator) -> Given:
    """Lines anywhere: crossing, the same, on a grid, along the border, or points."""
    lists = []
    for _ in range(5):
        ends = rng.uniform(0, 1, (2 * rng.integers(0, 5), 2))
        ends = np.round(3 * ends) / 3 if rng.random() < 0.4 else ends
        lists.append(tuple((float(x), float(y)) for x, y in ends))
    given = {"lines": PointLists("own", 0, tuple(lists)).text, "all_lines": True}
    given |= {"plane": str(rng.choice(("floor", "along"))), "centre": bool(rng.random() < 0.3)}
    size = rng.integers(1, 200, 2)
    return given, photograph(rng.uniform(0, 255, size), focal_35mm_mm=26.0), ()


INSTRUMENTS: dict[str, tuple[Scene[Any], Callable[[np.random.Generator], Given], int]] = {
    "calibration": (CALIBRATION, boards, 12),
    "photon transfer": (PHOTON_TRANSFER, walls, 20),
    "slanted edge": (SLANTED_EDGE, edges, 30),
    "single view": (SINGLE_VIEW, lines, 12),
}
"""Scene, its input by chance, and how many."""


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("name", INSTRUMENTS)
def test_odd_photographs_give_a_frame_a_sheet_and_files_or_a_sentence(name: str) -> None:
    scene, draw, count = INSTRUMENTS[name]
    for seed in range(count):
        given, looked, readings = draw(np.random.default_rng(seed))
        settings, cache = scene.check(given), StageCache()
        assert scene.render(settings, "", cache, looked, readings).description, seed
        outputs = scene.run(settings, "", cache, looked, readings).outputs
        if scene.instrument.sheet:
            scene.instrument.sheet(settings, outputs)
        for export in scene.instrument.exports:
            with suppress(UnfitError):
                assert export.make(settings, outputs)


def test_photograph_that_is_the_cause_is_named() -> None:
    """Also behind another one that is left out, and where all photographs are shown."""
    _, _, readings = boards(np.random.default_rng(1))
    good = photographs(5).views(0.05)
    line = np.stack([np.linspace(10, 600, 54), np.linspace(20, 300, 54)], axis=1)
    corners = [*good.pixels, line]
    made = tuple(
        Reading(
            n,
            f"IMG {n}.jpg",
            {**readings[0].data, "corners": each.tolist(), "indices": good.board[0].tolist()},
        )
        for n, each in enumerate(corners, 1)
    )
    described = [
        CALIBRATION.render(CALIBRATION.check(given), "", StageCache(), None, made).description
        for given in ({"without": 2}, {"without": 6, "detail": "sheet"})
    ]
    assert described[0].startswith("IMG 6.jpg: its corners lie on one line")
    assert described[1].startswith("From 5 photographs")
