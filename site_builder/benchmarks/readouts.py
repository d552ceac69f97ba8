"""Numbers that figures show: each scene is drawn once for each setting."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from simulations.engine.controls import ControlError
from simulations.engine.frame import Frame, Readout
from simulations.engine.scene import Scene
from site_builder.benchmarks.quantities import with_unit
from site_builder.diagnostics.blame import CodeError
from site_builder.diagnostics.diagnostic import cause, unknown
from site_builder.figures.frames import frame_at
from site_builder.sandbox.loading import loaded


class ReadoutError(CodeError):
    """No such readout; the message says what is legal."""


@dataclass(frozen=True, slots=True)
class Readouts:
    """Asks scenes for their readouts, and remembers the frames."""

    load_scene: Callable[[str], Scene[Any]]
    frames: dict[tuple[str, str, object], Frame] = field(default_factory=dict)
    """By scene, tier and settings."""

    def text(self, scene_id: str, name: str, settings: Mapping[str, str], *, bare: bool) -> str:
        """The readout at ``settings``: values of controls, and ``tier``; with its unit unless
        ``bare``. Raises `ReadoutError`."""
        scene = loaded("simulation", scene_id, self.load_scene, ReadoutError)
        tier = settings.get("tier", scene.default_tier)
        if tier not in scene.tiers and tier != scene.default_tier:
            raise ReadoutError(unknown(f"tier of {scene_id}", tier, scene.tiers))
        controls = {control: value for control, value in settings.items() if control != "tier"}
        shown = _find(scene_id, name, self._frame(scene, tier, controls))
        if "\n" in shown.text:
            raise ReadoutError(f"{scene_id} {name!r} is a matrix; legal: a readout of one line")
        return shown.text if bare else with_unit(shown.text, shown.unit)

    def _frame(self, scene: Scene[Any], tier: str, given: Mapping[str, str]) -> Frame:
        try:
            settings = scene.check(given)
        except ControlError as error:
            raise ReadoutError(f"{scene.id}: {error}") from error
        key = (scene.id, tier, settings)
        if key not in self.frames:
            try:
                self.frames[key] = frame_at(scene, settings, tier)
            except Exception as error:  # whatever a scene's own code may raise
                message = f"simulation {scene.id!r} cannot be drawn: {cause(error)}"
                raise ReadoutError(message) from error
        return self.frames[key]


def _find(scene_id: str, name: str, frame: Frame) -> Readout:
    readouts = {readout.name: readout for readout in frame.readouts}
    if name not in readouts:
        raise ReadoutError(unknown(f"readout of {scene_id}", name, readouts))
    return readouts[name]
