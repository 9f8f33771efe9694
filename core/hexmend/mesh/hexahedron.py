"""Reference hexahedron: numbering of corners, edges, faces and corner tetrahedra.

Corners are numbered as VTK_HEXAHEDRON numbers them, from 0 (the thesis's Table 2.1 counts from 1)::

            7 ----------- 6          z  y
           /|            /|          | /
          / |           / |          |/
         4 ----------- 5  |          0 --- x
         |  |          |  |
         |  3 ---------|- 2        corner 0 is the origin,
         | /           | /         1 lies along x, 3 along y, 4 along z
         |/            |/
         0 ----------- 1
"""

import numpy as np

#: Coordinates of the corners of the unit cube, (8, 3).
UNIT_CUBE = np.array(
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], dtype=np.float64
)

#: Corner tetrahedra (a, b, c, d), apex a first, (8, 4): the corner and its three edge neighbours, ordered so that
#: det[x_b-x_a, x_c-x_a, x_d-x_a] = +1 on the unit cube (Table 2.1 minus one; its row order is kept).
CORNER_TETRAHEDRA = np.array(
    [[0, 3, 4, 1], [1, 0, 5, 2], [2, 1, 6, 3], [3, 2, 7, 0], [4, 7, 5, 0], [5, 4, 6, 1], [6, 5, 7, 2], [7, 6, 4, 3]],
    dtype=np.int64,
)

#: The twelve edges, (12, 2): four along x, four along y, four along z.
EDGES = np.array(
    [[0, 1], [3, 2], [4, 5], [7, 6], [0, 3], [1, 2], [4, 7], [5, 6], [0, 4], [1, 5], [3, 7], [2, 6]], dtype=np.int64
)

#: The four diagonals through the inside, (4, 2).
DIAGONALS = np.array([[0, 6], [1, 7], [2, 4], [3, 5]], dtype=np.int64)

#: The six faces, (6, 4), each seen counter-clockwise from outside: x-, x+, y-, y+, z-, z+.
FACES = np.array([[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]], dtype=np.int64)

#: Permutation from the corners of VTK_VOXEL (type 11) to those of a hexahedron: hexahedron = voxel[VOXEL_ORDER].
VOXEL_ORDER = np.array([0, 1, 3, 2, 4, 5, 7, 6], dtype=np.int64)
