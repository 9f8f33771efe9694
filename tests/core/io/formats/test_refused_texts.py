"""Texts that no format takes: each is refused by a sentence that names what is wrong and its place."""

import numpy as np
import pytest

from hexmend.mesh.hexahedron import UNIT_CUBE
from tests.core.io.formats.abaqus.test_abaqus import DECK, cube
from tests.core.io.formats.gmsh.test_gmsh import FIRST_VERSION, HEAD, NODES
from tests.core.io.formats.nastran.test_nastran import CUBE, GRIDS
from tests.core.io.formats.ovm.test_ovm import written
from tests.core.io.formats.test_library_formats import POINTS, ZONE
from tests.core.io.kept import assert_refused

SOUND = {
    "a.su2": ZONE,
    "a.bdf": CUBE,
    "a.ovm": written(UNIT_CUBE, np.arange(8)[None]),
    "a.msh": FIRST_VERSION,
}
#: A part of a sound text, what stands for it, and what is said.
SPOILT = {
    "a.su2": [
        ("NDIME= 3", "\0", "holds bytes that are not text"),
        ("NDIME= 3", "NDIME= 2", "NDIME is '2': expected 3"),
        ("NELEM= 1", "NELEM= 99999999999", "NELEM holds 10 numbers, which are not 99999999999 elements"),
        ("12 0", "29 0", "NELEM holds 10 numbers, which are not 1 elements of the types"),
        ("NPOIN= 8 8", "NPOIN= 9", "NPOIN holds 24 numbers: expected 3 or 4 for each of 9 nodes"),
        ("6 7 0\n", "6 8 0\n", "refers to node 8: expected numbers from 0 to 7"),
        ("1 0 0\n", "1 x 0\n", "NPOIN holds 'x'"),
        ("NDIME= 3", "NZONE= 2\nNDIME= 3", "holds 1 zones: expected 2"),
        (ZONE, "NDIME= 3\n", "has neither NELEM= nor NPOIN="),
        ("NPOIN= 8 8\n" + POINTS, "", "zone 1 has no NPOIN="),
    ],
    "a.bdf": [
        ("GRID,2,,", "\0", "holds bytes that are not text"),
        ("GRID,2,,", "GRID,2,5,", "GRID in line 3 is in the coordinate system 5, which the file does not have"),
        ("GRID,2,,1.0", "GRID,2,,one", "GRID in line 3 holds 'one': expected a number"),
        ("GRID,2,,1.0", "GRID,2,,1_0", "GRID in line 3 holds '1_0': expected a number"),
        ("GRID,2,,1.0", f"GRID,2,,1.{'0' * 80}", "expected a number"),
        ("GRID,2,", "GRID,1,", "node 1 is given twice"),
        (",7,8\n", ",7\n", "CHEXA in line 10 has 7 nodes: expected 8"),
        (",7,8\n", ",7,77\n", "node 77 is used"),
        (",7,8\n", ",7,8.5\n", "CHEXA in line 10 holds '8.5': expected a whole number"),
        ("CHEXA,9", "INCLUDE 'more.bdf'\nCHEXA,9", "INCLUDE in line 10 of a.bdf reads 'more.bdf', which does not exist"),
        ("CHEXA", "CGAP", "holds no hexahedra"),
        (GRIDS, "", "has no GRID"),
    ],
    "a.ovm": [
        ("OVM ASCII", "OVM BINARY", "does not begin with OVM ASCII"),
        ("Polyhedra\n1\n", "Polyhedra\n2\n", "Polyhedra holds 1 whole rows of 2"),
        ("Edges\n12\n", "Edges\n99999999999\n", "Edges ends after 12 of 99999999999 rows"),
        ("Vertices\n8\n0.0 ", "Vertices\n8\nx ", "Vertices holds 'x' in row 1 of 8 (line 4)"),
        ("Faces\n6\n4 ", "Faces\n6\n4 99 ", "Faces holds"),
        ("Faces\n6\n4 ", "Faces\n6\n-4 ", "Faces holds 0 whole rows of 6"),
        ("Polyhedra\n1\n6 ", "Polyhedra\n1\n7 99 ", "Polyhedra refer to 99: expected numbers from 0 to 11"),
        ("Edges", "Hedges", "'Hedges' was found where a section should begin (line 12)"),
    ],
    "a.msh": [
        ("$NOD\n9", "$NOD\n8", "$NOD holds 37 numbers: expected 33 for 8 nodes"),
        ("$ELM\n3", "$ELM\n4", "$ELM holds 3 whole elements of 4"),
        ("1000 8 10", "1000 9 10", "element 7 of type 5 has 9 nodes: expected 8"),
        ("7 5 100", "7 99 100", "has elements of the type 99, which is unknown"),
        ("$ENDELM", "", "ends without"),
    ],
}  # fmt: skip
VTK = "# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n"
VTK_CUBE = "POINTS 8 float\n0 0 0 1 0 0 1 1 0 0 1 0\n0 0 1 1 0 1 1 1 1 0 1 1\n"
#: Whole texts, and what is said.
WHOLE = {
    "a.vtk": [
        ("hello\n", "line 1 is 'hello': expected '# vtk DataFile"),
        ("# vtk DataFile Version 2.0\nt\nASCII\nDATASET POLYDATA\n", "its dataset is POLYDATA: expected UNSTRUCTURED_GRID"),
        (VTK + "POINTS 8 float\n0 0 0 1 0 0\n", "POINTS ends after 2 of 8 rows"),
        (VTK + "POINTS 2 float\n0 0 0 1 x 0\n", "POINTS holds 'x' in row 2 of 2 (line 6): expected a number"),
        (VTK + VTK_CUBE, "has no section CELLS"),
        (VTK + VTK_CUBE + "CELLS 1 9\n8 0 1 2 3 4 5 6 8\nCELL_TYPES 1\n12\n", "expected numbers from 0 to 7"),
        (VTK + VTK_CUBE + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n", "holds no hexahedra, but 1 triangle cell"),
        (VTK + VTK_CUBE + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n9\n", "holds no hexahedra"),
        ("", "is empty"),
    ],
    "a.mesh": [
        ("MeshVersionFormatted 2\nDimension 2\n", "its Dimension is 2: expected 3"),
        ("MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 0 0\nTriangles\n1\n1 1 1 0\nEnd\n", "holds no hexahedra, but 1 triangle cell"),
        ("MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 0 0\nEnd\n", "holds no hexahedra"),
    ],
    "a.meshb": [
        ("words", "does not begin with the number 1"),
    ],
    "a.vtu": [
        ("<html/>", "does not begin with <VTKFile"),
        ('<VTKFile type="UnstructuredGrid"><Unstr', "its XML is broken at line 1"),
    ],
    "a.xyz": [
        ("1 2 3", "the suffix '.xyz' is unknown. Hexmend can read"),
    ],
    "a.inp": [
        ("\0" * 5000, "holds bytes that are not text"),
        ("hello", "has no line that begins with *"),
        ("*HEADING\n", "has no *NODE"),
        ("*NODE\n1, 0, 0, x\n", "*NODE in line 2 holds 'x': expected a number"),
        ("*NODE\n1.5, 0, 0, 0\n", "has the number 1.5"),
        (f"*NODE\n{cube()}*ELEMENT, TYPE=C3D8\n1, 1, 2, 3, 4, 5, 6, 7\n", "the element in line 11 has 8 numbers: expected 9"),
        (f"*NODE\n{cube()}*ELEMENT, TYPE=C3D8\n1, 1, 2, 3, 4, 5, 6, 7, 9\n", "node 9 is used"),
        (f"*NODE\n{cube()}*ELEMENT, TYPE=S3\n1, 1, 2, 4\n", "holds no hexahedra, but 1 triangle cell"),
        ("*INCLUDE, INPUT=nodes.inp\n", "reads 'nodes.inp', which does not exist"),
        ("*NODE, INPUT=nodes.inp\n", "reads 'nodes.inp', which does not exist"),
        ("*NODE\n1, 0, 0, 0\n*NGEN\n1, 5, 1\n", "*NGEN in line 3 generates nodes or elements from others"),
        ("*NODE, SYSTEM=C\n1, 0, 0, 0\n", "has other coordinates than x, y and z"),
        (DECK + "*NSET, NSET=x\ny\n*NSET, NSET=y\nx\n", "is a member of itself"),
        (DECK + "*NSET, NSET=x, GENERATE\n1, 5, 0\n", "expected first, last and step"),
        ("*INSTANCE, NAME=a, PART=b\n", "refers to the part 'b', which does not exist"),
    ],
    "a.msh": [
        ("hello", "does not begin with $MeshFormat"),
        ("$MeshFormat\n1 0 8\n$EndMeshFormat\n", "is of version '1'"),
        ("$MeshFormat\n3 0 8\n$EndMeshFormat\n", "Save it as 4.1 with Gmsh"),
        ("$MeshFormat\n4.1 1 8\nabcd\n$EndMeshFormat\n", "gives the byte order"),
        (HEAD, "has no section $Nodes"),
        (HEAD + NODES, "has no section $Elements"),
        (HEAD + "$Nodes\n8\n1 0 0 0\n", "$Nodes ends without $EndNodes"),
        (HEAD + "$Nodes\n9999999999\n1 0 0 0\n$EndNodes\n", "$Nodes holds 5 numbers: expected 39999999997"),
        (HEAD + "$Nodes\n1\n1.5 0 0 0\n$EndNodes\n", "the tag 1.5"),
        (HEAD + NODES + "$Elements\n1\n1 99 0 1\n$EndElements\n", "elements of the type 99"),
        (HEAD + NODES + "$Elements\n1\n1 5 0 1 2 4\n$EndElements\n", "$Elements holds 1 whole elements of 1"),
        (HEAD + NODES + "$Elements\n1\n1 5 -4 1 2 4 3 5 6 8 7\n$EndElements\n", "holds 0 whole elements of 1"),
        (HEAD + NODES + "$Elements\n1\n1 5 0 1 2 4 3 5 6 8 77\n$EndElements\n", "node 77 is used"),
        (HEAD + NODES + "$Elements\n1\n1 2 0 1 2 4\n$EndElements\n", "holds no hexahedra, but 1 triangle cell"),
        (HEAD + NODES.replace("\n3 ", "\n2 "), "has no section $Elements"),
        (HEAD + NODES.replace("\n3 ", "\n2 ") + "$Elements\n1\n1 5 0 1 2 4 3 5 6 8 7\n$EndElements\n", "node 2 is given twice"),
    ],
}  # fmt: skip


@pytest.mark.parametrize(
    ("name", "old", "new", "words"), [(name, *row) for name, rows in SPOILT.items() for row in rows]
)
def test_what_is_spoilt_in_a_sound_text_is_named(name, old, new, words, tmp_path):
    assert old in SOUND[name]
    assert_refused(tmp_path / name, words, SOUND[name].replace(old, new))


@pytest.mark.parametrize(("name", "text", "words"), [(name, *row) for name, rows in WHOLE.items() for row in rows])
def test_what_is_wrong_with_a_text_is_named(name, text, words, tmp_path):
    assert_refused(tmp_path / name, words, text)
