"""Element types of CGNS: their kinds, and the order of their nodes and faces.

*The CGNS Standard Interface Data Structures*, section 3.3. A hex counts the nodes of its vertical edges before those of
its upper ones, and its faces are z-, y-, x+, y+, x-, z+::

    CGNS, from 1      9-12      13-16       17-20     21 22 23 24 25 26    27
    edges, faces      lower     vertical    upper     z- y- x+ y+ x- z+    inside
"""

import numpy as np

#: Kind and number of nodes of each ElementType_t that is read. A kind may have fewer nodes than its type: those of the
#: faces and the inside of pyramids and wedges are left out.
TYPES = {
    2: ("vertex", 1), 3: ("line", 2), 4: ("line3", 3), 5: ("triangle", 3), 6: ("triangle6", 6), 7: ("quad", 4),
    8: ("quad8", 8), 9: ("quad9", 9), 10: ("tetra", 4), 11: ("tetra10", 10), 12: ("pyramid", 5), 13: ("pyramid13", 14),
    14: ("wedge", 6), 15: ("wedge15", 15), 16: ("wedge15", 18), 17: ("hex", 8), 18: ("hex20", 20), 19: ("hex27", 27),
    21: ("pyramid13", 13),
}  # fmt: skip
#: Types of sections whose elements differ in their number of nodes or faces.
MIXED, NGON, NFACE = 20, 22, 23

#: VTK's node order: vtk = cgns[ORDER[kind]]; kinds without an entry have one order in both.
ORDER = {
    "hex20": np.array([*range(12), *range(16, 20), *range(12, 16)]),
    "hex27": np.array([*range(12), *range(16, 20), *range(12, 16), 24, 22, 21, 23, 20, 25, 26]),
    "wedge15": np.array([*range(9), 12, 13, 14, 9, 10, 11]),
    "pyramid13": np.arange(13),
}

#: Face, of `hexmend.mesh.hexahedron.FACES`, of a hex's faces 1 to 6.
FACE_OF_NUMBER = np.array([4, 2, 1, 3, 0, 5])
