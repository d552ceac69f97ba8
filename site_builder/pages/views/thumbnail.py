"""Thumbnails of chapters: a panel of the still of a figure."""

from dataclasses import dataclass

from simulations.engine.frame import Panel
from site_builder.document.book import Chapter
from site_builder.figures.initial_frames import InitialFrames, PictureFile


@dataclass(frozen=True, slots=True)
class Thumbnail:
    """A panel of a figure, without handles."""

    panel: Panel
    picture: PictureFile | None
    """Its pixels; None of a pure drawing."""


def thumbnail(chapter: Chapter, initial_frames: InitialFrames) -> Thumbnail | None:
    """The main panel of the chapter's first figure with a picture there, else of its first; None
    where it has no figure."""
    stills = (initial_frames[figure.path, figure.line] for figure in chapter.simulations)
    shown = [
        Thumbnail(still.main_panel, still.pictures.get(still.main_panel.name)) for still in stills
    ]
    return next((each for each in shown if each.picture), next(iter(shown), None))
