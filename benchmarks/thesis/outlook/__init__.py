"""Variants of the methods that the thesis mentions in 3.2.2 and hopes for in 5.2, tried."""
