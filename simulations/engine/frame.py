"""The frame that a scene returns: pictures, overlays, readouts and a description."""

import json
from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from simulations.engine.message import Message

if TYPE_CHECKING:
    from numpy.typing import NDArray

type Raster = NDArray[np.uint8]
type Samples = NDArray[np.float32]

ROLES = ("", "world", "camera", "ray", "image", "light", "error")
"""Colour roles, one per idea, the same in every figure, formula and sentence."""


def is_role(name: str) -> bool:
    """Whether ``name`` has the form of a role. A book may name others besides `ROLES`; the builder
    checks them."""
    return name in ROLES or (name.isascii() and name.isalpha() and name.islower())


@dataclass(frozen=True, slots=True)
class Panel:
    """One drawing area. A figure's panels stand side by side, or stacked where space is short."""

    name: str
    """Identifier, unique in the frame and the same in every frame of a scene."""
    title: str
    """Caption above the panel; may be empty."""
    width: float
    """Width of the view box, in overlay units; near 400, so that 13-unit text always reads well."""
    height: float
    """Height of the view box, in overlay units."""
    raster: Raster | None = None
    """(H, W, 4) uint8 sRGB, straight alpha, C-contiguous; stretched over the view box."""
    overlay: str = ""
    """SVG markup in view box units; CSS classes only, so that themes and print work."""
    _: KW_ONLY
    pixelated: bool = False
    """Show the raster's pixels as squares instead of smoothing them."""
    lead: bool = False
    """Whether this is the main panel of the figure: the first, larger than the others."""

    def __post_init__(self) -> None:
        raster = self.raster
        if not isinstance(self.overlay, str):
            kind = type(self.overlay).__name__
            raise TypeError(f"panel {self.name!r}: overlay {kind}; legal: a str of SVG")
        if raster is not None and not isinstance(raster, np.ndarray):
            kind = type(raster).__name__
            raise TypeError(f"panel {self.name!r}: raster {kind}; legal: (H, W, 4) uint8")
        if raster is not None and (
            raster.ndim != 3
            or raster.shape[2] != 4
            or raster.dtype != np.uint8
            or not raster.flags.c_contiguous
        ):
            raise ValueError(
                f"panel {self.name!r}: raster {raster.shape} {raster.dtype}; "
                "legal: C-contiguous (H, W, 4) uint8"
            )
        if not (0 < self.width < 1e4 and 0 < self.height < 1e4):
            raise ValueError(
                f"panel {self.name!r}: view box {self.width} × {self.height}; "
                "legal: sides above 0 and below 10000 units"
            )


@dataclass(frozen=True, slots=True)
class Readout:
    """A named number (or matrix) that the picture shows."""

    name: str
    """Identifier: the ``name`` of the page's ``<output>``."""
    label: str
    text: str
    """The value as shown; rows of a matrix are separated by newlines, entries by spaces."""
    unit: str = ""
    _: KW_ONLY
    role: str = ""
    """One of `ROLES`, or a colour that the book defines: the idea that the number belongs to."""

    def __post_init__(self) -> None:
        for name in ("label", "text", "unit"):
            if not isinstance(value := getattr(self, name), str):
                found = f"readout {self.name!r}: {name} {type(value).__name__}"
                raise TypeError(f"{found}; legal: a str, as by readout()")
        if not is_role(self.role):
            raise ValueError(f"readout {self.name!r}: role {self.role!r}; legal: small letters")


@dataclass(frozen=True, slots=True)
class Sound:
    """The sound of a figure, which a button plays."""

    samples: Samples
    """(N,) float32 from -1 to 1, one channel."""
    rate: int = 22_050
    """Samples per second, in Hz."""

    def __post_init__(self) -> None:
        samples = self.samples
        if not isinstance(samples, np.ndarray) or samples.dtype != np.float32:
            kind = getattr(samples, "dtype", type(samples).__name__)
            raise TypeError(f"samples {kind}; legal: an array of float32")
        if samples.ndim != 1 or not len(samples) or not samples.flags.c_contiguous:
            raise ValueError(f"samples {samples.shape}; legal: (N,), at least one, C-contiguous")
        peak = float(np.abs(samples).max())
        if not peak <= 1:
            raise ValueError(f"samples up to {peak:g}; legal: from -1 to 1")
        if not 8000 <= self.rate <= 96_000:
            raise ValueError(f"rate {self.rate} Hz; legal: 8000 to 96000 Hz, as Web Audio plays")


@dataclass(frozen=True, slots=True)
class Place:
    """The place of a handle: see `simulations.engine.handles`."""

    name: str
    """Name of the handle."""
    x: float
    y: float
    """Place in view box units of its panel."""
    step: float = 0.0
    """How far an arrow key moves it, in view box units; 0 if it steps a control instead."""


@dataclass(frozen=True, slots=True)
class StageReport:
    """Report of one stage of the computation."""

    name: str
    status: Literal["computed", "reused", "skipped"]
    reason: str | tuple[Message, ...]
    """The reason: a text of the scene, or messages of the engine."""


@dataclass(frozen=True, slots=True)
class Frame:
    """The content of a figure for one setting of its controls."""

    panels: tuple[Panel, ...]
    readouts: tuple[Readout, ...]
    description: str
    """One sentence on what the picture shows, for readers who cannot see it."""
    _: KW_ONLY
    stages: tuple[StageReport, ...] = field(default=())
    handles: tuple[Place, ...] = ()
    """Places of the handles that can be grabbed; set by the engine, not by the scene."""
    sound: Sound | None = None
    """A scene has one in all of its frames or in none."""

    def __post_init__(self) -> None:
        for name, entries, legal in (
            ("panels", self.panels, Panel),
            ("readouts", self.readouts, Readout),
        ):
            if not isinstance(entries, tuple) or not all(isinstance(e, legal) for e in entries):
                entries_given = entries if isinstance(entries, tuple) else (entries,)
                given = ", ".join(type(entry).__name__ for entry in entries_given)
                raise TypeError(f"{name} {given}; legal: a tuple of {legal.__name__}")
        if not isinstance(self.sound, Sound | None):
            raise TypeError(f"sound {type(self.sound).__name__}; legal: a Sound")
        leads = [panel.name for panel in self.panels if panel.lead]
        if len(leads) > 1:
            raise ValueError(f"panels {leads} all lead; legal: at most one")
        for kind, names in (
            ("panel", [panel.name for panel in self.panels]),
            ("readout", [readout.name for readout in self.readouts]),
        ):
            if len(set(names)) != len(names):
                raise ValueError(f"duplicate {kind} name in {names}; legal: each once")
        if not isinstance(self.description, str) or not self.description.strip():
            raise ValueError("no description; legal: a sentence on what the frame shows")


def readout(
    name: str, label: str, value: float, unit: str = "", *, digits: int = 2, role: str = ""
) -> Readout:
    """A readout of a number with a fixed count of decimals: see `format_number`."""
    return Readout(name, label, format_number(value, digits), unit, role=role)


def matrix_readout(
    name: str, label: str, rows: Sequence[Sequence[float]], *, digits: int = 2, role: str = ""
) -> Readout:
    """A matrix, shown in brackets."""
    text = matrix_text([[format_number(float(entry), digits) for entry in row] for row in rows])
    return Readout(name, label, text, "", role=role)


def matrix_text(rows: Sequence[Sequence[str]]) -> str:
    """Entries in columns: right-aligned by spaces as wide as the digits and points they replace."""
    widest = [max(column, key=len) for column in zip(*rows, strict=True)]
    return "\n".join(
        " ".join(_pad(entry, model) for entry, model in zip(row, widest, strict=True))
        for row in rows
    )


def _pad(entry: str, model: str) -> str:
    replaced = model[: len(model) - len(entry)]
    return "".join("\u2008" if sign == "." else "\u2007" for sign in replaced) + entry


def format_number(value: float, digits: int = 2) -> str:
    """``value`` to ``digits`` decimals; no negative zero; ``∞`` and ``undefined`` in words."""
    if np.isnan(value):
        return "undefined"
    if np.isinf(value):
        return "∞" if value > 0 else "\u2212∞"
    text = f"{value:.{digits}f}"
    if not text.strip("-0."):
        text = text.lstrip("-")
    return text.replace("-", "\u2212")


def value_with_error(value: float, error: float) -> str:
    """A measured value and its standard error: ``2.13 ± 0.04``, ``1230 ± 230``.

    The error has two digits up to 3.5 of its leading power of ten, then one, and is never zero: one
    below the sixth digit of the value is ``under 0.00001``. ``undefined`` if either is not finite.
    Source: Review of Particle Physics, introduction, section 5.3 (rounding).
    """
    if not (np.isfinite(value) and np.isfinite(error)):
        return format_number(float("nan"))
    least = 10.0 ** (_exponent(abs(value)) - 5 if value else -5)
    printed = max(abs(error), least)
    power = int(f"{printed:.2e}".partition("e")[2])
    decimals = (1 if printed / 10.0**power < 3.545 else 0) - power
    if abs(error) < least:
        decimals = -power
    value, printed = (round(number, decimals) for number in (value, printed))
    words = [format_number(number, max(decimals, 0)) for number in (value, printed)]
    return " ± under ".join(words) if abs(error) < least else " ± ".join(words)


def format_magnitude(value: float, floor: float) -> str:
    """A positive number of unknown size to two digits: ``14.2``, ``0.035``, ``3.1 × 10⁻⁵``.

    Below ``floor``, a power of ten, the number is noise: ``under 10⁻⁹``.
    """
    if value < floor:
        return f"under {power_of_ten(_exponent(floor))}"
    if value >= 0.01:
        return format_number(value, 3 if value < 0.1 else 2 if value < 10 else 1)
    mantissa, _, _ = f"{value:.1e}".partition("e")
    return f"{mantissa}\u00a0×\u00a0{power_of_ten(_exponent(value))}"


def _exponent(value: float) -> int:
    """Power of ten of the first digit, once rounded to two."""
    return int(f"{value:.1e}".partition("e")[2])


def power_of_ten(exponent: int) -> str:
    """``10⁻⁵``."""
    return "10" + str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def content(frame: Frame) -> tuple[object, ...]:
    """The pixels, texts and sounds of a frame, to compare two of them; not how it was computed."""
    rasters = [panel.raster for panel in frame.panels if panel.raster is not None]
    pixels = [(raster.shape, raster.tobytes()) for raster in rasters]
    samples = frame.sound and frame.sound.samples.tobytes()
    return to_json(replace(frame, stages=())), pixels, samples


def to_json(frame: Frame) -> str:
    """The frame without its pixels and samples: panel ``i`` has a raster or not, in the panels'
    order."""
    sound = {"sound": {"rate": frame.sound.rate}} if frame.sound else {}
    return json.dumps(
        {
            "panels": [
                {
                    "name": panel.name,
                    "title": panel.title,
                    "width": panel.width,
                    "height": panel.height,
                    "raster": None
                    if panel.raster is None
                    else {"width": panel.raster.shape[1], "height": panel.raster.shape[0]},
                    "overlay": panel.overlay,
                    "pixelated": panel.pixelated,
                }
                for panel in frame.panels
            ],
            "readouts": frame.readouts,
            "description": frame.description,
            "stages": frame.stages,
            "handles": [
                {"name": place.name, "x": round(place.x, 2), "y": round(place.y, 2)}
                | ({"step": round(place.step, 5)} if place.step else {})
                for place in frame.handles
            ],
            **sound,
        },
        ensure_ascii=False,
        allow_nan=False,
        default=lambda item: {name: getattr(item, name) for name in item.__slots__},
    )
