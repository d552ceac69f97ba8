"""Frames of scenes, their readouts and estimates, for tests that compare them with theory."""

from typing import Any

from simulations.engine.frame import Frame, Raster, Readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs, StageCache


def frame_of(
    scene: Scene[Any], tier: str = "", cache: StageCache | None = None, /, **given: object
) -> Frame:
    """The frame at the given settings; the default tier and an empty cache unless given."""
    return scene.render(scene.check(given), tier, cache or StageCache())


def outputs_of(scene: Scene[Any], tier: str = "", /, **given: object) -> Outputs:
    """The outputs of the stages at the given settings."""
    return scene.run(scene.check(given), tier, StageCache()).outputs


def texts_of(frame: Frame) -> dict[str, str]:
    """The texts of the readouts, by name."""
    return {item.name: item.text for item in frame.readouts}


def texts_at(scene: Scene[Any], tier: str = "", /, **given: object) -> dict[str, str]:
    """The texts of the readouts at the given settings, by name."""
    return texts_of(frame_of(scene, tier, **given))


def estimates_of(scene: Scene[Any], tier: str = "", /, **given: object) -> list[Readout]:
    """The estimates of the error at the given settings; the last is the total."""
    return list(scene.estimates(scene.check(given), tier, StageCache()))


def number_of(text: str) -> float:
    """The number in a text such as ``5.5 × 10⁻³``."""
    mantissa, _, power = text.replace("\u00a0", "").partition("×10")
    digits = power.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
    return float(mantissa) * 10.0 ** int(digits or 0)


def pixels_of(frame: Frame, panel: int = 0) -> Raster:
    """The pixels of a panel; asserts that it has a raster."""
    raster = frame.panels[panel].raster
    assert raster is not None
    return raster
