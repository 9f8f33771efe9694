"""Runs: set-up, worker thread, comparison and timeline."""
