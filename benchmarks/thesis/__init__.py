"""The experiments of Chapter 4 of the thesis."""
