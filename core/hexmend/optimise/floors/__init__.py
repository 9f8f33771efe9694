"""Raising the minimum scaled Jacobian and the least q(H) along a central path, and an optimum above such floors."""
