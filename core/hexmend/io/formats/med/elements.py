"""Geometric types of MED: their kinds, numbers and node order."""

#: Kind of cell of each geometric type that is read.
KIND_OF_TYPE = {
    "PO1": "vertex", "SE2": "line", "SE3": "line3", "TR3": "triangle", "TR6": "triangle6",
    "QU4": "quad", "QU8": "quad8", "QU9": "quad9", "TE4": "tetra", "T10": "tetra10", "PE6": "wedge", "P15": "wedge15",
    "PY5": "pyramid", "P13": "pyramid13", "HE8": "hex", "H20": "hex20", "H27": "hex27",
}  # fmt: skip
TYPE_OF_KIND = {kind: type for type, kind in KIND_OF_TYPE.items()}

#: Number of each geometric type (med_geometry_type).
GEOMETRY_NUMBERS = {
    "PO1": 1, "SE2": 102, "SE3": 103, "TR3": 203, "TR6": 206, "QU4": 204, "QU8": 208, "QU9": 209, "TE4": 304,
    "T10": 310, "PE6": 306, "P15": 315, "PY5": 305, "P13": 313, "HE8": 308, "H20": 320, "H27": 327,
}  # fmt: skip

#: Bit of each geometric type in the attribute LGC of a field, which lists the types that have values.
GEOMETRY_BITS = {
    "PO1": 0, "SE2": 1, "SE3": 2, "TR3": 4, "TR6": 6, "QU4": 5, "QU8": 8, "QU9": 9, "TE4": 10, "T10": 14, "PE6": 12,
    "P15": 17, "PY5": 11, "P13": 16, "HE8": 13, "H20": 19, "H27": 20,
}  # fmt: skip

_HEX20 = [0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17]
#: VTK's node order: vtk = med[ORDER[kind]]; MED goes round the lower face in the opposite direction.
ORDER = {
    "tetra": [0, 2, 1, 3], "tetra10": [0, 2, 1, 3, 6, 5, 4, 7, 9, 8],
    "pyramid": [0, 3, 2, 1, 4], "pyramid13": [0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10],
    "wedge": [0, 2, 1, 3, 5, 4], "wedge15": [0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13],
    "hex": _HEX20[:8], "hex20": _HEX20, "hex27": [*_HEX20, 21, 23, 24, 22, 20, 25, 26],
}  # fmt: skip
