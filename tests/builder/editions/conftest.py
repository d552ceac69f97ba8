"""A chapter with figures, links, a question and a download, for both editions."""

import pytest
from support.little_book import files_of


@pytest.fixture
def body() -> str:
    return files_of("paper")["text.md"]
