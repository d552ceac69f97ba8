"""``python -m scale.ours BOOK OUT``: a book without Python for the browser, as others have none."""

import sys
from pathlib import Path

from site_builder.build import build_site
from site_builder.diagnostics import BuildError

if __name__ == "__main__":
    try:
        build_site(Path(sys.argv[1]), Path(sys.argv[2]), runtime=False)
    except BuildError as error:
        sys.exit(str(error))
