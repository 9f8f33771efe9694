"""Mend, the default method: untangling, then the optimum of shape or of the least scaled Jacobian."""
