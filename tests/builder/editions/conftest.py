"""A chapter with a figure, links and a question, for both editions."""

import pytest

BODY = """\
## Here

See [the other chapter](01-second.md) and [the figure](#figure-demo).

:::{simulation} demo
A caption.
:::

:::{quiz} which
Which one?
- [ ] This
  : No, for a reason.
- [x] That
  : Yes, for a reason.
:::
"""


@pytest.fixture
def body() -> str:
    return BODY
