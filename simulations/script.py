"""Exports a figure as a Python script that prints its readouts."""

import json
from textwrap import fill

from simulations.engine.controls import Action
from simulations.registry import load_scene, scene_module

WIDTH = 96
"""Width of a line of text."""
SCRIPT = '''\
"""{paragraphs}
"""

from simulations.engine.stages import StageCache
from {module} import SCENE

settings = SCENE.settings(
{settings}
)
frame = SCENE.render(settings, {tier!r}, StageCache())
for item in frame.readouts:
    print(f"{{item.label}}: {{item.text}} {{item.unit}}".rstrip())

# frame.panels[0].raster: (height, width, 4) uint8
# SCENE.run(settings, {tier!r}, StageCache()).outputs
'''


def script(scene_id: str, values: str, tier: str, paragraphs: str) -> str:
    """A Python script that prints the readouts of a scene.

    ``values`` is a JSON object of control values, as for `simulations.browser.render`, and
    ``paragraphs`` a JSON list of texts for the beginning of the script. Raises `UnknownIdError` and
    `ControlError`.
    """
    scene = load_scene(scene_id)
    settings = scene.clamp(json.loads(values))
    # Buttons that move other controls affect no frame themselves.
    lasting = (c.name for c in scene.controls if not (isinstance(c, Action) and c.drives))
    return SCRIPT.format(
        paragraphs="\n\n".join(fill(text, WIDTH) for text in json.loads(paragraphs)),
        module=scene_module(scene_id),
        settings="\n".join(f"    {name}={getattr(settings, name)!r}," for name in lasting),
        tier=tier,
    )
