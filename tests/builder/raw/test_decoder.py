"""The decoder of raw files: as its package has it, under a licence that is printed."""

from pathlib import Path

from site_builder.pages.licences import gather_licences
from site_builder.programs.node import installed_packages
from site_builder.raw.decoder import HERE, PACKAGE, fetch_decoder
from site_builder.runtime.pinned import VERSIONS


def test_the_decoder_is_the_package_s_own_under_a_licence_in_full() -> None:
    decoder = fetch_decoder()
    packaged = installed_packages(HERE) / "node_modules" / PACKAGE / "dist"
    assert {*decoder.files.values()} == {packaged / name for name in ("libraw.js", "libraw.wasm")}
    assert all(file.is_file() for file in decoder.files.values())
    (licence,) = [
        one
        for one in gather_licences(Path(), VERSIONS, decoder=decoder.packages)
        if one.part == "LibRaw"
    ]
    assert licence.name == "CDDL 1.0"
    assert "COMMON DEVELOPMENT AND DISTRIBUTION LICENSE" in licence.text
    assert PACKAGE in licence.use
