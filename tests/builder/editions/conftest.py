"""A chapter with figures, links, a question and a download, for both editions."""

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

:::{figure} images/plan.svg
:alt: A plan
:dark: images/plan.svg
:::

:::{download} book.toml
:::
"""


@pytest.fixture
def body() -> str:
    return BODY
