"""Keys of a TOML table, declared as fields of a frozen dataclass; tables read by them."""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import MISSING, dataclass, field, fields
from typing import Any

from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.files.text import Keys, Toml
from site_builder.settings.kinds import Kind


@dataclass(frozen=True, slots=True)
class Key:
    """What is declared of a key."""

    name: str
    kind: Kind
    doc: str
    """What it sets, for the table in the guide."""
    default: object
    """`MISSING` where the key is required."""
    without: str
    """What holds without the key, in words, where the default value is none."""

    @property
    def required(self) -> bool:
        return self.default is MISSING


def key(kind: Kind, doc: str = "", default: Any = MISSING, *, without: str = "") -> Any:
    """A field of a table's class; required where it has no default."""
    return field(default=default, metadata={"kind": kind, "doc": doc, "without": without})


def keys_of(table: type[Any]) -> Iterator[Key]:
    """The keys of a table, in their order."""
    for item in fields(table):
        if item.metadata:
            yield Key(name=item.name, default=item.default, **item.metadata)


@dataclass(frozen=True, slots=True)
class Reader:
    """Reads the tables of a TOML file and reports their mistakes."""

    path: str
    toml: Toml
    problems: Diagnostics

    def table[T](self, of: type[T], values: object, at: Keys = (), **others: object) -> T:
        """The table at the keys ``at``, with defaults for what is left out or wrong. ``others`` are
        the fields of the class that are no keys."""
        given = values if isinstance(values, dict) else {}
        declared = {item.name: item for item in keys_of(of)}
        for name in given:
            if name not in declared:
                self.report((*at, name), unknown(f"key{_inside(at)}", name, declared))
        read = {name: self._value(item, given, at) for name, item in declared.items()}
        return of(**others, **{name: each for name, each in read.items() if each is not MISSING})

    def tables[T](
        self, of: type[T], name: str, others: Collection[str] = ()
    ) -> tuple[T, ...] | None:
        """The tables ``[[name]]``; None, and a report, where there are none. ``others`` are the
        other keys of the file."""
        for given in self.toml.table:
            if given not in (name, *others):
                self.report((given,), unknown("key", given, (*others, name)))
        entries = self.toml.table.get(name)
        if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
            self.report((name,), f"no [[{name}]]; legal: one or more, each below '[[{name}]]'")
            return None
        return tuple(self.table(of, entry, (name, at)) for at, entry in enumerate(entries))

    def report(self, at: Keys, message: str) -> None:
        self.problems.add(self.path, self.toml.line(*at), message)

    def _value(self, item: Key, values: Mapping[str, object], at: Keys) -> Any:
        given, place = values.get(item.name, MISSING), (*at, item.name)
        if given is MISSING and not item.required:
            return MISSING
        try:
            value = item.kind.read(given)
        except ValueError:
            expected = item.kind.expected
            if item.required and (given is MISSING or not given):
                self.report(
                    place, f"no {item.name!r}{_inside(at)}; legal: {item.name} = {expected}"
                )
            else:
                if isinstance(given, dict) and item.kind.legal({}):
                    wrong = next(name for name in given if not item.kind.legal({name: given[name]}))
                    place, given = (*place, wrong), given[wrong]
                self.report(place, f"{_dotted(place)} is {_toml(given)}; legal: {expected}")
            return MISSING if not item.required else () if isinstance(given, list) else ""
        return self.table(item.kind.table, value, place) if item.kind.table else value


def _dotted(keys: Keys) -> str:
    return ".".join(name for name in keys if isinstance(name, str))


def _inside(at: Keys) -> str:
    return f" of [{_dotted(at)}]" if at else ""


def _toml(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict | list):
        return "a table" if isinstance(value, dict) else "a list"
    return f'"{value}"' if isinstance(value, str) else str(value)
