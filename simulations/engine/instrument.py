"""Instrument: a scene's use of the reader's photographs, and the files that it exports."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from simulations.engine.export import Export
from simulations.engine.frame import Readout
from simulations.engine.photograph import Codes, Photograph, Whole
from simulations.engine.stages import Outputs


@dataclass(frozen=True, slots=True, kw_only=True)
class Instrument[S]:
    """Pictures that a scene of the settings ``S`` takes, and files that it makes."""

    photograph: tuple[int, int] | Whole | None = None
    """Size of the reader's own picture, the parameter ``photograph``, which stages use in place of
    the book's: width and height in px to which it is cropped, or `Whole`; ``None`` if the scene
    takes none. In a scene with `read` it is the reader's picture that is selected."""
    read: Callable[[Photograph], Mapping[str, Any]] | None = None
    """Measures one photograph of up to 24 megapixels. Returns JSON values, which stages get as
    ``readings``. Raises `simulations.engine.reading.UnfitError` for one that cannot be used.
    It runs in a separate interpreter and may take seconds."""
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
    main result, then three about how it was measured."""
    measured: Callable[[Outputs], Sequence[int]] | None = None
    """Numbers of the readings that the lines are of, for a scene that may leave some out."""

    @property
    def measures_photographs(self) -> bool:
        """Whether it works on the reader's whole photographs."""
        return self.read is not None or isinstance(self.photograph, Whole)

    @property
    def reads_mosaics(self) -> bool:
        """Whether it takes the cells of raw files in place of their pictures."""
        return isinstance(self.photograph, Whole) and self.photograph.mosaic

    def mistakes(self) -> Iterator[str]:
        """Messages about contradictions."""
        if self.develop and not (self.photograph or self.read):
            yield "it develops no photograph; legal: with 'photograph' or 'read'"
        names = [export.name for export in self.exports]
        if len(set(names)) != len(names):
            yield f"exports {names}; legal: a name for each"


NO_INSTRUMENT: Instrument[Any] = Instrument()
"""For a scene that takes no pictures and makes no files."""
