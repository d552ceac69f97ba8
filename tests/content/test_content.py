"""The book's own text, questions and recorded measurements are right.

Numbers of figures and measurements come from roles in the text. Results that the text works out, so
that the reader can check them by hand, are computed again in the modules beside this one, and their
phrases are looked up in the source.
"""

import re
from importlib import import_module
from inspect import isgeneratorfunction
from math import ceil
from pathlib import Path
from statistics import mean

import pytest
from support.worked_numbers import CONTENT, SLOW, Calculation, source

from simulations.engine.ladder import DRAWS, errors_of_draws
from simulations.registry import LADDER_MODULES, load_ladder, load_scene
from site_builder.benchmarks.judgements import off_the_front
from site_builder.benchmarks.measurements import Measurements, read_measurements
from site_builder.benchmarks.measuring import close, finite
from site_builder.benchmarks.quoted_numbers import read_stage_costs
from site_builder.checks.whole_book import FEW_LETTERS
from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.files.text import Sources

ROOT = CONTENT.parent
CHAPTERS = sorted(file.stem for file in CONTENT.glob("*.md"))
MODULES = [import_module(file.stem) for file in sorted(Path(__file__).parent.glob("numbers_*.py"))]
CALCULATIONS = [
    pytest.param(
        module.CHAPTER,
        found,
        id=f"{module.CHAPTER[:2]}-{found.__name__}",
        marks=[pytest.mark.deep] if found in SLOW else [],
    )
    for module in MODULES
    for found in vars(module).values()
    if isgeneratorfunction(found) and found.__module__ == module.__name__
]


@pytest.mark.parametrize(("chapter", "worked"), CALCULATIONS)
def test_numbers_worked_out_in_a_chapter_agree_with_the_models(
    chapter: str, worked: Calculation
) -> None:
    text = source(chapter)
    for phrase in worked():
        assert phrase in text, f"content/{chapter}.md does not say: {phrase}"


PREDICTION = re.compile(r"^:::\{predict\} (\S+)\n(.*?)^:::$", re.MULTILINE | re.DOTALL)
FIGURE = re.compile(r"^:::\{simulation\} (\S+)\n((?::\w+:.*\n)*)", re.MULTILINE)
LINK = re.compile(r"\{set\}`[^<`]*<([^>]*)>`")
READOUT = re.compile(r'readout\("([\w-]+)", "\w+"([^()]*)\)')
GIVEN = re.compile(r"(\w+)=")
TEXTS = [(CONTENT / f"{chapter}.md").read_text(encoding="utf-8") for chapter in CHAPTERS]
PREDICTIONS = [
    pytest.param(chapter, body, id=name)
    for chapter in TEXTS
    for name, body in PREDICTION.findall(chapter)
    if READOUT.search(body)
]


def differing_controls(chapter: str, scene: str) -> set[str]:
    """Controls of the unlabelled figure of a scene that do not start at their defaults."""
    figures = (text for name, text in FIGURE.findall(chapter) if name == scene)
    options = next((text for text in figures if ":label:" not in text), "")
    start = dict(re.findall(r":(\w+): *(.*)", options))
    return {
        control.name
        for control in load_scene(scene).controls
        if str(control.default) != start.get(control.name, str(control.default))
    }


@pytest.mark.parametrize(("chapter", "body"), PREDICTIONS)
def test_links_of_a_prediction_set_every_control_that_differs(chapter: str, body: str) -> None:
    linked = {control for link in LINK.findall(body) for control in GIVEN.findall(link)}
    for scene, given in READOUT.findall(body):
        known = linked | set(GIVEN.findall(given))
        assert differing_controls(chapter, scene) <= known, scene


QUIZ = re.compile(r"^:::\{quiz\} (\S+)\n(.*?)^:::$", re.MULTILINE | re.DOTALL)
OPTION = re.compile(r"^- \[( |x)\] (.*)$", re.MULTILINE)
MARKUP = re.compile(r"\\[a-z]+|[\\{}$^*]")
"""Marks of formulae and emphasis, which are not displayed."""


@pytest.mark.parametrize("chapter", CHAPTERS)
def test_key_of_a_question_is_not_recognisable_by_its_length(chapter: str) -> None:
    """In a chapter, the key is the longest option no more often than by chance, rounded up."""
    longest, chance = 0, 0.0
    for name, body in QUIZ.findall(source(chapter)):
        if ":kind:" in body:
            continue
        options = [(mark == "x", len(MARKUP.sub("", text))) for mark, text in OPTION.findall(body)]
        (key,) = (length for right, length in options if right)
        others = mean(length for right, length in options if not right)
        assert abs(key - others) <= max(0.25 * others, FEW_LETTERS), name
        longest += max(options, key=lambda option: option[1])[0]
        chance += 1 / len(options)
    assert longest <= ceil(chance)


@pytest.fixture(scope="module")
def measured() -> Measurements:
    problems = Diagnostics()
    found = read_measurements(Sources(ROOT, problems))
    assert not problems, problems.found
    return found


def test_every_ladder_is_measured_and_shown_without_personal_data(measured: Measurements) -> None:
    assert set(LADDER_MODULES) <= set(measured.ladders), "run `make bench`"
    assert set(re.findall(r"^:{3,}\{ladder\} (\S+)", "".join(TEXTS), re.MULTILINE)) == set(
        LADDER_MODULES
    )
    allowed = {"processor", "cores", "system", "python", "numpy", "browser", "pyodide"}
    assert set(measured.machine) == allowed


@pytest.mark.parametrize("ladder_id", LADDER_MODULES)
def test_recorded_errors_are_current_and_defaults_are_pareto_optimal(
    ladder_id: str, measured: Measurements
) -> None:
    recorded, ladder = measured.find(ladder_id), load_ladder(ladder_id)
    workload = ladder.prepare()
    reference = ladder.reference(workload)
    for item in recorded.tiers:
        result = item.tier.run(workload)
        for metric in ladder.metrics:
            now = finite(metric.measure(result, reference, workload))
            then = item.errors[metric.id]
            assert close(now, then), f"{item.tier.id} {metric.id}: {now}, was {then}"
    assert off_the_front(recorded) == ""
    draw = ladder.draw
    assert draw, "without draws every verdict would rest on one workload"
    for name, tiers in errors_of_draws(ladder, lambda _: draw(5), 1).items():
        for tier, (error,) in tiers.items():
            before = recorded[tier].draws[name]
            assert before.size == DRAWS
            assert close(finite(error), finite(before[5])), f"{tier} {name}: was {before[5]}"


def test_recorded_time_shares_of_the_camera_support_the_book() -> None:
    """The recorded times, not this machine's."""
    costs = read_stage_costs(ROOT, load_scene("camera"))
    share = {move.label: move.share for move in costs.moves}
    assert max(share["Read noise σ"], share["Exposure"]) <= 0.10
    late = max(share["Aperture"], share["Light angle"], share["Distortion k₁"])
    assert late <= 0.50
    assert min(share["Focus distance"], share["Focal length"]) > late, "they move the rays"
    assert all(0 < each <= 1 for each in share.values())
