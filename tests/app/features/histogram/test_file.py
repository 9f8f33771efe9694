"""The histogram as a figure and as a table."""

import csv
import xml.etree.ElementTree as ET

import pytest

from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend_app.features.histogram.histogram_file import write_histogram

BLUE = "#0072b2"


@pytest.fixture(scope="module")
def mesh():
    return make("cube", size=1000, scramble=0.2, seed=1)


def rows(path):
    return list(csv.reader(path.read_text().splitlines()))


@pytest.mark.parametrize("log", [False, True])
def test_in_a_figure_too_a_bar_that_is_taller_than_the_bins_is_broken_and_carries_its_number(mesh, tmp_path, log):
    for one, broken in ((turned(mesh, 990), True), (turned(mesh, 3), False)):
        path = tmp_path / "figure.svg"
        write_histogram(path, "title", "q", [("now", BLUE, True, one)], log=log)
        ET.parse(path)
        inverted = measure(one.points, one.hexes).n_inverted
        assert (f">{inverted:,}<" in path.read_text()) == broken


def turned(mesh, count):
    """The mesh with so many hexes inside out."""
    hexes = mesh.hexes.copy()
    hexes[:count] = hexes[:count][:, [4, 5, 6, 7, 0, 1, 2, 3]]
    return Mesh(mesh.points, hexes)


def counted(mesh, folder, bins=50, cumulative=False):
    path = folder / "counts.csv"
    write_histogram(path, "title", "q", [("now", BLUE, True, mesh)], bins=bins, cumulative=cumulative)
    return rows(path)


def test_the_table_has_a_line_for_each_place_that_counts(mesh, tmp_path):
    lines = counted(mesh, tmp_path)
    assert lines[0] == ["q from", "q to", "now"]
    assert lines[1] == ["inverted", "inverted", str(measure(mesh.points, mesh.hexes).n_inverted)]
    assert len(lines) == 2 + 50
    assert sum(int(row[2]) for row in lines[1:]) == mesh.n_hexes


def test_shares_grow_to_all(mesh, tmp_path):
    shares = [float(row[2]) for row in counted(mesh, tmp_path, cumulative=True)[1:]]
    assert shares == sorted(shares)
    assert shares[-1] == 100


def test_the_axis_is_that_of_what_comes_first(mesh, tmp_path):
    path = tmp_path / "volume.csv"
    flat = mesh.with_points(mesh.points * [1, 1, 0.01])
    write_histogram(path, "title", "volume", [("at the start", BLUE, True, mesh), ("now", BLUE, True, flat)])
    edges = [row[0] for row in rows(path)]
    write_histogram(path, "title", "volume", [("at the start", BLUE, True, mesh)])
    assert [row[0] for row in rows(path)] == edges
