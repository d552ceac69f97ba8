"""A notebook and a page of MyST as chapters: what is taken is a book without mistakes, and what is
not taken is listed."""

import ast
import base64
import io
import json
import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

import pytest
from PIL import Image
from support.little_book import OUTLINE, MakeBook, diagnostics

from site_builder.scaffold.importing import import_file
from site_builder.scaffold.ipywidgets import control, interacting
from site_builder.scaffold.pieces import ScaffoldError

CODE = """\
%matplotlib inline
from ipywidgets import interact, FloatSlider, Dropdown

def wave(length=2, height=1.0, kind="sine", shown=True, other=None):
    plt.plot(length)

interact(wave, length=(1, 9), height=FloatSlider(min=0.5, max=4, step=0.5, value=2),
         kind=Dropdown(options=["Sine wave", "square"]), other=widgets.Text())
"""
SETTINGS = {"length": 2, "height": 2.0, "kind": "sine-wave", "shown": True}


def picture() -> str:
    buffer = io.BytesIO()
    Image.new("RGB", (4, 3)).save(buffer, "PNG")
    return base64.b64encode(buffer.getvalue()).decode()


def cell(kind: str, text: str, **more: Any) -> dict[str, Any]:
    return {"cell_type": kind, "source": text.splitlines(keepends=True), "metadata": {}, **more}


def notebook() -> str:
    drawn = {"output_type": "display_data", "data": {"image/png": picture(), "text/plain": "<F>"}}
    printed = {"output_type": "stream", "text": ["4\n"]}
    table = {"output_type": "display_data", "data": {"text/html": "<table></table>"}}
    cells = [
        cell("markdown", "# Waves *travel*\n\nT \\\\(2 + 2\\\\) <b>H</b>.\n\n$$\n2 + 2\n$$"),
        cell("markdown", "# One\n\n#### Two\n\n![A plan](attachment:a.png)",
             attachments={"a.png": {"image/png": picture()}}),
        cell("code", "2 + 2", outputs=[printed, drawn, table]),
        cell("code", CODE, outputs=[]),
    ]  # fmt: skip
    return json.dumps({"cells": cells, "nbformat": 4})


@pytest.mark.parametrize(
    ("code", "found"),
    [
        ("@interact(x=(0, 10))\ndef f(x=3): 0", ['f: x: int = slider("X", 3, 0, 10, 1)']),
        ("def f(x=3.5): 0\ninteract(f, x=(0, 10))", ['f: x: int = slider("X", 3, 0, 10, 1)']),
        ("@interact\ndef f(x=True): 0", ['f: x: bool = toggle("X", True)']),
        ("def f(x=3): 0\nf(x=1)", []),
    ],
)
def test_a_call_makes_another_figure_or_begins_elsewhere_than_in_the_notebook(
    code: str, found: list[str]
) -> None:
    tree = ast.parse(code)
    functions = {each.name: each for each in tree.body if isinstance(each, ast.FunctionDef)}
    calls = interacting(tree, functions)
    assert found == [f"{name}: {control('x', *given['x'])}" for name, given in calls]


def test_a_notebook_becomes_a_chapter_with_stills_and_a_figure_that_has_its_sliders(
    make_book: MakeBook, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    options = make_book("Text.\n", {"content/book.toml": OUTLINE})
    file = tmp_path / "01 Waves.ipynb"
    file.write_text(notebook(), encoding="utf-8")
    said = import_file(options.root, str(file))
    lost = [line for line in said.splitlines() if line.startswith("not taken")]
    for what in ("%matplotlib", "'<b>'", "text/html", "argument 'other'", "drawing of wave"):
        assert any(what in line for line in lost), what
    chapter = next((options.root / "content").glob("*-waves.md"))
    text = chapter.read_text("utf-8").replace("{simulation} waves-1", "{simulation} demo")
    for part in ('title: "Waves travel"', "## One", "### Two", "$2 + 2$", "```text\n4\n```"):
        assert part in text
    chapter.write_text(text, encoding="utf-8")
    assert [one for one in diagnostics(options) if one.fails] == []
    path = options.root / "simulations" / "scenes" / "waves_1.py"
    spec = spec_from_file_location("simulations.scenes.waves_1", path)
    assert spec
    assert spec.loader
    monkeypatch.setitem(sys.modules, spec.name, module_from_spec(spec))
    spec.loader.exec_module(sys.modules[spec.name])
    scene = vars(sys.modules[spec.name])["SCENE"]
    assert {each.name: each.default for each in scene.controls} == SETTINGS


MYST = """\
---
kernelspec: python3
---
(top)=
# A Page

```{admonition} Mind *this*
:class: tip
Text, {eq}`energy`, {doc}`elsewhere`.
```

```{math}
:label: energy
2 + 2
```

:::{seealso}
[There](other.md), [here](https://a.example).
:::

```{code-cell} ipython3
:tags: [hide]
x = 4
```

```{image} plan.png
:alt: A plan
:width: 50%
```

```{toctree}
other
```
"""


def test_a_page_of_myst_becomes_a_chapter(make_book: MakeBook, tmp_path: Path) -> None:
    options = make_book("Text.\n", {"content/book.toml": OUTLINE})
    (tmp_path / "page.md").write_text(MYST, encoding="utf-8")
    (tmp_path / "plan.png").write_bytes(base64.b64decode(picture()))
    said = import_file(options.root, str(tmp_path / "page.md"))
    for what in ("'elsewhere'", "(other.md)", "'toctree'"):
        assert what in said
    assert [one for one in diagnostics(options) if one.fails] == []
    (chapter,) = (options.root / "content").glob("*-page.md")
    text = chapter.read_text("utf-8")
    for part in (":::{note} Mind *this*", ":width: 50%", "```python\nx = 4\n```"):
        assert part in text


@pytest.mark.parametrize(("name", "text"), [("a.txt", ""), ("a.ipynb", "[]"), ("b.ipynb", "{")])
def test_what_is_neither_is_refused(
    name: str, text: str, make_book: MakeBook, tmp_path: Path
) -> None:
    (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(ScaffoldError, match="legal: "):
        import_file(make_book("Text.\n").root, str(tmp_path / name))
