"""Fixtures that tests of the browser share."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from support.static_server import StaticServer, serving


@pytest.fixture(scope="session")
def uncached(built_site: Path) -> Iterator[StaticServer]:
    """The book from a host that lets browsers keep nothing; tests set its faults."""
    with serving(built_site) as server:
        server.uncached = True
        yield server
