"""Chapter 0: from a speck of paint to 149."""

import tomllib

import numpy as np
from support.worked_numbers import CONTENT, Says, source

from simulations.models.sampling.aliasing import alias_frequency, box_mtf
from simulations.scenes.formation_pipeline.stations import stations, travel

CHAPTER = "00-why-image-formation"
SPELT: dict[float, str] = {4: "four", 7: "Seven"}


def one_list_of_links() -> Says:
    """Prose, table, worked example and figure have the same links in the same order."""
    scene, *links = [station.title for station in stations(travel(4.0, 0.6, 0))]
    assert scene == "Scene"
    yield f"{SPELT[len(links)]} links lie between"
    text = (CONTENT / f"{CHAPTER}.md").read_text(encoding="utf-8").replace("&shy;", "")
    prose, example = text.split(":::{example}")
    for part, mark in ((prose, "\n\n**{}.** "), (prose, "\n| {} | "), (example, "\n**{}.** ")):
        places = [part.index(mark.format(link)) for link in links]
        assert places == sorted(places), mark


def stripes_finer_than_the_grid() -> Says:
    """Five on four pixels: the average over a cell, and what the grid makes of the rest."""
    frequency = 5 / 4
    yield f"{100 * float(box_mtf(frequency, 1.0)):.0f} % of their contrast, the difference"
    period = 1 / abs(float(alias_frequency(frequency, 1.0)))
    yield f"one broad stripe every {SPELT[period]} pixels"


def specks_on_one_ray() -> Says:
    """Only the key of the four answers has the same image as the speck of the question."""
    x, y = 0.5 / 2.0, -0.2 / 2.0
    yield f"the same $({x:g}, {y:g})$"
    wrong = ((0.5, -0.2, 4.0), (2.5, 1.8, 4.0), (0.25, -0.1, 4.0))
    for X, Y, Z in (*wrong, (1.0, -0.4, 4.0)):
        assert np.allclose((X / Z, Y / Z), (x, y)) == ((X, Y, Z) not in wrong)
        yield f"{Y:g}, {Z:.1f})$ m"


def where_models_break() -> Says:
    yield "Every chapter has a section on where its model breaks."
    for name in tomllib.loads((CONTENT / "book.toml").read_text(encoding="utf-8"))["chapters"]:
        headings = [line for line in source(name).splitlines() if line[:3] == "## "]
        assert any("breaks" in heading for heading in headings), name
