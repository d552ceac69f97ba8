"""The simulations in parts: what each scene needs is in its part or in the core."""

from pathlib import Path

from simulations.registry import LADDER_MODULES, SCENE_MODULES
from site_builder.runtime.imports import reach, read_imports
from site_builder.runtime.modules import CORE, ENTRY, cut

IMPORTS = read_imports(Path(__file__).resolve().parents[3] / "simulations")
PARTS = cut(IMPORTS, SCENE_MODULES, LADDER_MODULES)


def test_a_part_and_the_core_have_all_that_a_scene_or_a_ladder_imports() -> None:
    wanted = {f"scene-{key}": name for key, name in SCENE_MODULES.items()}
    wanted |= {f"ladder-{key}": name for key, name in LADDER_MODULES.items()}
    assert reach(IMPORTS, ENTRY) <= PARTS[CORE]
    for part, module in wanted.items():
        assert reach(IMPORTS, module) <= PARTS[part] | PARTS[CORE], part
        assert not PARTS[part] & PARTS[CORE], part
