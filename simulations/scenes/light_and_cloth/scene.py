"""A light on a surface: the spectrum that comes back, and its colour to the eye.

The computation is in `simulations.scenes.light_and_cloth.stages`.
"""

from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.color.chromaticity import xyz_to_xyy
from simulations.models.color.observer import tristimulus
from simulations.scenes._spectra import axes, patches
from simulations.scenes._spectra.choices import NAMES
from simulations.scenes._spectra.settings import LitSurface
from simulations.scenes._spectra.words import lit_surface
from simulations.scenes.light_and_cloth import diagram, spectra
from simulations.scenes.light_and_cloth.handles import HANDLES
from simulations.scenes.light_and_cloth.stages import STAGES, Seen, chart, outside

VISIBLE = 2.0
"""Just noticeable ΔE."""


def draw(settings: LitSurface, outputs: Outputs) -> Frame:
    """The spectra, the surfaces to the eye, and their chromaticities."""
    seen: Seen = outputs["seen"]
    chosen = NAMES.index(settings.surface)
    pair, light = outputs["pairs"][:, chosen], outputs["light"]
    curves = spectra.light_and_surface(
        light, pair, twin=settings.twin, cloth=settings.surface == "cloth"
    )
    colours = diagram.diagram(settings.light, seen.white_xy, seen.xyz, chosen, twin=settings.twin)
    width, height = axes.WIDTH, axes.HEIGHT
    sent_back = axes.colours_under(light / light.max() * pair[0])
    return Frame(
        panels=(
            Panel("light", "Light × cloth", width, height, sent_back, curves, lead=True),
            Panel(
                "patches",
                "What the eye sees",
                patches.WIDTH,
                patches.HEIGHT,
                outputs["picture"],
                chart(settings.twin).overlay(settings.surface),
                pixelated=True,
            ),
            Panel("diagram", "Colours without brightness", width, height, overlay=colours),
        ),
        readouts=_readouts(seen, chosen),
        description=describe(settings, seen, chosen),
    )


def _readouts(seen: Seen, chosen: int) -> tuple[Readout, ...]:
    xyz = seen.xyz[0, chosen]
    x, y = xyz_to_xyy(xyz)[:2]
    return (
        readout("x", "Chromaticity x", x, digits=3, role="world"),
        readout("y", "Chromaticity y", y, digits=3, role="world"),
        readout("luminance", "Luminance Y", xyz[1], "of white", digits=3, role="world"),
        readout("apart", "Difference from the twin", seen.apart[chosen], "ΔE", digits=1),
    )


def describe(settings: LitSurface, seen: Seen, chosen: int) -> str:
    """The picture in one sentence."""
    x, y = (format_number(float(each), 3) for each in xyz_to_xyy(seen.xyz[0, chosen])[:2])
    sentence = f"{lit_surface(settings)} has the chromaticity x = {x}, y = {y}"
    if outside(seen.by_day[0, chosen]):
        sentence += ", and by day a colour that no display can show"
    if settings.twin:
        apart = float(seen.apart[chosen])
        sentence += (
            f"; its twin is {'another' if apart > VISIBLE else 'the same'} colour to the eye"
        )
    return f"{sentence}."


# A few sums over 81 wavelengths: no tiers.
SCENE = Scene(
    id="light-and-cloth",
    title="Light on a Cloth",
    settings=LitSurface,
    draw=draw,
    formula=tristimulus,
    stages=STAGES,
    handles=HANDLES,
)
