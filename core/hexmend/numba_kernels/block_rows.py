"""Rows of 3 x 3 blocks times vectors, as vector instructions, in the compiler's own language.

The compiler does not find them by itself: blocks lie 9 numbers apart, and what is to be added goes through indices.
Here a row of a block is one vector of four, the fourth belonging to the row behind it, or to nobody; it meets the
fourth number of a slot, which is 0 where it would be added, and counts nowhere else. Vectors by slots are therefore
(k, 4), and the array of blocks has one block more than it needs.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic
from numba.np.arrayobj import make_array

_INDEX, _INT = ir.IntType(64), ir.IntType(32)

#: Products and sums may be contracted to one rounding.
_CONTRACT = ("contract",)


class _Rows:
    """Writes code on vectors of four: of blocks in their array's type, of all else in that of the vectors by slots."""

    def __init__(self, context: Any, builder: ir.IRBuilder, blocks: types.Float, real: types.Float):
        self.context, self.builder = context, builder
        self.stored = ir.VectorType(context.get_value_type(blocks), 4)
        self.vector = ir.VectorType(context.get_value_type(real), 4)

    def data(self, kind: types.Array, value: ir.Value) -> ir.Value:
        """Where an array's numbers begin."""
        return make_array(kind)(self.context, self.builder, value).data

    def _at(self, data: ir.Value, index: ir.Value, kind: ir.VectorType) -> ir.Value:
        return self.builder.bitcast(self.builder.gep(data, [index]), kind.as_pointer())

    def load(self, data: ir.Value, index: ir.Value) -> ir.Value:
        """Four numbers of a vector by slots, from `index` on."""
        vector = self.builder.load(self._at(data, index, self.vector))
        vector.align = 4
        return vector

    def load_row(self, blocks: ir.Value, index: ir.Value) -> ir.Value:
        """Four numbers of the blocks."""
        row = self.builder.load(self._at(blocks, index, self.stored))
        row.align = 4
        return row if self.stored == self.vector else self.builder.fpext(row, self.vector)

    def store(self, vector: ir.Value, data: ir.Value, index: ir.Value) -> None:
        self.builder.store(vector, self._at(data, index, self.vector)).align = 4

    def add_product(self, a: ir.Value, b: ir.Value, to: ir.Value) -> ir.Value:
        product = self.builder.fmul(a, b, flags=_CONTRACT)
        return self.builder.fadd(to, product, flags=_CONTRACT)

    def spread(self, number: ir.Value) -> ir.Value:
        """A number, four times."""
        undefined = ir.Constant(self.vector, ir.Undefined)
        first = self.builder.insert_element(undefined, number, _INT(0))
        return self.builder.shuffle_vector(first, undefined, ir.Constant(ir.VectorType(_INT, 4), [0, 0, 0, 0]))

    def sum_of_three(self, vector: ir.Value) -> ir.Value:
        x, y, z = (self.builder.extract_element(vector, _INT(k)) for k in range(3))
        return self.builder.fadd(self.builder.fadd(x, y), z)

    def sums(self, count: int) -> list[ir.Value]:
        """Vectors to be added to, 0 at first."""
        zero = ir.Constant(self.vector, [0.0] * 4)
        return [cgutils.alloca_once_value(self.builder, zero) for _ in range(count)]

    def slot(self, columns: ir.Value, at: ir.Value) -> ir.Value:
        """Where the slot of block `at` begins in a vector."""
        column = self.builder.load(self.builder.gep(columns, [at]))
        return self.builder.mul(self.builder.zext(column, _INDEX), _INDEX(4))


@intrinsic
def times(typing: Any, off: types.Array, columns: types.Array, t: types.Array, begin: Any, end: Any) -> Any:
    """times(off, columns, t, begin, end): the sum of blocks begin to end, the last first, times t of their columns.

    Parameters
    ----------
    off : (blocks + 1, 9) float
    columns : (blocks,) int32
    t : (k, 4) float
        In the precision of the blocks, or in double precision.
    begin, end : int

    Returns
    -------
    x, y, z : float
    """
    signature = types.UniTuple(t.dtype, 3)(off, columns, t, types.int64, types.int64)

    def code(context: Any, builder: ir.IRBuilder, signature: Any, args: Sequence[ir.Value]) -> ir.Value:
        rows = _Rows(context, builder, signature.args[0].dtype, signature.args[2].dtype)
        blocks, slots, vector = (rows.data(signature.args[i], args[i]) for i in range(3))
        sums = rows.sums(3)
        last, before = builder.sub(args[4], _INDEX(1)), builder.sub(args[3], _INDEX(1))
        with cgutils.for_range_slice(builder, last, before, _INDEX(-1), _INDEX, inc=False) as (at, _):
            x, block = rows.load(vector, rows.slot(slots, at)), builder.mul(at, _INDEX(9))
            for k in range(3):
                row = rows.load_row(blocks, builder.add(block, _INDEX(3 * k)))
                builder.store(rows.add_product(row, x, builder.load(sums[k])), sums[k])
        return context.make_tuple(
            builder, signature.return_type, [rows.sum_of_three(builder.load(total)) for total in sums]
        )

    return signature, code


@intrinsic
def subtract_transposed(
    typing: Any,
    off: types.Array,
    columns: types.Array,
    w: types.Array,
    begin: Any,
    end: Any,
    x: types.Float,
    y: types.Float,
    z: types.Float,
) -> Any:
    """subtract_transposed(off, columns, w, begin, end, x, y, z): blocks begin to end, transposed, times (x, y, z),
    subtracted from w in the slots of their columns; arrays as in `times`.
    """
    real = w.dtype
    signature = types.void(off, columns, w, types.int64, types.int64, real, real, real)

    def code(context: Any, builder: ir.IRBuilder, signature: Any, args: Sequence[ir.Value]) -> ir.Value:
        rows = _Rows(context, builder, signature.args[0].dtype, signature.args[2].dtype)
        blocks, slots, vector = (rows.data(signature.args[i], args[i]) for i in range(3))
        minus = [rows.spread(builder.fneg(value)) for value in args[5:]]
        with cgutils.for_range_slice(builder, args[3], args[4], _INDEX(1), _INDEX) as (at, _):
            slot, block = rows.slot(slots, at), builder.mul(at, _INDEX(9))
            left = rows.load(vector, slot)
            for k in range(3):
                row = rows.load_row(blocks, builder.add(block, _INDEX(3 * k)))
                left = rows.add_product(row, minus[k], left)
            rows.store(left, vector, slot)
        return context.get_dummy_value()

    return signature, code
