"""A prediction asks of the figure as it stands, or its links set what the answer depends on."""

import re

import pytest
from support.worked_numbers import CONTENT

from simulations.registry import load_scene

PREDICTION = re.compile(r"^:::\{predict\} (\S+)\n(.*?)^:::$", re.MULTILINE | re.DOTALL)
FIGURE = re.compile(r"^:::\{simulation\} (\S+)\n((?::\w+:.*\n)*)", re.MULTILINE)
LINK = re.compile(r"\{set\}`[^<`]*<([^>]*)>`")
READOUT = re.compile(r'readout\("([\w-]+)", "\w+"([^()]*)\)')
GIVEN = re.compile(r"(\w+)=")

CHAPTERS = [file.read_text(encoding="utf-8") for file in sorted(CONTENT.glob("*.md"))]
ASKING = [
    pytest.param(chapter, body, id=name)
    for chapter in CHAPTERS
    for name, body in PREDICTION.findall(chapter)
    if READOUT.search(body)
]


def started_elsewhere(chapter: str, scene: str) -> set[str]:
    """The controls that the chapter's figure of a scene starts away from their defaults: the
    one without a label, which is the nearest to its questions."""
    figures = (text for name, text in FIGURE.findall(chapter) if name == scene)
    options = next((text for text in figures if ":label:" not in text), "")
    start = dict(re.findall(r":(\w+): *(.*)", options))
    return {
        control.name
        for control in load_scene(scene).controls
        if str(control.default) != start.get(control.name, str(control.default))
    }


@pytest.mark.parametrize(("chapter", "body"), ASKING)
def test_links_bring_the_figure_to_the_settings_that_are_asked_about(
    chapter: str, body: str
) -> None:
    linked = {control for link in LINK.findall(body) for control in GIVEN.findall(link)}
    for scene, given in READOUT.findall(body):
        known = linked | set(GIVEN.findall(given))
        assert started_elsewhere(chapter, scene) <= known, scene
