"""What a command imports: a process that pays for what it does not use is slow from its first moment."""

import pytest

from hexmend import gallery, io, measure
from tests.programs import run_python

#: Loaded for a few commands alone, and how long it takes.
HEAVY = {
    "scipy": "0.2 s",
    "matplotlib": "0.3 s",
    "meshlane": "0.1 s",
    "h5py": "0.2 s", "netCDF4": "", "lz4": "",
    "importlib.metadata": "0.04 s",
    "tomllib": "", "tomli_w": "",
    "numba": "", "llvmlite": "",
    "PySide6": "", "vtkmodules": "", "pyvista": "", "meshio": "",
}  # fmt: skip
NUMERICAL = {"numpy", "hexmend.kernels", "hexmend.mesh.mesh", *HEAVY}
RUNNING = {"hexmend.smoothers", "hexmend.energy", "hexmend.run"}
PROGRAM = """
import sys
from hexmend.cli.main import main
status = main(sys.argv[1:])
print("modules:", *sys.modules)
sys.exit(status)
"""
SMOOTH = ["smooth", "{mesh}", "-o", "{out}.vtk"]


def program(*words):
    done = run_python("-c", PROGRAM, *words)
    said, _, modules = done.stdout.rpartition("modules:")
    assert done.returncode == 0, done.stderr
    return said, modules.split()


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("start")
    mesh = gallery.make("cube", size=64, scramble=0.2)
    for suffix in (".vtk", ".vtu", ".mesh", ".meshb"):
        io.write(path / f"mesh{suffix}", mesh)
    tangled = gallery.make("five-side", size=500, scramble=0.6)
    assert measure(tangled.points, tangled.hexes).n_inverted > 10
    io.write(path / "tangled.vtk", tangled)
    return path


MENDING = [
    [],
    *(
        pytest.param(more, marks=pytest.mark.slow)
        for more in (["--boundary", "slide"], ["--set", "goal=scaled-jacobian"])
    ),
]


@pytest.mark.parametrize("words", MENDING)
def test_a_tangled_mesh_is_mended_without_scipy(folder, tmp_path, words):
    said, modules = program("smooth", str(folder / "tangled.vtk"), "-o", str(tmp_path / "out.vtk"), *words)
    assert "no hex is invalid" in said
    assert not {"scipy"} & set(modules)


@pytest.mark.slow
@pytest.mark.parametrize(("words", "forbidden"), [
    (["--version"], NUMERICAL | {"argparse", "typing", "dataclasses", "pathlib", "inspect"}),
    (["--help"], NUMERICAL - {"importlib.metadata"}),  # which knows the commands of others
    (["methods", "--json"], HEAVY.keys() - {"importlib.metadata"}),
    (["gallery"], HEAVY.keys() - {"importlib.metadata"} | RUNNING),  # and gallery meshes of others
    (["gallery", "plane", "--size", "700", "-o", "{out}.vtk"], HEAVY.keys() | RUNNING),
    (["info", "{mesh}.mesh"], HEAVY.keys() | RUNNING),
    (["info", "{mesh}.meshb", "--json"], HEAVY.keys() | RUNNING),
    (["info", "{mesh}.vtk", "--metrics"], HEAVY.keys() - {"importlib.metadata"} | RUNNING),  # and others' metrics
    (["info", "{mesh}.vtu"], HEAVY.keys() | RUNNING),
    ([*SMOOTH, "--method", "mend", "--json", "{out}.json", "--history", "{out}.csv"], HEAVY.keys()),
    ([*SMOOTH, "--method", "local-sd", "--save-recipe", "{out}.toml"], HEAVY.keys() - {"tomli_w"}),
    *(([*SMOOTH, "--method", method], HEAVY.keys()) for method in (
        "local-nr", "smart-laplacian", "getme-sequential", "global-sd",
    )),
])  # fmt: skip
def test_a_command_imports_what_it_uses(folder, tmp_path, words, forbidden):
    words = [word.format(mesh=folder / "mesh", out=tmp_path / "out") for word in words]
    words = [f"{word}.vtk" if word == str(folder / "mesh") else word for word in words]
    _, modules = program(*words)
    assert forbidden & set(modules) == set()
