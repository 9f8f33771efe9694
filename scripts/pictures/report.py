"""Take the picture of docs/results/report.md: a report in Debian's browser with its mesh cut open.

Use: python scripts/pictures/report.py FOLDER
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from playwright.sync_api import Page, sync_playwright
from screenshots import compress

from hexmend.cli.main import main as hexmend
from hexmend.gallery import make
from hexmend.io import write

#: WebGL without a graphics card.
_SOFTWARE = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]

#: Size of the part of the page in the picture, in pixels of the page, and pixels of the picture for each of them.
_SIZE, _SCALE = {"width": 1280, "height": 1120}, 0.75


def look(page: Page, report: Path) -> None:
    """Open a report, and cut its original mesh open."""
    page.goto(report.as_uri())
    page.wait_for_selector(".viewer.alive")
    for control, value in (("axis", "1"), ("metric", "Scaled Jacobian")):
        page.locator(f"[data-is={control}]").select_option(value)
    page.locator("[data-is=between]").fill("0")
    page.locator("[data-is=between]").blur()
    page.evaluate("() => new Promise((done) => setTimeout(done, 500))")


def main(folder: Path) -> None:
    """Take the picture."""
    with tempfile.TemporaryDirectory() as temporary, sync_playwright() as playwright:
        mesh, report = Path(temporary) / "bridge.vtu", Path(temporary) / "report.html"
        write(mesh, make("bridge-sharp", size=8000, scramble=0.35, seed=3))
        hexmend(["report", str(mesh), "--methods", "laplacian,mend", "-o", str(report)])
        browser = playwright.chromium.launch(executable_path="/usr/bin/chromium", args=_SOFTWARE)
        page = browser.new_page(viewport=_SIZE, device_scale_factor=_SCALE)
        look(page, report)
        page.screenshot(path=folder / "report.png")
        browser.close()
    compress(folder / "report.png")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
