"""Targets of elements: the three lengths that each hex is to have, as given, of one size, or from a formula."""

from hexmend.target.builders import SPECIFICATIONS, make_target
from hexmend.target.sheets import given_lengths, recovered_lengths

__all__ = ["SPECIFICATIONS", "given_lengths", "make_target", "recovered_lengths"]
