"""PDF reports: page breaks and split tables."""

import io as streams
import shutil
import subprocess

import numpy as np
import pytest
from PIL import Image

from hexmend import gallery, io
from hexmend.cli.main import main
from hexmend.report.tables import Table
from hexmend_app.report.templates import html
from hexmend_app.resources import resource

#: A table after its heading, each part with a mark by which it is found.
_TABLE = str(html.table(Table("The worst", ["hex", "q"], [[str(k), "0.5"] for k in range(8)])))
_MARKED = '<h3 id="heading">The worst hexes</h3>' + _TABLE.replace("<caption", '<caption id="title"').replace(
    "<tbody><tr", '<tbody><tr id="row"'
)


@pytest.mark.slow
def test_a_heading_is_on_the_page_of_the_table_that_follows():
    weasyprint = pytest.importorskip("weasyprint")
    style = resource("report/page.css").read_text(encoding="utf-8")
    found = set()
    for tall in range(180, 264, 4):  # in mm; a page has room for 263
        page = f'<style>{style}</style><div style="height: {tall}mm"></div>{_MARKED}'
        pages = weasyprint.HTML(string=page).render().pages
        places = [next(k for k, one in enumerate(pages) if name in one.anchors) for name in ("heading", "title", "row")]
        assert len(set(places)) == 1, tall
        found.add(places[0])
    assert found == {0, 1}


def test_wide_tables_are_split():
    names = [f"method {k}" for k in range(16)]
    whole = Table("All", ["figure", *names], [["q min", *map(str, range(16))]], ["A note."])
    text = html.tables(whole)
    assert text.count("<table>") == 3
    assert all(text.count(f">{name}<") == 1 for name in names)
    assert (text.count(">q min<"), text.count("A note."), text.count("<caption>")) == (3, 1, 1)


# Pages of a report as PDF: the table is on the first, and no page but the last is half empty.


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


@pytest.mark.slow
def test_no_page_is_half_empty(pages):
    """The ink of each page but the last ends in its lower third; the page's number is at the foot, below 0.93."""
    assert len(pages) > 2
    for page in pages[:-1]:
        body = page[: int(0.93 * len(page))]
        assert np.flatnonzero((body < 200).any(axis=1))[-1] > 2 / 3 * len(page)


@pytest.mark.slow
def test_nothing_is_cut_off_at_the_right(pages):
    for page in pages:
        assert (page[:, int(0.97 * page.shape[1]) :] > 200).all()
