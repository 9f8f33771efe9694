"""The process of a command: its signals and its terminal."""
