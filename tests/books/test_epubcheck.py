"""E-books as the checker of their standard sees them: EPUBCheck, of the W3C."""

import shutil
import sys
from pathlib import Path

import pytest
from support.engine import Engine, run
from support.places import ROOT, WAVES

PACKED = b"PK"
"""How an archive of Java begins: Debian's command is one."""
MISSING = "epubcheck is not installed; `apt-get install epubcheck` installs it, with Java"


@pytest.mark.deep
@pytest.mark.parametrize("book", [ROOT, WAVES], ids=lambda book: book.name)
def test_an_e_book_has_no_errors_and_no_warnings(
    engine: Engine, tmp_path: Path, book: Path
) -> None:
    checker = shutil.which("epubcheck")
    assert checker, MISSING
    out = tmp_path / "book.epub"
    python = sys.executable if book == ROOT else engine.python
    made = run(book, python, "-m", "site_builder", "epub", "--out", str(out))
    assert made.returncode == 0, made.stderr
    java = ("java", "-jar") if Path(checker).read_bytes().startswith(PACKED) else ()
    done = run(tmp_path, *java, checker, "--failonwarnings", str(out))
    assert done.returncode == 0, done.stdout + done.stderr
