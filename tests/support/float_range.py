"""Numbers from the whole range of floating point, and what may come back for them."""

from collections.abc import Callable
from typing import Any

import numpy as np
from hypothesis import strategies as st

LANDMARKS = (
    *(0.0, 5e-324, 2.2e-308, 1e-200, 1e-154, 1e-16, 1e-8, 0.5, 1.0, 3.0),
    *(1e8, 1e16, 1.3e154, 1e200, 1.7e308, np.inf, np.nan),
)
"""Where formulae break: smallest numbers, squares that vanish or overflow, the non-finite."""

any_float = st.one_of(
    st.sampled_from([sign * value for value in LANDMARKS for sign in (1.0, -1.0)]), st.floats()
)
"""Any of the 2⁶⁴ doubles, those that hurt most of all."""

finite_float = any_float.filter(np.isfinite)


def arrays(*shape: int, of: st.SearchStrategy[float] = any_float) -> st.SearchStrategy[Any]:
    """Arrays of the given shape with every entry on its own."""
    count = int(np.prod(shape))
    return st.lists(of, min_size=count, max_size=count).map(lambda v: np.reshape(v, shape))


def ask(function: Callable[..., Any], *args: Any, **kwargs: Any) -> Any:
    """What ``function`` returns, or None where it refuses: a `ValueError` that says why."""
    try:
        return function(*args, **kwargs)
    except np.linalg.LinAlgError:
        raise  # a ValueError by descent, but one that tells the caller nothing
    except ValueError as refusal:
        if len(str(refusal)) < 10:
            raise AssertionError("a refusal says what is wrong") from refusal
        return None


def assert_finite_where_valid(answer: tuple[Any, Any]) -> None:
    """And NaN everywhere else: a number there would pass for an answer."""
    values, valid = answer
    values, valid = np.asarray(values), np.asarray(valid)
    assert values.shape[: valid.ndim] == valid.shape
    assert np.isfinite(values[valid]).all()
    assert np.isnan(values[~valid]).all()
