"""The list of what a reader's browser keeps."""

import json
import subprocess

from site_builder.offline.release import LIST, WORKER, no_release, release_files

FILES = {"index.html": b"cover", "lens/index.html": b"lens", "assets/1/js/main.js": b"1"}


def test_pages_are_listed_by_the_addresses_that_links_lead_to() -> None:
    listed = json.loads(release_files(FILES, "assets/1/")[LIST])
    assert set(listed) == {"", "lens/", "assets/1/js/main.js"}


def test_what_few_readers_need_is_left_to_the_network() -> None:
    files = FILES | {"assets/1/raw/libraw.wasm": b"decoder", "raw/index.html": b"a page"}
    files |= {"embed/lens/figure-one/index.html": b"for a frame"}
    listed = json.loads(release_files(files, "assets/1/")[LIST])
    assert set(listed) == {"", "lens/", "assets/1/js/main.js", "raw/"}


def test_a_hash_is_what_openssl_says() -> None:
    listed = json.loads(release_files(FILES, "assets/1/")[LIST])
    digest = subprocess.run(
        "openssl dgst -sha256 -binary | openssl base64",
        shell=True, input=b"lens", capture_output=True, check=True,
    ).stdout  # fmt: skip
    assert listed["lens/"] == f"sha256-{digest.decode().strip()}"


def test_whatever_changes_gives_the_worker_another_release() -> None:
    workers = {
        release_files(FILES | {name: b"other"}, "assets/1/")[WORKER] for name in [*FILES, "new"]
    }
    assert len(workers) == len(FILES) + 1
    assert release_files(FILES, "assets/1/")[WORKER] not in workers


def test_a_site_that_is_not_kept_names_no_release() -> None:
    assert b'RELEASE = "";' in no_release("assets/1/")[WORKER]
