"""Judges a function that a reader has written.

Three stages, each a separate call: *values* compares its answers with the solution's,
*workload* measures it in a ladder, beside the ladder's tiers, and *hard* tries the hard cases of
the book's function. Mistakes that the author expects are recognised by what they compute.
"""

import ast
import base64
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import KW_ONLY, asdict, dataclass, field, replace
from importlib import import_module
from math import isfinite
from typing import Any

import numpy as np

from simulations.editing.definitions import import_from_sources
from simulations.editing.program import Place, check_text
from simulations.engine.hard_cases import HardCases, answer, as_expected, show, table_of
from simulations.engine.ladder import Clock, Ladder, Tier, TierResult, measure_tier

READERS = "exercise"
"""Name of the module in which the reader's text runs."""
TOLERANCE = 1e-6
"""Of the largest expected number; a name of the checks, ``TOLERANCE = 1e-3``, sets another."""
LONGEST_LISTED = 12
LONGEST_GIVEN = 12
"""Most numbers of an array that is printed in full beside a call with it."""
SMALLEST_PICTURE = 12
"""Arrays of fewer rows or columns are numbers, not pictures."""
ROUNDS, BUDGET_S, AT_LEAST = 3, 0.03, 2
"""Rounds of the ladder; time and samples for each tier in one."""

NUMBERS = "biufc"
"""Kinds of NumPy's types."""

type Function = Callable[..., Any]
type LoadLadder = Callable[[str], Ladder]


@dataclass(frozen=True, slots=True, kw_only=True)
class Exercise:
    """The task of an exercise, its solution and its checks."""

    name: str
    """Name of the function."""
    check: str
    """Python: expressions, each a case, and before the last of them statements that prepare them;
    ``run(workload)``, where they define it, is the function as a tier of the ladder. What follows
    is run when the book is built, and may assert properties of the solution."""
    solution: str
    wrong: tuple[str, ...] = ()
    """Texts with expected mistakes."""
    model: str = ""
    """``MODULE:NAME`` of the book's function for the same; the text has the names of the module."""
    adapter: str = ""
    """Python that makes the book's function from the reader's, if their arguments differ."""
    ladder: str = ""
    tier: str = ""
    """The tier of the ladder that is the same method."""
    hard: Mapping[str, Any] = field(default_factory=dict)
    """A table of hard cases, whose cases call the book's function."""


@dataclass(frozen=True, slots=True)
class Miss:
    """The first case that a function fails."""

    fault: str
    """``nothing``, ``kind``, ``shape``, ``nan``, ``value``, ``accepted``, or ``input``, which it
    changed."""
    call: str
    _: KW_ONLY
    got: str = ""
    expected: str = ""
    recognised: int = -1
    """Index of the expected mistake that answers the same; -1 for none."""
    pictures: tuple[Mapping[str, Any], ...] = ()
    """The two answers, where they are pictures."""
    given: tuple[Mapping[str, str], ...] = ()
    """What the names in the call are: ``name``, and ``value``, or ``shape`` of long arrays."""


@dataclass(frozen=True, slots=True)
class Trial:
    """A hard case, and the reader's answer."""

    call: str
    why: str
    got: str
    expected: str
    passed: bool
    asked: bool
    """Whether the exercise's solution passes."""


def place_of(exercise: Exercise, text: str) -> Place:
    """The reader's text among the places in which errors are looked for."""
    return Place(exercise.name, READERS, 1, text.count("\n") + 1, 0)


def function_of(exercise: Exercise, text: str, name: str = "") -> Function:
    """The function that ``text`` defines, or the one ``name`` of the adapter.

    Raises `RefusedEditError` for a text that does not define it, and what the text raises.
    """
    check_text(exercise.name, text)
    module = exercise.model.partition(":")[0]
    names = {**(vars(import_module(module)) if module else {}), "np": np, "__name__": READERS}
    whole = f"{text}\n\n{exercise.adapter}" if name else text
    exec(compile(whole, READERS, "exec", dont_inherit=True), names)
    found: Function = names[name or exercise.name]
    return found


def first_miss(exercise: Exercise, text: str) -> tuple[int, Miss | None]:
    """The number of cases, and the first that the function ``text`` fails, if any.

    Raises what the text raises.
    """
    readers, solution = (function_of(exercise, code) for code in (text, exercise.solution))
    check = Check.of(exercise)
    for case in check.cases:
        expected, _ = check.answer(case, solution, refuses=True)
        got, names = check.answer(case, readers, refuses=isinstance(expected, ValueError))
        tolerance = names.get("TOLERANCE", TOLERANCE)
        fault = _changed(names, check) or _fault(got, expected, tolerance)
        if fault:
            return len(check.cases), _miss(exercise, fault, case, got, expected, tolerance)
    return len(check.cases), None


@dataclass(frozen=True, slots=True)
class Check:
    """The block ``check`` of an exercise, in parts."""

    name: str
    prepared: str
    cases: tuple[str, ...]
    claims: tuple[str, ...]

    @classmethod
    def of(cls, exercise: Exercise) -> "Check":
        body = ast.parse(exercise.check).body
        cases = [statement for statement in body if isinstance(statement, ast.Expr)]
        last = body.index(cases[-1]) if cases else 0
        prepared = [item for item in body[:last] if not isinstance(item, ast.Expr)]
        return cls(
            exercise.name,
            _source(prepared),
            tuple(_source([case]) for case in cases),
            tuple(_source([claim]) for claim in body[last + 1 :]),
        )

    def names(self, function: Function) -> dict[str, Any]:
        """Fresh values of the prepared names."""
        names: dict[str, Any] = {"np": np, self.name: function}
        exec(self.prepared, names)
        return names

    def answer(self, case: str, function: Function, *, refuses: bool) -> tuple[Any, dict[str, Any]]:
        """The value of a case, or the `ValueError` of one that ``refuses``; and the names after
        it."""
        names = self.names(function)
        try:
            with np.errstate(all="ignore"):
                return eval(case, names), names
        except ValueError as refusal:
            if not refuses:
                raise
            return refusal, names


def _source(body: Sequence[ast.stmt]) -> str:
    return "\n".join(map(ast.unparse, body))


def check_claims(exercise: Exercise) -> None:
    """Run the check's claims about the solution. Raises what they raise, or `AssertionError` with
    the first that is false."""
    check = Check.of(exercise)
    names = check.names(function_of(exercise, exercise.solution))
    for claim in check.claims:
        try:
            exec(claim, names)
        except AssertionError:
            raise AssertionError(claim) from None


def model_miss(exercise: Exercise) -> Miss | None:
    """The first case in which the solution differs from the model, if any; none where a claim calls
    a function of the model's module. Raises what the model raises, as for other arguments."""
    module, _, name = exercise.model.partition(":")
    check = Check.of(exercise)
    names = check.names(function_of(exercise, exercise.solution))
    books = {key for key, value in names.items() if getattr(value, "__module__", "") == module}
    if not module or any(books & {*re.findall(r"\w+", claim)} for claim in check.claims):
        return None
    model = f"""
def {exercise.name}(*given, **named):
    import {module} as module
    return module.{name}(*given, **named)
"""
    return first_miss(replace(exercise, solution=model), exercise.solution)[1]


def _changed(names: Mapping[str, Any], check: Check) -> str:
    fresh = check.names(names[check.name]).items()
    arrays = [(name, value) for name, value in fresh if isinstance(value, np.ndarray)]
    same = all(np.array_equal(value, names[name], equal_nan=True) for name, value in arrays)
    return "" if same else "input"


def _fault(got: Any, expected: Any, tolerance: float) -> str:
    """The kind of fault of an answer; empty if it is right."""
    if isinstance(expected, ValueError):
        return "" if isinstance(got, ValueError) else "accepted"
    if got is None:
        return "nothing"
    if isinstance(expected, tuple):
        if not isinstance(got, tuple) or len(got) != len(expected):
            return "shape"
        faults = (_fault(*pair, tolerance) for pair in zip(got, expected, strict=True))
        return next(filter(None, faults), "")
    values, correct = np.asarray(got), np.asarray(expected)
    if correct.dtype.kind not in NUMBERS:
        return "" if type(got) is type(expected) and got == expected else "value"
    if values.dtype.kind not in NUMBERS:
        return "kind"
    if values.shape != correct.shape:
        return "shape"
    if np.any(np.isnan(values) & ~np.isnan(correct)):
        return "nan"
    size = np.max(np.abs(correct), where=np.isfinite(correct), initial=0.0) or 1.0
    close = np.allclose(values, correct, rtol=0, atol=tolerance * size, equal_nan=True)
    return "" if close else "value"


def _miss(
    exercise: Exercise, fault: str, case: str, got: Any, expected: Any, tolerance: float
) -> Miss:
    recognised = -1
    for index, wrong in enumerate(exercise.wrong):
        function = function_of(exercise, wrong)
        try:
            other, _ = Check.of(exercise).answer(case, function, refuses=True)
        except Exception:  # another mistake than the reader's, who has an answer
            continue
        if not _fault(got, other, tolerance) and _fault(other, expected, tolerance):
            recognised = index
            break
    miss = Miss(fault, case, recognised=recognised, given=_inputs_of(exercise, case))
    if fault == "kind":
        return replace(miss, got=type(got).__name__, expected=show(expected))
    if fault == "shape":
        return replace(miss, got=_shape(got), expected=_shape(expected))
    pictures = [_picture(answer) for answer in (got, expected) if fault == "value"]
    if fault in ("value", "nan") and np.size(expected) > LONGEST_LISTED:
        error = np.abs(np.subtract(got, expected, dtype=float))
        worst = np.unravel_index(np.argmax(np.where(np.isnan(error), np.inf, error)), error.shape)
        miss = replace(miss, call=f"{case}[{', '.join(map(str, worst))}]")
        got, expected = np.asarray(got)[worst], np.asarray(expected)[worst]
    return replace(
        miss, got=show(got), expected=show(expected), pictures=(*filter(None, pictures),)
    )


def _inputs_of(exercise: Exercise, case: str) -> tuple[Mapping[str, str], ...]:
    """The values of the names in a case, except functions and modules."""
    check = Check.of(exercise)
    names = check.names(function_of(exercise, exercise.solution))
    inputs = []
    for name in dict.fromkeys(re.findall(r"\b[A-Z]\w*", case)):
        value = names.get(name)
        if isinstance(value, np.ndarray) and value.size > LONGEST_GIVEN:
            inputs.append({"name": name, "shape": _shape(value)})
        elif isinstance(value, (np.ndarray, float, int, dict)):
            inputs.append({"name": name, "value": show(value)})
    return tuple(inputs)


def _shape(value: Any) -> str:
    if isinstance(value, tuple):
        return f"({', '.join(map(_shape, value))})"
    return str(np.shape(value))


def _picture(value: Any) -> Mapping[str, Any]:
    """Grey or coloured values from 0 to 1 as bytes; nothing where it is no picture."""
    values = np.asarray(value)
    if values.ndim not in (2, 3) or min(values.shape[:2]) < SMALLEST_PICTURE:
        return {}
    if values.ndim == 3 and values.shape[2] != 3:
        return {}
    shade = np.nan_to_num(np.clip(values, 0.0, 1.0)) * 255
    rgb = np.broadcast_to(shade if values.ndim == 3 else shade[..., None], (*values.shape[:2], 3))
    data = base64.b64encode(np.ascontiguousarray(np.rint(rgb), np.uint8).tobytes()).decode()
    return {"height": values.shape[0], "width": values.shape[1], "rgb": data}


def measured(
    exercise: Exercise, text: str, ladder: Ladder, clock: Clock
) -> tuple[TierResult, list[TierResult]]:
    """The reader's function, and the tiers of the ladder, on its workload."""
    run = Check.of(exercise).names(function_of(exercise, text))["run"]
    readers = Tier("", "", "", run)
    workload = ladder.prepare()
    reference = ladder.reference(workload)
    tiers = (*ladder.tiers, readers)
    rounds: list[list[TierResult]] = []
    with np.errstate(all="ignore"):
        for _ in range(ROUNDS):  # in turns: the pace of a machine changes
            rounds.append(
                [
                    measure_tier(
                        replace(ladder, tiers=(tier,), default_tier=tier.id),
                        tier.id,
                        workload,
                        reference,
                        clock,
                        budget_s=BUDGET_S,
                        at_least=AT_LEAST,
                    )
                    for tier in tiers
                ]
            )
    *results, yours = (_median_result(each) for each in zip(*rounds, strict=True))
    return yours, results


def _median_result(results: Sequence[TierResult]) -> TierResult:
    """The middle of several results, with all of their scatter."""
    middle = sorted(results, key=lambda result: result.milliseconds)[len(results) // 2]
    return replace(
        middle,
        low_ms=min(result.low_ms for result in results),
        high_ms=max(result.high_ms for result in results),
    )


def trials(exercise: Exercise, text: str) -> list[Trial]:
    """The reader's answers to the hard cases, except cases for which the adapter raises
    `NotImplementedError`: they need arguments that the reader's function does not have."""
    table, name = table_of(exercise.name, exercise.hard), exercise.model.partition(":")[2]
    readers, solutions = (
        table_of(exercise.name, exercise.hard, {name: function_of(exercise, code, name)})
        for code in (text, exercise.solution)
    )
    found = []
    for case in table.cases:
        got, expected = _answer_or_error(readers, case.call), answer(table, case.call)
        if isinstance(got, NotImplementedError):
            continue
        passed, asked = (
            _is_expected(table, case.expected, each)
            for each in (got, _answer_or_error(solutions, case.call))
        )
        found.append(Trial(case.call, case.why, show(got), show(expected), passed, asked))
    return found


def _is_expected(table: HardCases, expected: str, got: Any) -> bool:
    try:
        return as_expected(table, expected, got)
    except Exception:  # an answer of another shape
        return False


def _answer_or_error(table: HardCases, call: str) -> Any:
    """The answer of a reader's function, which may raise anything."""
    try:
        with np.errstate(all="ignore"):
            return answer(table, call)
    except Exception as error:
        return error


def findings(
    exercise: Exercise, text: str, stage: str, load_ladder: LoadLadder, clock: Clock
) -> dict[str, Any]:
    """The results of a ``stage``, as plain data. Raises what the text raises."""
    import_from_sources()
    if stage == "values":
        count, miss = first_miss(exercise, text)
        return {"count": count, "miss": miss and asdict(miss)}
    if stage == "workload":
        yours, tiers = measured(exercise, text, load_ladder(exercise.ladder), clock)
        return {"yours": _plain(yours), "tiers": [*map(_plain, tiers)]}
    return {"trials": [asdict(trial) for trial in trials(exercise, text)]}


def _plain(result: TierResult) -> dict[str, Any]:
    errors = result.errors.items()
    finite = {name: value if isfinite(value) else None for name, value in errors}
    return {**asdict(result), "errors": finite}
