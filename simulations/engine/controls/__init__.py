"""Controls of a figure: ranges, defaults and labels. Each kind is a class in its own folder.

    NAME/kind.py    its class, and the function by which a scene states it
    NAME/kind.html  its native element
    NAME/kind.ts    how the page reads, writes and parses its value
    NAME/kind.css   how it looks

To add one: its folder, its import, and its class in `Control`; its function among the imports of
`engine/settings.py`; its widget in `notebook/controls.py`; its gesture in
`tests/e2e/test_every_figure.py`. Folder, ``kind`` and function share one name. What needs a range
(handles, play, prerendered frames) takes a `Slider`.
"""

from typing import get_args

from simulations.engine.controls.action.kind import Action as Action
from simulations.engine.controls.choice.kind import Choice as Choice
from simulations.engine.controls.control import ControlError as ControlError
from simulations.engine.controls.control import Value as Value
from simulations.engine.controls.control import suggestion as suggestion
from simulations.engine.controls.points.kind import PointLists as PointLists
from simulations.engine.controls.points.kind import Points as Points
from simulations.engine.controls.slider.kind import Slider as Slider
from simulations.engine.controls.toggle.kind import Toggle as Toggle

type Control = Slider | Choice | Toggle | Action | Points

KINDS: tuple[str, ...] = tuple(kind.kind for kind in get_args(Control.__value__))
"""Names of the kinds and of their folders."""


def describe(control: Control) -> dict[str, object]:
    """The control as plain data: the entry of ``book.json`` and of the page."""
    return {
        "name": control.name,
        "kind": control.kind,
        "label": control.label,
        "default": control.default,
        **control.details(),
    }
