"""Meshes with sets, sides, data and nodes of second order, and whether two are the same."""

import numpy as np
from hypothesis import strategies as st

from hexmend.gallery import make
from hexmend.mesh.cells import CELL_KINDS
from hexmend.mesh.mesh import Mesh
from tests.core.io.kept import assert_same, with_everything

GALLERY = [("cube", 27), ("five-side", 500), ("plane", 700), ("bridge-sharp", 500)]

_TYPES = (np.float64, np.float32, np.int64, np.int32, np.int8, np.uint8, np.uint64, bool)


def of_gallery(name: str, size: int) -> Mesh:
    """A mesh of the gallery without a name, which grids do not have."""
    return make(name, size=size).replace(name="")


def with_all_data(second_order: int = 8) -> Mesh:
    """A mesh with everything that formats carry, and arrays of many types."""
    mesh = with_everything(second_order)
    n, m = mesh.n_nodes, mesh.n_hexes
    pinned = np.zeros(n, bool)
    pinned[mesh.cells[-1].nodes] = pinned[mesh.cells[-2].nodes] = pinned[7] = True  # as readers do, and one more
    random = np.random.default_rng(3)
    return mesh.replace(
        pinned=pinned,
        cells=tuple(sorted(mesh.cells, key=lambda cells: list(CELL_KINDS).index(cells.kind))),
        node_data={
            **mesh.node_data,
            "velocity": random.normal(size=(n, 3)),
            "temperature": random.normal(size=n).astype(np.float32),
            "温度": np.arange(n, dtype=">i4"),
            "wet": random.random(n) > 0.5,
            "wave": random.normal(size=n) + 1j,
            "label": np.array([f"Knoten ä {k}" for k in range(n)]),
        },
        hex_data={**mesh.hex_data, "material": np.arange(m, dtype=np.int16), "stress": random.normal(size=(m, 6))},
        field_data={"names": ["Einlaß", "入口"], "step": np.array([1.0, 2.0])},
    )


@st.composite
def with_sets(draw: st.DrawFn) -> Mesh:
    """A mesh of the gallery with data of some type, and sets of any nodes, hexes and sides, none of them empty."""
    mesh = of_gallery(*draw(st.sampled_from(GALLERY[:2])))
    names = st.text(min_size=1, max_size=8, alphabet=st.characters(exclude_categories=["C"]))

    def sets(high: int) -> dict[str, np.ndarray]:
        members = st.sets(st.integers(0, high - 1), min_size=1, max_size=9)
        return {
            name: np.array(sorted(some)) for name, some in draw(st.dictionaries(names, members, max_size=3)).items()
        }

    sides = {name: np.column_stack(np.divmod(members, 6)) for name, members in sets(6 * mesh.n_hexes).items()}
    random = np.random.default_rng(draw(st.integers(0, 99)))
    pinned = random.random(mesh.n_nodes) > 0.8
    type = draw(st.sampled_from(_TYPES))
    return mesh.replace(
        node_sets=sets(mesh.n_nodes),
        hex_sets=sets(mesh.n_hexes),
        side_sets=sides,
        node_data={"values": random.integers(0, 99, (mesh.n_nodes, 3)).astype(type)},
        hex_data={"values": random.integers(0, 99, mesh.n_hexes).astype(type)},
        pinned=pinned if draw(st.booleans()) else None,
    )


def assert_round_trip(mesh: Mesh, back: Mesh) -> None:
    """Fail unless all of a mesh came back: data with their types, sets, fixed nodes, nodes of second order, texts."""
    assert_same(mesh, back, without=("ids",))
    np.testing.assert_array_equal(mesh.fixed, back.fixed)
    for field in ("node_data", "hex_data"):
        before, after = getattr(mesh, field), getattr(back, field)
        assert set(after) - set(before) <= {"fixed"}
        for name, values in before.items():
            np.testing.assert_array_equal(after[name], values, err_msg=name)
            assert after[name].dtype.newbyteorder("=") == values.dtype.newbyteorder("="), name
    assert set(mesh.field_data) == set(back.field_data)
    for name, values in mesh.field_data.items():
        np.testing.assert_array_equal(back.field_data[name], values)
        assert isinstance(back.field_data[name], type(values))
    for one, other in zip(mesh.cells, back.cells, strict=True):
        for name, values in one.data.items():
            np.testing.assert_array_equal(other.data[name], values)
