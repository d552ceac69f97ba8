"""The copy of the program that is in use, and the errors in it."""

import json
from functools import lru_cache
from typing import Any

from simulations.editing.problems import Problem, problem_of
from simulations.editing.program import Edition, edition_of, load_copy
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache


@lru_cache(maxsize=1)
def copy_of(_figure: str, module: str, edits: str) -> tuple[Scene[Any], StageCache]:
    """The ``SCENE`` of ``module`` with ``edits``, for one figure, and the outputs of its stages.

    ``edits`` is a JSON object from definitions to texts. Raises what `edition_of` and the edited
    modules raise.
    """
    return load_copy(module, _edition(edits).sources).SCENE, StageCache()


def problem_with(error: BaseException, edits: str) -> Problem:
    """JSON of the problem to show for ``error``, raised while the copy with ``edits`` was made or
    ran."""
    try:
        places = _edition(edits).places
    except Exception:  # then none of the edits ran
        places = ()
    return problem_of(error, places)


@lru_cache(maxsize=1)
def _edition(edits: str) -> Edition:
    return edition_of(json.loads(edits))
