"""Definitions in a module's source, and the module that defines a stage's function."""

import numpy as np
import pytest

from simulations.editing.definitions import definitions, home, module_source
from simulations.registry import SCENE_MODULES, load_scene

SOURCE = '''\
"""A module."""

from numpy import pi

# Why it is two.
TWO = 2
"""Twice one."""
NEXT: int = 3


# A free remark.

@decorated
@again
def f(x):
    """Text."""

    def inner():
        pass
    return x


class C:
    def f(self):
        pass


a, b = 1, 2
'''


def text_of(name: str) -> str:
    found = definitions(SOURCE)[name]
    return "\n".join(SOURCE.split("\n")[found.first - 1 : found.last])


def test_functions_classes_and_constants_are_found_in_order() -> None:
    assert list(definitions(SOURCE)) == ["TWO", "NEXT", "f", "C"]


@pytest.mark.parametrize(
    ("name", "first", "last"),
    [
        ("TWO", "# Why it is two.", '"""Twice one."""'),
        ("NEXT", "NEXT: int = 3", "NEXT: int = 3"),
        ("f", "@decorated", "    return x"),
        ("C", "class C:", "        pass"),
    ],
)
def test_definition_includes_its_comment_decorators_and_docstring(
    name: str, first: str, last: str
) -> None:
    lines = text_of(name).split("\n")
    assert (lines[0], lines[-1]) == (first, last)


def test_lines_end_where_python_ends_them() -> None:
    source = '"""One\u2028two."""\n\n\f\n# Three.\nTHREE = 3\n'
    assert definitions(source)["THREE"].first == 4


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_every_stage_and_draw_function_is_in_an_editable_module(scene_id: str) -> None:
    scene = load_scene(scene_id)
    for function in (scene.draw, *(stage.compute for stage in scene.stages)):
        module, name = home(function)
        assert name in definitions(module_source(module))


def test_function_not_written_in_python_has_no_source_module() -> None:
    assert home(np.add) == ("", "")


@pytest.mark.parametrize("module", ["simulations.engine.stages", "os", "simulations.browser"])
def test_source_of_other_modules_is_refused(module: str) -> None:
    with pytest.raises(ValueError, match="legal: one in simulations/models"):
        module_source(module)
