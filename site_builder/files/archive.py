"""Files in a zip archive."""

import io
import zipfile
from collections.abc import Collection, Mapping


def archive_of(members: Mapping[str, bytes], stored: Collection[str] = ()) -> bytes:
    """Compressed but for those named in ``stored``, in their order and without times: equal members
    give equal bytes."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for path, content in members.items():
            how = zipfile.ZIP_STORED if path in stored else zipfile.ZIP_DEFLATED
            archive.writestr(zipfile.ZipInfo(path), content, how)
    return buffer.getvalue()
