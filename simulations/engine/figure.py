"""A figure from one function: its arguments are the controls, and its result is drawn. The
guide for authors has examples: `site_builder/scaffold/skeletons/gallery/`.
"""

import sys
from collections.abc import Callable, Sequence
from dataclasses import Field, make_dataclass, replace
from functools import wraps
from inspect import Parameter, signature
from itertools import takewhile
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from simulations.engine.controls import Action
from simulations.engine.frame import Frame, Panel, Readout, Sound
from simulations.engine.frame import readout as readout
from simulations.engine.handles import Handle as Handle
from simulations.engine.plotting.matplotlib import plots_of
from simulations.engine.plotting.plot import Plot as Plot
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.engine.settings import action as action
from simulations.engine.settings import choice as choice
from simulations.engine.settings import controls_of, values_of
from simulations.engine.settings import slider as slider
from simulations.engine.settings import toggle as toggle
from simulations.engine.stages import Outputs, Stage

type Part = Plot | NDArray[Any] | str | Panel | Readout | Sound
"""A plot, or a picture, (H, W) or (H, W, 3) from 0 to 1 or as bytes, each in its own panel;
SVG, over the panel before it; a sentence, the frame's description; a panel, readout or sound."""
type Drawn = Part | tuple[Part, ...]

PANEL = "figure"
"""Name of the first panel, for handles; those after it are ``figure_2``, ``figure_3``."""
WIDTH, HEIGHT = 400.0, 290.0
"""View box of a plot and of SVG; a picture has the same width, and the height of its shape."""
COARSE = 100
"""A picture with fewer columns than this shows its pixels as squares."""
BEYOND_WHITE = 2.0
"""Up to here a picture from 0 to 1 may overshoot, as one that was sharpened does; it is clipped."""


def figure[**P](
    title: str,
    *,
    stages: Sequence[Stage | Callable[..., Any]] = (),
    handles: Sequence[Handle[Any]] = (),
    **more: Any,
) -> Callable[[Callable[P, Drawn]], Callable[P, Drawn]]:
    """Make a scene of the function below: the ``SCENE`` of its module.

    An argument whose default is a control is a setting; its name may begin with an underscore if
    the function does not use it, which is no part of the setting's name. An argument without a
    default gets the output of the stage of its name. A stage may be a plain function, which reads
    earlier stages, then settings. ``more`` are further fields of `Scene`. The function itself stays
    as it is.
    """
    if not isinstance(title, str):
        raise TypeError("@figure without a title; legal: @figure('A Title')")

    def make_scene(function: Callable[P, Drawn]) -> Callable[P, Drawn]:
        arguments = signature(function, eval_str=True).parameters.values()
        module, name, steps = function.__module__, function.__name__, list[Stage]()
        inputs = {item.name.removeprefix("_"): item for item in arguments if _is_setting(item)}
        entries = [(key, _kind(item), item.default) for key, item in inputs.items()]
        kind = make_dataclass("Settings", entries, frozen=True, slots=True, module=module)
        for step in stages:
            steps.append(_stage(step, [earlier.name for earlier in steps]))
        stage_names = [item.name for item in arguments if not _is_setting(item)]
        for stage_name in stage_names:
            if stage_name not in [step.name for step in steps]:
                legal = "slider(…) or another control as its default, or a stage of its name"
                raise TypeError(
                    f"argument {stage_name!r} of a figure is no setting; legal: {legal}"
                )
        known = vars(sys.modules[module]).get("SCENE")
        if getattr(known and known.draw, "__name__", name) != name:
            raise TypeError(f"{name!r} is a second figure; legal: one in a file")

        @wraps(function)
        def draw(settings: object, outputs: Outputs) -> Frame:
            values = {key: outputs[key] for key in stage_names}
            values |= {inputs[key].name: value for key, value in values_of(settings).items()}
            return _frame(cast(Any, function)(**values), _settings_sentence(title, settings))

        scene_id = module.removesuffix(".scene").rpartition(".")[2].replace("_", "-")
        scene = Scene(scene_id, title, kind, draw, tuple(steps), tuple(handles), **more)
        vars(sys.modules[module])["SCENE"] = scene
        return function

    return make_scene


def _is_setting(argument: Parameter) -> bool:
    return isinstance(argument.default, Field)


def _kind(argument: Parameter) -> type:
    """Its annotation; without one, the first type of its control."""
    if argument.annotation is Parameter.empty:
        return cast(type, argument.default.metadata["control"](name=argument.name).types[0])
    return cast(type, argument.annotation)


def _stage(step: Stage | Callable[..., Any], before: Sequence[str]) -> Stage:
    if isinstance(step, Stage):
        return step
    after = takewhile(before.__contains__, signature(step).parameters)
    return Stage(step.__name__, step, tuple(after))


def _frame(drawn: Drawn, sentence: str) -> Frame:
    parts = drawn if isinstance(drawn, tuple) else (drawn,)
    panels: list[Panel] = []
    for part in parts:
        name = f"{PANEL}_{len(panels) + 1}" if panels else PANEL
        match part:
            case Panel():
                panels.append(part)
            case Plot():
                panels.append(Panel(name, "", WIDTH, HEIGHT, overlay=part.markup))
            case np.ndarray():
                panels.append(_picture(name, part))
            case str() if part.startswith("<"):
                under = panels.pop() if panels else Panel(name, "", WIDTH, HEIGHT)
                panels.append(replace(under, overlay=under.overlay + part))
            case str() | Readout() | Sound():
                pass
            case _ if hasattr(part, "savefig"):  # matplotlib's
                panels += [
                    Panel(f"{name}{n or ''}", title, WIDTH, HEIGHT, overlay=plot.markup)
                    for n, (title, plot) in enumerate(plots_of(part))
                ]
            case _:
                legal = "a Plot, an array, SVG, a sentence, Panel, Readout, Sound, or a tuple"
                raise TypeError(f"the figure returned {type(part).__name__}; legal: {legal}")
    readouts = tuple(part for part in parts if isinstance(part, Readout))
    sound = next((part for part in parts if isinstance(part, Sound)), None)
    sentences = [part for part in parts if isinstance(part, str) and not part.startswith("<")]
    numbers = (f"{item.label}: {item.text} {item.unit}".strip() + "." for item in readouts)
    return Frame(tuple(panels), readouts, " ".join(sentences or [sentence, *numbers]), sound=sound)


def _picture(name: str, picture: NDArray[Any]) -> Panel:
    if picture.ndim not in (2, 3) or not picture.size or picture.shape[2:] not in ((), (3,)):
        raise ValueError(f"a picture of shape {picture.shape}; legal: (H, W) or (H, W, 3)")
    if picture.dtype != np.uint8 and np.nanmax(picture, initial=0.0) > BEYOND_WHITE:
        legal = "0 (black) to 1 (white), or uint8 from 0 to 255"
        raise ValueError(f"a picture with a value of {np.nanmax(picture):g}; legal: {legal}")
    raster = to_rgba8(picture / (255.0 if picture.dtype == np.uint8 else 1.0))
    rows, columns = raster.shape[:2]
    return Panel(name, "", WIDTH, WIDTH * rows / columns, raster, pixelated=columns < COARSE)


def _settings_sentence(title: str, settings: object) -> str:
    """``A Travelling Wave: Time 1.00 s, Wavelength 2.0 m.``"""
    values = values_of(settings)
    parts = (
        " ".join((control.label, *control.text(values[control.name]))).strip()
        for control in controls_of(type(settings))
        if not isinstance(control, Action)
    )
    return f"{title}: {', '.join(parts)}."
