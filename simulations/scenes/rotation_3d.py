"""3D Rotation: three ways to blend two orientations of a camera.

The path leads from straight ahead, C = I, to C = Ry(pan) Rx(tilt) Rz(roll), in a world whose axes
are right, down and ahead. The line of sight leaves a trace on a sphere. Along a slerp that is an
arc of a circle about one fixed axis; blended Euler angles wander; blended matrices cut through the
sphere.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine.accuracy import Accuracy, tiers
from simulations.engine.drawing import circle, dot, group, line, path, text
from simulations.engine.frame import Frame, Panel, Readout, format_magnitude, format_number, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.labels import name_curves
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.engine.scene import Scene
from simulations.engine.settings import action, choice, slider
from simulations.engine.space.orbit import turning
from simulations.engine.space.view import View, runs
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.geometry import euler, quaternions
from simulations.models.geometry.quaternion_blends import BLENDS, bisected_arc, turn_between_rad
from simulations.models.geometry.rotation_paths import euler_blend, matrix_blend, off_great_circle
from simulations.models.geometry.rotations import slerp
from simulations.scenes._turned_camera import draw_body, nearest, view_from

HEIGHT = 412.0  # of the panel with the sphere, which is 400 wide
CENTRE, RADIUS = (200.0, 222.0), 160.0  # of the sphere
NAMES = {"slerp": (12.0, "start"), "euler": (220.0, "middle"), "matrix": (388.0, "end")}
"""Columns of the names of the three ways, above it."""
BODY = 100.0  # unit of length of the cameras' axes
FRONT = 0.82 * BODY / RADIUS  # of the lens, as a share of the way to the sphere
SHARES = np.linspace(0.0, 1.0, 61)
MARK_EVERY = 6
"""Steps between marks on the quaternions' path: even marks show a constant speed."""
START = np.array([1.0, 0.0, 0.0, 0.0])
STYLES = {"slerp": "ray bold", "euler": "error dashed", "matrix": "image thin"}
ROLES = {name: style.split()[0] for name, style in STYLES.items()}
LABELS = {"slerp": "quaternion slerp", "euler": "Euler angles", "matrix": "matrix entries"}

PLOT = Plot(Axis(0.0, 1.0, 52.0, 384.0), Axis(0.0, 180.0, 290.0, 36.0))
SCALES = (
    Scale("progress s", ticks=(0.0, 0.5, 1.0)),
    Scale("turned so far, °", ticks=(0.0, 60.0, 120.0)),
)

type Path = Callable[[ArrayLike], Floats]


@dataclass(frozen=True, slots=True)
class Settings:
    blend: str = choice("Blend", LABELS)
    t: float = slider("Progress s", 0.5, 0, 1, 0.01, arrival=1.0)
    play: int = action("Play", "Pause", drives="t", effect="play", seconds=6.0)
    pan: float = slider("Pan ψ at the end", 120, -180, 180, 1, unit="°")
    tilt: float = slider("Tilt τ at the end", 60, -90, 90, 1, unit="°")
    roll: float = slider("Roll γ at the end", 75, -180, 180, 1, unit="°")
    azimuth: float = slider("View azimuth", 51, -180, 180, 1, unit="°")
    elevation: float = slider("View elevation", 28, -90, 90, 1, unit="°")


@dataclass(frozen=True, slots=True)
class Orientation:
    """The orientation of the three angles."""

    angles_rad: tuple[float, float, float]
    """Pan, tilt, roll."""
    C: Floats
    """(3, 3) camera to world: the camera's axes as columns."""
    q: Floats
    """(4,) the same as a unit quaternion."""


def orientation(pan: float, tilt: float, roll: float) -> Orientation:
    """The orientation of three angles in degrees."""
    angles_rad = (math.radians(pan), math.radians(tilt), math.radians(roll))
    C = euler.to_matrix("YXZ", angles_rad)
    q = quaternions.from_matrix(C)
    # Exactly half a turn has two shortest paths; rounding must not decide between them.
    q = quaternions.canonical(np.where(np.abs(q) < 1e-12, 0.0, q))
    return Orientation(angles_rad, C, q)


def paths(here: Orientation, tier: str) -> dict[str, Path]:
    """Maps from shares (...), 0 straight ahead and 1 at the end, to matrices (..., 3, 3)."""
    blend = BLENDS[tier]
    return {
        "slerp": lambda share: quaternions.to_matrix(blend(START, here.q, share)),
        "euler": lambda share: euler_blend("YXZ", (0.0, 0.0, 0.0), here.angles_rad, share),
        "matrix": lambda share: matrix_blend(np.eye(3), here.C, share),
    }


def turned_deg(matrices: Floats) -> Floats:
    """Angles (...) of matrices (..., 3, 3): of a rotation its own, of a blend of entries that of
    the nearest rotation about the same axis."""
    skew = matrices - np.swapaxes(matrices, -1, -2)
    sine = np.hypot(np.hypot(skew[..., 2, 1], skew[..., 0, 2]), skew[..., 1, 0]) / 2.0
    cosine = (np.trace(matrices, axis1=-2, axis2=-1) - 1.0) / 2.0
    return np.degrees(np.arctan2(sine, cosine))


def traces_of(all_paths: Mapping[str, Path], view: View) -> dict[str, Floats]:
    """The places (n, 3) of the line of sight along each path: view box x, y, and depth."""
    return {name: view.place(curve(SHARES)[:, :, 2]) for name, curve in all_paths.items()}


def curves_of(all_paths: Mapping[str, Path]) -> dict[str, Floats]:
    """The angle (n,) turned along each path."""
    return {name: turned_deg(curve(SHARES)) for name, curve in all_paths.items()}


def view_of(azimuth: float, elevation: float) -> View:
    return View(view_from(azimuth, elevation), CENTRE, RADIUS)


def sphere(settings: Settings, outputs: Outputs) -> str:
    """The camera on the chosen way, those on the others as ghosts, and the traces of their lines of
    sight."""
    traces, view, chosen = outputs["traces"], outputs["view"], settings.blend
    blends = {name: curve(settings.t) for name, curve in outputs["paths"].items()}
    behind, front = (
        [
            path(runs(trace, front=near), STYLES[name] + ("" if near else " faint"))
            for name, trace in traces.items()
        ]
        for near in (False, True)
    )
    beads = [
        dot(view.place(blend[:, 2]), ROLES[name], 6.0 if name == chosen else 3.5)
        for name, blend in blends.items()
    ]
    lens, end = view.place(np.stack([FRONT * blends[chosen][:, 2], blends[chosen][:, 2]]))
    ghosts = [draw_body(C, view.axes, CENTRE, BODY) for name, C in blends.items() if name != chosen]
    parts = (
        *_globe(view),
        *behind,
        *(group([ghost], "faint") for ghost in ghosts),
        draw_body(blends[chosen], view.axes, CENTRE, BODY),
        line(lens, end, f"{ROLES[chosen]} dashed"),
        *front,
        *(
            dot(place, ROLES["slerp"] + (" faint" if place[2] > 0 else ""), 3.4)
            for place in traces["slerp"][MARK_EVERY:-1:MARK_EVERY]
        ),
        *_ends(*traces["slerp"][[0, -1]]),
        *beads,
        *_names(chosen),
    )
    return "".join(parts)


def _globe(view: View) -> Iterator[str]:
    """Outline, horizon and two meridians; only the near half of each."""
    yield circle(CENTRE, RADIUS, "muted thin")
    turns = np.linspace(0, 2 * math.pi, 73)
    cosine, sine, flat = np.cos(turns), np.sin(turns), np.zeros_like(turns)
    rings = ((cosine, flat, sine), (cosine, sine, flat), (flat, cosine, sine))
    places = [view.place(np.stack(ring, axis=-1)) for ring in rings]
    yield path([run for ring in places for run in runs(ring, front=True)], "muted thin faint")


def _ends(start: Floats, end: Floats) -> Iterator[str]:
    """Start and end, the upper one with its name above it and the lower one with it below."""
    for point, label, other in ((start, "start", end), (end, "end", start)):
        yield circle(point, 5.5, "camera")
        row = point[1] + (-11.0 if point[1] <= other[1] else 21.0)
        yield text((point[0], row), label, "camera small ground", "middle")


def _names(chosen: str) -> Iterator[str]:
    """The names of the three ways, with the style of their traces."""
    for name, (x, anchor) in NAMES.items():
        weight = " strong" if name == chosen else ""
        yield text((x, 22.0), LABELS[name], f"{ROLES[name]}{weight}", anchor)
        left = x - 26.0 * {"start": 0.0, "middle": 0.5, "end": 1.0}[anchor]
        yield line((left, 32.0), (left + 26.0, 32.0), STYLES[name])


def progress(settings: Settings, outputs: Outputs) -> str:
    """The angle that each way has turned the camera by, against the progress along it."""
    share, here = settings.t, float(turned_deg(outputs["paths"][settings.blend](settings.t)))
    curves = [(LABELS[name], STYLES[name], each) for name, each in outputs["curves"].items()]
    parts = (
        PLOT.frame(*SCALES),
        PLOT.drop(share, here),
        *(PLOT.curve(SHARES, curve, style) for _, style, curve in curves),
        name_curves(PLOT, SHARES, curves),
        PLOT.mark(share, here, ROLES[settings.blend]),
    )
    return "".join(parts)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The camera on its path, the three traces of its line of sight, and the angles turned."""
    here, there = outputs["orientation"], outputs["paths"]
    volume = float(np.linalg.det(there[settings.blend](settings.t)))
    turn_deg = math.degrees(float(np.linalg.norm(quaternions.to_rotation_vector(here.q))))
    reached = quaternions.from_matrix(there["euler"](settings.t))
    off_deg = math.degrees(off_great_circle(reached, START, here.q))
    angles = (settings.pan, settings.tilt, settings.roll)
    pan, tilt, roll = (format_number(angle, 0) for angle in angles)
    shrunk = f", shrunk to {format_number(100 * volume, 0)}\u00a0% of its volume"
    ball, plot = sphere(settings, outputs), progress(settings, outputs)
    return Frame(
        (
            Panel("blend", "Three ways from start to end", 400.0, HEIGHT, overlay=ball, lead=True),
            Panel("progress", "How far the camera has turned", 400.0, 340.0, overlay=plot),
        ),
        (
            readout("turn", "Angle θ from start to end", turn_deg, "°", digits=1),
            readout("off", "Euler path’s deviation", off_deg, "°", digits=1, role="error"),
            readout("determinant", "Camera’s volume, 1 if rigid", volume, digits=3),
        ),
        f"A camera turns from straight ahead to pan {pan}°, tilt {tilt}°, roll {roll}°. By "
        f"{LABELS[settings.blend]} it is at {format_number(100 * settings.t, 0)}\u00a0% of the "
        f"way{shrunk if volume < 0.995 else ''}; the Euler angles miss the shortest path by "
        f"{format_number(off_deg, 1)}°.",
    )


def estimate(_settings: Settings, outputs: Outputs, tier: str) -> Iterator[Readout]:
    """Error of the quaternions' path against constant speed on the arc, in one step."""
    q = outputs["orientation"].q
    off_rad = turn_between_rad(BLENDS[tier](START, q, SHARES), bisected_arc(START, q, SHARES))
    text = format_magnitude(math.degrees(float(off_rad.max())), 1e-12)
    yield Readout("error", "Largest error on the quaternions’ way", text, "°", role="error")


@lru_cache(maxsize=4)
def _sight_line(pan: float, tilt: float, roll: float, blend: str, tier: str) -> Floats:
    """The line of sight (101, 3) at each hundredth of the chosen path."""
    return paths(orientation(pan, tilt, roll), tier)[blend](np.linspace(0.0, 1.0, 101))[:, :, 2]


def sight(settings: Settings, outputs: Outputs) -> Point:
    view = view_of(settings.azimuth, settings.elevation)
    blend = outputs["paths"][settings.blend](settings.t)
    return tuple(view.all(blend[:, 2]).tolist())


def sight_pulled(settings: Settings, place: Point, tier: str) -> dict[str, float]:
    curve = _sight_line(settings.pan, settings.tilt, settings.roll, settings.blend, tier)
    track = view_of(settings.azimuth, settings.elevation).place(curve)
    index = nearest(track, place, np.abs(np.arange(len(curve)) - round(100 * settings.t)))
    return {"t": index / 100}


def mark(settings: Settings, outputs: Outputs) -> Point:
    """The place of the progress on the chosen curve."""
    return PLOT.at(settings.t, float(turned_deg(outputs["paths"][settings.blend](settings.t))))


def mark_pulled(_settings: Settings, place: Point) -> dict[str, float]:
    return {"t": min(max(PLOT.x.value(place[0]), 0.0), 1.0)}


SCENE = Scene(
    "rotation-3d",
    "3D Rotation",
    Settings,
    draw,
    (
        Stage("orientation", orientation),
        Stage("view", view_of),
        Stage("paths", paths, ("orientation",)),
        Stage("traces", traces_of, ("paths", "view")),
        Stage("curves", curves_of, ("paths",)),
    ),
    handles=(
        Handle("sight", "blend", "Line of sight", ("t",), sight, sight_pulled, role="camera"),
        Handle(
            "progress",
            "progress",
            "Mark on the curves",
            drives=("t",),
            at=mark,
            pull=mark_pulled,
            reach="press",
            role="camera",
        ),
        turning("blend"),
    ),
    accuracy=Accuracy(
        levels=tiers(*BLENDS), default="slerp", ladder="rotation-interpolation", estimate=estimate
    ),
    formula=slerp,
)
