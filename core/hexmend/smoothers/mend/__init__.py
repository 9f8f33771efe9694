"""Mend, the default method: untangling, the optimum of shape, floors that rise, a boundary free within a tolerance."""
