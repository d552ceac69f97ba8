"""Chapter 9: depth from two views."""

from support.worked_numbers import Phrases, source

from simulations.scenes.formation_pipeline.stations import stations, travel

CHAPTER = "09-connections"


def the_links_of_the_first_chapter() -> Phrases:
    """Chain and table have the figure's links, in its order."""
    _, *links = [station.title for station in stations(travel(4.0, 0.6, 0))]
    yield from (rf"\to \text{{{link.lower()}}}" for link in links)
    text = source(CHAPTER)
    rows = [text.index(f"\n| {link} | ") for link in links]
    assert rows == sorted(rows)
    assert len(links) == 7
    yield "Five of the seven lose information"
