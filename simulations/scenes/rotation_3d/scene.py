"""3D Rotation: three ways to blend two orientations of a camera.

The path leads from straight ahead, C = I, to C = Ry(pan) Rx(tilt) Rz(roll), in a world whose axes
are right, down and ahead.
"""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.geometry import quaternions
from simulations.models.geometry.quaternion_blends import BLENDS
from simulations.models.geometry.rotation_paths import off_great_circle
from simulations.models.geometry.rotations import slerp
from simulations.scenes.rotation_3d import progress, sphere
from simulations.scenes.rotation_3d.handles import HANDLES
from simulations.scenes.rotation_3d.settings import Settings
from simulations.scenes.rotation_3d.sphere import LABELS, START, Path
from simulations.scenes.rotation_3d.stages import STAGES, Orientation, speed_error


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The camera on its path, the three traces of its line of sight, and the angles turned."""
    here: Orientation = outputs["orientation"]
    there: dict[str, Path] = outputs["paths"]
    share, chosen = settings.t, settings.blend
    blend = there[chosen](share)
    off_rad = off_great_circle(quaternions.from_matrix(there["euler"](share)), START, here.q)
    return Frame(
        panels=(
            Panel(
                "blend",
                "Three ways from start to end",
                sphere.WIDTH,
                sphere.HEIGHT,
                overlay=sphere.draw(there, outputs["traces"], outputs["view"], chosen, share),
                lead=True,
            ),
            Panel(
                "progress",
                "How far the camera has turned",
                progress.WIDTH,
                progress.HEIGHT,
                overlay=progress.draw(there, outputs["curves"], chosen, share),
            ),
        ),
        readouts=(
            readout("turn", "Angle θ from start to end", _turn_deg(here.q), "°", digits=1),
            readout(
                "off", "Euler path’s deviation", math.degrees(off_rad), "°", digits=1, role="error"
            ),
            readout(
                "determinant", "Camera’s volume, 1 if rigid", float(np.linalg.det(blend)), digits=3
            ),
        ),
        description=describe(settings, off_rad, blend),
    )


def _turn_deg(q: Floats) -> float:
    return math.degrees(float(np.linalg.norm(quaternions.to_rotation_vector(q))))


def describe(settings: Settings, off_rad: float, blend: Floats) -> str:
    """The picture in one or two sentences."""
    angles = (settings.pan, settings.tilt, settings.roll)
    pan, tilt, roll = (format_number(angle, 0) for angle in angles)
    share = format_number(100 * settings.t, 0)
    volume = float(np.linalg.det(blend))
    shrunk = f", shrunk to {format_number(100 * volume, 0)}\u00a0% of its volume"
    fault = shrunk if volume < 0.995 else ""
    return (
        f"A camera turns from straight ahead to pan {pan}°, tilt {tilt}°, roll {roll}°. By "
        f"{LABELS[settings.blend]} it is at {share}\u00a0% of the way{fault}; the Euler angles "
        f"miss the shortest path by {format_number(math.degrees(off_rad), 1)}°."
    )


def estimate(_settings: Settings, outputs: Outputs, tier: str) -> Iterator[Readout]:
    """Error of the quaternions' path against constant speed on the arc, in one step."""
    yield speed_error(outputs["orientation"], tier)


SCENE = Scene(
    id="rotation-3d",
    title="3D Rotation",
    settings=Settings,
    draw=draw,
    formula=slerp,
    stages=STAGES,
    handles=HANDLES,
    tiers=tuple(BLENDS),
    default_tier="slerp",
    ladder="rotation-interpolation",
    estimate=estimate,
)
