"""The state of one window, its file and its recovery."""
