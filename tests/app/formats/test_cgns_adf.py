"""CGNS files based on ADF, written by the CGNS library that is part of VTK."""

import ctypes
import tomllib
from importlib.metadata import EntryPoint
from pathlib import Path

import numpy as np
import pytest

from hexmend import FileError, io, summarise
from hexmend.io import format_lookup
from hexmend_app.formats.cgns_adf import FORMAT
from tests.core.grids import grid

pytest.importorskip("vtkmodules.vtkIOCGNSReader")


@pytest.fixture
def library():
    import vtkmodules

    found = sorted(Path(vtkmodules.__file__).parent.glob("libvtkcgns*.so"))
    if not found:
        pytest.skip("VTK's CGNS library is not where it is looked for on this system")
    return ctypes.CDLL(str(found[0]))


@pytest.fixture
def joined(monkeypatch):
    """Register the format, independent of installed entry points."""
    monkeypatch.setattr(format_lookup, "plugin_formats", lambda: (FORMAT,))


def write_adf(library, path, mesh):
    """Write an unstructured zone with the hexes of a mesh, and a structured zone of eight hexes next to it."""

    def call(name, *words):
        assert getattr(library, f"vtkcgns_cg_{name}")(*words) == 0, name

    file, base, zone, more = (ctypes.c_int() for _ in range(4))
    one = ctypes.byref
    call("set_file_type", 1)
    call("open", str(path).encode(), 1, one(file))
    call("base_write", file, b"Base", 3, 3, one(base))
    hexes = np.ascontiguousarray(mesh.hexes + 1, dtype=np.int32)
    # Of 32 or 64 bits as the library was built: both read right here.
    sizes = np.array([mesh.n_nodes, mesh.n_hexes, 0], np.int64)
    call("zone_write", file, base, b"hexes", sizes.ctypes, 3, one(zone))
    for axis, letter in enumerate("XYZ"):
        values = np.ascontiguousarray(mesh.points[:, axis])
        call("coord_write", file, base, zone, 4, f"Coordinate{letter}".encode(), values.ctypes, one(more))
    hexes = hexes.astype(np.int64)
    first, last = ctypes.c_int64(1), ctypes.c_int64(mesh.n_hexes)
    call("section_write", file, base, zone, b"cells", 17, first, last, 0, hexes.ctypes, one(more))
    sizes = np.array([3, 3, 3, 2, 2, 2, 0, 0, 0], np.int64)
    call("zone_write", file, base, b"block", sizes.ctypes, 2, one(zone))
    for axis, letter in enumerate("XYZ"):
        values = np.ascontiguousarray(grid(2).points[:, axis] + 10)
        call("coord_write", file, base, zone, 4, f"Coordinate{letter}".encode(), values.ctypes, one(more))
    call("close", file)


def test_an_adf_file_is_read(library, joined, tmp_path):
    mesh = grid(3)
    write_adf(library, tmp_path / "old.cgns", mesh)
    assert b"ADF Database" in (tmp_path / "old.cgns").read_bytes()[:64]
    found = io.read(tmp_path / "old.cgns")
    assert found.n_hexes == 27 + 8
    assert summarise(found).q_min == pytest.approx(1)
    assert sorted(len(members) for members in found.hex_sets.values()) == [8, 27]
    assert any("Boundary conditions" in note for note in found.notes)


def test_a_damaged_file_crashes_the_subprocess_only(library, joined, tmp_path):
    write_adf(library, tmp_path / "old.cgns", grid(3))
    data = bytearray((tmp_path / "old.cgns").read_bytes())
    (tmp_path / "bad.cgns").write_bytes(data[: len(data) // 2])
    with pytest.raises(FileError, match=r"bad\.cgns: "):
        io.read(tmp_path / "bad.cgns")


@pytest.mark.parametrize("other", [b"other.cgns", b"/dev/null", b""])
def test_a_link_to_another_file_is_rejected_but_an_internal_link_is_not(other, library, joined, tmp_path):
    path, file = tmp_path / "linked.cgns", ctypes.c_int()
    for name in ("linked.cgns", "other.cgns"):
        write_adf(library, tmp_path / name, grid(2))
    assert library.vtkcgns_cg_open(str(path).encode(), 2, ctypes.byref(file)) == 0
    assert library.vtkcgns_cg_goto(file, 1, b"Zone_t", ctypes.c_int(1), b"end") == 0
    assert library.vtkcgns_cg_link_write(b"More", other, b"/Base/hexes/GridCoordinates") == 0
    assert library.vtkcgns_cg_close(file) == 0
    if other:
        with pytest.raises(FileError, match="its node 'More' is a link to another file, which is not followed"):
            io.read(path)
    else:
        assert io.read(path).n_hexes == 16


def test_an_hdf5_file_is_not_read_as_adf(joined, tmp_path):
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "both.cgns"
    with h5py.File(path, "w", userblock_size=512) as file:
        file["link"] = h5py.ExternalLink("other.cgns", "/")
    data = path.read_bytes()
    path.write_bytes(b"  ADF Database" + data[14:])  # in the block that HDF5 leaves to programs
    with pytest.raises(FileError, match="is not a CGNS file based on ADF"):
        io.read(path)


def test_without_the_app_the_error_names_the_package_that_reads_it(library, monkeypatch, tmp_path):
    monkeypatch.setattr(format_lookup, "plugin_formats", tuple)
    write_adf(library, tmp_path / "old.cgns", grid(1))
    with pytest.raises(FileError, match=r"pip install '\.\[app\]'  in the source folder of Hexmend") as caught:
        io.read(tmp_path / "old.cgns")
    assert "damaged" not in str(caught.value)


def test_the_entry_point_is_registered():
    data = tomllib.loads((Path(__file__).parents[3] / "pyproject.toml").read_text())
    value = data["project"]["entry-points"]["hexmend.formats"]["cgns-adf"]
    assert EntryPoint("cgns-adf", value, "hexmend.formats").load() is FORMAT
