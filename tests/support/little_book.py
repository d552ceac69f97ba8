"""A little book, checked and rendered, and its one scene."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from simulations.engine.drawing import line, text
from simulations.engine.frame import Frame, Panel, matrix_readout, readout
from simulations.engine.scene import Scene
from simulations.engine.settings import action, choice, slider, toggle
from simulations.engine.stages import Outputs, Stage
from simulations.registry import UnknownIdError
from site_builder.build import Options, check_site, render_site
from site_builder.diagnostics import BuildError, Diagnostic
from site_builder.output.assets import content_bytes

OUTLINE = 'title = "T"\nsubtitle = "S"\nprerequisites = "P"\nchapters = ["00-first", "01-second"]\n'
"""Of two chapters, and no figure on the cover."""
FRONT = "---\ntitle: First\nsummary: The first chapter.\n---\n"


def files_of(name: str) -> dict[str, str]:
    """The files of a book in ``fixtures/little_books``, by path."""
    root = Path(__file__).parents[1] / "fixtures" / "little_books" / name
    files = (file for file in root.rglob("*") if file.is_file())
    return {file.relative_to(root).as_posix(): file.read_text("utf-8") for file in files}


def diagnostics(options: Options) -> list[Diagnostic]:
    """Warnings and mistakes."""
    found: list[Diagnostic] = []
    try:
        check_site(replace(options, warn=found.append))
    except BuildError as error:
        found += error.diagnostics
    return found


def rendered(options: Options) -> dict[str, bytes]:
    """The files of the site."""
    return {path: content_bytes(content) for path, content in render_site(options).items()}


@dataclass(frozen=True, slots=True)
class Settings:
    k1: float = slider("Distortion", 0.0, -0.5, 0.5, 0.01, unit="px")
    kind: str = choice("Kind", {"a": "First", "b": "Second"})
    on: bool = toggle("On")
    play: int = action("Play", "Pause", drives="k1", effect="play")


def tell(k1: float, tier: str) -> str:
    return f"Shows k1 of {k1:g} in tier {tier}."


def draw_demo(settings: Settings, outputs: Outputs) -> Frame:
    raster = np.full((4, 6, 4), 255, np.uint8)
    return Frame(
        panels=(
            Panel("picture", "Picture", 400, 300, raster=raster, pixelated=True),
            Panel("plan", "Plan", 400, 300, overlay=line((0, 0), (10, 10)) + text((1, 1), "a<b")),
        ),
        readouts=(
            readout("k1", "k₁", settings.k1, "px", role="ray"),
            matrix_readout("H", "Matrix", [[1, 0], [0, 1]]),
        ),
        description=outputs["sentence"],
    )


DEMO = Scene(
    id="demo",
    title="Demo",
    settings=Settings,
    draw=draw_demo,
    stages=(Stage("sentence", tell),),
    tiers=("fast", "exact"),
    default_tier="exact",
    draft_tier="fast",
    tier_labels={"fast": "Fast", "exact": "Exact"},
)


def load_demo(scene_id: str) -> Scene[Settings]:
    if scene_id == "broken":
        raise ImportError("no module")
    if scene_id != "demo":
        raise UnknownIdError(f"unknown simulation {scene_id!r}; legal: demo")
    return DEMO
