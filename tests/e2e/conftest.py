"""Fixtures that tests of the browser share."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser
from support.page_scripts import SILENT_WORKER
from support.reader import PHONE, Reader, visit
from support.static_server import StaticServer, serving


@pytest.fixture(scope="session")
def uncached(built_site: Path) -> Iterator[StaticServer]:
    """The book from a host that lets browsers keep nothing; tests set its faults."""
    with serving(built_site) as server:
        server.uncached = True
        yield server


@pytest.fixture(scope="session")
def telephone(brisk_chromium: Browser, site_server: StaticServer) -> Iterator[Reader]:
    options = {"viewport": PHONE, "has_touch": True, "is_mobile": True}
    with visit(brisk_chromium, site_server, SILENT_WORKER, **options) as someone:
        yield someone


@pytest.fixture
def quiet_phone(telephone: Reader) -> Iterator[Reader]:
    """A telephone before Python has answered; each test loads its pages anew."""
    telephone.begin_anew(PHONE)
    yield telephone
    telephone.assert_no_complaints()
