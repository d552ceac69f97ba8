"""The contract between a widget and everything that shows it."""

import itertools
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace

from simulations.engine.controls import Control, Slider, Value
from simulations.engine.frame import Frame, Readout
from simulations.engine.handles import Handle, Point, mistakes, places, pulled
from simulations.engine.photograph import Photograph
from simulations.engine.settings import check_settings, clamp_settings, controls_of, values_of
from simulations.engine.stages import Outputs, Parameter, Run, Stage, StageCache, run


@dataclass(frozen=True, slots=True)
class Scene[S]:
    """A widget: what the reader may change, how it is computed, and what is drawn of it.

    ``S`` is the dataclass of its settings. Nothing that a scene does depends on a clock, on
    globals or on unseeded randomness.
    """

    id: str
    title: str
    settings: type[S]
    """Frozen dataclass whose fields state the controls: see `simulations.engine.settings`."""
    draw: Callable[[S, Outputs], Frame]
    """The frame at some settings, from what the stages made of them."""
    stages: tuple[Stage, ...] = ()
    """In the order in which they run. They read settings, ``tier``, ``photograph`` and `parameters`
    by name."""
    handles: tuple[Handle[S], ...] = ()
    """What in the picture can be grabbed; where marks touch, the nearest is taken."""
    photograph: tuple[int, int] | None = None
    """Width and height in px of the reader's own picture that stages take in place of the book's,
    as the parameter ``photograph``; ``None`` where the scene takes none."""
    parameters: Callable[[S, str], Mapping[str, Value] | None] | None = None
    """What stages read besides the settings: set by the tier, or worked out, also in place of a
    setting. ``None`` where there is nothing to compute: no stage runs then, nor is any reported."""
    tiers: tuple[str, ...] = ()
    """Accuracy choices, cheap to dear."""
    default_tier: str = ""
    """The tier a figure settles in."""
    draft_tier: str = ""
    """The tier a figure uses while a control is being dragged, unless a cheaper one is chosen; the
    default where none is named."""
    drafted: tuple[str, ...] = ()
    """The controls whose drags need the draft; all of them where none is named."""
    drafted_in: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Further controls by tier, where a dear one must redo what the default keeps at hand."""
    own_drafts: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Drafts that are no tiers, since they are of use only while one of their controls is dragged:
    there they stand in for the default tier and for all dearer ones."""
    ladder: str = ""
    """The ladder that the tiers are rungs of: it labels them and tells what they cost. Without
    tiers, a control of the scene's own chooses between its rungs."""
    tier_labels: Mapping[str, str] = field(default_factory=dict)
    """What the reader sees of tiers that belong to no ladder, or that its words do not fit here."""
    estimate: Callable[[S, Outputs, str], Iterator[Readout]] | None = None
    """How far a frame in this tier is from the truth, with a unit. Asked only while nothing
    moves, one step at a time: each step is short and yields a better estimate than the last."""

    def __post_init__(self) -> None:
        if not self.draft_tier:
            object.__setattr__(self, "draft_tier", self.default_tier)
        for mistake in (
            *self._wrong_stages(),
            *self._wrong_buttons(),
            *self._wrong_tiers(),
            *self._wrong_drafts(),
            *mistakes(self.handles, self.controls),
        ):
            raise ValueError(f"scene {self.id!r}: {mistake}")

    @property
    def controls(self) -> tuple[Control, ...]:
        """What the reader may change, in the order shown."""
        return controls_of(self.settings)

    def check(self, given: Mapping[str, object]) -> S:
        """The settings that an author gave; anything illegal raises `ControlError`."""
        return check_settings(self.settings, given)

    def clamp(self, given: Mapping[str, object]) -> S:
        """The settings of a reader's gestures; numbers out of range are brought into it."""
        return clamp_settings(self.settings, given)

    def run(
        self, settings: S, tier: str, cache: StageCache, photograph: Photograph | None = None
    ) -> Run:
        """What the stages make of these settings; a tier that the scene lacks is its default.

        With the outputs comes the reader's own picture, as ``photograph``, for those who put into
        words what is seen.
        """
        tier = self._settled(tier)
        extra = self.parameters(settings, tier) if self.parameters else {}
        if extra is None:
            return Run({}, ())
        read: dict[str, Parameter] = {
            **values_of(settings),
            "tier": tier,
            "photograph": photograph,
            **extra,
        }
        done = run(self.stages, read, cache)
        return replace(done, outputs={**done.outputs, "photograph": photograph})

    def render(
        self, settings: S, tier: str, cache: StageCache, photograph: Photograph | None = None
    ) -> Frame:
        """The frame at these settings. The cache changes how long it takes, never the result."""
        done = self.run(settings, tier, cache, photograph)
        frame = self.draw(settings, done.outputs)
        if not isinstance(frame, Frame):
            kind = type(frame).__name__
            raise TypeError(f"scene {self.id!r}: draw returned {kind}; legal: a Frame")
        where = places(self.handles, settings, done.outputs, frame.panels)
        return replace(frame, stages=done.reports, handles=where)

    def pull(self, settings: S, handle: str, place: Point, tier: str = "") -> dict[str, Value]:
        """The values of what ``handle`` drives that bring it as near to ``place`` as can be, in the
        frames of a tier.

        Raises `KeyError` for a handle that the scene lacks, `ValueError` for a place that is none.
        """
        by_name = {entry.name: entry for entry in self.handles}
        if handle not in by_name:
            raise KeyError(f"handle {handle!r}; legal: {', '.join(by_name) or 'none'}")
        return pulled(by_name[handle], settings, place, self.controls, self._settled(tier))

    def estimates(
        self, settings: S, tier: str, cache: StageCache, photograph: Photograph | None = None
    ) -> Iterator[Readout]:
        """Better and better estimates of how far the frame is from the truth; none without one."""
        if self.estimate is not None:
            outputs = self.run(settings, tier, cache, photograph).outputs
            yield from self.estimate(settings, outputs, self._settled(tier))

    def _settled(self, tier: str) -> str:
        return tier if tier in (*self.tiers, *self.own_drafts) else self.default_tier

    def drafts_of(self, tier: str) -> dict[str, str]:
        """By control, the draft of its own that answers its drags in place of a tier."""
        dear = tier in self.tiers[self.tiers.index(self.default_tier) :] if self.tiers else True
        drafts = self.own_drafts.items() if dear else ()
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
