"""Which changes a worker can build, and which need a fresh one."""

import pytest

from site_builder.serve import is_code


@pytest.mark.parametrize(
    ("path", "code"),
    [
        ("/book/simulations/scenes/camera/scene.py", True),
        ("/engine/site_builder/build.py", True),
        ("/engine/site_builder/languages/de.toml", True),
        ("/engine/site_builder/search/index.mjs", True),
        ("/engine/site_builder/editor/package-lock.json", True),
        ("/engine/site_builder/templates/base.html", False),
        ("/book/static/css/prose.css", False),
        ("/book/content/book.toml", False),
        ("/book/content/measurements.json", False),
        ("/book/content/01-second.md", False),
    ],
)
def test_what_a_worker_has_in_memory_for_good_is_built_by_a_fresh_one(
    path: str, code: bool
) -> None:
    assert is_code(path) is code
