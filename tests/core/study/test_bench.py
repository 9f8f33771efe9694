"""Sections of the benchmark: all are named in the help, and whole processes are measured as they are."""

import argparse

import pytest

from hexmend import io
from hexmend.boundary import SkinSurface
from hexmend.cli.commands.bench import command
from hexmend.gallery import make
from hexmend.ranks.launching import launcher
from hexmend.study.bench import boundaries, freedom, goals, offsets, surface_quality, surfaces
from hexmend.study.bench.freedom import FREEDOM, lower
from hexmend.study.bench.scale import SCALE, measure_process
from hexmend.study.bench.section import BenchSection
from hexmend.study.bench.sections import sections
from hexmend.study.bench.surface_quality import SURFACE_QUALITY
from hexmend.study.bench.surfaces import SURFACES
from tests.core.grids import invalid_inside


def test_the_help_names_all_sections():
    parser = argparse.ArgumentParser()
    command.arguments(parser)
    text = " ".join(parser.format_help().split()).replace("- ", "-")  # lines break at hyphens
    named = set(text.split("--only PART")[-1].split(";")[0].replace(" or ", ", ").replace(",", " ").split())
    assert sections().keys() <= named


def test_a_process_is_measured_from_file_to_file(tmp_path):
    io.write(tmp_path / "mesh.vtu", make("five-side", size=500, scramble=0.6))
    row = measure_process(tmp_path / "mesh.vtu", tmp_path, ("--set", "goal=shape"))
    assert row["hexes"] == io.read(tmp_path / "out.vtu").n_hexes
    assert row["left"] == 0
    assert row["iterations"] > 1
    assert 0 < row["method_seconds"] < row["seconds"]
    assert 20 < row["peak_mb"] < 1000


def test_the_table_has_a_row_a_mesh_and_says_how_far_nodes_are_from_the_lattice(monkeypatch):
    monkeypatch.setenv("HEXMEND_SCALE", "100")
    monkeypatch.setenv("HEXMEND_KERSHAW", "6")
    head, _, *rows, last = SCALE.lines(SCALE.measure())
    assert {head.count("|")} == {row.count("|") for row in rows}
    assert [row.split()[5] for row in rows] == [*(["1", "2", "4"] if launcher() else ["1"]), "1"]
    assert "inverted hexes left: 0" in last
    assert float(last.split()[-2]) == pytest.approx(0, abs=1e-6)


def test_a_skin_is_divided_until_it_has_enough_triangles_and_stays_where_it_is(monkeypatch):
    mesh = make("cube", size=8)
    points, triangles = surfaces.refined(mesh.points, mesh.topology.boundary_faces, 300)
    assert len(triangles) == 4 * 4 * 24
    skin = SkinSurface(points, triangles)
    assert len(skin.edges.nodes) == 3 * len(triangles) // 2
    assert skin.volume() == pytest.approx(SkinSurface(mesh.points, mesh.topology.boundary_faces).volume())
    monkeypatch.delenv("HEXMEND_MESHES", raising=False)
    monkeypatch.setattr(surfaces, "_METHODS", ("laplacian",))
    monkeypatch.setattr(surfaces, "_TIMES", 1)
    monkeypatch.setattr(surfaces, "_TRIANGLES", 100)
    monkeypatch.setattr(surfaces, "make", lambda name, size: make("five-side", size=100))
    head, _, row = SURFACES.lines(SURFACES.measure())
    assert head.count("|") == row.count("|")
    assert "| laplacian |" in row


def test_quads_of_the_surface_end_better_with_weight(monkeypatch):
    monkeypatch.delenv("HEXMEND_MESHES", raising=False)
    for name, value in {"_SIZE": 300, "_ITERATIONS": 40, "_METHODS": ("local-nr",), "_WEIGHTS": (0.0, 10.0)}.items():
        monkeypatch.setattr(surface_quality, name, value)
    figures = SURFACE_QUALITY.measure()
    given, without, with_quads = figures["runs"]
    assert given["flipped_quads"] > 0 == without["inverted"] == with_quads["inverted"] == with_quads["flipped_quads"]
    assert with_quads["quad_q_mean"] > without["quad_q_mean"]
    head, _, *rows = SURFACE_QUALITY.lines(figures)
    assert {head.count("|")} == {row.count("|") for row in rows}


@pytest.mark.slow
def test_more_freedom_of_a_mesh_is_a_row_that_names_what_ends_lower(tmp_path, monkeypatch):
    io.write(tmp_path / "cube.vtk", make("cube", size=27, scramble=0.3))
    (tmp_path / "broken.vtk").write_text("# vtk DataFile Version 3.0\n")
    monkeypatch.setenv("HEXMEND_MESHES", str(tmp_path))
    figures = FREEDOM.measure()
    (row,) = figures["runs"]
    assert not lower(row)
    head, _, line, _, last = FREEDOM.lines(figures)
    assert head.count("|") == line.count("|")
    assert line.count("1.0000") == 7
    assert last.startswith("0 of 6 pairs")
    row["0.1"]["least"] -= 0.01
    row["1"]["invalid"] = 1
    assert lower(row) == ["0.03 to 0.1", "0.3 to 1"]
    assert "(0, 1)" in FREEDOM.lines(figures)[2]


_REPORT = {
    time: dict.fromkeys(("q_min", "q_mean", "scaled_jacobian_min"), 0.5)
    | {"hexes": 9, "inverted": 3, "invalid": invalid}
    for time, invalid in (("before", 5), ("after", 4))
}


@pytest.mark.parametrize(
    ("section", "file", "cells"),
    [
        (goals, "bone.vtk", "| 3 | 5 | 0.5000 |"),
        (boundaries, "bone.vtk", "| 3 → 3 | 5 → 4 |"),
        (freedom, "a.vtk", "| 0.5000 (3, 4) |"),
    ],
)
def test_tables_count_inverted_and_invalid_hexes(section, file, cells, tmp_path, monkeypatch):
    (tmp_path / file).touch()
    monkeypatch.setenv("HEXMEND_MESHES", str(tmp_path))
    monkeypatch.setattr(section, "smoothed", lambda *_: (_REPORT, 1.0))
    (part,) = (one for one in vars(section).values() if isinstance(one, BenchSection))
    head, rule, *lines = part.lines(part.measure())
    assert head.count("|") == rule.count("|") == lines[0].count("|")
    assert cells in lines[0]


def test_the_optima_with_and_without_the_offset_count_inverted_and_invalid_hexes(monkeypatch):
    monkeypatch.setattr(offsets, "_thesis", lambda: iter([("folded", invalid_inside(), None)]))
    monkeypatch.setattr(offsets, "collection", lambda: iter([]))
    figures = offsets.OFFSETS.measure()
    (row,) = figures["runs"]
    assert (row["before"]["inverted"], row["before"]["invalid"]) == (0, 1)
    head, rule, line, *_ = offsets.OFFSETS.lines(figures)
    assert head.count("|") == rule.count("|") == line.count("|")
    assert line.startswith("| folded | 27 | 0 · 0 | 0 · 0 | ")
