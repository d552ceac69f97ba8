"""The scene: the interface between a figure and everything that shows it."""

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from simulations.engine.controls import Control, Slider, Value
from simulations.engine.export import Export
from simulations.engine.frame import Frame, Readout
from simulations.engine.handles import Handle, Point, mistakes, places, pulled
from simulations.engine.ladder import Clock
from simulations.engine.photograph import Codes, Photograph, Whole
from simulations.engine.reading import Readings
from simulations.engine.settings import check_settings, clamp_settings, controls_of, values_of
from simulations.engine.stages import LazyOutputs, Outputs, Parameter, Run, Stage, StageCache, run

OWN = ("photograph", "readings")
"""Names of the reader's own pictures among the parameters of stages."""


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
    photograph: tuple[int, int] | Whole | None = None
    """Size of the reader's own picture, the parameter ``photograph``, which stages use in place of
    the book's: width and height in px to which it is cut, or whole; ``None`` if the scene takes
    none. In a scene with `read` it is the one of the reader's pictures that is looked at."""
    read: Callable[[Photograph], Mapping[str, Any]] | None = None
    """Finds in one photograph of up to 24 megapixels what is kept of it: JSON values, which stages
    get as ``readings``. Raises `simulations.engine.reading.UnfitError` for one that cannot be used.
    It runs in an interpreter of its own and may take seconds."""
    samples: Mapping[str, Callable[[], Codes]] = field(default_factory=dict)
    """Simulated photographs to try an instrument with, (H, W, 3) or grey (H, W, 1) sRGB, by the
    names of their files, which may state the truth."""
    develop: Callable[[Photograph, S, Outputs], Codes] | None = None
    """Makes the reader's photograph anew, at full resolution, to be saved: (H, W, 3) sRGB, of the
    size of its codes."""
    exports: tuple[Export[S], ...] = ()
    """Files to save, a button each."""
    sheet: Callable[[S, Outputs], tuple[Readout, ...]] | None = None
    """The lines of the data sheet, what was measured of the reader's camera, with errors: first the
    main one, then three that say how it was measured."""
    measured: Callable[[Outputs], Sequence[int]] | None = None
    """Numbers of the readings that the lines are of, for a scene that may leave some out."""
    parameters: Callable[[S, str], Mapping[str, Value] | None] | None = None
    """Computes further parameters of the stages from the settings and the tier; they may replace a
    setting. If it returns ``None``, no stage runs and none is reported."""
    tiers: tuple[str, ...] = ()
    """The tiers, from cheap to expensive."""
    default_tier: str = ""
    """The tier of a figure at rest."""
    draft_tier: str = ""
    """The tier while a control is dragged, unless a cheaper one is chosen; if empty, the default
    tier."""
    drafted: tuple[str, ...] = ()
    """The controls that need the draft while dragged; if empty, all."""
    drafted_in: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Further controls that need the draft, by tier: an expensive tier may recompute more than the
    default."""
    own_drafts: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Drafts that are not tiers, each with the controls that use it while dragged. They replace the
    default tier and all more expensive ones."""
    ladder: str = ""
    """The ladder whose rungs are the tiers; it has their labels and costs. In a scene without
    tiers, one of the controls chooses between the rungs."""
    tier_labels: Mapping[str, str] = field(default_factory=dict)
    """Labels of tiers that are in no ladder, or whose label in the ladder does not fit here."""
    estimate: Callable[[S, Outputs, str], Iterator[Readout]] | None = None
    """Yields better and better estimates of the error of a frame in a tier, with a unit. Called
    while nothing moves; each step must be short."""
    times: Callable[[S, Clock], Iterator[Readout]] | None = None
    """Yields better and better times that parts of the frame take here, by a clock in seconds. A
    drawing shows each in an element that has its name as ``data-estimate``; no frame holds any."""
    sets: Mapping[str, Callable[[S, Outputs], Mapping[str, Value]]] = field(default_factory=dict)
    """For each button that sets other controls, the values that it gives them."""
    formula: Callable[..., object] | None = None
    """The function of a model that the figure is about, among those that compute or draw it; the
    editor of its Python opens there."""

    def __post_init__(self) -> None:
        if not self.draft_tier:
            object.__setattr__(self, "draft_tier", self.default_tier)
        for mistake in (
            *self._wrong_stages(),
            *self._wrong_buttons(),
            *self._wrong_own_pictures(),
            *self._wrong_tiers(),
            *self._wrong_drafts(),
            *mistakes(self.handles, self.controls),
        ):
            raise ValueError(f"scene {self.id!r}: {mistake}")

    @property
    def controls(self) -> tuple[Control, ...]:
        """The controls in the order shown."""
        return controls_of(self.settings)

    @property
    def measures_photographs(self) -> bool:
        """Whether it is an instrument: it works on whole photographs of the reader's."""
        return self.read is not None or isinstance(self.photograph, Whole)

    @property
    def reads_mosaics(self) -> bool:
        """Whether it takes the cells of raw files in place of their pictures."""
        return isinstance(self.photograph, Whole) and self.photograph.mosaic

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
        """Run the stages; an unknown tier means the default.

        The outputs include the reader's own pictures as ``photograph`` and ``readings``, for
        descriptions of the frame.
        """
        tier = self._settled(tier)
        extra = self.parameters(settings, tier) if self.parameters else {}
        if extra is None:
            return Run({}, ())
        read: dict[str, Parameter] = {
            **values_of(settings),
            "tier": tier,
            "photograph": photograph,
            "readings": readings,
            **extra,
        }
        done = run(self.stages, read, cache)
        own = {"photograph": photograph, "readings": readings}
        return replace(done, outputs={**done.outputs, **own})

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
        shown = {"tier": self._settled(tier), "photograph": photograph}
        entries = cache.entries if cache else {}  # a copy: the search must not displace outputs
        cache = StageCache(entries={name: dict(found) for name, found in entries.items()})

        def outputs_at(other: S) -> Outputs:
            return LazyOutputs(lambda: self.run(other, tier, cache, photograph, readings).outputs)

        return pulled(by_name[handle], settings, place, self.controls, shown, outputs_at)

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
        none if the scene has no `estimate` and no `times`."""
        if self.estimate is not None:
            outputs = self.run(settings, tier, cache, photograph, readings).outputs
            yield from self.estimate(settings, outputs, self._settled(tier))
        if self.times is not None and clock:
            yield from self.times(settings, clock)

    def _settled(self, tier: str) -> str:
        return tier if tier in (*self.tiers, *self.own_drafts) else self.default_tier

    def drafts_of(self, tier: str) -> dict[str, str]:
        """For each control with a draft of its own, the name of that draft."""
        expensive = (
            tier in self.tiers[self.tiers.index(self.default_tier) :] if self.tiers else True
        )
        drafts = self.own_drafts.items() if expensive else ()
        return {control: draft for draft, controls in drafts for control in controls}

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

    def _wrong_own_pictures(self) -> Iterator[str]:
        for control in self.controls:
            if control.name in OWN:
                yield f"setting {control.name!r} has the name of the reader's; legal: another name"
        if self.read and not any("readings" in stage.reads for stage in self.stages):
            yield "no stage reads what `read` finds; legal: one that takes 'readings'"
        if self.develop and not (self.photograph or self.read):
            yield "it develops no photograph; legal: with 'photograph' or 'read'"
        names = [export.name for export in self.exports]
        if len(set(names)) != len(names):
            yield f"exports {names}; legal: a name for each"

    def _wrong_tiers(self) -> Iterator[str]:
        for tier in (self.default_tier, self.draft_tier):
            if tier not in (*self.tiers, "") or bool(self.tiers) != bool(tier):
                yield f"tier {tier!r}; legal: {self.tiers}"
        labelled = set(self.tier_labels)
        if not labelled <= set(self.tiers):
            yield f"labels {labelled}; legal: {self.tiers}"
        if self.tiers and not self.ladder and labelled != set(self.tiers):
            yield f"tiers {self.tiers} have no ladder to label them"

    def _wrong_drafts(self) -> Iterator[str]:
        names = [control.name for control in self.controls]
        if not set(self.drafted_in) <= set(self.tiers):
            yield f"drafted_in {self.drafted_in}; legal: {self.tiers}"
        for draft in self.own_drafts:
            if draft in self.tiers:
                yield f"own draft {draft!r} is a tier; legal: another name"
        drafts = (self.drafted, *self.drafted_in.values(), *self.own_drafts.values())
        for name in itertools.chain(*drafts):
            if name not in names:
                yield f"drafted {name!r}; legal: {names}"
