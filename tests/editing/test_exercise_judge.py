"""Judging exercises: the first fault of a reader's function is named, expected mistakes are
recognised by their results, and a correct function is tried on the hard cases."""

from dataclasses import replace

import pytest

from simulations.editing.exercise import Exercise, check_claims, first_miss, trials

TURNED = Exercise(
    name="turned",
    check="""
POINTS = np.array([[1.0, 0.0], [2.0, 3.0]])
turned(POINTS, 0.5)
turned(POINTS, 0.0)
turned(POINTS, np.inf)
assert np.allclose(turned(POINTS, np.pi / 2), [[0, 1], [-3, 2]])
""",
    solution="""
def turned(points, angle):
    if not np.isfinite(angle):
        raise ValueError("angle")
    c, s = np.cos(angle), np.sin(angle)
    return points @ np.array([[c, s], [-s, c]])
""",
    wrong=(
        "def turned(points, angle):\n    return points",
        "def turned(points, angle):\n    c, s = np.cos(angle), np.sin(angle)\n"
        "    return points @ np.array([[c, -s], [s, c]])",
    ),
)
C_S = "c, s = np.cos(angle), np.sin(angle); R = np.array([[c, s], [-s, c]]); "


@pytest.mark.parametrize(
    ("body", "fault", "recognised"),
    [
        ("pass", "nothing", -1),
        ("return points", "value", 0),
        ("return points + 0.0", "value", 0),
        ("return points @ np.array([[np.cos(angle), -np.sin(angle)], "
         "[np.sin(angle), np.cos(angle)]])", "value", 1),
        ("return points[0]", "shape", -1),
        ("return points * np.nan", "nan", -1),
        ("return points.astype(str)", "kind", -1),
        (C_S + "points[:] = points @ R; return points", "input", -1),
        (C_S + "return points @ np.nan_to_num(R)", "accepted", -1),
    ],
)  # fmt: skip
def test_first_fault_is_named(body: str, fault: str, recognised: int) -> None:
    cases, miss = first_miss(TURNED, f"def turned(points, angle):\n    {body}")
    assert miss
    assert (cases, miss.fault, miss.recognised) == (3, fault, recognised)


def test_names_in_a_failed_call_are_given_with_their_values() -> None:
    _, miss = first_miss(TURNED, TURNED.wrong[0])
    assert miss
    assert miss.given == ({"name": "POINTS", "value": "[[1, 0], [2, 3]]"},)
    check = "GRID = np.ones((9, 2))\nturned(GRID, 0.5)"
    _, miss = first_miss(replace(TURNED, check=check), TURNED.wrong[0])
    assert miss
    assert miss.given == ({"name": "GRID", "shape": "(9, 2)"},)


def test_solution_passes_and_a_false_assertion_about_it_fails() -> None:
    check_claims(TURNED)
    assert first_miss(TURNED, TURNED.solution) == (3, None)
    with pytest.raises(AssertionError):
        check_claims(replace(TURNED, check=TURNED.check + "\nassert not turned(POINTS, 0.0).any()"))


def test_wrong_picture_is_reported_at_its_largest_error() -> None:
    grey = Exercise(
        name="grey", check="grey(16)", solution="def grey(n):\n    return np.full((n, n), 0.5)"
    )
    _, miss = first_miss(grey, "def grey(n):\n    a = np.full((n, n), 0.5)\n    a[3, 4] = 1\n"
                                "    return a")  # fmt: skip
    assert miss
    assert (miss.call, miss.got, miss.expected) == ("grey(16)[3, 4]", "1", "0.5")
    assert [(each["width"], each["height"]) for each in miss.pictures] == [(16, 16)] * 2


def test_hard_cases_call_the_readers_function_through_the_adapter() -> None:
    case = {"why": "why", "returns": "it", "expected": "near([0.0, 1.0])"}
    table = {
        "title": "Turns",
        "names": ["simulations.models.geometry.rotations:*"],
        "cases": {"one": {**case, "call": "exponential([0, 0, np.pi / 2])[:2, 0]"}},
    }
    adapter = "def exponential(v):\n    return np.pad(turned(np.eye(2), v[2]).T, ((0, 1), (0, 1)))"
    model = "simulations.models.geometry.rotations:exponential"
    adapted = replace(TURNED, model=model, adapter=adapter, hard=table)
    assert [trial.passed for trial in trials(adapted, TURNED.solution)] == [True]
    (failed,) = trials(adapted, TURNED.wrong[0])
    assert (failed.passed, failed.asked) == (False, True)
    easier = replace(adapted, solution=TURNED.wrong[0])
    assert [trial.asked for trial in trials(easier, TURNED.solution)] == [False]
    beyond = "def exponential(v):\n    raise NotImplementedError"
    assert trials(replace(adapted, adapter=beyond), TURNED.solution) == []
