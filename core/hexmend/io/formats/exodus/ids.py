"""Ids of blocks and sets, which solvers know them by: kept beside the mesh as lines such as "ns 100 inlet"."""

from __future__ import annotations

from collections.abc import Sequence

#: Field data that hold the lines: the sort, the id, and the name that the block or set has here.
IDS = "exodus:ids"


def kept(found: Sequence[tuple[str, int, str]]) -> dict[str, list[str]]:
    """Field data of (sort, id, name); nothing where the ids of every sort count from 1, as they would anyway."""
    sorts = dict.fromkeys(sort for sort, _, _ in found)
    counted = [(sort, k) for sort in sorts for k, _ in enumerate((one for one in found if one[0] == sort), 1)]
    if [(sort, number) for sort in sorts for one, number, _ in found if one == sort] == counted:
        return {}
    return {IDS: [f"{sort} {number} {name}" for sort, number, name in found]}


def ids_of(lines: object, sort: str, names: Sequence[str]) -> list[int]:
    """Ids for the blocks or sets of a sort: those of the lines, and unused ones for names that have none there.

    Examples
    --------
    >>> ids_of(["ns 100 inlet", "ss 7 wall"], "ns", ["new", "inlet"])
    [101, 100]
    >>> ids_of(None, "ns", ["a", "b"])
    [1, 2]
    """
    words = [line.split(" ", 2) for line in lines if isinstance(line, str)] if isinstance(lines, list | tuple) else []
    known: dict[str, list[int]] = {}
    for one in words:
        if len(one) == 3 and one[0] == sort and one[1].isdecimal() and 0 < int(one[1]) < 2**31:
            known.setdefault(one[2], []).append(int(one[1]))
    answer: list[int | None] = []
    taken: set[int] = set()
    for name in names:
        number = known[name].pop(0) if known.get(name) else None
        answer.append(None if number in taken else number)
        taken.update([number] if number else [])
    following = max(taken, default=0)
    if following + answer.count(None) >= 2**31:
        following = 0
    for k, number in enumerate(answer):
        if number is None:
            following += 1
            while following in taken:
                following += 1
            answer[k] = following
    return answer
