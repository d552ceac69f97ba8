"""Finding the scene that an author names."""

from typing import Any

from simulations.engine.scene import Scene
from simulations.registry import UnknownIdError
from site_builder.diagnostics import cause
from site_builder.markdown.reading import Reading


def find_scene(scene_id: str, line: int, reading: Reading) -> Scene[Any] | None:
    """The scene, or None and a diagnostic: unknown id, or a module that cannot be imported."""
    try:
        return reading.load_scene(scene_id)
    except UnknownIdError as error:
        reading.problem(line, str(error))
    except Exception as error:  # whatever a scene's own code may raise is the author's to see
        reading.problem(line, f"simulation {scene_id!r} cannot be loaded: {cause(error)}")
    return None
