"""Chapter 0: from a speck of paint to 149."""

import tomllib

from support.worked_numbers import CONTENT, Phrases, source

from simulations.scenes.formation_pipeline.stations import stations, travel

CHAPTER = "00-why-image-formation"
SPELT: dict[float, str] = {4: "four", 7: "Seven"}


def links_in_the_same_order_everywhere() -> Phrases:
    """Prose, table, worked example and figure have the same links in the same order."""
    scene, *links = [station.title for station in stations(travel(4.0, 0.6, 0))]
    assert scene == "Scene"
    yield f"{SPELT[len(links)]} links lie between"
    text = (CONTENT / f"{CHAPTER}.md").read_text(encoding="utf-8").replace("&shy;", "")
    prose, example, _ = text.split(":::{example}")
    for part, mark in ((prose, "\n\n**{}.** "), (prose, "\n| {} | "), (example, "\n**{}.** ")):
        places = [part.index(mark.format(link)) for link in links]
        assert places == sorted(places), mark


def where_models_break() -> Phrases:
    yield "Every chapter has a section on where its model breaks."
    for name in tomllib.loads((CONTENT / "book.toml").read_text(encoding="utf-8"))["chapters"]:
        headings = [line for line in source(name).splitlines() if line[:3] == "## "]
        assert any("breaks" in heading for heading in headings), name
