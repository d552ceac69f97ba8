"""What references may lead to, once every chapter is parsed; and finding one by what an author
wrote."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from site_builder.diagnostics.diagnostic import unknown
from site_builder.document.places import Target


@dataclass(frozen=True, slots=True)
class Targets:
    """Targets of the whole book."""

    chapters: Mapping[str, Target] = field(default_factory=dict)
    """By their ids, in the order of the book."""
    inside: Mapping[str, Sequence[Target]] = field(default_factory=dict)
    """By the id of the chapter they stand in."""

    def find(self, given: str, here: str) -> Target:
        """What ``given`` names on the page ``here``: ``chapter``, ``chapter#id``, ``#id``, or an
        ``id`` of this page or, where no other page has it, of another. Raises `LookupError`."""
        chapter, mark, name = given.partition("#")
        if mark and not chapter:
            return _one(name, self.inside.get(here, ()), "target on this page")
        if mark:
            self._chapter(chapter)
            return _one(name, self.inside.get(chapter, ()), f"target in {chapter}")
        if given in self.chapters:
            return self.chapters[given]
        return self._anywhere(given, here)

    def _chapter(self, name: str) -> Target:
        if name not in self.chapters:
            raise LookupError(unknown("chapter", name, self.chapters))
        return self.chapters[name]

    def _anywhere(self, name: str, here: str) -> Target:
        for target in self.inside.get(here, ()):
            if target.id == name:
                return target
        every = [target for targets in self.inside.values() for target in targets]
        found = [target for target in every if target.id == name]
        if len(found) > 1:
            expected = " or ".join(repr(f"{target.chapter}#{name}") for target in found[:3])
            raise LookupError(f"target {name!r} is in {len(found)} chapters; legal: {expected}")
        if not found:
            names = dict.fromkeys((*self.chapters, *(target.id for target in every)))
            raise LookupError(unknown("target", name, names))
        return found[0]


def _one(name: str, targets: Sequence[Target], kind: str) -> Target:
    by_id = {target.id: target for target in targets}
    if name not in by_id:
        raise LookupError(unknown(kind, name, by_id))
    return by_id[name]
