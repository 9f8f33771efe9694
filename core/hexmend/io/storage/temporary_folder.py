"""Folders that appear complete or not at all."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from hexmend.io.storage.temporary_files import flush_file, flush_folder


@contextmanager
def temporary_folder(target: Path) -> Iterator[Path]:
    """Context manager that gives an empty folder beside `target`, and renames it to `target` at the end.

    If the block raises, the temporary folder is removed. The content is flushed to the disk before it is renamed.

    Parameters
    ----------
    target : Path
        It does not exist, or is an empty folder.

    Yields
    ------
    Path

    Raises
    ------
    OSError
        Where the folder cannot be made, or `target` is not empty.
    """
    temporary = target.with_name(f".hexmend-{os.urandom(8).hex()}-{target.name[:80]}")
    temporary.mkdir()
    try:
        yield temporary
        for folder, _, names in os.walk(temporary):
            for name in names:
                path = Path(folder, name)
                if path.is_file() and not path.is_symlink():
                    flush_file(path)
            flush_folder(Path(folder))
        os.replace(temporary, target)
        flush_folder(target.parent)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
