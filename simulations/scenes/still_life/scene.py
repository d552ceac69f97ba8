"""A still life through a fast lens: the picture of the title page."""

from simulations.engine.frame import Frame, Panel, format_number
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.pictures.still_life.things import THINGS, thing_depth
from simulations.scenes._still_life_camera.focus_plane import line_on_floor
from simulations.scenes.still_life.handles import HANDLES
from simulations.scenes.still_life.settings import Settings
from simulations.scenes.still_life.stages import DRAFT, STAGES, parameters
from simulations.scenes.still_life.view import HEIGHT, WIDTH, floor_row


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The picture, and where the plane of focus cuts the floor."""
    line = line_on_floor(outputs["light"], floor_row(settings.focus), WIDTH, HEIGHT)
    picture = Panel("picture", "", WIDTH, HEIGHT, outputs["picture"], line)
    return Frame((picture,), (), _description(settings))


def _description(settings: Settings) -> str:
    nearest = min(THINGS, key=lambda thing: abs(1 / thing_depth(thing) - 1 / settings.focus))
    sharp = (
        f"the {nearest.name} is the sharpest thing" if settings.focus < 7.3 else "the wall is sharp"
    )
    side = "right" if settings.light_angle > 0 else "left"
    lit = f"lit from {abs(settings.light_angle):.0f}° to the {side}"
    return (
        "Balls and boxes on a chequered floor, a test chart on the wall behind them; focused at "
        f"{format_number(settings.focus, 1)} m with f/{settings.aperture:.1f}, {sharp}; {lit}."
    )


SCENE = Scene(
    id="still-life",
    title="Still Life",
    settings=Settings,
    draw=draw,
    stages=STAGES,
    handles=HANDLES,
    parameters=parameters,
    own_drafts={DRAFT: ("focus", "aperture", "light_angle")},
)
