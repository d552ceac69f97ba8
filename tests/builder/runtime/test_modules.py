"""The simulations in parts: what each scene needs is in its part or in the core."""

from support.waves import LADDERS, SCENES, WAVES

from site_builder.runtime.imports import imports_of, reach
from site_builder.runtime.modules import CORE, ENTRY, cut
from site_builder.runtime.pack import book_modules


def test_a_part_and_the_core_have_all_that_a_scene_or_a_ladder_imports() -> None:
    imports = imports_of(book_modules(WAVES / "simulations"))
    parts = cut(imports, SCENES, LADDERS)
    wanted = {f"scene-{key}": name for key, name in SCENES.items()}
    wanted |= {f"ladder-{key}": name for key, name in LADDERS.items()}
    assert reach(imports, ENTRY) <= parts[CORE]
    for part, module in wanted.items():
        assert reach(imports, module) <= parts[part] | parts[CORE], part
        assert not parts[part] & parts[CORE], part
