"""The scene: the Python of a figure, for the page, notebooks and tests."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import KW_ONLY, dataclass, field, replace

from simulations.engine.accuracy import ONE_LEVEL, Accuracy
from simulations.engine.controls import Control, Slider, Value
from simulations.engine.frame import Frame, Readout
from simulations.engine.handles import Handle, Point, mistakes, places, values_at_place
from simulations.engine.instrument import NO_INSTRUMENT, Instrument
from simulations.engine.ladder import Clock
from simulations.engine.photograph import Photograph
from simulations.engine.reading import Readings
from simulations.engine.settings import check_settings, clamp_settings, controls_of, values_of
from simulations.engine.stages import LazyOutputs, Outputs, Parameter, Run, Stage, StageCache, run

READERS = ("photograph", "readings")
"""Names of the reader's pictures among the parameters of stages."""


@dataclass(frozen=True, slots=True)
class Scene[S]:
    """A figure: its settings, how it is computed, and how it is drawn.

    ``S`` is the dataclass of its settings. The functions are pure: no clock, no globals, no
    unseeded randomness.
    """

    id: str
    title: str
    settings: type[S]
    """Frozen dataclass whose fields define the controls: see `simulations.engine.settings`."""
    draw: Callable[[S, Outputs], Frame]
    """Makes the frame from the settings and the outputs of the stages."""
    stages: tuple[Stage, ...] = ()
    """The stages in the order in which they run. They read settings, ``tier``, ``photograph``,
    ``readings`` and `parameters` by name."""
    handles: tuple[Handle[S], ...] = ()
    """The handles of the picture; of overlapping marks, the nearest is grabbed."""
    accuracy: Accuracy[S] = ONE_LEVEL
    _: KW_ONLY
    """The levels at which it can be computed, and the error of each."""
    instrument: Instrument[S] = NO_INSTRUMENT
    """Its use of the reader's photographs, and the files that it exports."""
    parameters: Callable[[S, str], Mapping[str, Value] | None] | None = None
    """Computes further parameters of the stages from the settings and the level; they may replace a
    setting. If it returns ``None``, no stage runs and none is reported."""
    times: Callable[[S, Clock], Iterator[Readout]] | None = None
    """Yields better and better times that parts of the frame take here, by a clock in seconds. A
    drawing shows each in an element that has its name as ``data-estimate``; no frame holds any."""
    sets: Mapping[str, Callable[[S, Outputs], Mapping[str, Value]]] = field(default_factory=dict)
    """For each button that sets other controls, the values that it gives them."""
    formula: Callable[..., object] | None = None
    """The function of a model that the figure is about, among those that compute or draw it; the
    editor of its Python opens there."""

    def __post_init__(self) -> None:
        for mistake in (
            *self._wrong_stages(),
            *self._wrong_buttons(),
            *self._wrong_reader_pictures(),
            *self.instrument.mistakes(),
            *self.accuracy.mistakes(),
            *mistakes(self.handles, self.controls),
        ):
            raise ValueError(f"scene {self.id!r}: {mistake}")

    @property
    def controls(self) -> tuple[Control, ...]:
        """The controls in the order shown."""
        return controls_of(self.settings)

    def check(self, given: Mapping[str, object]) -> S:
        """The settings with an author's values; anything illegal raises `ControlError`."""
        return check_settings(self.settings, given)

    def clamp(self, given: Mapping[str, object]) -> S:
        """The settings with a reader's values; numbers out of range are clamped."""
        return clamp_settings(self.settings, given)

    def run(
        self,
        settings: S,
        tier: str,
        cache: StageCache,
        photograph: Photograph | None = None,
        readings: Readings = (),
    ) -> Run:
        """Run the stages at the level named ``tier``; an unknown one means the default.

        The outputs include the reader's pictures as ``photograph`` and ``readings``, for
        descriptions of the frame.
        """
        level = self.accuracy.level(tier)
        extra = self.parameters(settings, level.name) if self.parameters else {}
        if extra is None:
            return Run({}, ())
        read: dict[str, Parameter] = {
            **values_of(settings),
            **level.parameters,
            "photograph": photograph,
            "readings": readings,
            **extra,
        }
        done = run(self.stages, read, cache)
        readers = {"photograph": photograph, "readings": readings}
        return replace(done, outputs={**done.outputs, **readers})

    def render(
        self,
        settings: S,
        tier: str,
        cache: StageCache,
        photograph: Photograph | None = None,
        readings: Readings = (),
    ) -> Frame:
        """The frame at these settings. The cache changes only how long it takes."""
        done = self.run(settings, tier, cache, photograph, readings)
        frame = self.draw(settings, done.outputs)
        if not isinstance(frame, Frame):
            kind = type(frame).__name__
            raise TypeError(f"scene {self.id!r}: draw returned {kind}; legal: a Frame")
        where = places(self.handles, settings, done.outputs, frame.panels)
        return replace(frame, stages=done.reports, handles=where)

    def pull(
        self,
        settings: S,
        handle: str,
        place: Point,
        tier: str = "",
        photograph: Photograph | None = None,
        readings: Readings = (),
        cache: StageCache | None = None,
    ) -> dict[str, Value]:
        """The values that bring ``handle`` as near to ``place`` as possible, in the frames of a
        tier; or those that a button of this name sets.

        Raises `KeyError` for an unknown handle, `ValueError` for a place that is not finite.
        """
        by_name = {entry.name: entry for entry in self.handles}
        if handle in self.sets:
            done = self.run(settings, tier, cache or StageCache(), photograph, readings)
            return dict(self.sets[handle](settings, done.outputs))
        if handle not in by_name:
            raise KeyError(f"handle {handle!r}; legal: {', '.join(by_name) or 'none'}")
        context = {**self.accuracy.level(tier).parameters, "photograph": photograph}
        entries = cache.entries if cache else {}  # a copy: the search must not displace outputs
        cache = StageCache(entries={name: dict(found) for name, found in entries.items()})

        def outputs_at(other: S) -> Outputs:
            return LazyOutputs(lambda: self.run(other, tier, cache, photograph, readings).outputs)

        return values_at_place(by_name[handle], settings, place, self.controls, context, outputs_at)

    def estimates(
        self,
        settings: S,
        tier: str,
        cache: StageCache,
        photograph: Photograph | None = None,
        readings: Readings = (),
        clock: Clock | None = None,
    ) -> Iterator[Readout]:
        """Better and better estimates of the error of the frame, then, with a clock, of its times;
        none if it estimates neither."""
        if self.accuracy.estimate is not None:
            outputs = self.run(settings, tier, cache, photograph, readings).outputs
            name = str(self.accuracy.level(tier).parameters["tier"])
            yield from self.accuracy.estimate(settings, outputs, name)
        if self.times is not None and clock:
            yield from self.times(settings, clock)

    def _wrong_stages(self) -> Iterator[str]:
        names = [stage.name for stage in self.stages]
        for name in dict.fromkeys(names):
            if names.count(name) > 1:
                yield f"two stages named {name!r}; legal: a name for each"

    def _wrong_buttons(self) -> Iterator[str]:
        sliders = [control.name for control in self.controls if isinstance(control, Slider)]
        for control in self.controls:
            driven = getattr(control, "drives", "")
            if driven and driven not in sliders:
                legal = ", ".join(sliders) or "none"
                yield f"{control.name!r} drives no slider {driven!r}; legal: {legal}"
            if (getattr(control, "effect", "") == "set") != (control.name in self.sets):
                yield f"{control.name!r} sets nothing; legal: a button in `sets`, with effect set"

    def _wrong_reader_pictures(self) -> Iterator[str]:
        for control in self.controls:
            if control.name in READERS:
                yield f"setting {control.name!r} has the name of the reader's; legal: another name"
        if self.instrument.read and not any("readings" in stage.reads for stage in self.stages):
            yield "no stage reads what `read` finds; legal: one that takes 'readings'"
