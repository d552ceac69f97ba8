"""What a scene may not return or draw, told where the figure stands and where the scene failed."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support.little_book import OUTLINE, diagnostics

from simulations.engine.drawing import text
from simulations.engine.frame import Frame, Panel, Readout
from simulations.engine.handles import Handle
from simulations.engine.scene import Scene
from site_builder.build import Options
from site_builder.checks import frames as frame_checks

STYLES = ".overlay .ray { stroke: red }\n.world {}\n"
type Told = Callable[..., list[str]]


def frame(overlay: str = "", raster: Any = None) -> Frame:
    return Frame((Panel("plan", "Plan", 40, 30, raster, overlay),), (), "A plan.")


def raising(*_: object) -> Frame:
    raise ZeroDivisionError("division by zero")


@pytest.fixture
def told(make_book: Callable[..., Options]) -> Told:
    """The diagnostics of a figure whose scene differs in these fields."""

    def find(**fields: Any) -> list[str]:
        body = ":::{simulation} demo\n:::\n"
        options = make_book(body, {"content/book.toml": OUTLINE, "static/css/book.css": STYLES})

        def load(scene_id: str) -> Scene[Any]:
            return replace(options.load_scene(scene_id), **fields)

        return [str(one) for one in diagnostics(replace(options, load_scene=load))]

    return find


@pytest.mark.parametrize(
    ("draw", "says"),
    [
        (raising, "ZeroDivisionError: division by zero"),
        (lambda *_: None, "draw returned NoneType; legal: a Frame"),
        (lambda *_: {"panels": ()}, "draw returned dict; legal: a Frame"),
        (lambda *_: Frame([], (), "A."), "panels list; legal: a tuple of Panel"),  # type: ignore[arg-type]
        (lambda *_: Frame(("a",), (), "A."), "panels str; legal: a tuple of Panel"),  # type: ignore[arg-type]
        (lambda *_: Frame((), ("a",), "A."), "readouts str; legal: a tuple of Readout"),  # type: ignore[arg-type]
        (lambda *_: Frame((), (), None), "no description; legal: a sentence"),  # type: ignore[arg-type]
        (lambda *_: Readout("x", "x", 3.0), "readout 'x': text float; legal: a str"),  # type: ignore[arg-type]
        (lambda *_: frame(overlay=3), "panel 'plan': overlay int; legal: a str of SVG"),  # type: ignore[arg-type]
        (lambda *_: frame(raster=[[0]]), "panel 'plan': raster list; legal: (H, W, 4) uint8"),
        (lambda *_: frame(raster=np.zeros((2, 2, 4))), "raster (2, 2, 4) float64; legal: "),
        (lambda *_: frame("<circel/>"), "overlay: unknown element 'circel'; did you mean 'circle'"),
        (lambda *_: frame("<g>"), "overlay: no SVG: mismatched tag"),
        (lambda *_: frame("<g onclick='x'/>"), "overlay: attribute 'onclick'; legal: "),
        (lambda *_: frame("<circle r='nan'/>"), "overlay: 'nan' as a place or a size; legal: "),
        (lambda *_: frame("<path d='M0,-inf L1 1'/>"), "overlay: '-inf' as a place or a size"),
        (lambda *_: frame("<g class='rya'/>"), "unknown class 'rya'; did you mean 'ray'?"),
    ],
)
def test_what_a_scene_may_not_draw_is_reported_once_where_it_stands(
    told: Told, draw: Callable[..., Any], says: str
) -> None:
    (found,) = told(draw=draw)
    assert found.startswith("content/00-first.md:5: ")
    assert says in found


def test_what_a_scene_may_draw_is_in_order(told: Told) -> None:
    drawn = frame("<g class='ray world'><text>nan</text></g>", np.zeros((2, 2, 4), np.uint8))
    assert told(draw=lambda *_: drawn) == []


def test_a_raster_or_a_drawing_beyond_measure_is_refused(
    told: Told, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = frame("<g></g>", np.zeros((3, 2, 4), np.uint8))
    for name in ("PIXELS", "LETTERS"):
        monkeypatch.setattr(frame_checks, f"MOST_{name}", 5)
    found = [line.split("; ")[1] for line in told(draw=lambda *_: drawn)]
    assert found == ["legal: at most 5"] * 2


@pytest.mark.parametrize(
    ("fields", "says"),
    [
        ({"pull": lambda _settings, _place: None}, "pull returns None; legal: {'k1': …}"),
        ({"pull": lambda _settings, _place: {"z": 1}}, "a pull changes 'z'; legal: k1"),
        ({"at": lambda _settings, _outputs: "x"}, "at returns 'x'; legal: (x, y) or None"),
        ({"panel": "plans"}, "panel 'plans'; legal: picture, plan"),
    ],
)
def test_a_handle_that_would_fail_when_it_is_pulled_is_reported(
    told: Told, fields: dict[str, Any], says: str
) -> None:
    sound: Handle[Any] = Handle(
        "h", "plan", "H", ("k1",), lambda _s, _o: (1.0, 1.0), lambda _s, _p: {"k1": 0}
    )
    (found,) = told(handles=(replace(sound, **fields),))
    assert found.startswith("content/00-first.md:5: simulation 'demo' cannot be drawn: ")
    assert found.endswith(f"handle 'h': {says}")


def test_a_formula_that_the_figure_does_not_use_is_reported(told: Told) -> None:
    (found,) = told(formula=raising)
    assert found.startswith("content/00-first.md:5: demo: formula raising; legal: ")


@pytest.mark.parametrize(
    ("label", "is_seen"),
    [
        (text((41, 9), "A"), False),
        (text((41, 9), "A", anchor="end"), True),
        (text((-1, 9), "A", anchor="end"), False),
        (text((9, -1), "A"), False),
        (text((9, 60), "A"), False),
        (f'<g transform="translate(-9 0)">{text((44, 9), "A")}</g>', True),
    ],
)
def test_a_label_outside_its_panel_is_a_warning(told: Told, label: str, is_seen: bool) -> None:
    found = told(draw=lambda *_: frame(label))
    assert [": warning: demo: panel 'plan': a label at " in one for one in found] == (
        [] if is_seen else [True]
    )
