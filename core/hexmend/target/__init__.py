"""Targets of elements: the three lengths that each hex is to have, as given, of one size, or from a formula."""

from hexmend.target.builders import SPECIFICATIONS, make_target
from hexmend.target.edge_lengths import given_lengths
from hexmend.target.sheets import recovered_lengths

__all__ = ["SPECIFICATIONS", "given_lengths", "make_target", "recovered_lengths"]
