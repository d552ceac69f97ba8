"""The mutator of `make mutants`: which mistakes it makes, and that a weak test lets them live."""

from pathlib import Path

import pytest
from mutation import trial
from mutation.__main__ import SCORES
from mutation.mutants import mutants, names
from mutation.scores import Row, Score, read_table, write_table
from mutation.trial import file_of, modules, survives


def after(line: str) -> set[str]:
    """What becomes of a statement; ``= …`` stands for an expression that is used."""
    used = line.startswith("= ")
    found = {mutant.after for mutant in mutants(f"used {line}" if used else line)}
    return {after.removeprefix("used = ") for after in found} if used else found


@pytest.mark.parametrize(
    ("line", "mistakes"),
    [
        ("a + 2", {"a - 2", "a + 3", "a + 1"}),
        ("-x * y", {"x * y", "-x / y", "-(-x * y)"}),
        ("(x * y / z) ** n", {"(x / y / z) ** n", "(x * y * z) ** n", "x * y / z * n"}),
        ("a < b", {"a <= b", "a >= b"}),
        ("a and (not b)", {"a or not b", "a and b"}),
        ("= f(x, axis=-1)", {"f(x, axis=1)", "f(x, axis=-2)", "f(x, axis=-0)"}),
        ("x[1:]", {"x[2:]", "x[0:]"}),
        ("x[a:b]", {"x[:b]", "x[a:]"}),
        ("x[i, j]", {"x[j, i]"}),
        ("(a, b, c)", {"(b, a, c)", "(a, c, b)"}),
        ("[a, b, c, d, e]", {"[b, a, c, d, e]"}),
        ("A @ B", {"B @ A"}),
        ("R.T", {"R"}),
        ("= np.moveaxis(x, a, b)", {"x", "np.moveaxis(x, b, a)"}),
        ("= 'xyz'", {"'yxz'"}),
        ("= project(a, b, c)", {"project(b, a, c)", "project(a, c, b)"}),
        ("= np.cross(a, b)", {"np.cross(b, a)"}),
        ("= np.where(c, a, b)", {"np.where(c, b, a)"}),
        ("= np.add(a, b)", set()),
        ("if neutral: a", {"if not neutral:"}),
        ("a if neutral else b", {"a if not neutral else b"}),
        ("check(x)", {"pass  # check(x)"}),
        ("x[i] = y", {"pass  # x[i] = y"}),
        ("= np.sin(x)", {"np.cos(x)"}),
        ("= np.sqrt(x)", {"x"}),
        ("= np.cos(x / y)", {"np.sin(x / y)", "np.cos(x * y)"}),
        ("= x.sum()", {"x.mean()"}),
        ("= max(a, b)", {"min(a, b)"}),
        ("= math.floor(x)", {"math.ceil(x)"}),
        ("= np.arctan2(y, x)", {"np.arctan2(x, y)"}),
        ("= abs(x)", {"x"}),
        ("1e-12", {"1e-09"}),
        ("2.0", {"2.2"}),
        ("0.0", {"1.0"}),
        ("def f(closed=True): pass", {"def f(closed=False):"}),
    ],
)
def test_every_small_mistake_is_made_once(line: str, mistakes: set[str]) -> None:
    assert after(line) == mistakes


@pytest.mark.parametrize(
    "line",
    [
        '"""1 + 1"""',
        "raise ValueError(f'{x + 1}')",
        "x: A[1]",
        "f'{a + 1}'",
        "= zip(a, strict=True)",
        "__all__ = ['a', 'b']",
    ],
)
def test_words_types_and_messages_are_left_alone(line: str) -> None:
    assert after(line) == set()


def test_a_mutant_is_named_by_its_function_and_differs_in_one_line() -> None:
    source = "class A:\n    def f(self):\n        return 1\nb = 2\n"
    found = list(mutants(source))
    assert [(m.place, m.before, m.after) for m in found] == [
        ("A.f", "return 1", "return 2"),
        ("A.f", "return 1", "return 0"),
        ("", "b = 2", "b = 3"),
        ("", "b = 2", "b = 1"),
    ]
    for mutant in found:
        lines = zip(source.splitlines(), mutant.source.splitlines(), strict=False)
        assert sum(a != b for a, b in lines if b) == 1 or "\n\n" in mutant.source


def test_mutants_have_their_names_without_being_made() -> None:
    source = file_of("color.srgb").read_text("utf-8")
    assert list(names(source)) == [(mutant.place, mutant.after) for mutant in mutants(source)]


def test_a_test_that_looks_notices_and_one_that_does_not_look_does_not(tmp_path: Path) -> None:
    source = file_of("arrays").read_text("utf-8")
    broken = source.replace('== "f"', '!= "f"')
    looks, looks_away = tmp_path / "test_looks.py", tmp_path / "test_looks_away.py"
    use = "from simulations.models.arrays import as_floats\n\ndef test_it():\n    "
    looks.write_text(use + "assert as_floats([1]).dtype == float\n", "utf-8")
    looks_away.write_text(use + "assert len(as_floats([1])) == 1\n", "utf-8")
    assert survives("arrays", source, [looks], 30)
    assert not survives("arrays", broken, [looks], 30)
    assert survives("arrays", broken, [looks_away], 30)


def test_an_endless_mutant_is_noticed(tmp_path: Path) -> None:
    test = tmp_path / "test_arrays.py"
    test.write_text("import simulations.models.arrays\n\ndef test_it(): pass\n", "utf-8")
    assert not survives("arrays", "while True: pass", [test], 1)


def test_every_model_has_tests_of_its_own_or_of_a_model_that_uses_it() -> None:
    assert [module for module in modules() if not trial.tests_of(module)] == []


def test_every_score_is_of_a_module_that_there_is() -> None:
    assert set(read_table(SCORES)) - set(modules()) == set()


def test_scores_are_read_as_they_were_written_and_summed(tmp_path: Path) -> None:
    file = tmp_path / "score.txt"
    assert read_table(file) == {}
    rows = {
        "both": Row(Score(30, 3), Score(200, 1)),
        "held_out_alone": Row(Score(10, 1), None),
        "all_alone": Row(None, Score(7, 0)),
    }
    write_table(file, rows)
    assert read_table(file) == rows
    total = file.read_text("utf-8").splitlines()[-1].split()
    assert total == ["total", "40", "36", "90.0%", "207", "206", "1", "99.5%"]
