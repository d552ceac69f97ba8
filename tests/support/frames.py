"""Frames of scenes, and what they say, for tests that compare it with theory."""

from typing import Any

from simulations.engine.frame import Frame, Raster, Readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs, StageCache


def frame_of(
    scene: Scene[Any], tier: str = "", cache: StageCache | None = None, /, **given: object
) -> Frame:
    """The frame at the given settings; of the default tier, and from a cold start, unless told."""
    return scene.render(scene.check(given), tier, cache or StageCache())


def outputs_of(scene: Scene[Any], tier: str = "", /, **given: object) -> Outputs:
    """What the stages make of the given settings."""
    return scene.run(scene.check(given), tier, StageCache()).outputs


def texts_of(frame: Frame) -> dict[str, str]:
    """The readouts as shown, by name."""
    return {item.name: item.text for item in frame.readouts}


def texts_at(scene: Scene[Any], tier: str = "", /, **given: object) -> dict[str, str]:
    """The readouts at the given settings, by name."""
    return texts_of(frame_of(scene, tier, **given))


def estimates_of(scene: Scene[Any], tier: str = "", /, **given: object) -> list[Readout]:
    """What is said of the error at the given settings, the last for all of it."""
    return list(scene.estimates(scene.check(given), tier, StageCache()))


def number_of(text: str) -> float:
    """``5.5 × 10⁻³`` as a number."""
    mantissa, _, power = text.replace("\u00a0", "").partition("×10")
    digits = power.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
    return float(mantissa) * 10.0 ** int(digits or 0)


def pixels_of(frame: Frame, panel: int = 0) -> Raster:
    """The pixels of a panel, which has some."""
    raster = frame.panels[panel].raster
    assert raster is not None
    return raster
