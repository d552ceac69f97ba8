"""Camera Pose: one room in world coordinates and, by p′ = R p + t, in a camera's.

A level camera, dragged and panned in the room; world axes are right, down and ahead.
"""

from simulations.engine.frame import Frame, Readout, format_number, matrix_readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs, Stage
from simulations.models.projection.pinhole import world_to_camera
from simulations.scenes.camera_pose.handles import HANDLES
from simulations.scenes.camera_pose.plans import camera_panel, triple, world_panel
from simulations.scenes.camera_pose.room import LAMP, Standpoint, standpoint
from simulations.scenes.camera_pose.settings import Settings


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The room twice, the pose, and the lamp in camera coordinates."""
    here: Standpoint = outputs["standpoint"]
    lamp = triple(here.seen(LAMP))
    return Frame(
        panels=(world_panel(here), camera_panel(here)),
        readouts=(
            matrix_readout("R", "R", here.rotation.tolist(), role="camera"),
            Readout("t", "t", triple(here.t), "m", "ray"),
            Readout("lamp", "Lamp p′ = R p + t", lamp, "m", "light"),
        ),
        description=describe(settings, here),
    )


def describe(settings: Settings, here: Standpoint) -> str:
    """The pose and the lamp in one sentence."""
    return (
        f"A room from above, in world and in camera coordinates. The camera at "
        f"{triple(here.centre)} m, panned by {format_number(settings.pan, 0)}°, has "
        f"the world’s origin at t = {triple(here.t)} m and the lamp, which is at {triple(LAMP)} m "
        f"in the world, at {triple(here.seen(LAMP))} m."
    )


SCENE = Scene(
    id="camera-pose",
    title="Camera Pose",
    settings=Settings,
    draw=draw,
    formula=world_to_camera,
    stages=(Stage("standpoint", standpoint),),
    handles=HANDLES,
)
