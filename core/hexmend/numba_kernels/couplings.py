"""Which free nodes share a hex: the pattern of a Hessian's 3 x 3 blocks above its diagonal, as compressed rows."""

from __future__ import annotations

import numba
import numpy as np

from hexmend.numba_kernels import CHUNK, parallel, serial

#: Pairs of corners of a hex, in the order 01, 02... 07, 12...
PAIRS = 28


@serial
def _row(i, node, slots, start, corners, row):
    """Write the slots above i that share a hex with it, ascending; returns how many."""
    size = 0
    for s in range(start[node], start[node + 1]):
        h = corners[s] // 8
        for c in range(8):
            v = slots[h, c]
            if v > i:
                j = size
                while j > 0 and row[j - 1] > v:
                    j -= 1
                if j == 0 or row[j - 1] != v:
                    for t in range(size, j, -1):
                        row[t] = row[t - 1]
                    row[j] = v
                    size += 1
    return size


@parallel
def rows(slots, nodes, start, corners):
    """Rows of the blocks above the diagonal.

    Parameters
    ----------
    slots : (m, 8) int32
        Slot of each corner, -1 if it is fixed.
    nodes : (k,) int32
        Node of each slot.
    start, corners
        `Topology.node_corners`.

    Returns
    -------
    row_start : (k + 1,) int32
    columns : (blocks,) int32
        Ascending within a row.
    """
    k, widest = nodes.size, 0
    for i in range(start.size - 1):
        widest = max(widest, start[i + 1] - start[i])
    row_start = np.zeros(k + 1, np.int32)
    chunks = (k + CHUNK - 1) // CHUNK
    for chunk in numba.prange(chunks):
        row = np.empty(7 * widest + 1, np.int32)
        for i in range(chunk * CHUNK, min(k, (chunk + 1) * CHUNK)):
            row_start[i + 1] = _row(i, nodes[i], slots, start, corners, row)
    for i in range(k):
        row_start[i + 1] += row_start[i]
    columns = np.empty(row_start[k], np.int32)
    for chunk in numba.prange(chunks):
        row = np.empty(7 * widest + 1, np.int32)
        for i in range(chunk * CHUNK, min(k, (chunk + 1) * CHUNK)):
            size = _row(i, nodes[i], slots, start, corners, row)
            for j in range(size):
                columns[row_start[i] + j] = row[j]
    return row_start, columns


@parallel
def targets(slots, row_start, columns, target):
    """Which block each pair of a hex's corners adds to; writes target (m, 28) int32.

    -1 where a corner is fixed, -2 - slot where both are one node: that node's own block.
    """
    m = slots.shape[0]
    for chunk in numba.prange((m + CHUNK - 1) // CHUNK):
        for h in range(chunk * CHUNK, min(m, (chunk + 1) * CHUNK)):
            pair = 0
            for a in range(8):
                for b in range(a + 1, 8):
                    low, high = min(slots[h, a], slots[h, b]), max(slots[h, a], slots[h, b])
                    target[h, pair] = -1
                    if low >= 0 and low == high:
                        target[h, pair] = -2 - low
                    elif low >= 0:
                        s = row_start[low]
                        while columns[s] != high:
                            s += 1
                        target[h, pair] = s
                    pair += 1


@serial
def split(part, row_start, columns):
    """Divide the slots into parts of consecutive ones, and the blocks into those inside a part and those across.

    Parameters
    ----------
    part : int
        Slots in a part.

    Returns
    -------
    inner_end : (k,) int32
        Where, in each row, the blocks inside its part end.
    across_start : (k + 1,) int32
    across_block, across_slot : (across_start[k],) int32
        For each slot, above and below the diagonal: the blocks across that it meets, and the slot at the other end.
    """
    k = row_start.size - 1
    inner_end, across_start = np.empty(k, np.int32), np.zeros(k + 1, np.int32)
    for i in range(k):
        end, s = (i // part + 1) * part, row_start[i + 1]
        while s > row_start[i] and columns[s - 1] >= end:
            s -= 1
            across_start[i + 1] += 1
            across_start[columns[s] + 1] += 1
        inner_end[i] = s
    for i in range(k):
        across_start[i + 1] += across_start[i]
    place = across_start[:-1].copy()
    across_block, across_slot = np.empty(across_start[k], np.int32), np.empty(across_start[k], np.int32)
    for i in range(k):
        for s in range(inner_end[i], row_start[i + 1]):
            j = columns[s]
            across_block[place[i]], across_slot[place[i]] = s, j
            place[i] += 1
            across_block[place[j]], across_slot[place[j]] = s, i
            place[j] += 1
    return inner_end, across_start, across_block, across_slot
