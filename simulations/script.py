"""A figure as a script of its own, for whoever wants to go on from its numbers."""

import json
from typing import Any

from simulations.engine.controls import Action
from simulations.engine.scene import Scene
from simulations.registry import load_scene, scene_module

SCRIPT = '''\
"""{title}, as the figure shows it.
{unlike}
Needs Python 3.12 or newer and the book's simulations: `pip install .` in a copy of the book.
"""

from simulations.engine.stages import StageCache
from {module} import SCENE

settings = SCENE.settings(
{settings}
)
frame = SCENE.render(settings, {tier!r}, StageCache())
for item in frame.readouts:
    print(f"{{item.label}}: {{item.text}} {{item.unit}}".rstrip())

# Pixels, (height, width, 4) uint8, where a panel has any: frame.panels[0].raster
# What each stage computed: SCENE.run(settings, {tier!r}, StageCache()).outputs
'''

EDITED = """
The figure ran Python that its reader had changed. This script runs the book's: what the changes
do, it does not print.
"""
OWN_PICTURE = """
The figure showed its reader's own picture. This script takes the book's.
"""


def script(
    scene_id: str, values: str, tier: str, edited: bool = False, own_picture: bool = False
) -> str:
    """Python that prints the readouts of a scene as a figure does.

    ``values`` is a JSON object of control values, as `simulations.browser.render` takes it. Of a
    figure that ran ``edited`` code, or showed its reader's ``own_picture``, the script says that it
    does not. Raises `UnknownIdError` and `ControlError`.
    """
    scene = load_scene(scene_id)
    settings = scene.clamp(json.loads(values))
    return SCRIPT.format(
        title=scene.title,
        unlike=EDITED * edited + OWN_PICTURE * own_picture,
        module=scene_module(scene_id),
        settings="\n".join(f"    {name}={getattr(settings, name)!r}," for name in _lasting(scene)),
        tier=tier,
    )


def _lasting(scene: Scene[Any]) -> list[str]:
    """The settings that say something about a frame: not the buttons that move others."""
    return [c.name for c in scene.controls if not (isinstance(c, Action) and c.drives)]
