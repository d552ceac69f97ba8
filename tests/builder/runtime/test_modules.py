"""The simulations in parts: what each scene needs is in its part or in the core."""

from support.waves import LADDERS, SCENES, WAVES

from site_builder.runtime.imports import imports_of, reach
from site_builder.runtime.modules import CORE, ENTRY, cut
from site_builder.runtime.pack import book_modules

IMPORTS = imports_of(book_modules(WAVES / "simulations"))
PARTS = cut(IMPORTS, SCENES, LADDERS)


def test_a_part_and_the_core_have_all_that_a_scene_or_a_ladder_imports() -> None:
    wanted = {f"scene-{key}": name for key, name in SCENES.items()}
    wanted |= {f"ladder-{key}": name for key, name in LADDERS.items()}
    assert reach(IMPORTS, ENTRY) <= PARTS[CORE]
    for part, module in wanted.items():
        assert reach(IMPORTS, module) <= PARTS[part] | PARTS[CORE], part
        assert not PARTS[part] & PARTS[CORE], part
