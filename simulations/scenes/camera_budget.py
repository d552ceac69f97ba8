"""A Camera within a Budget: what plans save of twenty photographs, and what their pictures lose."""

from collections.abc import Sequence
from dataclasses import dataclass

from simulations.engine.frame import Frame, Panel, format_number, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.labels import Label, Rectangle, place_labels
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.engine.scene import Scene
from simulations.engine.settings import choice
from simulations.engine.stages import Outputs, Stage
from simulations.world.camera_budget import (
    COUNT,
    ENOUGH,
    PLANS,
    error_in_picture,
    given,
    in_order,
    prepare,
    time_saved,
)

WIDTH, HEIGHT = 400.0, 300.0
MOST_MS, MOST_ERROR = 6.5, 1.5
"""Ends of the axes; what is beyond them is drawn at them."""
PLOT = Plot(Axis(0.0, MOST_MS, 46.0, 388.0), Axis(0.0, MOST_ERROR, 250.0, 30.0))
NAMES = {
    "nothing": "leave out nothing",
    "single": "one by one",
    "squares": "best of 128, in squares",
    "added": "best of 128, blur and area added",
}


@dataclass(frozen=True, slots=True)
class Settings:
    plan: str = choice("Plan", {name: label.capitalize() for name, label in NAMES.items()}, "added")


@dataclass(frozen=True, slots=True)
class Result:
    """What a plan leaves out of one photograph."""

    saved_ms: float
    share: float
    """Error of the picture, as a share of the tolerance."""


type Results = tuple[Result, ...]


def results_of_plans() -> dict[str, Results]:
    """Of each plan, its results by photograph."""
    found = {}
    for name, plan in PLANS.items():
        results = []
        for number, task in enumerate(prepare()):
            left = in_order(plan(*given(task)))
            error = task.errors.get(left)
            error = error_in_picture(number, left) if error is None else error
            results.append(Result(time_saved(task.saved, left), error / task.tolerance))
        found[name] = tuple(results)
    return found


STAGES = (Stage("results", results_of_plans),)


def whole(results: Sequence[Result]) -> tuple[float, float]:
    """Mean time saved in milliseconds, and the largest share of the tolerance."""
    saved = sum(result.saved_ms for result in results) / len(results)
    return saved, max(result.share for result in results)


def chart(results: dict[str, Results], chosen: str) -> str:
    """All plans, and the photographs of one."""
    points = {name: whole(each) for name, each in results.items()}
    best = sum(task.most for task in prepare()) / COUNT
    places = {name: PLOT.clamped(*point) for name, point in points.items()}
    dots = [(result.saved_ms, result.share) for result in results[chosen]]
    styles = {name: "image" if name == chosen else "muted" for name in points}
    labels = [
        Label(
            places[name],
            NAMES[name],
            f"{styles[name]} small ground",
            prefer="left",
            leader="muted thin",
        )
        for name in sorted(points, key=lambda name: name != chosen)
    ]
    taken = [Rectangle(x - 6, y - 6, x + 6, y + 6) for x, y in places.values()]
    return "".join(
        (
            PLOT.region((ENOUGH * best, MOST_MS), (0.0, 1.0), "light fill faint"),
            PLOT.frame(Scale("time saved, ms"), Scale("error / tolerance")),
            PLOT.level(1.0, "error thin dashed"),
            *(PLOT.mark(*dot, "image faint", 2.5) for dot in dots),
            *(PLOT.mark(*points[name], f"{styles[name]} solid", 6.0) for name in points),
            place_labels(labels, Rectangle(50, 20, 388, 246), (), taken),
        )
    )


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """A chart of error against time saved."""
    results: dict[str, Results] = outputs["results"]
    saved, worst = whole(results[settings.plan])
    beyond = sum(result.share > 1.0 for result in results[settings.plan])
    return Frame(
        (
            Panel(
                "chart",
                "What is saved, and what is lost",
                WIDTH,
                HEIGHT,
                overlay=chart(results, settings.plan),
                lead=True,
            ),
        ),
        (
            readout("beyond", "Pictures beyond their tolerance", beyond, digits=0, role="error"),
            readout("saved", "Saved on average", saved, "ms"),
        ),
        f"The plan “{NAMES[settings.plan]}” saves {format_number(saved, 2)} ms a photograph; the "
        f"worst picture has {format_number(worst, 2)} times the error it may have.",
    )


def plan_at(settings: Settings, outputs: Outputs) -> Point:
    return PLOT.clamped(*whole(outputs["results"][settings.plan]))


SCENE = Scene(
    "camera-budget",
    "A Camera within a Budget",
    Settings,
    draw,
    STAGES,
    (Handle("plan", "chart", "Plan", ("plan",), plan_at, reach="press", role="image"),),
)
