"""Ranks that read and write their parts alone: figures, data and errors are those of one process."""

import json
import os
import re
import signal
import subprocess
import time

import numpy as np
import pytest

from hexmend import Cells, Mesh, gallery, read, summarise, write
from hexmend.io.formats.vtk.grid import from_mesh
from hexmend.io.formats.vtk.pvtu_writer import PieceFiles, numbered
from hexmend.io.slices import open_slices, slice_of
from hexmend.mesh.orientation import MIRRORED_CORNERS
from tests.core.ranks.test_ranks import ENVIRONMENT, _descendants, _words_of, command, figures, needs_mpi, on_ranks

OPTIONS = "--goal", "shape", "--tolerance", "1e-10"


@pytest.fixture(scope="module")
def given(tmp_path_factory):
    """A tangled mesh in three formats, one of them in five pieces, and the figures of one process."""
    folder = tmp_path_factory.mktemp("given")
    write(folder / "given.vtu", gallery.make("five-side", size=1500, scramble=0.3))
    write(folder / "given.vtkhdf", read(folder / "given.vtu"))
    assert figures(folder / "given.vtu")[0] > 5
    subprocess.run(
        [*command(1, folder / "given.vtu", "-o", folder / "one.vtu", *OPTIONS)], check=True, capture_output=True
    )
    return folder


def reaches_the_figures_of_one_process(given, source, out, ranks):
    run = on_ranks(ranks, source, "-o", out, *OPTIONS, "--json", out.with_suffix(".json"))
    assert run.returncode == 0, run.stderr
    assert "rank 0 reads the whole mesh" not in run.stderr
    assert f"in {ranks} pieces" in run.stdout
    assert len(list((out.parent / out.stem).iterdir())) == ranks
    np.testing.assert_allclose(figures(out), figures(given / "one.vtu"), atol=1e-8, rtol=1e-8)
    np.testing.assert_array_equal(read(out).hexes, read(given / "given.vtu").hexes)
    report = json.loads(out.with_suffix(".json").read_text())
    for time_, mesh in ("before", read(source)), ("after", read(out)):
        expected = summarise(mesh).to_dict()
        assert report[time_].keys() == expected.keys()
        for kind, of_kind in expected.pop("cells").items():
            assert report[time_]["cells"][kind] == pytest.approx(of_kind, rel=1e-12, abs=1e-12), kind
        for name, value in expected.items():
            assert report[time_][name] == (value and pytest.approx(value, rel=1e-12, abs=1e-12)), name


@pytest.mark.slow
@needs_mpi
def test_two_ranks_reach_the_optimum_of_one_process(given, tmp_path):
    reaches_the_figures_of_one_process(given, given / "given.vtu", tmp_path / "out.pvtu", 2)


@needs_mpi
@pytest.mark.slow
def test_any_number_of_ranks_reads_any_number_of_pieces(given, tmp_path):
    pieces = tmp_path / "pieces.pvtu"
    run = on_ranks(2, given / "given.vtu", "-o", pieces, "--goal", "shape", "--max-iterations", "1")
    assert "Written" in run.stdout, run.stderr
    assert figures(pieces)[0] > 0
    reaches_the_figures_of_one_process(given, pieces, tmp_path / "out.pvtu", 5)


@needs_mpi
@pytest.mark.slow
def test_the_file_that_is_read_can_be_written(given, tmp_path):
    for source in (given / "given.vtu", tmp_path / "a.pvtu"):
        on_ranks(2, source, "-o", tmp_path / "a.pvtu", "--goal", "shape", "--max-iterations", "2")
        assert len(list((tmp_path / "a").iterdir())) == 2
    np.testing.assert_array_equal(read(tmp_path / "a.pvtu").hexes, read(given / "given.vtu").hexes)


def rich():
    """A mesh with data, node sets, fixed nodes, quads and lines before the hexes' data, and a node of no hex."""
    mesh, rng = gallery.make("five-side", size=400, scramble=0.1), np.random.default_rng(3)
    points = np.concatenate([mesh.points[:7], [[9.0, 0.1, -0.0]], mesh.points[7:]])
    hexes = np.where(mesh.hexes >= 7, mesh.hexes + 1, mesh.hexes)
    quads = mesh.topology.boundary_faces[:9]
    quads = np.where(quads >= 7, quads + 1, quads)
    far = np.array([[0, len(points) - 1], [7, 3]], dtype=np.int32)  # of nodes that no hex has both of
    values = rng.random(len(hexes))
    return Mesh(
        points,
        hexes,
        node_data={
            "t": rng.random((len(points), 3)),
            "k": np.arange(len(points), dtype=np.int16),
            "fixed": (np.arange(len(points)) % 7 == 0).astype(np.uint8),
        },
        hex_data={"w": values.astype(np.float32), "v": rng.random((len(hexes), 2))},
        node_sets={"a b": np.array([1, 5, 7])},
        cells=(
            Cells("quad", quads.astype(np.int32), {"w": np.arange(9, dtype=np.float32)}, {"low": np.array([0, 2])}),
            Cells("line", far, {"w": np.arange(2, dtype=np.float32)}),
        ),
        field_data={"title": ["x"]},
    )


@needs_mpi
@pytest.mark.slow
def test_all_but_the_points_stays_bit_for_bit(tmp_path):
    source, out, whole = tmp_path / "rich.vtkhdf", tmp_path / "out.pvtu", tmp_path / "whole.vtu"
    write(source, rich())
    for target in (out, whole):
        run = on_ranks(3, source, "-o", target, "--goal", "shape", "--tolerance", "1e-10")
        assert run.returncode == 0, run.stderr
    assert "rank 0 reads the whole mesh" not in run.stderr
    a, b, old = read(out), read(whole), read(source)
    np.testing.assert_allclose(a.points, b.points, atol=1e-7)
    assert not np.array_equal(a.points, old.points)
    np.testing.assert_array_equal(a.points[a.fixed], old.points[a.fixed])
    for name in ("node_data", "hex_data", "node_sets"):
        x, y = getattr(a, name), getattr(old, name)
        assert list(x) == list(y)
        for key in x:
            assert np.asarray(x[key]).tobytes() == np.asarray(y[key]).tobytes()
    for mine, its in zip(a.cells, old.cells, strict=True):
        np.testing.assert_array_equal(mine.nodes, its.nodes)
        assert mine.data["w"].tobytes() == its.data["w"].tobytes()
        assert list(mine.sets) == list(its.sets)
    assert a.hexes.tobytes() == old.hexes.tobytes()
    assert dict(a.field_data) == dict(old.field_data)


@needs_mpi
@pytest.mark.slow
def test_left_handed_hexes_are_renumbered_as_in_one_process(tmp_path):
    mesh = gallery.make("cube", size=512, scramble=0.2)
    n = mesh.n_nodes
    both = np.concatenate([mesh.hexes, (mesh.hexes + n)[:, MIRRORED_CORNERS]])
    flipped = mesh.hexes.copy()
    flipped[::3] = flipped[::3][:, MIRRORED_CORNERS]
    both[: len(flipped)] = flipped
    write(tmp_path / "a.vtu", Mesh(np.concatenate([mesh.points, mesh.points + [2, 0, 0]]), both))
    words = tmp_path / "a.vtu", "-o", tmp_path / "out.pvtu", "--goal", "shape", "--max-iterations", "1"
    on_ranks(3, *words)
    written = read(tmp_path / "out.pvtu", as_is=True)
    np.testing.assert_array_equal(written.hexes, np.concatenate([mesh.hexes, mesh.hexes + n]))
    np.testing.assert_array_equal(written.hexes, read(tmp_path / "a.vtu").hexes)


@needs_mpi
def test_ranks_smooth_no_left_handed_hexes_and_name_their_number(tmp_path):
    mesh = gallery.make("cube", size=64)
    hexes = mesh.hexes.copy()
    hexes[[3, 40]] = hexes[[3, 40]][:, MIRRORED_CORNERS]
    write(tmp_path / "a.vtu", mesh.rebuilt(hexes=hexes))
    run = on_ranks(2, tmp_path / "a.vtu", "-o", tmp_path / "out.pvtu", "--as-is")
    assert run.returncode != 0
    assert len(re.findall("^hexmend: 2 hexes.* are numbered inside out", run.stderr, re.MULTILINE)) == 1
    assert "rank 0 reads the whole mesh" not in run.stderr
    assert "Traceback" not in run.stderr
    assert not (tmp_path / "out.pvtu").exists()


REASONS = [
    (gallery.make("layered", size=2000), "it may have boundary layers"),
    (gallery.make("cube", size=64).replace(hex_sets={"half": np.arange(32)}), "it has materials or sets of hexes"),
    (
        gallery.make("cube", size=64).replace(cells=(Cells("tetra", np.array([[0, 1, 5, 25]], dtype=np.int32)),)),
        "it has cells other than hexes",
    ),
    (
        gallery.make("cube", size=64).replace(hex_data={"vtkGhostType": np.arange(64, dtype=np.uint8) % 2}),
        "it has ghost cells",
    ),
]


@needs_mpi
@pytest.mark.slow
@pytest.mark.parametrize(("mesh", "reason"), REASONS)
def test_rank_0_reads_what_only_the_whole_mesh_tells(tmp_path, mesh, reason):
    write(tmp_path / "a.vtu", mesh)
    run = on_ranks(2, tmp_path / "a.vtu", "-o", tmp_path / "out.pvtu", "--goal", "shape", "--max-iterations", "2")
    assert run.stderr.count(f"rank 0 reads the whole mesh: {reason}") == 1
    np.testing.assert_array_equal(read(tmp_path / "out.pvtu").hexes, read(tmp_path / "a.vtu").hexes)


@needs_mpi
@pytest.mark.slow
def test_data_that_the_numbers_of_the_file_replace_are_reported(tmp_path):
    mesh = gallery.make("cube", size=64)
    write(tmp_path / "a.vtu", mesh.replace(node_data={"GlobalNodeId": np.arange(mesh.n_nodes) + 1}))
    run = on_ranks(2, tmp_path / "a.vtu", "-o", tmp_path / "b.pvtu", "--goal", "shape", "--max-iterations", "2")
    assert "rank 0 reads" not in run.stderr
    assert run.stderr.count("cannot hold point data (GlobalNodeId), a name that it uses itself") == 1
    # The numbers that the file itself has are no data.
    run = on_ranks(2, tmp_path / "b.pvtu", "-o", tmp_path / "b.pvtu", "--goal", "shape", "--max-iterations", "2")
    assert "cannot hold" not in run.stderr


@needs_mpi
@pytest.mark.slow
def test_nodes_of_one_number_at_different_places_stay_apart(tmp_path):
    mesh = gallery.make("cube", size=64)
    grid, files = from_mesh(mesh), PieceFiles.new(tmp_path / "a.pvtu")
    ids = np.arange(mesh.n_nodes)
    ids[-2] = ids[-1]
    files.make_folder()
    piece = numbered(grid, ids, np.arange(mesh.n_hexes))
    files.write_piece(0, piece)
    files.finish(1, piece)
    run = on_ranks(2, tmp_path / "a.pvtu", "-o", tmp_path / "out.pvtu", "--goal", "shape", "--max-iterations", "2")
    assert "rank 0 reads the whole mesh: its numbers of nodes" in run.stderr
    assert read(tmp_path / "out.pvtu").n_nodes == mesh.n_nodes


@needs_mpi
@pytest.mark.slow
def test_rank_0_raises_an_unsound_mesh_alone_and_all_write_it(tmp_path):
    given, out, report = (tmp_path / name for name in ("given.vtu", "out.pvtu", "report.json"))
    mesh = gallery.make("cube", size=64)
    points, boundary = mesh.points.copy(), mesh.topology.boundary
    moves = np.random.default_rng(0).uniform(-0.5, 0.5, (np.count_nonzero(boundary), 3))
    points[boundary] += moves * mesh.mean_edge_length
    write(given, mesh.with_points(points))
    run = on_ranks(2, given, "-o", out, "--layers", "free", "--json", report)
    assert "rank 0 raises it alone" in run.stderr, run.stderr
    assert json.loads(report.read_text())["ranks"]["iterations_alone"] > 0
    assert json.loads(report.read_text())["after"]["inverted"] == figures(out)[0]
    assert len(list((tmp_path / "out").iterdir())) == 2


@needs_mpi
@pytest.mark.slow
def test_more_ranks_than_hexes_are_too_many(tmp_path):
    write(tmp_path / "one.vtu", gallery.make("cube", size=1))
    run = on_ranks(2, tmp_path / "one.vtu", "-o", tmp_path / "out.pvtu")
    assert run.returncode != 0
    assert run.stderr.count("2 ranks are too many for 1 hexes") == 1
    assert not (tmp_path / "out.pvtu").exists()


@needs_mpi
@pytest.mark.slow
def test_a_damaged_file_is_an_error_of_one_line(given, tmp_path):
    data = (given / "given.vtu").read_bytes()
    (tmp_path / "a.vtu").write_bytes(data[: len(data) // 2])
    run = on_ranks(3, tmp_path / "a.vtu", "-o", tmp_path / "out.pvtu")
    assert run.returncode != 0
    assert run.stderr.count("continues past the end of the data") == 1
    assert "Traceback" not in run.stderr


@needs_mpi
@pytest.mark.slow
def test_a_rank_that_is_killed_leaves_whole_files(tmp_path):
    given, out, checkpoint = (tmp_path / name for name in ("given.vtu", "out.pvtu", "out.checkpoint.pvtu"))
    write(given, gallery.make("five-side", size=30_000, scramble=0.3))
    write(out, gallery.make("cube", size=8))
    words = given, "-o", out, "--goal", "shape", "--checkpoint", "1e-4"
    with subprocess.Popen(
        command(2, *words), env=ENVIRONMENT, stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as launcher:
        for _ in range(2):
            while not checkpoint.exists() or figures(checkpoint)[0] == figures(given)[0]:
                assert launcher.poll() is None
                time.sleep(0.02)
        ranks = [process for process in _descendants(launcher.pid) if b"smooth" in _words_of(process)]
        os.kill(ranks[-1], signal.SIGKILL)
        launcher.communicate(timeout=60)
    assert launcher.returncode != 0
    assert read(out).n_hexes == 8
    assert figures(checkpoint)[0] < figures(given)[0]
    run = on_ranks(2, checkpoint, "-o", out, "--goal", "shape", "--checkpoint", "1e-4")
    assert run.returncode == 0, run.stderr
    assert figures(out)[0] == 0
    assert sorted(file.name for file in tmp_path.iterdir() if file.is_dir()) == ["out", "out.checkpoint"]


@needs_mpi
@pytest.mark.slow
def test_a_signal_ends_the_run_with_the_result_so_far(tmp_path):
    given, out = tmp_path / "given.vtu", tmp_path / "out.pvtu"
    write(given, gallery.make("five-side", size=60_000, scramble=0.3))
    words = given, "-o", out, "--goal", "shape", "--checkpoint", "1e-4", "--json", tmp_path / "report.json"
    with subprocess.Popen(
        command(2, *words), env=ENVIRONMENT, stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as launcher:
        while not (tmp_path / "out.checkpoint.pvtu").exists():
            assert launcher.poll() is None
            time.sleep(0.02)
        ranks = [process for process in _descendants(launcher.pid) if b"smooth" in _words_of(process)]
        os.kill(ranks[-1], signal.SIGTERM)
        launcher.communicate(timeout=120)
    assert json.loads((tmp_path / "report.json").read_text())["outcome"] == "stopped"
    assert figures(out)[0] < figures(given)[0]
    assert not (tmp_path / "out.checkpoint.pvtu").exists()


@pytest.mark.parametrize("suffix", [".vtu", ".vtkhdf", ".pvtu"])
@pytest.mark.parametrize("count", [1, 4])
def test_slices_are_the_file(tmp_path, suffix, count):
    mesh = rich()
    write(tmp_path / f"a{suffix}", mesh)
    files = open_slices(tmp_path / f"a{suffix}")
    slices = [slice_of(files, part, count) for part in range(count)]
    assert np.concatenate([one.points for one in slices]).tobytes() == mesh.points.tobytes()
    np.testing.assert_array_equal(np.concatenate([one.node_ids for one in slices]), np.arange(mesh.n_nodes))
    np.testing.assert_array_equal(np.concatenate([one.cell_ids for one in slices]), np.arange(mesh.n_hexes + 11))
    nodes = np.concatenate([one.nodes for one in slices])
    np.testing.assert_array_equal(nodes[: 8 * mesh.n_hexes], mesh.hexes.ravel())
    np.testing.assert_array_equal(nodes[-4:], [0, mesh.n_nodes - 1, 7, 3])
    np.testing.assert_array_equal(np.concatenate([one.cell_data["w"] for one in slices])[-11:-2], np.arange(9))


def test_files_of_which_no_slices_can_be_read(tmp_path):
    mesh = gallery.make("cube", size=8)
    write(tmp_path / "a.vtk", mesh)
    write(tmp_path / "a.vtu", mesh, encoding="ascii")
    write(tmp_path / "b.vtu", mesh)
    (tmp_path / "b.pvtu").write_text(
        '<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid><Piece Source="b.vtu"/></PUnstructuredGrid></VTKFile>'
    )
    assert [open_slices(tmp_path / name) for name in ("a.vtk", "a.vtu", "b.pvtu")] == [None] * 3


@pytest.mark.parametrize("section", [b"Points>", b'Components="3"'])
def test_a_file_without_coordinates_has_no_slices(tmp_path, section):
    write(tmp_path / "a.vtu", gallery.make("cube", size=8))
    data = (tmp_path / "a.vtu").read_bytes()
    assert section in data
    (tmp_path / "a.vtu").write_bytes(data.replace(section, section.replace(b"Points", b"Places").replace(b"3", b"2")))
    assert open_slices(tmp_path / "a.vtu") is None
