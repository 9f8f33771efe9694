"""Off-screen rendering."""
