"""Every public function of the models, with arguments inside and outside their legal range.

`arguments.toml` has a row for each. An argument outside its range is refused by a `ValueError` that
names it and the legal range. Numbers and arrays from the whole range of legal floats, Python's and
NumPy's, give results without a warning (pytest turns those into errors) and, where they are finite,
without NaN; or their combination is refused by such an error. Further promises about the result
stand after the arrow of a row.
"""

import dataclasses
import importlib
import inspect
import pkgutil
import re
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from properties.kinds import Kind, kind_of

from simulations import models
from simulations.registry import hard_case_tables
from site_builder.runtime.imports import Table, reach
from site_builder.runtime.pack import page_modules

TABLE = tomllib.loads(Path(__file__).with_name("arguments.toml").read_text("utf-8"))


def public_functions() -> Iterator[tuple[str, str, Callable[..., Any]]]:
    """Folder, name within it, and function; also classes that check their fields."""
    for module in pkgutil.walk_packages(models.__path__, f"{models.__name__}."):
        room, _, file = module.name.removeprefix(f"{models.__name__}.").rpartition(".")
        for name, value in vars(importlib.import_module(module.name)).items():
            hidden = name.startswith("_") or "__mutmut_" in name  # also what `make mutants` adds
            own = getattr(value, "__module__", "") == module.name and not hidden
            checks = inspect.isclass(value) and hasattr(value, "__post_init__")
            if own and (checks or inspect.isfunction(inspect.unwrap(value))):
                yield room or "models", f"{file}.{name}", value


def rows() -> Iterator[tuple[str, Callable[..., Any], str | None]]:
    """The name of each function, with its module where names in a folder clash; function; row."""
    for room, path, function in public_functions():
        table, (file, name) = TABLE.get(room, {}), path.split(".")
        key = path if path in table else name
        if {room, file, path, name}.isdisjoint(TABLE["unchecked"] + table.get("unchecked", [])):
            yield f"{room}.{key}", function, table.get(key)


ROWS = {name: (function, row) for name, function, row in rows() if row is not None}


def test_every_public_function_has_a_row_and_every_row_a_function() -> None:
    named = {f"{room}.{name}" for room in TABLE for name in TABLE[room] if room != "unchecked"}
    found = {name for name, *_ in rows()}
    assert {name for name in named if not name.endswith(".unchecked")} == found, (
        "arguments.toml needs a row, or a name under `unchecked`, for each function"
    )


def test_every_module_is_used_by_a_figure_a_ladder_or_a_hard_case(
    imports_of_the_book: Table,
) -> None:
    tables = [tomllib.loads(file.read_text("utf-8")) for file in hard_case_tables().values()]
    named = {path.partition(":")[0] for table in tables for path in table["names"]}
    needed = [reach(imports_of_the_book, name) for name in named & imports_of_the_book.keys()]
    walk = pkgutil.walk_packages(models.__path__, f"{models.__name__}.")
    every = {module.name for module in walk if not module.ispkg}
    assert every <= page_modules(imports_of_the_book).union(*needed)


@dataclasses.dataclass(frozen=True)
class Call:
    """A function, the kinds of its arguments, and the promise about its result."""

    function: Callable[..., Any]
    kinds: dict[str, Kind]
    words: dict[str, str]
    """For each argument, a word in the message of its refusal."""
    result: str

    def answer(self, **changed: Any) -> Any:
        """The result for the examples of all arguments, except the changed ones."""
        return self.function(**{name: kind.example for name, kind in self.kinds.items()} | changed)


def call_of(name: str) -> Call:
    function, row = ROWS[name]
    arguments, _, result = row.partition("->")
    kinds, words = {}, {}
    for argument in filter(None, map(str.strip, arguments.split(";"))):
        title, _, kind = argument.partition(": ")
        key, _, word = title.partition("~")
        kinds[key], words[key] = kind_of(kind), word or key
    return Call(function, kinds, words, result.strip() or "number")


@pytest.mark.parametrize("name", ROWS)
def test_arguments_out_of_range_are_refused_by_name(name: str) -> None:
    call = call_of(name)
    call.answer()
    for argument, kind in call.kinds.items():
        for end in kind.ends:
            call.answer(**{argument: end})
        for value in kind.illegal:
            try:
                with pytest.raises(ValueError, match=call.words[argument]) as refused:
                    call.answer(**{argument: value})
                assert not isinstance(refused.value, np.linalg.LinAlgError)
            except (Exception, pytest.fail.Exception) as failure:
                failure.add_note(f"{name}({argument}={value!r})")
                raise


@pytest.mark.parametrize("name", ROWS)
@pytest.mark.parametrize(
    "draws", [range(25), pytest.param(range(25, 2000), marks=pytest.mark.deep)], ids=["few", "many"]
)
def test_legal_arguments_of_any_size_give_numbers(name: str, draws: range) -> None:
    call = call_of(name)
    known = re.compile("|".join(call.words.values()))
    for seed in draws:
        rng = np.random.default_rng(seed)
        given = {argument: kind.draw(rng) for argument, kind in call.kinds.items()}
        if seed % 3 == 0:
            given |= {key: given[key][0] for key, kind in call.kinds.items() if kind.single}
        if seed % 2:
            given = {key: np.float64(v) if type(v) is float else v for key, v in given.items()}
        try:
            answer = call.function(**given)
            check(answer, call.result, all(map(is_finite, given.values())))
        except Exception as failure:
            refused = type(failure) is ValueError and "legal: " in str(failure)
            if refused and known.search(str(failure)):
                continue  # legal one by one, but not together
            failure.add_note(f"{name} of {given}")
            raise


STACKS = [name for name, (_, row) in ROWS.items() if "* " in row]


@pytest.mark.parametrize("name", STACKS)
def test_stack_gives_the_results_of_each_vector_alone(name: str) -> None:
    call = call_of(name)
    stacks = {key: kind.example for key, kind in call.kinds.items() if kind.stack}
    together = list(numbers_of(call.answer()))
    for place in range(len(next(iter(stacks.values())))):
        each = numbers_of(call.answer(**{key: value[place] for key, value in stacks.items()}))
        for many, alone in zip(together, each, strict=True):
            np.testing.assert_allclose(many[place], alone, rtol=1e-12, atol=1e-14)
    none = numbers_of(call.answer(**{key: value[:0] for key, value in stacks.items()}))
    assert [part.shape for part in none] == [(0, *part.shape[1:]) for part in together]


@pytest.mark.parametrize("name", STACKS)
@pytest.mark.parametrize("wild", [1e200, np.inf, np.nan])
def test_extreme_vector_does_not_change_its_neighbours(name: str, wild: float) -> None:
    call = call_of(name)
    for key, kind in call.kinds.items():
        if kind.stack:
            spoilt = kind.example.copy()
            spoilt[0] = wild
            try:
                answer = call.answer(**{key: spoilt})
            except ValueError:
                continue
            for part, calm in zip(numbers_of(answer), numbers_of(call.answer()), strict=True):
                np.testing.assert_array_equal(part[1:], calm[1:])


def numbers_of(answer: Any) -> Iterator[np.ndarray[Any, Any]]:
    """All arrays in a result."""
    if dataclasses.is_dataclass(answer):
        answer = [getattr(answer, field.name) for field in dataclasses.fields(answer)]
    if isinstance(answer, (tuple, list)):
        for part in answer:
            yield from numbers_of(part)
    elif isinstance(answer, (float, np.ndarray, np.generic)):
        yield np.asarray(answer)


def is_finite(value: Any) -> bool:
    return all(np.isfinite(part).all() for part in numbers_of(value))


def check(answer: Any, result: str, finite_input: bool) -> None:
    numbers = list(numbers_of(answer))
    if result == "masked":
        values, valid = numbers[0], np.asarray(answer[1])
        assert np.isfinite(values[valid]).all()
        assert np.isnan(values[~valid]).all()
    elif result == "rotation":
        for R in numbers:
            assert np.abs(R @ np.swapaxes(R, -1, -2) - np.eye(3)).max() < 1e-9
    elif result == "unit":
        for vector in numbers:
            assert np.linalg.norm(vector, axis=-1) == pytest.approx(1.0)
    elif limits := re.fullmatch(r"\[(\S+), (\S+)\]", result):
        for part in numbers:
            assert ((part >= float(limits[1])) & (part <= float(limits[2]))).all()
    elif result == "finite":
        assert is_finite(answer)
    elif result == "number" and finite_input:
        assert not any(np.isnan(part).any() for part in numbers if part.dtype.kind in "fc")
