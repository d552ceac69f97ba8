"""Without a browser there is no PDF, and its author is told how to get one."""

import pytest

from site_builder.programs import chromium


def test_a_missing_chromium_is_said_to_be_installed_how(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(chromium, "find_chromium", lambda: None)
    with pytest.raises(chromium.MissingChromiumError, match="playwright install chromium"):
        chromium.require_chromium("the PDF")


def test_a_missing_driver_is_said_to_come_with_the_command(monkeypatch: pytest.MonkeyPatch) -> None:
    def find() -> None:
        raise ModuleNotFoundError("no module", name="playwright")

    monkeypatch.setattr(chromium, "find_chromium", find)
    with pytest.raises(chromium.MissingChromiumError, match="pip install playwright"):
        chromium.require_chromium("the PDF")
