"""The simulations in parts: what each scene needs is in its part or in the core."""

from simulations.registry import LADDER_MODULES, SCENE_MODULES
from site_builder.runtime.imports import Table, reach
from site_builder.runtime.modules import CORE, ENTRY, cut


def test_a_part_and_the_core_have_all_that_a_scene_or_a_ladder_imports(
    imports_of_the_book: Table,
) -> None:
    imports = imports_of_the_book
    parts = cut(imports, SCENE_MODULES, LADDER_MODULES)
    wanted = {f"scene-{key}": name for key, name in SCENE_MODULES.items()}
    wanted |= {f"ladder-{key}": name for key, name in LADDER_MODULES.items()}
    assert reach(imports, ENTRY) <= parts[CORE]
    for part, module in wanted.items():
        assert reach(imports, module) <= parts[part] | parts[CORE], part
        assert not parts[part] & parts[CORE], part
