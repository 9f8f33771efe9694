"""Debian's browser, with its own folder for what it leaves behind."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

#: WebGL without a graphics card.
SOFTWARE = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")

_CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


@contextmanager
def chromium(folder: Path) -> Iterator:
    """Makes browsers: takes their arguments, gives what is to be closed. Without one here the test is skipped."""
    if _CHROMIUM is None:
        pytest.skip("there is no chromium")
    playwright = pytest.importorskip("playwright.sync_api")
    places = {"TMPDIR": str(folder), "HOME": str(folder)}
    with pytest.MonkeyPatch.context() as patch:
        for name, place in places.items():
            patch.setenv(name, place)
        started = playwright.sync_playwright().start()
    try:
        yield lambda *arguments: started.chromium.launch(
            executable_path=_CHROMIUM, args=list(arguments), env=os.environ | places
        )
    finally:
        started.stop()
