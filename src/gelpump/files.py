"""Files that are whole or not there."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path


@contextmanager
def whole(path: str | Path) -> Iterator[Path]:
    """Another name to write the file ``path`` under; it gets its own when all is on the disk.

    What a killed run has left under that name goes first.  OSError, with the path and the space
    left, if the file cannot be written.
    """
    path = Path(path)
    partial = path.with_name(f".{path.name}.partial")
    try:
        partial.unlink(missing_ok=True)
        yield partial
        with partial.open("r+b") as stream:  # Windows flushes only what can be written
            os.fsync(stream.fileno())
        partial.replace(path)
    except (OSError, RuntimeError) as refusal:  # RuntimeError: how netCDF-4 tells of a full disk
        free = shutil.disk_usage(path.parent).free // 1024
        raise OSError(f"{path} was not written ({free} kB are free): {refusal}") from refusal
    finally:
        with suppress(OSError):  # on a disk that has become read-only
            partial.unlink(missing_ok=True)
