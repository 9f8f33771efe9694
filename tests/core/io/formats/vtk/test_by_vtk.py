"""What VTK's own writers make is read, and what is written is read by VTK: in each of its formats."""

import itertools

import numpy as np
import pytest

from hexmend import FileError, io
from tests.core.grids import grid, scrambled
from tests.core.io.vtk_writers import by_vtk, grid_by_vtk

vtk = pytest.importorskip("vtk")
pyvista = pytest.importorskip("pyvista")

WRITERS = {
    ".vtk": vtk.vtkUnstructuredGridWriter,
    ".vtu": vtk.vtkXMLUnstructuredGridWriter,
    ".vtkhdf": vtk.vtkHDFWriter,
    ".pvtu": vtk.vtkXMLPUnstructuredGridWriter,
}
#: Data modes and compressors of VTU, with byte orders and widths of headers in turn; an array has many blocks.
MODES = [("Ascii", "None"), *itertools.product(("Binary", "Base64", "Raw"), ("None", "ZLib", "LZ4", "LZMA"))]
OPTIONS = [
    *((".vtk", {"SetFileVersion": version, "SetFileType": kind}) for version in (42, 51) for kind in (1, 2)),
    *(
        (
            ".vtu",
            {
                "SetByteOrder": k % 2,
                f"SetHeaderTypeToUInt{32 + 32 * (k // 2 % 2)}": None,
                f"SetDataModeTo{mode if mode in ('Ascii', 'Binary') else 'Appended'}": None,
                "SetEncodeAppendedData": mode == "Base64",
                f"SetCompressorTypeTo{packing}": None,
                "SetBlockSize": 256,
            },
        )
        for k, (mode, packing) in enumerate(MODES)
    ),
    *((".vtkhdf", {"SetCompressionLevel": level}) for level in (0, 4)),
    (".pvtu", {"SetUseSubdirectory": True}),
]
NAMES = ["p & T", "a < b", 'say "x"', "it's", "tab\tand\nline", "ä λ 漢"]
TYPES = ["i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"]
WAYS = [(".vtk", "ascii"), (".vtk", "binary"), (".vtu", "ascii"), (".vtu", "binary"), (".vtkhdf", "binary")]


@pytest.mark.parametrize(("suffix", "options"), OPTIONS)
def test_what_vtk_writes_is_read(suffix, options, tmp_path):
    mesh = scrambled(grid(3), 0.3)
    arrays = {
        "velocity": np.random.default_rng(0).normal(size=(64, 3)),
        "temperature": np.linspace(0, 1, 64, dtype=np.float32),
        "number": np.arange(64, dtype=np.int64) + 2**40,
        "code": np.arange(64, dtype=np.int8) - 32,
    }
    fields = {"time": np.array([0.25, 0.5]), "axes": np.eye(3)}
    if suffix in (".vtk", ".vtu"):
        fields["a title"] = ["made elsewhere, ä 100%\nnew", "", "x" * 100, "y" * 20000]
        arrays["names"] = ["n"] * 64
    path = tmp_path / f"a{suffix}"
    by_vtk(WRITERS[suffix](), path, grid_by_vtk(mesh, arrays, np.arange(27, dtype=np.int16), fields), options)
    back, digits = io.read(path), 1e-5 if options.get("SetFileType") == 1 else 0
    np.testing.assert_allclose(back.points, mesh.points, atol=digits)
    np.testing.assert_array_equal(back.hexes, mesh.hexes)
    np.testing.assert_array_equal(back.hex_data["material"], np.arange(27))
    if arrays.pop("names", None):
        assert any(note.startswith("Not read: arrays") and "(names)" in note for note in back.notes)
        assert back.field_data["a title"] == fields.pop("a title")
    for name, values in arrays.items():
        np.testing.assert_allclose(back.node_data[name], values, rtol=digits, atol=digits)
        assert suffix == ".vtk" or back.node_data[name].dtype == values.dtype
    for name, values in fields.items():
        np.testing.assert_array_equal(np.squeeze(back.field_data[name]), values)


@pytest.mark.parametrize(("suffix", "encoding"), WAYS)
def test_every_name_and_type_comes_back_and_vtk_reads_it_alike(suffix, encoding, tmp_path):
    mesh = scrambled(grid(6), 0.3)
    n = mesh.n_nodes
    arrays = {name: np.arange(n) / (3 + k) for k, name in enumerate(NAMES)}
    arrays |= {code: np.arange(n).astype(code) for code in TYPES}
    arrays |= {"most": np.full(n, 2**64 - 1, np.uint64), "least": np.full((n, 2), -(2**63))}
    arrays |= {"big": np.arange(n, dtype=">f8"), "tensors": np.arange(9.0 * n).reshape(n, 9)}
    arrays["not finite"] = np.tile([np.nan, np.inf, -np.inf], (n, 3))
    texts = ["made & elsewhere 100%\nnew", "", "ä", "x" * 100, "y" * 20000]
    fields = {"title of it": texts, "one": ["x"], "time": np.array([0.1, 1e-300]), "axes": np.arange(6).reshape(2, 3)}
    path = tmp_path / f"a{suffix}"
    io.write(path, mesh.replace(node_data=arrays, field_data=fields), encoding=encoding)
    back, other = io.read(path), pyvista.read(path)
    assert set(back.node_data) == set(arrays)
    np.testing.assert_array_equal(other.points, mesh.points)
    np.testing.assert_array_equal(other.cells_dict[12], mesh.hexes)
    for name, values in arrays.items():
        np.testing.assert_array_equal(back.node_data[name], values)
        assert suffix == ".vtk" or back.node_data[name].dtype == values.dtype.newbyteorder("=")
        if (name, encoding) != ("not finite", "ascii"):  # of which VTK reads -inf as inf
            np.testing.assert_array_equal(np.reshape(other.point_data[name], values.shape), values)
    for name, values in fields.items():
        np.testing.assert_array_equal(back.field_data[name], values)
        np.testing.assert_array_equal(np.reshape(other.field_data[name], np.shape(values)), values)
    io.write(tmp_path / f"b{suffix}", back.replace(name=mesh.name), encoding=encoding)
    assert suffix != ".vtu" or (tmp_path / f"b{suffix}").read_bytes() == path.read_bytes()


@pytest.mark.parametrize("suffix", [".vtk", ".vtu", ".vtkhdf"])
@pytest.mark.parametrize(
    "values", [np.zeros(8, np.float16), np.zeros(8, np.complex128), np.zeros(8, np.longdouble), {"a": 1}]
)
def test_what_vtk_cannot_hold_is_refused(suffix, values, tmp_path):
    with pytest.raises(FileError, match="which VTK cannot"):
        io.write(tmp_path / f"a{suffix}", grid(1).replace(field_data={"z": values}))
    assert not list(tmp_path.iterdir())
