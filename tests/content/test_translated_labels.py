"""What the figure of the translated chapter says, at every station of its point."""

from itertools import chain, product
from pathlib import Path

from support.frames import frame_of

from simulations.scenes.formation_pipeline.scene import SCENE
from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.sources.translations.labels import NUMBER, TEXT, read_labels

ROOT = Path(__file__).parents[2]
SAME = {"Pose", "Sensor", "# · sRGB(# / #) = #"}
"""In both languages."""


def test_every_text_of_the_pipeline_is_translated() -> None:
    labels = read_labels(ROOT, "de", Diagnostics())
    said: set[str] = set()
    for station, again in product(range(8), range(4)):
        frame = frame_of(SCENE, station=float(station), again=again)
        drawn = chain.from_iterable(TEXT.findall(panel.overlay) for panel in frame.panels)
        said |= {NUMBER.sub("#", text.strip()) for text in (frame.description, *drawn)}
    assert {text for text in said if any(map(str.isalpha, text))} <= labels.keys() | SAME
    assert sum("Chance" in text for text in said) == 2, "errors of reading of either sign"
