"""Keys of a TOML table, declared as the fields of a frozen dataclass; tables read by them."""

from collections.abc import Iterator, Mapping
from dataclasses import MISSING, dataclass, field, fields
from typing import Any

from site_builder.diagnostics import Diagnostics, unknown
from site_builder.settings.kinds import Kind, Table
from site_builder.source_text import Toml


@dataclass(frozen=True, slots=True)
class Key:
    """What is declared of a key."""

    name: str
    kind: Kind
    doc: str
    """What it sets, for the author's table and for editors."""
    required: bool
    default: object
    """What holds where the key is absent; None where that follows from something else."""
    without: str
    """What holds then, in words, where the default does not say it."""


def key(kind: Kind, doc: str, default: Any = MISSING, *, without: str = "") -> Any:
    """A field of a table's class; required where it has no default."""
    metadata = {"kind": kind, "says": doc, "without": without}
    if default is MISSING:
        return field(metadata=metadata)
    return field(default=default, metadata=metadata)


def keys_of(table: type[Any]) -> Iterator[Key]:
    """The keys of a table, in their order."""
    for item in fields(table):
        required = item.default is MISSING
        yield Key(
            name=item.name,
            kind=item.metadata["kind"],
            doc=item.metadata["says"],
            required=required,
            default=None if required else item.default,
            without=item.metadata["without"],
        )


@dataclass(frozen=True, slots=True)
class Given:
    """A TOML file that is read, and where its mistakes go."""

    path: str
    toml: Toml
    problems: Diagnostics

    def table[T](self, of: type[T], values: Mapping[str, object], at: tuple[str, ...] = ()) -> T:
        """What ``values`` say, with the defaults of what they leave out; mistakes are reported."""
        declared = {item.name: item for item in keys_of(of)}
        for name in values:
            if name not in declared:
                where = f" of [{'.'.join(at)}]" if at else ""
                message = unknown(f"key{where}", name, declared)
                self.report((*at, name), message)
        read = {name: self._value(item, values, at) for name, item in declared.items()}
        return of(**{name: value for name, value in read.items() if value is not MISSING})

    def report(self, at: tuple[str, ...], message: str) -> None:
        self.problems.add(self.path, self.toml.line(*at), message)

    def _value(self, item: Key, values: Mapping[str, object], at: tuple[str, ...]) -> Any:
        place = (*at, item.name)
        given = values.get(item.name, MISSING)
        if given is MISSING and not item.required:
            return MISSING
        try:
            value = item.kind.read(given)
        except ValueError:
            self._refuse(item, given, place)
            return _empty(item.kind) if item.required else MISSING
        return self.table(item.kind.of, value, place) if isinstance(item.kind, Table) else value

    def _refuse(self, item: Key, given: object, place: tuple[str, ...]) -> None:
        name = ".".join(place)
        if item.required and (given is MISSING or not given):
            # Of lists the name is a plural, and no word of the file.
            what = (
                item.name
                if isinstance(given, list) or "[" in item.kind.expected
                else repr(item.name)
            )
            form = (
                item.kind.expected
                if "[" in item.kind.expected
                else f"{item.name} = {item.kind.expected}"
            )
            where = f" in [{'.'.join(place[:-1])}]" if place[1:] else ""
            self.report(place, f"no {what}{where}; legal: {form}")
        else:
            self.report(place, f"{name} is {_toml(given)}; legal: {item.kind.expected}")


def _empty(kind: Kind) -> object:
    """A stand-in for a required value that is missing, so that reading goes on."""
    return () if kind.schema().get("type") == "array" else ""


def _toml(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict | list):
        return "a table" if isinstance(value, dict) else "a list"
    return f'"{value}"' if isinstance(value, str) else str(value)
