"""Sections of the benchmark: all are named in the help, and whole processes are measured as they are."""

import argparse

import pytest

from hexmend import io
from hexmend.cli.commands.bench import command
from hexmend.gallery import make
from hexmend.study.bench import scale
from hexmend.study.bench.scale import SCALE, measure_process
from hexmend.study.bench.sections import sections


def test_the_help_names_all_sections():
    parser = argparse.ArgumentParser()
    command.arguments(parser)
    text = " ".join(parser.format_help().split())
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
    monkeypatch.setattr(scale, "_KERSHAW", (216,))
    head, _, five, kershaw, last = SCALE.lines(SCALE.measure())
    assert head.count("|") == five.count("|") == kershaw.count("|")
    assert "inverted hexes left: 0" in last
    assert float(last.split()[-2]) == pytest.approx(0, abs=1e-6)
