"""Colours of a book's own ideas: in sentences, formulae, drawings and numbers."""

from collections.abc import Callable
from dataclasses import replace

from support.little_book import DEMO, OUTLINE, diagnostics, rendered
from support.places import ROOT

from simulations.engine.drawing import line
from simulations.engine.frame import Frame, Panel, readout
from site_builder.build import Options
from site_builder.output.colour_rules import colour_rules
from site_builder.output.light_theme import style_of_drawings

type MakeBook = Callable[..., Options]
COLOURED = OUTLINE + '[colours]\nheat = "#ad4209 #f79c63"\n'
TEXT = "{heat}`Warm`, $\\role{heat}{T}$.\n\n:::{simulation} demo\nText.\n:::\n"


def drawn_in(role: str, options: Options) -> Options:
    def draw(_settings: object, _outputs: object) -> Frame:
        panel = Panel("picture", "Picture", 400, 300, overlay=line((0, 0), (9, 9), role))
        return Frame((panel,), (readout("t", "T", 1.0, role=role),), "Shows heat.")

    scene = replace(DEMO, draw=draw, stages=())
    return replace(options, load_scene=lambda _id: scene)


def test_a_colour_of_the_book_is_used_as_the_engine_s_are(make_book: MakeBook) -> None:
    options = drawn_in("heat", make_book(TEXT, {"content/book.toml": COLOURED}))
    assert diagnostics(options) == []
    page = rendered(options)["first/index.html"].decode()
    assert page.count("role-heat") >= 3
    assert "--idea-heat: light-dark(#ad4209, #f79c63);" in colour_rules(
        {"heat": ("#ad4209", "#f79c63")}
    )


def test_drawings_on_paper_have_the_colour_of_light_paper() -> None:
    faces = {"--serif": "serif", "--sans": "sans-serif"}
    sheet = style_of_drawings(ROOT, "", faces, {"heat": ("#ad4209", "#f79c63")})
    assert ".overlay .heat, .role-heat { color: #ad4209; }" in sheet
    assert "#f79c63" not in sheet


def test_a_colour_that_nobody_names_is_told_where_it_is_used(make_book: MakeBook) -> None:
    found = diagnostics(drawn_in("heat", make_book(TEXT)))
    told = {one.message.partition(";")[0] for one in found}
    assert told == {
        "unknown role 'heat'",
        "unknown colour role 'heat'",
        "demo: 't' has an unknown colour role 'heat'",
        "demo: panel 'picture': unknown class 'heat'",
    }
