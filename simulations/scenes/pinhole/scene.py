"""A box with a hole: a wide hole blurs the picture, a narrow one darkens it or spreads it by
diffraction."""

from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.lens.pinhole import pinhole_transfer, spread_mm
from simulations.scenes.pinhole.drawing import HEIGHT, WIDTH, section
from simulations.scenes.pinhole.handles import HANDLES
from simulations.scenes.pinhole.settings import WIDEST_MM, Settings
from simulations.scenes.pinhole.stages import DEPTH_MM, STAGES, WAVELENGTHS_UM, share_of_light

PICTURE = 400.0, 320.0
"""View box of the picture."""


def spread(settings: Settings) -> float:
    """Width of the spot by diffraction, mm, in green light."""
    return spread_mm(settings.hole, DEPTH_MM, WAVELENGTHS_UM[1])


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The wall as seen from within, and the box from the side."""
    return Frame(
        panels=(
            Panel("wall", "The picture on the wall", *PICTURE, outputs["picture"], lead=True),
            Panel(
                "section", "The box from the side", WIDTH, HEIGHT, overlay=section(settings.hole)
            ),
        ),
        readouts=_readouts(settings),
        description=describe(settings),
    )


def _readouts(settings: Settings) -> tuple[Readout, ...]:
    light = 100.0 * share_of_light(settings.hole)
    return (
        readout("straight", "Spot, straight rays", settings.hole, "mm", digits=2, role="camera"),
        readout("spread", "Spot, diffraction", spread(settings), "mm", digits=2),
        readout(
            "light",
            f"Light, 100\u00a0% at {WIDEST_MM:g}\u00a0mm",
            light,
            "%",
            digits=1,
            role="light",
        ),
    )


def describe(settings: Settings) -> str:
    """The picture in one sentence."""
    wide = settings.hole >= spread(settings)
    cause = "the width of the hole" if wide else "diffraction"
    exposure = (
        "exposed as long as it needs"
        if settings.longer
        else f"with {format_number(100.0 * share_of_light(settings.hole), 1)}\u00a0% of the light "
        f"of a hole of {WIDEST_MM:g}\u00a0mm"
    )
    size = format_number(max(settings.hole, spread(settings)), 2)
    return (
        f"A balloon over a field of tulips, upside down on the wall of a box, {exposure}. Each "
        f"point makes a spot about {size}\u00a0mm wide, mostly because of {cause}."
    )


# One transfer function for each colour, exact for its wavelength: no tiers.
SCENE = Scene(
    id="pinhole",
    title="A Box with a Hole",
    settings=Settings,
    draw=draw,
    formula=pinhole_transfer,
    stages=STAGES,
    handles=HANDLES,
)
