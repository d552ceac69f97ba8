"""What a worker builds with: all that earlier builds have made, in memory."""

import gc
import threading
import traceback
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path

from site_builder.build import Options, RenderedSite, render_parts
from site_builder.diagnostics import BuildError, Diagnostic
from site_builder.drawing.apart import Limits, limited
from site_builder.kept.ahead import Ask, make_ahead
from site_builder.kept.files import file_hash
from site_builder.kept.keeper import Keeper, keeping
from site_builder.kept.store import Store, default_folder
from site_builder.output.assets import content_bytes
from site_builder.output.writer import Hashes, replace_file, way_out, write_site
from site_builder.search.index import ADDRESS
from site_builder.search.records import PageRecords
from site_builder.serving.loaded_code import let_go, may_let_go
from site_builder.serving.redrawn import redrawn
from site_builder.site_assets import Files


class Bench:
    """Builds the same book again and again."""

    def __init__(self, root: Path, out: Path, runtime: bool, since_ns: int) -> None:
        self._root, self._out, self._runtime = root, out, runtime
        self._keeper = Keeper(Store(default_folder()), since_ns)
        self._index = b""
        """What can be searched now: it is made after the pages, and may be of the build before."""
        self._records: PageRecords = ()
        """What the last index was to be made of."""
        self._hashes: Hashes = {}
        """Of the files as they were written."""
        self._writing = threading.Lock()
        self._indexing: threading.Thread | None = None
        self._again: Sequence[Ask] = ()
        """What the last build asked for that any change of code makes necessary again."""
        self._first: list[Ask] = []
        """What the next build will certainly ask for."""

    def rest(self) -> None:
        """Wait for what is still being done; then the process can be forked."""
        if self._indexing:
            self._indexing.join()

    def renew(self, files: Collection[Path]) -> bool:
        """In a process that was forked: from here on, code is as these changed ``files`` have it.
        False where only a fresh process knows that: where the builder itself imports it."""
        gone = self._keeper.importers(files)
        if gone is None or not may_let_go(gone):
            return False
        let_go(gone)
        self._keeper.forget(gone)
        self._first = [*self._again, *redrawn(gone, self._keeper.asked)]
        self._writing, self._indexing = threading.Lock(), None
        return True

    def build(self) -> Iterator[dict[str, object]]:
        """Build once; yields what came of it as soon as the pages are there."""
        warnings: list[Diagnostic] = []
        options = Options(self._root, runtime=self._runtime, reload=True, warn=warnings.append)
        try:
            with keeping(self._keeper), limited(Limits()):
                first, self._first = self._first, []
                make_ahead(first)
                site = render_parts(options)
                self._again = site.again
                with self._writing:
                    changed = write_site(self._with_index(site), self._out, self._hashes)
                yield _answer(warnings, f"{len(site.files)} files", changed=changed)
                # From here on nobody waits: what is new goes into the store, too.
                records = site.records()
                self._get_ready()
        except BuildError as error:
            yield _answer(warnings, "", mistakes=str(error))
        except OSError as error:
            yield _answer(warnings, "", mistakes=f"{error}{way_out(error)}")
        except (ValueError, RuntimeError) as error:
            yield _answer(warnings, "", mistakes=str(error) or repr(error))
        except Exception:  # a mistake of the builder's own must not end it
            yield _answer(warnings, "", mistakes=traceback.format_exc())
        else:
            if records != self._records:
                self._records = records
                given = (site, records)
                self._indexing = threading.Thread(target=self._make_index, args=given, daemon=True)
                self._indexing.start()
        _set_apart()

    def _get_ready(self) -> None:
        """What the next build, or the copy that makes it, would have to see anew."""
        self._keeper.get_ready()
        for name in self._hashes:
            file_hash(self._out / name)

    def _with_index(self, site: RenderedSite) -> Files:
        place = self._out / ADDRESS
        if not self._index and place.is_file():
            self._index = place.read_bytes()
        files = {**site.files, ADDRESS: self._index or b"{}"}
        return {**files, **site.finish(files)}

    def _make_index(self, site: RenderedSite, records: PageRecords) -> None:
        """Beside the next build, if there is one: Node takes longer than a page."""
        made = content_bytes(site.index(records).get(ADDRESS, b""))
        with self._writing:
            if records is self._records and made != self._index and made:
                self._index = made
                replace_file(self._out / ADDRESS, self._index)


def _set_apart() -> None:
    """What is in memory now stays there: Python's collector of garbage, which would go through all
    of it several times in the next build, passes it by."""
    gc.unfreeze()
    gc.collect()
    gc.freeze()


def _answer(
    warnings: list[Diagnostic], said: str, *, mistakes: str = "", changed: object = ()
) -> dict[str, object]:
    printed = "".join(f"{warning}\n" for warning in sorted(set(warnings)))
    return {"printed": printed, "said": said, "mistakes": mistakes, "changed": changed}
