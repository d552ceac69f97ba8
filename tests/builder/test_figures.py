"""Figures: invalid results of a scene are reported at the figure's line; controls and readouts in
the page; and colours that a book defines."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from support.ladders import toy_ladder
from support.little_book import DEMO, OUTLINE, MakeBook, diagnostics, rendered
from support.places import ROOT

from simulations.engine.accuracy import Accuracy, columns, tiers
from simulations.engine.drawing import line, text
from simulations.engine.frame import Frame, Panel, Readout, readout
from simulations.engine.handles import Handle
from simulations.engine.illustration import Illustration
from simulations.engine.scene import Scene
from simulations.engine.settings import action, choice, slider
from simulations.engine.stages import Outputs
from simulations.registry import level_labels
from site_builder.build import Options
from site_builder.checks import frames as frame_checks
from site_builder.document.blocks import Simulation
from site_builder.document.places import Passage
from site_builder.figures.initial_frames import InitialFrame
from site_builder.output.style_sheets import colour_rules, style_of_drawings
from site_builder.pages.views.simulation import ControlView, control_cells, readouts_in_sight

STYLES = ".overlay .ray { stroke: red }\n.world {}\n"
FIGURE = ":::{simulation} demo\n:::\n"
HEAT = {"heat": ("#ad4209", "#f79c63")}
type Diagnose = Callable[..., list[str]]


def frame(overlay: str = "", raster: Any = None, readouts: tuple[Readout, ...] = ()) -> Frame:
    return Frame((Panel("plan", "Plan", 40, 30, raster, overlay=overlay),), readouts, "A plan.")


def raising(*_: object) -> Frame:
    raise ZeroDivisionError("division by zero")


def with_scene(options: Options, **fields: Any) -> Options:
    """The book with fields of its scene replaced."""
    return replace(options, load_scene=lambda _id: replace(DEMO, **fields))


@pytest.fixture
def diagnose(make_book: MakeBook) -> Diagnose:
    """The diagnostics of a figure whose scene differs in these fields."""

    def find(**fields: Any) -> list[str]:
        files = {"content/book.toml": OUTLINE, "static/css/book.css": STYLES}
        return [str(one) for one in diagnostics(with_scene(make_book(FIGURE, files), **fields))]

    return find


@pytest.mark.parametrize(
    ("draw", "says"),
    [
        (raising, "ZeroDivisionError: division by zero"),
        (lambda *_: Readout("x", "x", 3.0), "readout 'x': text float; legal: a str"),  # type: ignore[arg-type]
        (lambda *_: Readout("x", None, "3"), "readout 'x': label NoneType; legal: a str"),  # type: ignore[arg-type]
        (lambda *_: frame(readouts=(Readout("x", "\ud800", "3"),)), r"'\ud800'; legal: a text"),
        (lambda *_: None, "draw returned NoneType; legal: a Frame"),
        (lambda *_: {"panels": ()}, "draw returned dict; legal: a Frame"),
        (lambda *_: Frame([], (), "A."), "panels list; legal: a tuple of Panel"),  # type: ignore[arg-type]
        (lambda *_: Frame(("a",), (), "A."), "panels str; legal: a tuple of Panel"),  # type: ignore[arg-type]
        (lambda *_: Frame((), ("a",), "A."), "readouts str; legal: a tuple of Readout"),  # type: ignore[arg-type]
        (lambda *_: Frame((), (), None), "no description; legal: a sentence"),  # type: ignore[arg-type]
        (lambda *_: frame(overlay=3), "panel 'plan': overlay int; legal: a str of SVG"),  # type: ignore[arg-type]
        (lambda *_: frame(raster=[[0]]), "panel 'plan': raster list; legal: (H, W, 4) uint8"),
        (lambda *_: frame(raster=np.zeros((2, 2, 4))), "raster (2, 2, 4) float64; legal: "),
        (lambda *_: frame("<g>"), "overlay: no SVG: mismatched tag"),
        (lambda *_: frame("<text>\ud800</text>"), "overlay: no SVG: not well-formed"),
        (lambda *_: frame("<style/>"), "overlay: <style> in a drawing; legal: classes"),
        (lambda *_: frame("<circle r='nan'/>"), "overlay: 'nan' as a place or a size; legal: "),
        (lambda *_: frame("<path d='M0,-inf L1 1'/>"), "overlay: '-inf' as a place or a size"),
        (lambda *_: frame("<g class='rya'/>"), "unknown class 'rya'; did you mean 'ray'?"),
    ],
)
def test_invalid_frame_is_reported_once_at_the_figures_line(
    diagnose: Diagnose, draw: Callable[..., Any], says: str
) -> None:
    (found,) = diagnose(draw=draw)
    assert found.startswith("content/00-first.md:5: ")
    assert says in found


def test_valid_frame_has_no_report_and_an_unused_formula_has_one(diagnose: Diagnose) -> None:
    drawn = frame("<g class='ray world'><text>nan</text></g>", np.zeros((2, 2, 4), np.uint8))
    assert diagnose(draw=lambda *_: drawn) == []
    (found,) = diagnose(formula=raising)
    assert found.startswith("content/00-first.md:5: demo: formula raising; legal: ")


def test_oversized_raster_or_drawing_is_refused(
    diagnose: Diagnose, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = frame("<g></g>", np.zeros((3, 2, 4), np.uint8))
    for name in ("PIXELS", "LETTERS"):
        monkeypatch.setattr(frame_checks, f"MOST_{name}", 5)
    found = [line.split("; ")[1] for line in diagnose(draw=lambda *_: drawn)]
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
def test_handle_that_would_fail_when_pulled_is_reported(
    diagnose: Diagnose, fields: dict[str, Any], says: str
) -> None:
    sound: Handle[Any] = Handle(
        "h", "plan", "H", ("k1",), at=lambda _s, _o: (1.0, 1.0), pull=lambda _s, _p: {"k1": 0}
    )
    (found,) = diagnose(handles=(replace(sound, **fields),))
    assert found.startswith("content/00-first.md:5: simulation 'demo' cannot be drawn: ")
    assert found.endswith(f"handle 'h': {says}")


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
def test_label_outside_its_panel_is_a_warning(
    diagnose: Diagnose, label: str, is_seen: bool
) -> None:
    found = diagnose(draw=lambda *_: frame(label))
    warned = [": warning: demo: panel 'plan': a label at " in one for one in found]
    assert warned == [True] * (not is_seen)


@pytest.mark.parametrize(
    ("draw", "says"),
    [
        (raising, "illustration 'similar-triangles' cannot be drawn: "),
        (
            lambda: Illustration((Panel("plan", "Plan", 40, 30),), "\ud800"),
            r"'\ud800'; legal: a text",
        ),
    ],
)
def test_failing_illustration_is_reported(
    make_book: MakeBook, monkeypatch: pytest.MonkeyPatch, draw: Callable[..., Any], says: str
) -> None:
    monkeypatch.setattr("support.little_book.draw", draw)
    body = ":::{illustration} similar-triangles\nTwo triangles.\n:::\n"
    (found,) = diagnostics(make_book(body, {"content/book.toml": OUTLINE}))
    assert found.message.startswith(says)


def coloured_book(make_book: MakeBook, more: str) -> Options:
    """A book with a figure, a sentence and a formula in the colour of heat."""
    panel = Panel("picture", "Picture", 400, 300, overlay=line((0, 0), (9, 9), "heat"))
    drawn = Frame((panel,), (readout("t", "T", 1.0, role="heat"),), "Shows heat.")
    body = "{heat}`Warm`, $\\role{heat}{T}$.\n\n" + FIGURE
    options = make_book(body, {"content/book.toml": OUTLINE + more})
    return with_scene(options, draw=lambda *_: drawn, stages=())


def test_colour_of_the_book_is_used_like_the_engines_colours(make_book: MakeBook) -> None:
    options = coloured_book(make_book, '[colours]\nheat = "#ad4209 #f79c63"\n')
    assert diagnostics(options) == []
    assert rendered(options)["first/index.html"].decode().count("role-heat") >= 3
    assert "--idea-heat: light-dark(#ad4209, #f79c63);" in colour_rules(HEAT)
    on_paper = style_of_drawings(ROOT, "", {"--serif": "serif", "--sans": "sans-serif"}, HEAT)
    assert ".overlay .heat, .role-heat { color: #ad4209; }" in on_paper
    assert "#f79c63" not in on_paper


def test_colour_that_the_book_does_not_define_is_reported(make_book: MakeBook) -> None:
    assert {one.message.partition(";")[0] for one in diagnostics(coloured_book(make_book, ""))} == {
        "unknown role 'heat'",
        "unknown colour role 'heat'",
        "demo: 't' has an unknown colour role 'heat'",
        "demo: panel 'picture': unknown class 'heat'",
    }


MEASURED = tuple(readout(name, name.upper(), 1.0) for name in "vwxyz")


def draw(_settings: Any, _outputs: Outputs) -> Frame:
    return Frame((), MEASURED, "Nothing.")


def initial_frame(settings: type, in_sight: tuple[str, ...] = ()) -> InitialFrame:
    scene = Scene("s", "S", settings, draw)
    values = {control.name: control.default for control in scene.controls}
    figure = Simulation(
        scene=scene,
        id="figure-s",
        values={},
        tier="",
        caption=Passage(),
        path="",
        line=1,
        in_sight=in_sight,
    )
    return InitialFrame(figure, values, draw(None, {}), {})


@dataclass(frozen=True, slots=True)
class Five:
    a: float = slider("A", 5, -170, 90, 5, unit="°")
    b: str = choice("B", {"one": "One", "two": "Two"})
    play: int = action("Play")
    again: int = action("Again")
    c: float = slider("C", 5, 0, 9, 1)


def names(cells: Iterable[tuple[ControlView, ...]]) -> list[str]:
    return ["+".join(item.control.name for item in cell) for cell in cells]


@pytest.mark.parametrize(
    ("named", "in_view", "folded", "readouts"),
    [
        ((), ["a", "b"], ["play+again", "c", ""], "v"),
        (("tier", "c"), ["", "c"], ["a", "b", "play+again"], ""),
        (("a", "z"), ["a"], ["b", "play+again", "c", ""], "z"),
    ],
)
def test_controls_and_readouts_in_sight_are_the_named_or_first(
    named: tuple[str, ...], in_view: list[str], folded: list[str], readouts: str
) -> None:
    cells = control_cells(initial_frame(Five, named), tiers=True)
    assert [names(each) for each in cells] == [in_view, folded]
    longest = [view.longest for cell in (*cells[0], *cells[1]) for view in cell]
    assert "−170°" in longest, "space for a slider's widest value"
    in_sight, others = readouts_in_sight(initial_frame(Five, named))
    assert "".join(each.name for each in in_sight) == readouts
    assert sorted(each.name for each in (*in_sight, *others)) == list("vwxyz")


@dataclass(frozen=True, slots=True)
class Empty:
    """No controls."""


def test_levels_are_labelled_by_their_scene_or_their_ladder() -> None:
    levels = (*tiers("rough", "fine", labels={"fine": "In every pixel"}), *columns(100))
    scene = Scene("s", "S", Empty, draw, accuracy=Accuracy(levels=levels, ladder="toy"))
    labels = (("rough", "Rough"), ("fine", "In every pixel"), ("100", "100 columns"))
    assert level_labels(scene, toy_ladder) == labels
