"""A sample of mutants, spread over files by their lines."""

from __future__ import annotations

import random
from collections.abc import Mapping

from mutation.operators import Mutant, mutants, statements


def sample(sources: Mapping[str, str], count: int, seed: int) -> list[Mutant]:
    """Choose mutants at random.

    Parameters
    ----------
    sources : mapping
        Texts of files by their paths.
    count : int
        How many; each file has a share by the number of its statements.
    seed : int
        A larger `count` with the same seed keeps those of a smaller one, but for some that rounding moves.

    Returns
    -------
    list of Mutant
        In the order of the files.
    """
    drawn = {path: _drawn(path, text, seed) for path, text in sources.items()}
    sizes = {path: min(statements(text), len(drawn[path])) for path, text in sources.items()}
    return [mutant for path, share in _shares(sizes, count).items() for mutant in drawn[path][:share]]


def _shares(sizes: Mapping[str, int], count: int) -> dict[str, int]:
    """Whole numbers in proportion to `sizes` with the sum `count`; the greatest remainders are rounded up."""
    total = max(sum(sizes.values()), 1)
    exact = {path: count * size / total for path, size in sizes.items()}
    shares = {path: int(share) for path, share in exact.items()}
    by_remainder = sorted(exact, key=lambda path: shares[path] - exact[path])
    for path in by_remainder[: count - sum(shares.values())]:
        shares[path] += 1
    return shares


def _drawn(path: str, source: str, seed: int) -> list[Mutant]:
    """Every mutant of a file in a random order, no line twice before all others had their turn."""
    everything = mutants(path, source)
    random.Random(f"{seed} {path}").shuffle(everything)
    turns: dict[int, int] = {}
    ranked = []
    for place, mutant in enumerate(everything):
        turn = turns[mutant.first] = turns.get(mutant.first, -1) + 1
        ranked.append((turn, place, mutant))
    return [mutant for _, _, mutant in sorted(ranked, key=lambda one: one[:2])]
