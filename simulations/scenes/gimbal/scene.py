"""Camera on a Gimbal: pan, tilt and roll on three rings, and the lock at a tilt of ±90°.

The camera's axes are the columns of C = Ry(pan) Rx(tilt) Rz(roll), in a world whose axes are
right, down and ahead.
"""

import math

import numpy as np

from simulations.engine.frame import Frame, Panel, Readout, format_number, matrix_readout, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.geometry import euler
from simulations.models.geometry.rotation_paths import rate_axes
from simulations.scenes._turned_camera.body import view_from
from simulations.scenes.gimbal import rings, sight
from simulations.scenes.gimbal.handles import HANDLES
from simulations.scenes.gimbal.settings import Settings

LOST = 1e-6
"""Singular value below which a direction of rotation counts as lost."""


def ringed(view: Floats, pan: float, tilt: float, roll: float) -> str:
    """The panel's markup; angles in degrees."""
    return rings.draw(math.radians(pan), math.radians(tilt), math.radians(roll), view)


STAGES = (Stage("view", view_from), Stage("rings", ringed, ("view",)), Stage("sight", sight.draw))


def smallest_factor(angles_rad: Floats) -> float:
    """The smallest singular value of the matrix of the three axes."""
    return float(np.linalg.svd(rate_axes("YXZ", angles_rad.tolist()))[1][2])


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The camera in its rings, and how well the three angles can turn it."""
    angles_rad = np.radians([settings.pan, settings.tilt, settings.roll])
    smallest = smallest_factor(angles_rad)
    rank = 3 if smallest > LOST else 2
    return Frame(
        panels=(
            Panel(
                "gimbal",
                "Pan, tilt and roll, each on its ring",
                rings.WIDTH,
                rings.HEIGHT,
                overlay=outputs["rings"],
                lead=True,
            ),
            Panel(
                "sight", "What the camera sees", sight.WIDTH, sight.HEIGHT, overlay=outputs["sight"]
            ),
        ),
        readouts=(
            matrix_readout(
                "axes",
                "C, the camera’s axes as columns",
                euler.to_matrix("YXZ", angles_rad).tolist(),
                role="camera",
            ),
            Readout("rank", "Independent axes", f"{rank} of 3"),
            readout("smallest", "Turn per degree, at worst", smallest, digits=3),
        ),
        description=describe(settings, smallest),
    )


def describe(settings: Settings, smallest: float) -> str:
    """The picture in one or two sentences."""
    angles = (settings.pan, settings.tilt, settings.roll)
    pan, tilt, roll = (format_number(angle, 0) for angle in angles)
    if smallest > LOST:
        locked = (
            f"All three angles still steer (smallest singular value {format_number(smallest, 2)})"
        )
    else:
        locked = (
            "The pan and roll rings lie in one plane: both angles turn the camera about the same "
            "line, and one degree of freedom is lost"
        )
    return f"Three rings around a camera at pan {pan}°, tilt {tilt}°, roll {roll}°. {locked}."


SCENE = Scene(
    id="gimbal",
    title="Camera on a Gimbal",
    settings=Settings,
    draw=draw,
    formula=euler.to_matrix,
    stages=STAGES,
    handles=HANDLES,
)
