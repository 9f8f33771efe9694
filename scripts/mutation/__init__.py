"""Mutation testing: small faults are put into copies of the sources, and the tests should find each of them."""
