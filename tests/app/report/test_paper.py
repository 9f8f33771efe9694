"""Pages of a report as PDF: the table is on the first, and no page but the last is half empty."""

import io as streams
import shutil
import subprocess

import numpy as np
import pytest
from PIL import Image

from hexmend import gallery, io
from hexmend.cli.main import main

pytest.importorskip("weasyprint")


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """Return the pages as arrays of grey values, (height, width) uint8."""
    if shutil.which("gs") is None:
        pytest.skip("Ghostscript is not installed")
    folder = tmp_path_factory.mktemp("paper")
    io.write(folder / "cube.vtu", gallery.make("cube", size=125, scramble=0.5))
    words = ["--methods", "laplacian,mend", "--max-iterations", "3", "-o", str(folder / "report.pdf")]
    assert main(["report", str(folder / "cube.vtu"), *words]) == 0
    subprocess.run(
        ["gs", "-q", "-dNOPAUSE", "-dBATCH", "-sDEVICE=pnggray", "-r36", "-sOutputFile=%02d.png", "report.pdf"],
        cwd=folder,
        check=True,
    )
    return [np.asarray(Image.open(streams.BytesIO(path.read_bytes()))) for path in sorted(folder.glob("*.png"))]


def test_no_page_is_half_empty(pages):
    """The ink of each page but the last ends in its lower third; the page's number is at the foot, below 0.93."""
    assert len(pages) > 2
    for page in pages[:-1]:
        body = page[: int(0.93 * len(page))]
        assert np.flatnonzero((body < 200).any(axis=1))[-1] > 2 / 3 * len(page)


def test_nothing_is_cut_off_at_the_right(pages):
    for page in pages:
        assert (page[:, int(0.97 * page.shape[1]) :] > 200).all()
