"""Valid arguments of every compiled kernel, on a small mesh.

A new kernel gets a row in one of the modules here, `row("family.kernel", q=m)`, and a new module is named in `ROWS`. A
whole number is the number of rows of an array of zeros, whose type the kernel's signature states. Arguments that many
kernels have, such as points and hexes, are in `common`. A kernel checks the length of every array but those named as

- `numbered`: other arrays hold numbers of its rows, which callers answer for;
- `listed`: a list of any length, as of chosen nodes, or the only array;
- `empty`: it may have no rows at all.

A method has the object that it is called `of`.
"""

from functools import cache

from tests.core.kernels.arguments import matrices, meshes, methods, surfaces, views
from tests.core.kernels.arguments.rows import Row

ROWS = meshes.rows, matrices.rows, methods.rows, surfaces.rows, views.rows


@cache
def arguments() -> dict[str, Row]:
    """A row for each kernel, by its name."""
    return {row.kernel: row for rows in ROWS for row in rows()}
