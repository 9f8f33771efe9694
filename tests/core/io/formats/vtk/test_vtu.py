"""VTU: whatever VTK's own writer makes of a grid is read as VTK has it, and what is damaged is refused at once.

What VTK's own writers make is read, and what is written is read by VTK: in each of its formats.
"""

import itertools
import re
import tracemalloc
import zlib
from base64 import b64encode

import numpy as np
import pytest

from hexmend import FileError, io
from hexmend.io.formats.vtk import vtu_writer
from hexmend.mesh.hexahedron import UNIT_CUBE
from tests.core.grids import grid, scrambled
from tests.core.io.kept import assert_refused, read_content
from tests.core.io.vtk_writers import by_vtk, grid_by_vtk

CUBE = " ".join(f"{x:g}" for x in UNIT_CUBE.ravel())


def text_of(points=8, cells=1, hexes="0 1 2 3 4 5 6 7", ends="8", types="12", more="", kind="Int64", data=""):
    """A file of one piece in decimals."""
    return (
        '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>' + more + "<Piece "
        f'NumberOfPoints="{points}" NumberOfCells="{cells}"><Points><DataArray type="Float64" NumberOfComponents="3">'
        f'{CUBE}</DataArray></Points><Cells><DataArray type="{kind}" Name="connectivity">{hexes}</DataArray>'
        f'<DataArray type="Int64" Name="offsets">{ends}</DataArray><DataArray type="UInt8" Name="types">{types}'
        f"</DataArray></Cells>{data}</Piece></UnstructuredGrid></VTKFile>"
    )


def test_text_is_read_as_xml_allows_it_to_be(tmp_path):
    plain = text_of(data='<PointData><DataArray type="Int32" Name="n&lt;ä">0 1 2 3 4 5 6 7</DataArray></PointData>')
    forms = {
        "quotes": plain.replace('"', "'").encode(),
        "mark": b"\xef\xbb\xbf" + plain.encode(),
        "latin": ('<?xml version="1.0" encoding="ISO-8859-1"?>' + plain).encode("latin-1"),
        "windows": ('<?xml version="1.0" encoding="windows-1252"?>' + plain).encode("cp1252"),
        "comment": plain.replace("0 1 2 3", "<!-- <DataArray> --> 0 1 2 3").encode(),
        "key": plain.replace("0 1 2 3", "<InformationKey n='>'><Value>9</Value></InformationKey> 0 1 2 3<a/>").encode(),
    }
    for name, data in forms.items():
        back = read_content(tmp_path / f"{name}.vtu", data)
        np.testing.assert_array_equal(back.points, UNIT_CUBE)
        np.testing.assert_array_equal(back.node_data["n<ä"], np.arange(8))


def test_several_pieces_are_put_together(tmp_path):
    one = re.search(
        "<Piece.*</Piece>", text_of(data='<CellData><DataArray type="Int8" Name="a">7</DataArray></CellData>')
    )[0]
    empty = '<Piece NumberOfPoints="0" NumberOfCells="0"/>'
    other = one.replace(
        "7</DataArray></CellData>", '9</DataArray><DataArray type="Int8" Name="b">1</DataArray></CellData>'
    )
    text = text_of().replace(re.search("<Piece.*</Piece>", text_of())[0], one + empty + other)
    back = read_content(tmp_path / "a.vtu", text)
    np.testing.assert_array_equal(back.hexes, [np.arange(8), np.arange(8, 16)])
    np.testing.assert_array_equal(back.hex_data["a"], [7, 9])
    assert "b" not in back.hex_data
    assert "2 pieces are merged; 8 duplicate nodes remain where they meet" in back.notes[0]
    assert back.notes[1] == "Not read: arrays that are missing or different in some pieces (b)."


def test_strings_of_nodes_and_bits_and_whole_numbers_of_other_types(tmp_path):
    data = (
        '<PointData><Array type="String" Name="words">97 0 98 0 99 0 100 0 101 0 102 0 103 0 104 0</Array>'
        '<DataArray type="Bit" Name="bits">0 1 0 1 0 1 0 1</DataArray></PointData>'
    )
    more = '<FieldData><Array type="String" Name="title">195 -92 0 0 98 0</Array></FieldData>'
    back = read_content(tmp_path / "a.vtu", text_of(data=data, kind="Float32", more=more))
    assert any("strings" in note and "words" in note for note in back.notes)
    np.testing.assert_array_equal(back.node_data["bits"], [0, 1] * 4)
    assert back.field_data["title"] == ["ä", "", "b"]


def test_base64_whose_head_is_encoded_by_itself_is_read(tmp_path):
    def encoded(values):
        data = np.ascontiguousarray(values).tobytes()
        return (b64encode(np.uint32(len(data)).tobytes()) + b64encode(data)).decode()

    text = text_of(hexes=encoded(np.arange(8)), ends=encoded(np.int64(8)), types=encoded(np.uint8(12)))
    text = text.replace(CUBE, encoded(UNIT_CUBE)).replace("<DataArray", '<DataArray format="binary"')
    np.testing.assert_array_equal(read_content(tmp_path / "a.vtu", text).points, UNIT_CUBE)


WRONG_TEXTS = [
    (text_of(hexes="0 1 2 3 4 5 6 4294967303"), "expected numbers from 0 to 7"),
    (text_of(hexes="0 1 2 3 4 5 6 4294967303", kind="Int32"), "holds 4294967303, which is outside of its type Int32"),
    (text_of(hexes="0 1 2 3 4 5 6 36893488147419103239"), "outside of its type Int64"),
    (text_of(hexes="0 1 2 3 4 5 6 7.9"), "words that are not numbers of its type"),
    (text_of(hexes="0 1 2 3 4 5 6 7.9", kind="Float64"), "holds 7.9: expected whole numbers"),
    (text_of(types="268"), "holds 268, which is outside of its type UInt8"),
    (text_of(types="268").replace("UInt8", "Int32"), "cell 0 is of type 268: expected one of VTK's types"),
    (text_of(hexes="0 1 2 3 4 5 6 7 0"), "holds 9 numbers: expected 8"),
    (text_of(ends="7"), "holds 8 numbers: expected 7"),
    (text_of(ends="7", hexes="0 1 2 3 4 5 6"), "cell 0 is of type 12 and has 7 nodes: expected 8"),
    (text_of(cells=2, ends="8 0", types="12 12"), "its offsets fall at cell 1"),
    (text_of(ends="-8"), "its offsets fall at cell 0"),
    (text_of(points="9"), "holds 24 numbers: expected 27"),
    (text_of(points="1e3"), "NumberOfPoints of Piece is '1e3': expected a natural number"),
    (text_of(points=10**15), "are declared to have"),
    (text_of(cells=10**15), "are declared to have"),
    (text_of(ends=str(10**15)), "are declared to have"),
    (text_of(kind="Int65"), "has the type 'Int65': expected Int8"),
    (text_of(kind='Int64" format="hex'), "has the format 'hex'"),
    (text_of(kind='Int64" format="appended'), "has no AppendedData"),
    (text_of(kind='Int64" format="binary'), "'connectivity' has 3820445139 bytes: expected 64"),
    (text_of(kind='Int64" format="binary', hexes="QAAAAA=="), "continues past the end of the data"),
    (text_of(kind='Int64" format="binary', hexes="Q!!!!!!!"), "is not valid base64"),
    (text_of().replace('Name="types"', 'Name="type"'), "its Cells hold no array 'types'"),
    (text_of().replace('"3"', '"2"'), "its Points have 2 coordinates each: expected 3"),
    (text_of().replace("UnstructuredGrid", "PolyData"), "is a VTKFile of the type 'PolyData': expected UnstructuredGrid"),
    (text_of().replace("Piece", "Part"), "holds no Piece"),
    (text_of()[:-20], "its XML is broken at line 1, column"),
    ('<!DOCTYPE a [<!ENTITY b "bbbbbbbb">]>' + text_of(), "declares a document type"),
    ("\0" * 5000, "does not begin with <VTKFile"),
    ("<VTKFile" + " " * 5000, "its XML is broken"),
    ('<?xml version="1.0" encoding="no-such"?>' + text_of(), "its XML is broken"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "words"), WRONG_TEXTS)
def test_what_is_wrong_is_named(text, words, tmp_path):
    assert_refused(tmp_path / "a.vtu", words, text)


def packed(size, *, blocks=1):
    """An array of zeros that zlib has packed, in base64: `blocks` of `size` bytes."""
    block = zlib.compress(bytes(size), 9)
    head = np.array([blocks, size, 0, *[len(block)] * blocks], "<u4")
    return (b64encode(head.tobytes()) + b64encode(block * blocks)).decode()


@pytest.mark.slow
@pytest.mark.parametrize("consistent", [False, True])
def test_a_small_file_cannot_fill_the_memory(consistent, tmp_path):
    """256 MB of zeros in 260 kB: refused before they are unpacked, whether the piece's counts agree with them or not."""
    size, rows = 1 << 28, (1 << 25 if consistent else 8)
    array = f'<PointData><DataArray type="Int64" Name="a" format="binary">{packed(size)}</DataArray></PointData>'
    text = text_of(points=rows, data=array).replace("<VTKFile", '<VTKFile compressor="vtkZLibDataCompressor"')
    (tmp_path / "bomb.vtu").write_text(text)
    tracemalloc.start()
    try:
        with pytest.raises(FileError):
            io.read(tmp_path / "bomb.vtu")
        assert tracemalloc.get_traced_memory()[1] < 1 << 25
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("packing", ["ZLib", "LZ4", "LZMA"])
def test_a_block_that_holds_more_or_less_than_announced_is_refused(packing, tmp_path):
    import lzma

    from lz4 import block

    pack = {"ZLib": zlib.compress, "LZMA": lzma.compress, "LZ4": lambda data: block.compress(data, store_size=False)}
    for real in (63, 65, 1 << 20):
        data = pack[packing](bytes(real))
        head = np.array([1, 64, 0, len(data)], "<u4").tobytes()
        array = (b64encode(head) + b64encode(data)).decode()
        text = text_of(
            data=f'<PointData><DataArray type="Int64" Name="a" format="binary">{array}</DataArray></PointData>'
        )
        text = text.replace("<VTKFile", f'<VTKFile compressor="vtk{packing}DataCompressor"')
        (tmp_path / "a.vtu").write_text(text)
        with pytest.raises(FileError, match="block 1 of 1"):
            io.read(tmp_path / "a.vtu")


def test_appended_data_are_never_taken_for_xml_and_may_not_be_shared_by_too_many(tmp_path):
    mesh = scrambled(grid(3), 0.3)
    marks = np.frombuffer(b"</AppendedData><!DOCTYPE x>&<Piece " * 16, np.uint8)[:512].view(np.float64)
    vtk = pytest.importorskip("vtk")
    raw = {"SetDataModeToAppended": None, "SetEncodeAppendedData": False, "SetCompressorTypeToNone": None}
    content = grid_by_vtk(mesh, {"marks": marks}, np.arange(27), {})
    by_vtk(vtk.vtkXMLUnstructuredGridWriter(), tmp_path / "a.vtu", content, raw)
    np.testing.assert_array_equal(io.read(tmp_path / "a.vtu").node_data["marks"].view(np.int64), marks.view(np.int64))
    content = (tmp_path / "a.vtu").read_bytes()
    one = re.search(rb'<DataArray type="Float64" Name="marks"[^>]*/>', content)[0]
    many = b"".join(one.replace(b'"marks"', b'"m%d"' % k) for k in range(2000))
    assert len(read_content(tmp_path / "many.vtu", content.replace(one, many)).node_data) == 2000
    for bad, words in (
        (content[:-3000], "continues past"),
        (content.replace(b"   _", b"   x"), "do not begin with '_'"),
    ):
        (tmp_path / "bad.vtu").write_bytes(bad)
        with pytest.raises(FileError, match=words):
            io.read(tmp_path / "bad.vtu")


@pytest.mark.parametrize(("name", "hexes"), [("can.vtu", 4800), ("box_hybrid_mesh.vtu", 943)])
def test_real_files_are_as_vtk_has_them(name, hexes, real_mesh):
    pyvista = pytest.importorskip("pyvista")
    path = real_mesh(name)
    other, mesh = pyvista.read(path), io.read(path, as_is=True)
    assert mesh.n_hexes == hexes
    np.testing.assert_array_equal(mesh.points, other.points)
    np.testing.assert_array_equal(mesh.hexes, other.cells_dict[12])
    for key, values in other.point_data.items():
        np.testing.assert_array_equal(mesh.node_data[key], values)
    chosen = np.asarray(other.celltypes) == 12
    for key, values in other.cell_data.items():
        np.testing.assert_array_equal(mesh.hex_data[key], values[chosen])


# Writing VTU: what is written is read again by us and by VTK.


def test_vtk_reads_arrays_of_many_blocks_and_of_none(tmp_path, monkeypatch):
    pyvista = pytest.importorskip("pyvista")
    monkeypatch.setattr(vtu_writer, "_BLOCK", 1000)
    mesh = scrambled(grid(6), 0.3)
    fields = {"none": np.zeros(0), "no rows": np.zeros((0, 3)), "one": np.ones(1)}
    io.write(tmp_path / "a.vtu", mesh.replace(field_data=fields))
    other = pyvista.read(tmp_path / "a.vtu")
    np.testing.assert_array_equal(other.points, mesh.points)
    np.testing.assert_array_equal(other.cells_dict[12], mesh.hexes)
    np.testing.assert_array_equal(other.field_data["one"], 1)
    for encoding in ("binary", "ascii"):
        io.write(tmp_path / "b.vtu", mesh.replace(field_data=fields), encoding=encoding)
        assert not np.size(io.read(tmp_path / "b.vtu").field_data["none"])


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
