"""Mend, the default method: untangling, shape optimum, max-min of the scaled Jacobian, return to the surface."""
