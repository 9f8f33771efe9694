"""Physical groups of Gmsh's format: their numbers, by dimension and name."""

from __future__ import annotations

import re

#: Name of the field data that hold the lines of $PhysicalNames, so that groups keep their numbers.
PHYSICAL_NAMES = "gmsh:physical"
_LINE = re.compile(r'\s*(\d+)\s+(-?\d+)\s+"?(.*?)"?\s*\Z')
_UNNAMED = re.compile(r"physical (\d+)\Z")


def group_numbers(lines: object) -> dict[tuple[int, str], int]:
    """Number of each group by dimension and name.

    Parameters
    ----------
    lines : list of str
        Lines of $PhysicalNames, such as '2 1 "inlet"'; anything else gives no groups.
    """
    found = [_LINE.match(line) for line in lines if isinstance(line, str)] if isinstance(lines, list | tuple) else []
    return {(int(match[1]), match[3]): int(match[2]) for match in found if match}


def unnamed_group(number: int) -> str:
    """Name of the set that a group without a name becomes."""
    return f"physical {number}"


def unnamed_group_number(name: str) -> int | None:
    """Number of the group without a name that a set stands for; None for other sets."""
    found = _UNNAMED.match(name)
    return int(found[1]) if found else None
