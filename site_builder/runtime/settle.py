"""Run in an interpreter before its snapshot is taken, which then has no trace of time or chance."""

import gc
import random
import sys
import tempfile
from importlib.machinery import FileFinder

random.seed(0)  # readers' interpreters seed anew
tempfile._name_sequence = None  # type: ignore[attr-defined]
for finder in sys.path_importer_cache.values():
    if isinstance(finder, FileFinder):
        finder.invalidate_caches()
del finder
sys._clear_internal_caches()  # type: ignore[attr-defined]
gc.collect()
